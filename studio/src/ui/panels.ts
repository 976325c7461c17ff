// The panels at the side, in the order of the flow: each a few controls, and what came of them in plain words.
import type { Catalog, Report, SoupReport } from '../core/protocol';
import { heightOf, kDefaults, kSoftest, kStiffest, kUnits, type Settings, stiffnessOf, type Store } from '../state';
import { choice, type Control, select, slider, toggle } from './controls';
import { el } from './dom';
import * as words from './words';

export type PanelName = 'soup' | 'mesh' | 'simulation' | 'volume' | 'lattice' | 'smoothing' | 'embedding';

const kTitles: Record<PanelName, string> = {
  soup: 'Soup', mesh: 'Mesh', simulation: 'Material', volume: 'Volume', lattice: 'Lattice', smoothing: 'Smoothing', embedding: 'Embedding',
};
/** What few people turn; folded away until they do. */
const kAdvanced: readonly PanelName[] = ['volume', 'lattice', 'smoothing', 'embedding'];

export interface PanelActions {
  open(): void;
  sample(name: string): void;
  gizmo(mode: 'translate' | 'rotate' | null): void;
  embed(): void;
  showSurface(): void;
  play(scene: string | null): void;
}

interface Panel {
  element: HTMLDetailsElement;
  brief: HTMLElement;
  report: HTMLElement;
  body: HTMLElement;
}

export class Panels {
  readonly element = el('aside', { 'aria-label': 'Settings' });
  private readonly advanced = el('details', { class: 'advanced', id: 'panel-advanced' }, el('summary', {}, 'Advanced'));
  private readonly panels = new Map<PanelName, Panel>();
  private readonly bindings: ((s: Settings) => void)[] = [];
  private readonly gizmoButtons = new Map<string, HTMLButtonElement>();
  private readonly meshOnly: HTMLButtonElement[] = [];
  private readonly doubt = el('p', { class: 'doubt', role: 'status', hidden: true });

  constructor(private readonly store: Store, private readonly actions: PanelActions, catalog: Catalog) {
    for (const name of Object.keys(kTitles) as PanelName[]) this.addPanel(name);
    this.element.append(this.advanced);
    this.fillSoup(catalog);
    this.fillMesh();
    this.fillVolume();
    this.fillLattice();
    this.fillSmoothing();
    this.fillEmbedding();
    this.fillSimulation();
    this.element.append(el('div', { class: 'end' }, el('button', { type: 'button', id: 'reset-settings', onclick: () => this.resetSettings() }, 'Reset settings')),
      el('p', { class: 'about' }, `tetsoup ${catalog.version} · `,
      el('a', { href: 'licenses.txt', target: '_blank' }, 'Licences')));
    this.show(store.now);
  }

  /** As they were when the model came; the model stays, and so does the view. */
  private resetSettings(): void {
    const { sample, damage, file, up, unit, view, camera } = this.store.now;
    this.store.set({ ...kDefaults, sample, damage, file, up, unit, view, camera });
    this.store.endStep();
  }

  private addPanel(name: PanelName): void {
    const brief = el('span', { class: 'brief' });
    // What a slider did is said by the status line; only answers to a button are said here.
    const answers = name === 'embedding' || name === 'simulation';
    const report = el('ul', { class: 'report', 'data-report': name, 'aria-live': answers ? 'polite' : 'off' });
    const body = el('div', { class: 'body' }, report);
    const element = el('details', { class: 'panel', id: `panel-${name}`, open: true },
      el('summary', {}, kTitles[name], brief), body);
    this.panels.set(name, { element, brief, report, body });
    if (kAdvanced.includes(name)) this.advanced.append(element);
    else this.element.append(element);
  }

  private put(name: PanelName, ...elements: Node[]): void {
    const panel = this.panels.get(name) as Panel;
    elements.forEach((element) => panel.body.insertBefore(element, panel.report));
  }

  /** A control that shows one setting and changes it. */
  private bind<T>(control: Control<T>, read: (s: Settings) => T): HTMLElement {
    this.bindings.push((s) => control.show(read(s)));
    return control.element;
  }

  private number(key: 'voxels' | 'tets' | 'rho' | 'min_part' | 'min_angle' | 'passes' | 'damage' | 'density' | 'poisson',
                 o: { label: string; hint: string; min: number; max: number; step: number; most?: number; unit?: string; logarithmic?: boolean }): HTMLElement {
    return this.bind(slider({ id: key, ...o, change: (value) => this.store.set({ [key]: value }), done: () => this.store.endStep() }),
      (s) => s[key]);
  }

  private fillSoup(catalog: Catalog): void {
    const samples: (readonly [string, string])[] = [['', 'Choose a sample …'], ...catalog.samples.map((s) => [s.name, words.title(s.name)] as const)];
    const pick = this.bind(select({ id: 'sample', label: 'Sample', hint: 'Shapes made by formula, to try things with.', choices: samples,
      change: (name) => name && this.actions.sample(name) }), (s) => s.sample);
    const damage = this.number('damage', { label: 'Damage', unit: '%', min: 0, max: 80, step: 5,
      hint: 'Share of a sample’s triangles that is taken away at random, to see holes being closed.' });
    this.bindings.push((s) => (damage.hidden = !s.sample));
    this.put('soup', pick, el('button', { type: 'button', onclick: () => this.actions.open() }, 'Open a file …'), damage,
      el('div', { class: 'pair' }, this.bind(choice({ id: 'up', label: 'Up', hint: 'The axis of the model that points up: in the view, when it falls, and in files for engines.',
        choices: [['x', 'x'], ['y', 'y'], ['z', 'z']], change: (up) => this.store.set({ up }) }), (s) => s.up),
      this.bind(select({ id: 'unit', label: 'Unit', hint: 'What a length of 1 in the file means. Engines get metres.',
        choices: Object.entries(kUnits).map(([k, u]) => [k as Settings['unit'], u.label] as const),
        change: (unit) => this.store.set({ unit }) }), (s) => s.unit)), this.doubt);
  }

  private fillMesh(): void {
    this.put('mesh',
      this.number('tets', { label: 'Tets', min: 100, max: 20000, most: 500000, step: 1, logarithmic: true,
        hint: 'How many tetrahedra the mesh shall have; it has as many within 5 %.' }),
      this.number('voxels', { label: 'Voxels along the longest side', min: 16, max: 256, most: 2048, step: 8,
        hint: 'The grid on which inside and outside are decided. More see finer parts, and take longer; the tool alone takes 128.' }));
  }

  private fillVolume(): void {
    const k = slider({ id: 'k', label: 'Reach, k', min: 0.5, max: 1, step: 0.002, unit: '',
      hint: 'How far from a triangle a surface is still felt. 1 is the triangles alone; less bridges wider gaps between them, and thickens thin parts.',
      change: (value) => this.store.set({ k: value }), done: () => this.store.endStep() });
    this.put('volume',
      this.bind(toggle({ id: 'k-auto', label: 'Choose k for me', hint: 'Takes the k for which the rays agree best on what is inside.',
        change: (on) => this.store.set({ k: on ? null : this.lastK }) }), (s) => s.k === null),
      this.bind(k, (s) => s.k ?? this.lastK),
      this.bind(choice({ id: 'cavities', label: 'Enclosed space', hint: 'Space that the triangles enclose although rays call it outside, as where closed parts overlap.',
        choices: [['auto', 'By evidence'], ['fill', 'Fill'], ['keep', 'Leave hollow']], change: (cavities) => this.store.set({ cavities }) }), (s) => s.cavities));
    this.bindings.push((s) => k.enable(s.k !== null));
  }

  /** The k that was chosen automatically, from which a choice by hand begins. */
  private lastK = 0.98;
  private setAutomaticK(k: number): void {
    this.lastK = Number(k.toFixed(3));
    this.show(this.store.now);
  }

  private fillLattice(): void {
    this.put('lattice',
      this.bind(choice({ id: 'lattice', label: 'Lattice', hint: 'Cubes of five tets each, or body-centred cubes whose tets are all alike and rounder.',
        choices: [['five', 'Five a cube'], ['bcc', 'Body-centred']], change: (lattice) => this.store.set({ lattice }) }), (s) => s.lattice),
      this.number('rho', { label: 'Share that must be inside, ρ', min: 0.05, max: 1, step: 0.05,
        hint: 'A tet stays when this share of it lies inside. Less covers more space around the model.' }),
      this.number('min_part', { label: 'Smallest part', min: 0, max: 0.2, most: 0.99, step: 0.001,
        hint: 'Pieces with a smaller share of the volume are dropped; 0 keeps all.' }),
      this.bind(choice({ id: 'boundary_only', label: 'Tets without an inner vertex', hint: 'They make thin parts stiff. Split, each gets a vertex in its midst; removed, they leave notches.',
        choices: [['leave', 'Leave'], ['split', 'Split'], ['remove', 'Remove']], change: (boundary_only) => this.store.set({ boundary_only }) }), (s) => s.boundary_only),
      this.place());
  }

  private place(): HTMLElement {
    const mode = (name: 'translate' | 'rotate', text: string) => {
      const button = el('button', { type: 'button', 'aria-pressed': 'false', 'data-gizmo': name,
        onclick: () => this.setGizmo(button.getAttribute('aria-pressed') === 'true' ? null : name) }, text);
      this.gizmoButtons.set(name, button);
      return button;
    };
    const axes = (key: 'translate' | 'rotate', most: number, step: number, unit: string, hint: string) => [0, 1, 2].map((axis) =>
      this.bind(slider({ id: `${key}-${'xyz'[axis]}`, label: `${key === 'translate' ? 'Shift' : 'Turn'} ${'xyz'[axis]}`, hint, unit,
        min: -most, max: most, step, done: () => this.store.endStep(),
        change: (value) => {
          const next = [...this.store.now[key]] as Settings['translate'];
          next[axis] = value;
          this.store.set({ [key]: next });
        } }), (s) => s[key][axis]));
    return el('details', { class: 'sub', id: 'place' }, el('summary', {}, 'Place of the lattice'), el('div', { class: 'body' },
      el('div', { class: 'row' }, mode('translate', 'Move by hand'), mode('rotate', 'Turn by hand')),
      this.bind(toggle({ id: 'fit', label: 'Search the best place', hint: 'Tries shifts, turns and sizes of the lattice and takes the one that meets the shape best. Takes a few seconds.',
        change: (on) => this.store.set({ fit: on ? 'search' : 'off' }) }), (s) => s.fit === 'search'),
      ...axes('translate', 1, 0.02, 'cells', 'Shift of the lattice, in edges of its cells.'),
      ...axes('rotate', 90, 1, '°', 'Rotation of the lattice about x, then y, then z.')));
  }

  setGizmo(mode: 'translate' | 'rotate' | null): void {
    this.gizmoButtons.forEach((button, name) => button.setAttribute('aria-pressed', String(name === mode)));
    this.actions.gizmo(mode);
  }

  private fillSmoothing(): void {
    const strength = slider({ id: 'strength', label: 'Strength', min: 0.1, max: 2, step: 0.1,
      hint: 'How far a pass moves vertices. Where the boundary is drawn to the shape, the shape decides that.',
      change: (value) => this.store.set({ strength: value }), done: () => this.store.endStep() });
    this.bindings.push((s) => strength.enable(s.snap === 'off'));
    this.put('smoothing',
      this.number('passes', { label: 'Passes', min: 0, max: 30, most: 1000, step: 1, hint: 'How often the boundary is smoothed; 0 leaves the lattice as it is.' }),
      this.bind(toggle({ id: 'snap', label: 'Draw to the shape', hint: 'Draws the boundary to the surface of the inside. Off: it is only smoothed, and the lattice’s volume kept.',
        change: (on) => this.store.set({ snap: on ? 'on' : 'off' }) }), (s) => s.snap === 'on'),
      this.bind(strength, (s) => s.strength),
      this.number('min_angle', { label: 'No angle below', unit: '°', min: 0, max: 45, most: 59, step: 1,
        hint: 'Smoothing stops where an angle between two faces would fall below this.' }));
  }

  private fillEmbedding(): void {
    const hang = this.need(el('button', { type: 'button', id: 'hang', onclick: () => this.actions.embed() }, 'Check it'));
    const show = this.need(el('button', { type: 'button', onclick: () => this.actions.showSurface() }, 'Show it'));
    this.put('embedding', el('p', { class: 'unit' }, 'The model’s own surface hangs on the tets and follows them.'), el('div', { class: 'row' }, hang, show));
  }

  private fillSimulation(): void {
    const likeness = el('span', { class: 'unit' });
    const stiffness = slider({ id: 'stiffness', label: 'Stiffness', unit: 'kPa', min: 10 ** (kSoftest - 3), max: 10 ** (kStiffest - 3), most: 1e7, step: 0.1, logarithmic: true,
      hint: 'Young’s modulus: jelly has 10 kPa, rubber 1,000 or more. Until you choose one it is such that the body hardly sags. It holds while playing and in files for engines.',
      change: (value) => this.store.set({ stiffness: Number(Math.log10(1000 * value).toFixed(3)) }), done: () => this.store.endStep() });
    const now = (s: Settings) => stiffnessOf(s, this.height);
    this.bindings.push((s) => (likeness.textContent = words.likeWhat(10 ** now(s))));
    const robots = el('button', { type: 'button', id: 'robots', onclick: () => this.actions.play('robots-on-tree') }, 'Robots on a tree');
    this.put('simulation', el('div', { class: 'triple' }, this.bind(stiffness, (s) => Number((10 ** (now(s) - 3)).toPrecision(3))), likeness),
      this.number('density', { label: 'Density', unit: 'kg/m³', min: 20, max: 10000, most: 100000, step: 1, logarithmic: true,
        hint: 'Mass of a cubic metre: foam has 50, water 1,000, steel 7,800.' }),
      this.number('poisson', { label: 'Poisson ratio', min: 0, max: 0.49, step: 0.01,
        hint: 'How much it grows aside when it is squeezed: cork 0, most materials 0.3 to 0.4, rubber 0.49, which keeps its volume.' }), robots);
  }

  private need(button: HTMLButtonElement): HTMLButtonElement {
    button.disabled = true;
    this.meshOnly.push(button);
    return button;
  }

  /** Whether there is a finished mesh to work on. */
  setReady(mesh: boolean): void {
    this.meshOnly.forEach((button) => (button.disabled = !mesh));
    this.gizmoButtons.forEach((button) => (button.disabled = !mesh));
  }

  /** Of the model, metres. */
  private height = 1;
  private body: readonly words.Sentence[] = [];
  private reportBody(report: Report): void {
    this.body = report.quality.tet_count ? words.ofBody(report, this.store.now) : [];
    this.reportPlay([]);
  }

  /** What falls, and how it plays. */
  reportPlay(played: readonly words.Sentence[]): void {
    this.report('simulation', words.pascals(10 ** stiffnessOf(this.store.now, this.height)), [...this.body, ...played]);
  }

  /** Asks whether a size that is unlikely is meant. */
  private showDoubt(soup: SoupReport | null): void {
    const doubt = soup && words.ofDoubt(soup.box, this.store.now.unit);
    this.doubt.hidden = !doubt;
    if (doubt) this.doubt.replaceChildren(doubt.text, el('button', { type: 'button', onclick: () => this.store.set({ unit: doubt.unit }) }, doubt.ask));
  }

  clear(): void {
    this.showDoubt(null);
    this.body = [];
    for (const name of this.panels.keys()) this.report(name, '', []);
  }

  show(s: Settings): void {
    this.bindings.forEach((binding) => binding(s));
  }

  /** What came of the soup, and of its mesh as far as there is one. */
  showReports(soup: SoupReport, report: Report | null): void {
    const { now } = this.store;
    this.showDoubt(soup);
    this.height = heightOf(soup.box, now);
    this.show(now);
    this.report('soup', words.count(soup.used_triangles, 'triangle'), words.ofSoup(soup, now.unit));
    if (!report) return;
    const { pseudo_volume, lattice, quality } = report;
    if (pseudo_volume.automatic && now.k === null) this.setAutomaticK(pseudo_volume.k);
    this.report('mesh', words.count(lattice.tet_count, 'tet'), words.ofMesh(report, now));
    this.reportBody(report);
    this.report('volume', `k = ${pseudo_volume.k.toFixed(3)}`, words.ofVolume(report, now));
    this.report('lattice', '', words.ofLattice(report, now));
    const angles = quality.tet_count ? `${quality.min_dihedral_deg.toFixed(0)}° to ${quality.max_dihedral_deg.toFixed(0)}°` : '';
    this.report('smoothing', angles, words.ofSmoothing(report));
  }

  report(name: PanelName, brief: string, sentences: readonly words.Sentence[]): void {
    const panel = this.panels.get(name) as Panel;
    panel.brief.textContent = brief;
    panel.report.replaceChildren(...sentences.map((s) => el('li', { class: s.tone }, s.text)));
  }
}
