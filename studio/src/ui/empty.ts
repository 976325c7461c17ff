// What is there before there is a model: a place to drop one, and samples.
import type { Catalog } from '../core/protocol';
import { el, icon } from './dom';

export const kAccepted = '.obj,.stl,.ply,.off,.glb,.gltf,.3mf,.dae';

export function emptyState(catalog: Catalog | null, open: () => void, sample: (name: string) => void, robots: () => void): HTMLElement {
  const samples = (catalog?.samples ?? []).map((s) =>
    el('button', { type: 'button', 'data-sample': s.name, onclick: () => sample(s.name) }, el('b', {}, s.name), el('small', {}, s.summary.replace(/; --.*$/, ''))));
  return el('section', { class: 'empty', 'aria-label': 'Begin' }, el('div', { class: 'inner' },
    el('div', { class: 'triple' },
      el('h2', {}, 'Any triangles in, a tet mesh for simulation out'),
      el('p', {}, 'Holes, loose triangles and parts pushed into each other are fine. Everything happens in this page: nothing is uploaded.')),
    el('div', { class: 'drop' },
      el('button', { type: 'button', class: 'primary', onclick: open }, icon('open'), 'Open a model'),
      el('span', { class: 'unit' }, 'or drop it here: OBJ, STL, PLY, OFF, GLB, 3MF or DAE')),
    catalog ? el('div', { class: 'triple' }, el('p', {}, 'Or try a sample'), el('div', { class: 'samples' }, ...samples))
      : el('p', { role: 'status' }, 'Loading the mesher …'),
    catalog && el('p', { class: 'watch-line' }, 'Or just watch', el('button', { type: 'button', id: 'watch', onclick: robots }, icon('play'), 'Four robots fall on a tree'))));
}

/** A drop anywhere on the page opens files, or what lies at an address. */
export function acceptDrops(take: (files: File[], address: string) => void): void {
  let depth = 0;
  const mark = (change: number) => {
    depth = Math.max(0, depth + change);
    document.body.classList.toggle('dropping', depth > 0);
  };
  addEventListener('dragenter', (event) => {
    if (event.dataTransfer?.types.some((type) => type === 'Files' || type === 'text/uri-list')) mark(1);
  });
  addEventListener('dragleave', () => mark(-1));
  addEventListener('dragover', (event) => event.preventDefault());
  addEventListener('drop', (event) => {
    event.preventDefault();
    mark(-depth);
    const address = event.dataTransfer?.getData('text/uri-list').split(/\r?\n/).find((line) => line && !line.startsWith('#')) ?? '';
    const files = [...(event.dataTransfer?.files ?? [])];
    if (files.length || address) take(files, address);
  });
}
