// Keys of the whole page; those of sliders, choices and the picture are their own.
import type { View } from '../state';

export interface KeyActions {
  undo(): void;
  redo(): void;
  fit(): void;
  view(view: View): void;
}

const kViews: readonly View[] = ['soup', 'votes', 'lattice', 'tets', 'surface'];

/** Whether a key is the text of a field, or chooses in a list. */
function types(target: EventTarget | null): boolean {
  return (target instanceof HTMLInputElement && !['range', 'radio', 'checkbox'].includes(target.type)) || target instanceof HTMLSelectElement;
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
      const view = kViews[Number(key) - 1];
      if (view) actions.view(view);
    }
  });
}
