// How many dihedral angles there are of each size.
import { svg } from '../ui/dom';
import { angleColor } from './colors';
import { Color } from 'three';

const kWidth = 216;
const kHeight = 56;
const kAxis = 14;

/** The worst of an angle is its distance from flat, at either end. */
function worst(degrees: number): number {
  return degrees <= 70 ? degrees : Math.max(0, (180 - degrees) * 0.8);
}

export function histogram(bins: readonly number[]): SVGElement {
  const most = Math.max(1, ...bins);
  const width = kWidth / bins.length;
  const degrees = 180 / bins.length;
  const total = bins.reduce((a, b) => a + b, 0);
  const bars = bins.map((n, i) => {
    const height = n ? Math.max(1, (kHeight * n) / most) : 0;
    const middle = (i + 0.5) * degrees;
    const bar = svg('rect', { x: i * width + 0.5, y: kHeight - height, width: width - 1, height,
      fill: `#${angleColor(worst(middle), new Color()).getHexString()}` });
    bar.append(svg('title', {}, document.createTextNode(`${i * degrees}° to ${(i + 1) * degrees}°: ${n.toLocaleString('en')} of ${total.toLocaleString('en')} angles`)));
    return bar;
  });
  const ticks = [0, 45, 90, 135, 180].map((d) => svg('text', {
    x: (kWidth * d) / 180, y: kHeight + kAxis - 2, 'text-anchor': d === 0 ? 'start' : d === 180 ? 'end' : 'middle', class: 'tick',
  }, document.createTextNode(`${d}°`)));
  const label = 'Histogram of the angles between the faces of tets, from 0 to 180 degrees';
  return svg('svg', { viewBox: `0 0 ${kWidth} ${kHeight + kAxis}`, class: 'histogram', role: 'img', 'aria-label': label },
    ...bars, svg('line', { x1: 0, x2: kWidth, y1: kHeight, y2: kHeight, class: 'axis' }), ...ticks);
}
