// Keys of the whole page, and the list of them; those of sliders, choices and the picture are their own.
import type { View } from '../state';
import { el } from './dom';

export interface KeyActions {
  undo(): void;
  redo(): void;
  fit(): void;
  view(view: View): void;
  turn(): void;
  cut(): void;
  quality(): void;
  /** Drops the body, or holds it and lets it go on. */
  play(): void;
  reset(): void;
  /** One step back: out of a card, a handle, or the play. */
  leave(): void;
  help(): void;
}

const kList: readonly (readonly [string, string])[] = [
  ['1 to 5', 'Soup, votes, lattice, tets, surface'], ['F', 'All in the picture'], ['T', 'Turn another axis up'], ['C', 'Cut away'], ['Q', 'Colour tets by quality'],
  ['Space', 'Drop it; then pause and go on'], ['R', 'While playing: begin again'], ['Esc', 'Close, or back from playing'],
  ['Ctrl+Z, Ctrl+Y', 'Undo, redo'], ['Arrows, + and −', 'In the picture: turn, come closer, go away'], ['?', 'This list'],
];

export function keysDialog(): HTMLDialogElement {
  const dialog = el('dialog', { id: 'keys', 'aria-labelledby': 'keys-title' },
    el('h2', { id: 'keys-title' }, 'Keys'),
    el('dl', { class: 'keys' }, ...kList.flatMap(([key, what]) => [el('dt', {}, el('kbd', {}, key)), el('dd', {}, what)])),
    el('div', { class: 'buttons' }, el('button', { type: 'button', onclick: () => dialog.close() }, 'Close')));
  return dialog;
}

const kViews: readonly View[] = ['soup', 'votes', 'lattice', 'tets', 'surface'];

/** Whether a key is the text of a field, or chooses in a list. */
function types(target: EventTarget | null): boolean {
  return (target instanceof HTMLInputElement && !['range', 'radio', 'checkbox'].includes(target.type)) || target instanceof HTMLSelectElement;
}

/** What a space presses already. */
function presses(target: EventTarget | null): boolean {
  return target instanceof Element && target.closest('button, input, select, summary, a') !== null;
}

export function listenToKeys(actions: KeyActions): void {
  addEventListener('keydown', (event) => {
    if (types(event.target) || document.querySelector('dialog[open]')) return;
    const key = event.key.toLowerCase();
    if (event.ctrlKey || event.metaKey) {
      if (key === 'z' && event.shiftKey || key === 'y') actions.redo();
      else if (key === 'z') actions.undo();
      else return;
      event.preventDefault();
    } else if (!event.altKey) {
      if (key === 'f') actions.fit();
      if (key === 't') actions.turn();
      if (key === 'c') actions.cut();
      if (key === 'q') actions.quality();
      if (key === 'r') actions.reset();
      if (key === 'escape') actions.leave();
      if (key === '?') actions.help();
      if (key === ' ' && !presses(event.target)) {
        actions.play();
        event.preventDefault();
      }
      const view = kViews[Number(key) - 1];
      if (view) actions.view(view);
    }
  });
}
