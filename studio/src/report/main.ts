// A report that opens from disk: the mesh with its cut and its histogram, what was found, checks, settings, times.
import '../style.css';
import './report.css';
import type { Box, Report, Vec3 } from '../core/protocol';
import { Theme } from '../theme';
import { el, icon } from '../ui/dom';
import { Viewport } from '../ui/viewport';
import * as words from '../ui/words';
import { kDefaults, kUnits, type ViewSettings } from '../state';
import { ModelView } from '../view/model_view';
import { Stage } from '../view/stage';
import { readReport, type ReportData } from './data';

function boxOf(...arrays: Float32Array[]): Box {
  const lo: Vec3 = [Infinity, Infinity, Infinity];
  const hi: Vec3 = [-Infinity, -Infinity, -Infinity];
  for (const array of arrays) array.forEach((x, i) => {
    if (!Number.isFinite(x)) return;
    lo[i % 3] = Math.min(lo[i % 3], x);
    hi[i % 3] = Math.max(hi[i % 3], x);
  });
  return { lo, hi };
}

function section(title: string, ...body: (Node | null)[]): HTMLElement | null {
  const there = body.filter((node): node is Node => node !== null);
  return there.length ? el('section', { class: 'panel' }, el('h2', {}, title), ...there) : null;
}

function list(sentences: words.Sentence[]): HTMLElement | null {
  return sentences.length ? el('ul', { class: 'report' }, ...sentences.map((s) => el('li', { class: s.tone }, s.text))) : null;
}

function table(rows: [string, string][]): HTMLElement | null {
  if (!rows.length) return null;
  return el('table', {}, el('tbody', {}, ...rows.map(([name, value]) => el('tr', {}, el('th', { scope: 'row' }, name), el('td', {}, value)))));
}

function checks(report: Partial<Report>): HTMLElement | null {
  const all = Object.entries(report.readiness?.checks ?? {});
  return table(all.map(([name, check]) => {
    const limit = check.at_least !== undefined ? `at least ${check.at_least}` : `at most ${check.at_most}`;
    return [name.replace(/_deg$/, ' (°)').replace(/_/g, ' '), `${check.value === null ? 'no number' : Number(check.value.toPrecision(4))}, ${limit}: ${check.passed ? 'passes' : `fails. ${words.sentence(check.advice)}`}`];
  }));
}

function settings(options: Record<string, unknown> | undefined): HTMLElement | null {
  const given = Object.entries(options ?? {}).filter(([, value]) => value !== null && value !== '');
  return table(given.map(([name, value]) => [name.replace(/_/g, ' '), Array.isArray(value) ? value.join(', ') : String(value)]));
}

function times(seconds: Record<string, number> | undefined): HTMLElement | null {
  const rows = Object.entries(seconds ?? {}).filter(([, s]) => s > 0);
  return table(rows.map(([stage, s]) => [stage.replace(/_/g, ' '), words.milliseconds(1000 * s)]));
}

function unitOf(metres: number): words.Unit {
  const known = Object.entries(kUnits).find(([, unit]) => unit.metres === metres && metres !== 1);
  return known ? known[0] as words.Unit : 'own';
}

function facts(data: ReportData): HTMLElement {
  const { report } = data;
  const options = report.options ?? {};
  // A mesh of cells or edges asked for no number of tets, so none can be missed.
  const tets = Number(options.tets ?? (options.vertices || options.edge || options.cells || options.cell_size ? report.lattice?.tet_count : kDefaults.tets));
  const unit = unitOf(data.metres_per_unit);
  const scaled = { tets, unit, cavities: options.cavities === 'keep' ? 'keep' as const : options.cavities === 'fill' ? 'fill' as const : 'auto' as const };
  const whole = report.pseudo_volume && report.grid && report.soup ? report as Report : null;
  const quality = report.quality as Report['quality'];
  const smoothing = whole?.lattice && report.readiness ? words.ofSmoothing(report as Report)
    : [{ tone: 'plain' as const, text: `${words.count(quality.tet_count, 'tet')}, angles from ${quality.min_dihedral_deg.toFixed(1)}° to ${quality.max_dihedral_deg.toFixed(1)}°.` }];
  return el('aside', { 'aria-label': 'What was found' }, ...[
    report.soup ? section('Soup', list(words.ofSoup(report.soup, unit))) : null,
    whole ? section('Volume', list(words.ofVolume(whole, scaled))) : null,
    whole?.lattice ? section('Lattice', list(words.ofLattice(whole, scaled))) : null,
    section('Mesh', list(smoothing)),
    section('Checks', checks(report)),
    section('Settings', settings(report.options)),
    section('Times', times(report.seconds)),
  ].filter((node): node is HTMLElement => node !== null));
}

function show(root: HTMLElement, data: ReportData): void {
  document.title = `${data.title}: tetsoup report`;
  const views = [...(data.surface ? [['soup', 'Soup'] as const] : []), ['tets', 'Tets'] as const, ...(data.surface ? [['surface', 'Surface'] as const] : [])];
  const quality = data.report.quality as Report['quality'];
  const refresh = () => {
    model.show(viewport.look, true);
    if (viewport.look.view === 'tets') viewport.showAngles(quality.dihedral_histogram, viewport.look.quality);
    else viewport.hideLegend();
  };
  let seen: ViewSettings = kDefaults;
  const none = () => undefined;
  const fit = () => stage.fit(model.box);
  const viewport = new Viewport({
    change: (part) => {
      seen = { ...seen, ...part };
      viewport.show(seen);
      refresh();
    },
    done: none, look: refresh, fit, pause: none, cancel: none, reset: none, stop: none,
  }, views);
  const theme = new Theme((dark) => {
    stage.setDark(dark);
    model.setPalette(dark);
    refresh();
  });
  root.append(
    el('header', {}, el('h1', {}, data.title), el('span', { class: 'model-name' }, `${words.count(quality.tet_count, 'tet')}, ${words.count(quality.vertex_count, 'vertex', 'vertices')}`),
      el('span', { class: 'gap' }), el('span', { class: 'model-name' }, `tetsoup ${data.version}`),
      el('button', { type: 'button', class: 'icon', 'aria-label': 'Switch between light and dark', title: 'Light or dark', onclick: () => theme.toggle() }, icon('theme'))),
    facts(data), viewport.element);
  const stage = new Stage(viewport.canvas, 'The mesh in 3D. Arrow keys turn it, plus and minus zoom.');
  const model = new ModelView(stage, none, none);
  const surface = data.surface ?? { vertices: new Float32Array(), triangles: new Uint32Array() };
  model.setSoup(surface, boxOf(data.mesh.vertices, surface.vertices));
  model.setFinal(data.mesh);
  stage.setUp({ x: 0, y: 1, z: 2 }[data.up] ?? 2);
  viewport.setStatus('');
  viewport.setModel(true);
  viewport.show(seen);
  theme.apply();
  stage.resize();
  fit();
  root.dataset.state = 'done';
}

const root = document.getElementById('app') as HTMLElement;
try {
  const data = readReport();
  if (data) show(root, data);
  else root.append(el('p', { class: 'card' }, 'This is the empty template of a report. Write one with: tetsoup mesh model.obj -o model.msh --report model.html'));
} catch (error) {
  root.append(el('p', { class: 'card', role: 'alert' }, `This report cannot be read: ${String(error)}. Write it again.`));
}
