// What lies over the picture: which view, which cut, the legend, the status.
import { gradient, kAngleStops, kBandColor, kVoteStops } from '../view/colors';
import { histogram } from '../view/histogram';
import type { Look } from '../view/model_view';
import type { Report, Slice } from '../core/protocol';
import type { View, ViewSettings } from '../state';
import { choice, type Control, slider, toggle } from './controls';
import { el, icon } from './dom';

const kViews: readonly (readonly [View, string])[] =
  [['soup', 'Soup'], ['votes', 'Votes'], ['lattice', 'Lattice'], ['tets', 'Tets'], ['surface', 'Surface']];
const kAxes = [['x', 'x'], ['y', 'y'], ['z', 'z']] as const;

/** Degrees that are said at the scale of angles, which goes from 10 to 60. */
const kAngleMarks = [10, 20, 40, 60];
/** Milliseconds of work after which there is a button to end it. */
const kSlow = 600;

export interface ViewportActions {
  change(part: Partial<ViewSettings>): void;
  /** A slider was let go. */
  done(): void;
  /** While playing, something else shall be drawn. */
  look(): void;
  fit(): void;
  pause(): void;
  cancel(): void;
  reset(): void;
  stop(): void;
}

export class Viewport {
  readonly canvas = el('div', { class: 'canvas' });
  readonly status = el('span', { class: 'status', role: 'status' });
  private readonly cancelButton = el('button', { type: 'button', id: 'cancel', hidden: true, onclick: () => this.actions.cancel() }, 'Cancel');
  private slow = 0;
  readonly legend = el('div', { class: 'card legend', hidden: true, 'aria-live': 'off' });
  readonly element: HTMLElement;
  readonly look: Look = { view: 'tets', edges: true, quality: false, ghost: false, clip: { on: false, axis: 0, position: 0.5, flip: false } };
  readonly cut = { axis: 1, position: 0.5 };
  private bindings: ((v: ViewSettings) => void)[] = [];
  private lastCut: 'x' | 'y' | 'z' = 'x';
  private readonly views: Control<View>;
  private readonly viewBar: HTMLElement;
  private readonly playBar: HTMLElement;
  private readonly pauseButton: HTMLButtonElement;
  private readonly cutTool: HTMLElement;
  private readonly clipTool: HTMLElement;
  private readonly clipRows: HTMLElement;
  private readonly flags = new Map<string, HTMLButtonElement>();
  playTets = false;

  /** @param beside  What stands beside the views, and what it opens. */
  constructor(private readonly actions: ViewportActions, views: readonly (readonly [View, string])[] = kViews,
              private readonly beside: { buttons: readonly HTMLElement[]; card: HTMLElement | null } = { buttons: [], card: null }) {
    this.views = choice({ id: 'view', label: 'View', hint: 'What is shown; also keys 1 to 5.', choices: views, change: (view) => actions.change({ view }) });
    this.viewBar = strip(this.views.element);
    const fit = el('button', { type: 'button', class: 'icon', title: 'Fit to view (F)', 'aria-label': 'Fit to view', onclick: () => actions.fit() }, icon('fit'));
    this.pauseButton = el('button', { type: 'button', id: 'pause', onclick: () => actions.pause() });
    this.setPaused(false);
    const shown = choice({ id: 'play-view', label: 'Shown while playing', hint: '', choices: [['surface', 'Surface'], ['tets', 'Tets']],
      change: (what: string) => {
        this.playTets = what === 'tets';
        actions.look();
      } });
    shown.show('surface');
    this.playBar = el('div', { class: 'play-bar', hidden: true }, strip(shown.element), this.pauseButton,
      el('button', { type: 'button', id: 'reset', 'aria-label': 'Reset', onclick: () => actions.reset() }, ...pictured('reset', 'Reset')),
      el('button', { type: 'button', id: 'back', 'aria-label': 'Back', onclick: () => actions.stop() }, ...pictured('close', 'Back')));
    this.cutTool = this.makeCutTool();
    [this.clipTool, this.clipRows] = this.makeClipTool();
    this.element = el('main', { class: 'without-model', id: 'model', 'aria-label': 'Model' }, this.canvas,
      el('div', { class: 'bar top' }, this.viewBar, this.playBar, fit, this.status, this.cancelButton, el('div', { class: 'beside', hidden: !beside.buttons.length }, ...beside.buttons)),
      beside.card,
      el('div', { class: 'bottom' }, el('div', {}, this.cutTool, this.clipTool), this.legend));
  }

  private makeCutTool(): HTMLElement {
    const position = slider({ id: 'slice', label: 'Place of the slice', hint: '', min: 0, max: 1, step: 0.005,
      change: (slice_at) => this.actions.change({ slice_at }), done: () => this.actions.done() });
    const axis = choice({ id: 'slice-axis', label: 'Slice across', hint: '', choices: kAxes, change: (slice) => this.actions.change({ slice }) });
    this.bindings.push((v) => position.show(v.slice_at), (v) => axis.show(v.slice));
    return el('div', { class: 'card tool', hidden: true }, el('div', { class: 'line' }, 'Slice across', strip(axis.element)), bare(position.element));
  }

  private makeClipTool(): [HTMLElement, HTMLElement] {
    const flag = (key: 'edges' | 'quality' | 'ghost', text: string, hint: string) => {
      const button = el('button', { type: 'button', title: hint, 'data-flag': key,
        onclick: () => this.actions.change({ [key]: button.getAttribute('aria-pressed') === 'true' ? 'off' : 'on' }) }, text);
      this.flags.set(key, button);
      this.bindings.push((v) => button.setAttribute('aria-pressed', String(v[key] === 'on')));
      return button;
    };
    const on = toggle({ id: 'clip', label: 'Cut away', hint: 'Hides whole tets on one side of a plane; teal faces lie inside. Key C.',
      change: (value) => this.actions.change({ cut: value ? this.lastCut : 'off' }) });
    const axis = choice({ id: 'clip-axis', label: 'Cut across', hint: '', choices: kAxes, change: (cut) => this.actions.change({ cut }) });
    const position = slider({ id: 'clip-position', label: 'Place of the cut', hint: '', min: 0, max: 1, step: 0.005,
      change: (cut_at) => this.actions.change({ cut_at }), done: () => this.actions.done() });
    const flip = el('button', { type: 'button', onclick: () => this.actions.change({ cut_side: this.look.clip.flip ? 'high' : 'low' }) }, 'Other side');
    this.bindings.push((v) => on.show(v.cut !== 'off'), () => axis.show(this.lastCut), (v) => position.show(v.cut_at),
      (v) => flip.setAttribute('aria-pressed', String(v.cut_side === 'low')));
    const rows = el('div', { class: 'tool-rows', hidden: true }, el('div', { class: 'line' }, strip(axis.element), flip), bare(position.element));
    const tool = el('div', { class: 'card tool', hidden: true },
      el('div', { class: 'flags' }, flag('edges', 'Edges', 'Draw the edges of tets and triangles'), flag('quality', 'Quality', 'Colour each tet by its smallest angle'),
        flag('ghost', 'Model', 'Show the model around the tets')), on.element, rows);
    return [tool, rows];
  }

  /** Cuts away, or no longer. */
  toggleCut(): void {
    this.actions.change({ cut: this.look.clip.on ? 'off' : this.lastCut });
  }

  show(v: ViewSettings): void {
    if (v.cut !== 'off') this.lastCut = v.cut;
    Object.assign(this.look, { view: v.view, edges: v.edges === 'on', quality: v.quality === 'on', ghost: v.ghost === 'on',
      clip: { on: v.cut !== 'off', axis: 'xyz'.indexOf(this.lastCut), position: v.cut_at, flip: v.cut_side === 'low' } });
    Object.assign(this.cut, { axis: 'xyz'.indexOf(v.slice), position: v.slice_at });
    this.views.show(v.view);
    this.bindings.forEach((binding) => binding(v));
    this.refresh();
  }

  private refresh(): void {
    const { view } = this.look;
    const playing = !this.playBar.hidden;
    const model = !this.element.classList.contains('without-model');
    this.cutTool.hidden = playing || !model || view !== 'votes';
    this.clipTool.hidden = playing || !model || view === 'votes';
    (this.flags.get('edges') as HTMLElement).hidden = view === 'surface' && !this.look.clip.on;
    (this.flags.get('quality') as HTMLElement).hidden = view !== 'tets' && view !== 'lattice';
    (this.flags.get('ghost') as HTMLElement).hidden = view !== 'tets' && view !== 'lattice';
    this.clipRows.hidden = !this.look.clip.on;
  }

  /** Whether the soup's edges can be drawn by what draws here. */
  setEdges(possible: boolean): void {
    const button = this.flags.get('edges') as HTMLButtonElement;
    button.disabled = !possible && this.look.view === 'soup';
    button.title = button.disabled ? 'So many edges need a graphics card' : 'Draw the edges of tets and triangles';
  }

  setModel(present: boolean): void {
    // On a phone the button that brought the model may be far down.
    if (present && this.element.classList.contains('without-model')) scrollTo(0, 0);
    this.element.classList.toggle('without-model', !present);
    this.refresh();
  }

  setPlaying(playing: boolean): void {
    this.playBar.hidden = !playing;
    this.viewBar.hidden = playing;
    this.beside.buttons.forEach((button) => button.parentElement?.toggleAttribute('hidden', playing));
    this.status.setAttribute('aria-live', playing ? 'off' : 'polite');
    this.refresh();
    if (playing) this.legend.hidden = true;
  }

  setPaused(paused: boolean): void {
    const name = paused ? 'Go on' : 'Pause';
    this.pauseButton.setAttribute('aria-label', name);
    this.pauseButton.replaceChildren(...pictured(paused ? 'play' : 'pause', name));
  }

  /** @param long  It may take so long that somebody wants it to end. */
  setStatus(text: string, busy = false, long = false): void {
    this.status.textContent = text;
    this.status.hidden = !text;
    this.status.classList.toggle('busy', busy);
    if (!long) {
      clearTimeout(this.slow);
      this.slow = 0;
      this.cancelButton.hidden = true;
    } else if (!this.slow) this.slow = setTimeout(() => (this.cancelButton.hidden = false), kSlow);
    // Screen readers say what came of it, not every step on the way.
    this.status.setAttribute('aria-busy', String(busy));
  }

  /** What the colours of the view stand for; nothing without a report. */
  showLegend(report: Report | null, slice: Slice | null, dark: boolean): void {
    const { view, quality } = this.look;
    if (report && view === 'votes') this.showVotes(slice, dark);
    else if (report && view === 'tets') this.showAngles(report.quality.dihedral_histogram, quality);
    else if (report && view === 'lattice') this.showAngles(report.lattice_quality.dihedral_histogram, quality);
    else this.hideLegend();
  }

  private showVotes(slice: Slice | null, dark: boolean): void {
    this.legend.hidden = slice === null;
    this.legend.classList.remove('histogram-only');
    if (!slice) return;
    const rays = slice.grid.rays || 26;
    this.legend.replaceChildren(
      el('strong', {}, 'Rays that say “inside”'),
      el('div', { class: 'scale', style: `background: ${gradient(kVoteStops[dark ? 'dark' : 'light'])}` }),
      el('div', { class: 'ends' }, el('span', {}, 'none: outside'), el('span', {}, `all ${rays}: inside`)),
      el('div', {}, el('span', { class: 'swatch', style: `background: ${kBandColor}` }), 'Near a triangle, by reach k'),
      el('div', {}, `Layer ${slice.layer + 1} of ${slice.grid.size[slice.axis]}`));
  }

  showAngles(bins: readonly number[], byQuality: boolean): void {
    this.legend.hidden = false;
    // On small screens there is room for a scale, but not for a histogram alone.
    this.legend.classList.toggle('histogram-only', !byQuality);
    const scale = [
      el('strong', {}, 'Smallest of each tet'),
      el('div', { class: 'scale', style: `background: ${gradient(kAngleStops)}` }),
      el('div', { class: 'ends exact' }, ...kAngleMarks.map((at) => el('span', { style: `left: ${2 * (at - 10)}%` }, `${at}°`))),
    ];
    this.legend.replaceChildren(el('div', { class: 'part' }, el('strong', {}, 'Angles between faces'), histogram(bins)),
      ...(byQuality ? [el('div', { class: 'part' }, ...scale)] : []));
  }

  hideLegend(): void {
    this.legend.hidden = true;
  }
}

/** A picture and a word, of which a phone shows the picture. */
function pictured(name: string, word: string): Node[] {
  return [icon(name), el('span', { class: 'wide' }, word)];
}

/** A choice without its label: the group says it to those who cannot see. */
function strip(control: HTMLElement): HTMLElement {
  const group = control.querySelector('.segments') as HTMLElement;
  return group;
}

/** A slider alone, named by its label. */
function bare(control: HTMLElement): HTMLElement {
  const range = control.querySelector('input[type=range]') as HTMLInputElement;
  range.setAttribute('aria-label', control.querySelector('label')?.textContent ?? '');
  range.removeAttribute('aria-describedby');
  return range;
}
