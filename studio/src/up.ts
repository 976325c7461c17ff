// Which axis of a model points up: the one along which it stands, rather than lies.

/** Of its height, what is called the bottom. */
const kBottom = 0.02;
/** A bottom that is so many times wider than the other's decides; else the custom of the format does. */
const kClearly = 2.5;
const kLeast = 0.15;
const kMostPoints = 20000;

type Flat = readonly [number, number];

/** The area of the convex hull. */
function hullArea(points: Flat[]): number {
  const sorted = [...points].sort((a, b) => a[0] - b[0] || a[1] - b[1]);
  const half = (all: Flat[]) => {
    const chain: Flat[] = [];
    for (const p of all) {
      while (chain.length > 1) {
        const [a, b] = chain.slice(-2);
        if ((b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]) > 0) break;
        chain.pop();
      }
      chain.push(p);
    }
    return chain.slice(0, -1);
  };
  const hull = [...half(sorted), ...half(sorted.reverse())];
  return Math.abs(hull.reduce((sum, [x, y], i) => {
    const [u, v] = hull[(i + 1) % hull.length];
    return sum + x * v - u * y;
  }, 0)) / 2;
}

/** How wide the bottom is, as a share of all that is seen from above. */
function stands(vertices: Float32Array, axis: number): number {
  const step = 3 * Math.max(1, Math.ceil(vertices.length / 3 / kMostPoints));
  const [u, v] = [(axis + 1) % 3, (axis + 2) % 3];
  const all: { at: number; flat: Flat }[] = [];
  for (let i = 0; i < vertices.length; i += step)
    if (Number.isFinite(vertices[i] + vertices[i + 1] + vertices[i + 2])) all.push({ at: vertices[i + axis], flat: [vertices[i + u], vertices[i + v]] });
  let [low, high] = [Infinity, -Infinity];
  for (const { at } of all) [low, high] = [Math.min(low, at), Math.max(high, at)];
  const whole = hullArea(all.map((p) => p.flat));
  return whole > 0 ? hullArea(all.filter((p) => p.at <= low + kBottom * (high - low)).map((p) => p.flat)) / whole : 0;
}

/** @param custom  What files of this format have up by custom. */
export function guessUp(vertices: Float32Array, custom: 'y' | 'z'): 'y' | 'z' {
  const other = custom === 'y' ? 'z' : 'y';
  const [usual, unusual] = [custom, other].map((axis) => stands(vertices, axis === 'y' ? 1 : 2));
  return unusual > kLeast && unusual > kClearly * usual ? other : custom;
}
