// The line at the top: open, what is open, undo, link, light or dark, export.
import { el, icon } from './dom';

export interface HeaderActions {
  open(): void;
  undo(): void;
  redo(): void;
  copyLink(): void;
  toggleTheme(): void;
  export(): void;
  help(): void;
}

export class Header {
  readonly element: HTMLElement;
  private readonly name = el('span', { class: 'model-name' });
  private readonly undo: HTMLButtonElement;
  private readonly redo: HTMLButtonElement;
  private readonly export: HTMLButtonElement;

  constructor(actions: HeaderActions) {
    const button = (name: string, title: string, label: string, action: () => void) =>
      el('button', { type: 'button', class: 'icon', title, 'aria-label': label, onclick: action }, icon(name));
    this.undo = button('undo', 'Undo (Ctrl+Z)', 'Undo', () => actions.undo());
    this.redo = button('redo', 'Redo (Ctrl+Y)', 'Redo', () => actions.redo());
    this.export = el('button', { type: 'button', class: 'primary', id: 'export', onclick: () => actions.export() }, icon('save'), 'Export');
    this.element = el('header', {}, el('h1', {}, 'tetsoup ', el('small', {}, 'studio')),
      el('button', { type: 'button', 'aria-label': 'Open a model', onclick: () => actions.open() }, icon('open'), el('span', { class: 'wide' }, 'Open')),
      this.name, el('span', { class: 'gap' }), this.undo, this.redo,
      button('link', 'Copy a link to this mesh', 'Copy a link to this mesh', () => actions.copyLink()),
      el('button', { type: 'button', class: 'icon wide', title: 'Keys (?)', 'aria-label': 'Keys', onclick: () => actions.help() }, '?'),
      button('theme', 'Light or dark', 'Switch between light and dark', () => actions.toggleTheme()), this.export);
    this.setHistory(false, false);
    this.setModel('');
  }

  setHistory(canUndo: boolean, canRedo: boolean): void {
    this.undo.disabled = !canUndo;
    this.redo.disabled = !canRedo;
  }

  /** The name of what is open; without one there is nothing to export. */
  setModel(name: string): void {
    this.name.textContent = name;
    this.export.disabled = !name;
  }
}
