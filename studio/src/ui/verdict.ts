// Whether the mesh is good for simulation: one word beside the views, and behind it what is to look at, and what helps.
import type { Accuracy, Report } from '../core/protocol';
import type { Settings } from '../state';
import { canShow } from '../view/problems';
import { type Checked, checksOf, notesOf } from './checks';
import { el, icon } from './dom';
import * as words from './words';

export interface VerdictActions {
  apply(change: Partial<Settings>): void;
  /** Shows in the view what a check is about, and says how much that is; null: nothing. */
  mark(check: Checked | null): string;
  opened(): void;
}

export class Verdict {
  readonly chip = el('button', { type: 'button', id: 'verdict', class: 'chip', hidden: true, 'aria-expanded': 'false', 'aria-controls': 'verdict-card', onclick: () => this.toggle() });
  readonly card = el('section', { class: 'card verdict', id: 'verdict-card', 'aria-label': 'Is it good for simulation?', tabindex: -1, hidden: true });
  private readonly accuracy = el('li', { class: 'plain', hidden: true });
  private marked: string | null = null;
  private checks: Checked[] = [];

  constructor(private readonly actions: VerdictActions) {}

  get open(): boolean {
    return !this.card.hidden;
  }

  toggle(open = !this.open): void {
    this.card.hidden = !open;
    this.chip.setAttribute('aria-expanded', String(open));
    if (!open && this.marked) this.mark(null);
    if (open) this.actions.opened();
  }

  /** Without a report nothing is known yet. */
  show(report: Report | null, s: Settings): void {
    this.chip.hidden = !report;
    if (!report) {
      this.checks = [];
      return this.toggle(false);
    }
    this.checks = checksOf(report, s);
    const failed = this.checks.filter((check) => !check.passed);
    const passed = this.checks.filter((check) => check.passed);
    const word = failed.length ? `${failed.length} to look at` : 'Ready';
    this.chip.replaceChildren(word);
    this.chip.className = failed.length ? 'chip watch' : 'chip good';
    this.accuracy.hidden = true;
    const focused = this.card.contains(document.activeElement);
    this.card.replaceChildren(
      el('div', { class: 'line' }, el('h2', {}, failed.length ? `${failed.length} to look at` : 'Ready for simulation'),
        el('button', { type: 'button', class: 'icon plain', 'aria-label': 'Close', onclick: () => this.close() }, icon('close'))),
      ...failed.map((check) => this.problem(check)),
      el('ul', { class: 'report' }, this.accuracy, ...this.remarks(report).map((text) => el('li', { class: 'plain' }, text))),
      el('details', { class: 'sub' }, el('summary', {}, `${words.count(passed.length, 'check passes', 'checks pass')}`),
        el('dl', {}, ...passed.flatMap((check) => [el('dt', {}, check.title), el('dd', {}, check.found)]))));
    if (focused) this.card.focus();
    this.mark(failed.find((check) => check.name === this.marked)?.name ?? null);
  }

  private remarks(report: Report): string[] {
    const { fidelity: f } = report;
    const said: string[] = [];
    if (f.closed && f.soup_volume > 0) said.push(`The mesh has ${Number(f.volume_ratio.toPrecision(3))} times the model’s volume.`);
    if (f.soup_pieces > 1 || f.mesh_pieces > 1) said.push(`${words.count(f.mesh_pieces, 'piece')} for ${words.count(f.soup_pieces, 'piece')} of the model.`);
    return [...said, ...notesOf(report)];
  }

  private problem(check: Checked): HTMLElement {
    const show = canShow(check.name) && el('button', { type: 'button', 'data-show': check.name, 'aria-pressed': 'false',
      onclick: () => this.mark(this.marked === check.name ? null : check.name) }, 'Show');
    return el('section', { class: 'check', 'data-check': check.name }, el('h3', {}, check.title), el('p', { class: 'found' }, check.found), el('p', {}, check.why), el('p', { class: 'marked', role: 'status' }),
      el('div', { class: 'row' }, show, ...check.fixes.map((fix) => el('button', { type: 'button', 'data-fix': Object.keys(fix.change).join(), onclick: () => this.actions.apply(fix.change) }, fix.label))));
  }

  private mark(name: string | null): void {
    this.marked = name;
    this.card.querySelectorAll<HTMLElement>('[data-show]').forEach((button) => button.setAttribute('aria-pressed', String(button.dataset.show === name)));
    const text = this.actions.mark(this.checks.find((check) => check.name === name) ?? null);
    this.card.querySelectorAll<HTMLElement>('[data-check]').forEach((check) => {
      (check.querySelector('.marked') as HTMLElement).textContent = check.dataset.check === name ? text : '';
    });
  }

  showAccuracy({ iou_pseudo_volume, boundary_distance_edges: { mean, percentile95 } }: Accuracy): void {
    this.accuracy.hidden = false;
    this.accuracy.textContent = `${Math.round(100 * iou_pseudo_volume)} % overlap with the voxels inside; the surface is off by ${mean.toFixed(2)} edges of a tet on average, by less than ${percentile95.toFixed(2)} for 95 % of it.`;
  }

  close(): void {
    this.toggle(false);
    this.chip.focus();
  }
}
