// Takes the mesh away: as a file of any format, or as what an engine wants; several files come in one zip.
import { zipSync } from 'fflate';
import type { Catalog, OutFile } from '../core/protocol';
import { el } from './dom';

export interface ExportChoice {
  /** Of all files, without an extension. */
  stem: string;
  name: string;
  format?: string;
  engine?: string;
}

export class ExportDialog {
  readonly element: HTMLDialogElement;
  private readonly name = el('input', { type: 'text', id: 'export-name', spellcheck: 'false', autocomplete: 'off' });
  private readonly what: HTMLSelectElement;
  private readonly note = el('p', { class: 'note', role: 'status' });
  private readonly save = el('button', { type: 'submit', class: 'primary', id: 'export-save' }, 'Download');

  constructor(private readonly catalog: Catalog, onExport: (choice: ExportChoice) => void, onPicture: () => void,
              onRecipe: (choice: ExportChoice, language: 'command' | 'python') => void) {
    const group = (label: string, prefix: string, rows: { name: string; title?: string; summary: string }[]) => {
      const options = rows.map((row) => el('option', { value: `${prefix}:${row.name}` }, row.title ?? row.summary));
      const element = el('optgroup', { label }, ...options);
      return element;
    };
    this.what = el('select', { id: 'export-what', onchange: () => this.describe() },
      group('Files', 'format', catalog.formats), group('Engines, with a scene where there is one', 'engine', catalog.engines));
    const form = el('form', { method: 'dialog', onsubmit: (event) => {
      event.preventDefault();
      onExport(this.choice());
    } },
      el('h2', { id: 'export-title' }, 'Export'),
      el('div', { class: 'field' }, el('label', { for: 'export-what' }, 'As'), this.what),
      el('div', { class: 'field' }, el('label', { for: 'export-name' }, 'Name'), this.name),
      el('div', { class: 'recipes' }, el('span', {}, 'The same without this page:'),
        el('button', { type: 'button', id: 'copy-command', onclick: () => onRecipe(this.choice(), 'command') }, 'Copy as command'),
        el('button', { type: 'button', id: 'copy-python', onclick: () => onRecipe(this.choice(), 'python') }, 'Copy as Python')),
      this.note,
      el('div', { class: 'buttons' },
        el('button', { type: 'button', id: 'export-picture', onclick: onPicture }, 'Picture of the view'),
        el('button', { type: 'button', onclick: () => this.element.close() }, 'Close'), this.save));
    this.element = el('dialog', { 'aria-labelledby': 'export-title' }, form);
  }

  open(name: string): void {
    this.name.value = name;
    this.describe();
    this.element.showModal();
  }

  /** Whether there is a mesh to be saved. */
  setReady(ready: boolean): void {
    this.save.disabled = !ready;
  }

  private choice(): ExportChoice {
    const [kind, value] = this.what.value.split(':');
    const rows = kind === 'engine' ? this.catalog.engines : this.catalog.formats;
    const extension = rows.find((row) => row.name === value)?.extension ?? '';
    // Names become files of other systems, too; what follows a dot would be taken for an extension.
    const stem = this.name.value.replace(/[^\p{L}\p{N}_-]+/gu, '_').replace(/^_+$/, '') || 'mesh';
    const name = kind === 'engine' ? stem : stem + extension;
    return { stem, name, [kind]: value };
  }

  private describe(): void {
    const [kind, value] = this.what.value.split(':');
    const rows = kind === 'engine' ? this.catalog.engines : this.catalog.formats;
    const summary = rows.find((row) => row.name === value)?.summary ?? '';
    // Formats are named by their summary.
    this.note.textContent = kind === 'engine' ? `${summary}. Lengths are written in metres, by the unit of the soup.` : '';
  }

  done(stem: string, files: OutFile[], usage: string): void {
    const names = files.map((file) => file.name).join(', ');
    const saved = files.length === 1 ? `Saved ${names}. ` : `Saved ${stem}.zip with ${names}. `;
    const next = files.length === 1 ? 'Next: ' : 'Next, where you unpacked it: ';
    this.note.replaceChildren(saved, ...(usage ? [next, el('code', {}, usage)] : []));
  }

  /** A text that was copied, or that is there to be copied by hand. */
  recipe(text: string, copied: boolean): void {
    this.note.replaceChildren(copied ? 'Copied:' : 'Copy this:', el('pre', {}, text));
  }

  failed(text: string): void {
    this.note.textContent = text;
  }
}

export function download(name: string, content: Blob): void {
  const address = URL.createObjectURL(content);
  const link = el('a', { href: address, download: name });
  document.body.append(link);
  link.click();
  link.remove();
  // Browsers read the address after this function has ended.
  setTimeout(() => URL.revokeObjectURL(address), 10000);
}

export function downloadFiles(stem: string, files: OutFile[]): void {
  if (files.length === 1) return download(files[0].name, new Blob([files[0].bytes as Uint8Array<ArrayBuffer>]));
  const zip = zipSync(Object.fromEntries(files.map((file) => [file.name, file.bytes])));
  download(`${stem}.zip`, new Blob([zip as Uint8Array<ArrayBuffer>], { type: 'application/zip' }));
}
