// Measures of single tets, and what is near a place.
import type { Surface, Tets } from '../core/protocol';

type Point = ArrayLike<number>;

export function cornersAt(mesh: Tets, tet: number): Float32Array[] {
  return [0, 1, 2, 3].map((k) => {
    const v = 3 * mesh.tets[4 * tet + k];
    return mesh.vertices.subarray(v, v + 3);
  });
}

const minus = (a: Point, b: Point) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
const cross = (a: Point, b: Point) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const dot = (a: Point, b: Point) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const size = (a: Point) => Math.sqrt(dot(a, a));

export function volume([a, b, c, d]: Point[]): number {
  return dot(cross(minus(b, a), minus(c, a)), minus(d, a)) / 6;
}

/** Smallest and largest angle between two faces, degrees. */
export function dihedrals(p: Point[]): [number, number] {
  const normals = [[1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1]].map(([a, b, c]) => cross(minus(p[b], p[a]), minus(p[c], p[a])));
  let [least, most] = [180, 0];
  for (let i = 0; i < 4; ++i)
    for (let j = 0; j < i; ++j) {
      const cosine = -dot(normals[i], normals[j]) / (size(normals[i]) * size(normals[j]) || 1);
      const angle = (Math.acos(Math.min(1, Math.max(-1, cosine))) * 180) / Math.PI;
      least = Math.min(least, angle);
      most = Math.max(most, angle);
    }
  return [least, most];
}

export function edgeRatio(p: Point[]): number {
  let [least, most] = [Infinity, 0];
  for (let i = 0; i < 4; ++i)
    for (let j = 0; j < i; ++j) {
      const length = size(minus(p[i], p[j]));
      least = Math.min(least, length);
      most = Math.max(most, length);
    }
  return most / least;
}

/** Whether a point lies in a tet, or outside by at most `slack` of the heights over its faces. */
export function inside(point: Point, p: Point[], slack: number): boolean {
  const whole = volume(p);
  if (!(whole > 0)) return false;
  return [0, 1, 2, 3].every((k) => volume(p.map((corner, i) => (i === k ? point : corner))) >= -slack * whole);
}

/** Where the upright line through a point meets a triangle, and whether that triangle faces upwards. */
export function insideTriangle(p: Point, [a, b, c]: Point[]): { height: number; upwards: boolean } | null {
  const flat = (s: Point, t: Point) => (s[0] - p[0]) * (t[1] - p[1]) - (s[1] - p[1]) * (t[0] - p[0]);
  const [u, v, w] = [flat(b, c), flat(c, a), flat(a, b)];
  const sum = u + v + w;
  if (sum === 0 || Math.min(u * sum, v * sum, w * sum) < 0) return null;
  return { height: (u * a[2] + v * b[2] + w * c[2]) / sum, upwards: sum > 0 };
}

/** Things by the cubes of space that they reach into. */
export class Buckets {
  private readonly things = new Map<string, number[]>();

  private constructor(private readonly cell: number, private readonly surface: Surface | null = null) {}

  static ofTets(mesh: Tets, cell: number, margin = 0): Buckets {
    const buckets = new Buckets(cell);
    for (let t = 0; t < mesh.tets.length / 4; ++t) buckets.add(t, cornersAt(mesh, t), margin, 3);
    return buckets;
  }

  /** A model's triangles, seen from above. */
  static ofColumns(surface: Surface, cell: number): Buckets {
    const buckets = new Buckets(cell);
    const { vertices, triangles } = surface;
    for (let i = 0; i < triangles.length / 3; ++i)
      buckets.add(i, [0, 1, 2].map((k) => vertices.subarray(3 * triangles[3 * i + k], 3 * triangles[3 * i + k] + 3)), 0, 2);
    return buckets;
  }

  static ofPoints(surface: Surface, cell: number): Buckets {
    const buckets = new Buckets(cell, surface);
    for (let v = 0; v < surface.vertices.length / 3; ++v) buckets.add(v, [surface.vertices.subarray(3 * v, 3 * v + 3)], 0, 3);
    return buckets;
  }

  private cellOf(x: number): number {
    return Math.floor(x / this.cell);
  }

  private add(thing: number, points: Point[], margin: number, axes: number): void {
    if (!points.every((p) => Number.isFinite(p[0] + p[1] + p[2]))) return;
    const range = [0, 1, 2].map((axis) => {
      if (axis >= axes) return [0, 0];
      const values = points.map((p) => p[axis]);
      return [this.cellOf(Math.min(...values) - margin), this.cellOf(Math.max(...values) + margin)];
    });
    for (let x = range[0][0]; x <= range[0][1]; ++x)
      for (let y = range[1][0]; y <= range[1][1]; ++y)
        for (let z = range[2][0]; z <= range[2][1]; ++z) {
          const key = `${x},${y},${z}`;
          const there = this.things.get(key);
          if (there) there.push(thing);
          else this.things.set(key, [thing]);
        }
  }

  at(p: Point): readonly number[] {
    return this.things.get(`${this.cellOf(p[0])},${this.cellOf(p[1])},${this.cellOf(p[2])}`) ?? [];
  }

  /** Of points: the nearest one within a cube's side, or -1. */
  nearest(p: Point): number {
    const vertices = this.surface?.vertices ?? new Float32Array();
    let [found, least] = [-1, Infinity];
    for (let i = 0; i < 27; ++i) {
      const step = [(i % 3) - 1, (Math.floor(i / 3) % 3) - 1, Math.floor(i / 9) - 1];
      for (const v of this.at(step.map((s, axis) => p[axis] + s * this.cell))) {
        const distance = size(minus(vertices.subarray(3 * v, 3 * v + 3), p));
        if (distance < least) [found, least] = [v, distance];
      }
    }
    return found;
  }

  /** Of points: the part of the surface that each belongs to, those in one place together. */
  parts(): Int32Array {
    const { vertices, triangles } = this.surface as Surface;
    const part = Int32Array.from({ length: vertices.length / 3 }, (_, v) => v);
    const find = (v: number): number => {
      while (part[v] !== v) v = part[v] = part[part[v]];
      return v;
    };
    const places = new Map<string, number>();
    for (let v = 0; v < part.length; ++v) {
      const key = vertices.subarray(3 * v, 3 * v + 3).join();
      const first = places.get(key);
      if (first === undefined) places.set(key, v);
      else part[find(v)] = find(first);
    }
    for (let i = 0; i < triangles.length; i += 3)
      for (const k of [1, 2]) part[find(triangles[i])] = find(triangles[i + k]);
    return part.map((_, v) => find(v));
  }
}
