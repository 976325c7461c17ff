// Elements in one line each.
type Child = Node | string | null | undefined | false;
type Props = Record<string, string | number | boolean | null | undefined | ((event: Event) => void)>;

/** Functions become listeners, `true` an attribute without a value, and what is false or missing nothing. */
export function el<K extends keyof HTMLElementTagNameMap>(
  tag: K, props: Props = {}, ...children: Child[]): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(props)) {
    if (typeof value === 'function') element.addEventListener(name.replace(/^on/, ''), value);
    else if (value === true) element.setAttribute(name, '');
    else if (value !== false && value !== null && value !== undefined) element.setAttribute(name, String(value));
  }
  element.append(...children.filter((child): child is Node | string => !!child));
  return element;
}

const kSvg = 'http://www.w3.org/2000/svg';
export function svg(tag: string, props: Record<string, string | number>, ...children: Node[]): SVGElement {
  const element = document.createElementNS(kSvg, tag);
  for (const [name, value] of Object.entries(props)) element.setAttribute(name, String(value));
  element.append(...children);
  return element;
}

/** Icons of 20 units, drawn with the text's colour. */
const kIcons: Record<string, string> = {
  undo: 'M7 4 3 8l4 4M3 8h9a5 5 0 0 1 0 10H8',
  redo: 'm13 4 4 4-4 4M17 8H8a5 5 0 0 0 0 10h4',
  link: 'M8 12a3.5 3.5 0 0 0 5 0l3-3a3.5 3.5 0 0 0-5-5l-1 1M12 8a3.5 3.5 0 0 0-5 0l-3 3a3.5 3.5 0 0 0 5 5l1-1',
  theme: 'M10 3a7 7 0 1 0 7 7 5.5 5.5 0 0 1-7-7Z',
  fit: 'M3 7V3h4M13 3h4v4M17 13v4h-4M7 17H3v-4M7.5 7.5h5v5h-5z',
  save: 'M10 3v9m-4-3.5 4 4 4-4M3 14v3h14v-3',
  picture: 'M3 5h3l1.5-2h5L14 5h3v11H3zM10 13a3 3 0 1 0 0-6 3 3 0 0 0 0 6Z',
  play: 'M6 4v12l10-6z',
  pause: 'M7 4v12M13 4v12',
  reset: 'M4 4v4h4M4.5 8A6.5 6.5 0 1 1 4 12',
  close: 'm5 5 10 10M15 5 5 15',
  open: 'M3 16V4h5l2 2h7v10z',
  move: 'M10 2v16M2 10h16M10 2 8 4m2-2 2 2M10 18l-2-2m2 2 2-2M2 10l2-2m-2 2 2 2M18 10l-2-2m2 2-2 2',
};
export function icon(name: keyof typeof kIcons | string): SVGElement {
  const path = svg('path', { d: kIcons[name], fill: 'none', stroke: 'currentColor', 'stroke-width': 1.6,
    'stroke-linecap': 'round', 'stroke-linejoin': 'round' });
  return svg('svg', { viewBox: '0 0 20 20', width: 18, height: 18, 'aria-hidden': 'true', focusable: 'false' }, path);
}
