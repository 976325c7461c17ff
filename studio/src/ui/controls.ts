// Sliders, choices and switches: labelled, reachable by keyboard, with a sentence that explains them.
import { el } from './dom';

let unique = 0;

export interface Control<T> {
  element: HTMLElement;
  show(value: T): void;
  enable(on: boolean): void;
}

interface Common {
  id: string;
  label: string;
  /** What it does, in a sentence; the button behind the label shows it. */
  hint: string;
}

/** What has a name, a question mark that explains it, and perhaps a value in the same line. */
function labelled(common: Common, target: string, value: Node | null, ...body: Node[]): HTMLElement {
  return explained(common, target, el('label', { for: target }, common.label), value, ...body);
}

function explained(common: Common, target: string, name: Node, value: Node | null, ...body: Node[]): HTMLElement {
  const hintId = `${target}-hint`;
  const hint = el('p', { class: 'hint', id: hintId, hidden: true }, common.hint);
  const more = el('button', {
    type: 'button', class: 'more', 'aria-label': `What is “${common.label}”?`, 'aria-expanded': 'false',
    'aria-controls': hintId, title: common.hint,
    onclick: () => {
      hint.hidden = !hint.hidden;
      more.setAttribute('aria-expanded', String(!hint.hidden));
    },
  }, '?');
  return el('div', { class: 'control' },
    el('div', { class: 'control-head' }, name, more, value), ...body, hint);
}

export interface SliderOptions extends Common {
  min: number;
  max: number;
  step: number;
  unit?: string;
  /** The number may be typed beyond the slider's ends, up to here. */
  most?: number;
  /** From the slider's travel to the value: many values span powers of ten. */
  logarithmic?: boolean;
  change(value: number): void;
  done(): void;
}

const kTravel = 1000;

export function slider(o: SliderOptions): Control<number> {
  const id = `${o.id}-${++unique}`;
  const log = o.logarithmic;
  const round = (x: number) => {
    const step = log ? (x < 1000 ? 10 : 50) * (o.step || 1) : o.step;
    return Number((Math.round(x / step) * step).toFixed(6));
  };
  const fromTravel = (t: number) => round(log ? o.min * (o.max / o.min) ** (t / kTravel) : t);
  const toTravel = (x: number) => (log ? (kTravel * Math.log(x / o.min)) / Math.log(o.max / o.min) : x);
  const range = el('input', {
    type: 'range', id, 'data-control': o.id, 'aria-describedby': `${id}-hint`,
    min: log ? 0 : o.min, max: log ? kTravel : o.max, step: log ? 1 : o.step,
    oninput: () => {
      const value = fromTravel(Number(range.value));
      write(value);
      o.change(value);
    },
    onchange: () => o.done(),
  });
  const number = el('input', {
    type: 'number', class: 'number', 'aria-label': `${o.label}, as a number`, min: o.min, max: o.most ?? o.max, step: log ? 1 : o.step,
    onchange: () => {
      const value = Math.min(o.most ?? o.max, Math.max(o.min, Number(number.value)));
      if (number.value === '' || !Number.isFinite(value)) return;
      show(value);
      o.change(value);
      o.done();
    },
  });
  const write = (value: number) => {
    number.value = String(value);
    range.setAttribute('aria-valuetext', `${value}${o.unit ? ' ' + o.unit : ''}`);
    range.style.setProperty('--filled', `${(100 * (Number(range.value) - Number(range.min))) / (Number(range.max) - Number(range.min))}%`);
  };
  const show = (value: number) => {
    range.value = String(toTravel(value));
    write(value);
  };
  const unit = o.unit ? el('span', { class: 'unit' }, o.unit) : null;
  const value = el('span', { class: 'value' }, number, unit);
  return {
    element: labelled(o, id, value, range),
    show,
    enable: (on) => (range.disabled = number.disabled = !on),
  };
}

export interface ChoiceOptions<T extends string> extends Common {
  choices: readonly (readonly [T, string])[];
  change(value: T): void;
}

/** A few values side by side. */
export function choice<const T extends string>(o: ChoiceOptions<T>): Control<T> {
  const id = `${o.id}-${++unique}`;
  const inputs = o.choices.map(([value, text]) => {
    const input = el('input', { type: 'radio', name: id, value, 'data-control': o.id,
      onchange: () => o.change(value) });
    return { value, input, label: el('label', {}, input, el('span', {}, text)) };
  });
  const group = el('div', { class: 'segments', role: 'radiogroup', 'aria-label': o.label }, ...inputs.map((i) => i.label));
  return {
    element: explained(o, id, el('span', { class: 'name' }, o.label), null, group),
    show: (value) => inputs.forEach((i) => (i.input.checked = i.value === value)),
    enable: (on) => inputs.forEach((i) => (i.input.disabled = !on)),
  };
}

export function select<const T extends string>(o: ChoiceOptions<T>): Control<T> {
  const id = `${o.id}-${++unique}`;
  const input = el('select', { id, 'data-control': o.id, onchange: () => o.change(input.value as T) },
    ...o.choices.map(([value, text]) => el('option', { value }, text)));
  return {
    element: labelled(o, id, null, input),
    show: (value) => (input.value = value),
    enable: (on) => (input.disabled = !on),
  };
}

export function toggle(o: Common & { change(on: boolean): void }): Control<boolean> {
  const id = `${o.id}-${++unique}`;
  const input = el('input', { type: 'checkbox', id, class: 'switch', role: 'switch', 'data-control': o.id,
    onchange: () => o.change(input.checked) });
  return {
    element: labelled(o, id, input),
    show: (value) => (input.checked = value),
    enable: (on) => (input.disabled = !on),
  };
}
