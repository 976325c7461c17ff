// Fewer triangles of the same vertices. Where a processor draws, it is their number that costs, and hardly the pixels.
import { MeshoptSimplifier } from 'meshoptimizer/simplifier';

/** How far the thinned triangles may be from the given ones, as a share of their size. */
const kMostError = 0.05;

export async function thin(vertices: Float32Array, triangles: Uint32Array, most: number): Promise<Uint32Array> {
  if (triangles.length <= 3 * most) return triangles;
  await MeshoptSimplifier.ready;
  return MeshoptSimplifier.simplify(triangles, vertices, 3, 3 * most, kMostError, ['LockBorder'])[0];
}

/** Whether no back of a triangle is ever seen from outside: every part is closed, and counter-clockwise from there. */
export function facesOutward(vertices: Float32Array, triangles: Uint32Array): boolean {
  const count = vertices.length / 3;
  const part = Uint32Array.from({ length: count }, (_, v) => v);
  const partOf = (v: number): number => {
    while (part[v] !== v) v = part[v] = part[part[v]];
    return v;
  };
  const open = new Map<number, number>();
  for (let i = 0; i < triangles.length; ++i) {
    const [a, b] = [triangles[i], triangles[i % 3 === 2 ? i - 2 : i + 1]];
    part[partOf(a)] = partOf(b);
    const [edge, way] = a < b ? [a * count + b, 1] : [b * count + a, -1];
    const sum = (open.get(edge) ?? 0) + way;
    if (sum) open.set(edge, sum);
    else open.delete(edge);
  }
  if (open.size) return false;
  const volumes = new Map<number, number>();
  for (let i = 0; i < triangles.length; i += 3) {
    const of = partOf(triangles[i]);
    volumes.set(of, (volumes.get(of) ?? 0) + volume(vertices, triangles, i));
  }
  return [...volumes.values()].every((v) => v >= 0);
}

/** Six times that of the tet between a triangle and the origin. */
function volume(p: Float32Array, triangles: Uint32Array, first: number): number {
  const [a, b, c] = [3 * triangles[first], 3 * triangles[first + 1], 3 * triangles[first + 2]];
  return p[a] * (p[b + 1] * p[c + 2] - p[b + 2] * p[c + 1]) + p[a + 1] * (p[b + 2] * p[c] - p[b] * p[c + 2])
    + p[a + 2] * (p[b] * p[c + 1] - p[b + 1] * p[c]);
}
