// Where a check fails: the tets of the mesh, or the triangles of the model, that it is about.
import type { Fidelity, Surface, Tets } from '../core/protocol';
import { Buckets, cornersAt, dihedrals, edgeRatio, inside, insideTriangle, volume } from './measures';
import { TetFaces } from './tet_faces';

export interface Problem {
  tets: Uint32Array;
  triangles: Uint32Array;
}
interface Input {
  mesh: Tets;
  soup: Surface;
  fidelity: Fidelity;
  /** What the check allows. */
  limit: number;
}
type Finder = (input: Input) => Partial<Problem>;

const kNone = new Uint32Array();
/** A corner that lies in a tet by less than this share of its height touches it. */
const kTouching = 0.02;
/** How far outside of a tet, in its own coordinates, a triangle's middle still belongs to it. */
const kNear = 0.6;

function tetsWhere(mesh: Tets, wanted: (tet: number) => boolean): Partial<Problem> {
  const found: number[] = [];
  for (let t = 0; t < mesh.tets.length / 4; ++t) if (wanted(t)) found.push(t);
  return { tets: new Uint32Array(found) };
}

function topology(mesh: Tets): TetFaces {
  return new TetFaces(mesh.tets, mesh.vertices.length / 3);
}

/** All pieces but the largest. */
function pieces({ mesh }: Input): Partial<Problem> {
  const { piece, sizes } = topology(mesh).pieces();
  const largest = sizes.indexOf(Math.max(...sizes));
  return tetsWhere(mesh, (t) => piece[t] !== largest);
}

function withoutInnerVertex({ mesh }: Input): Partial<Problem> {
  const outer = topology(mesh).boundaryVertices(mesh.vertices.length / 3);
  return tetsWhere(mesh, (t) => mesh.tets.subarray(4 * t, 4 * t + 4).every((v) => outer[v]));
}

/** Tets at edges that more than two triangles of the boundary share, and at vertices where several fans of them meet. */
function touching({ mesh }: Input): Partial<Problem> {
  const count = mesh.vertices.length / 3;
  const faces = topology(mesh).boundaryFaces();
  const triangles = faces.map(([a, b, c]) => [a, b, c]);
  const uses = new Map<number, number>();
  const around = new Map<number, number[]>();
  triangles.forEach((corners, i) => corners.forEach((v, k) => {
    const w = corners[(k + 1) % 3];
    const edge = Math.min(v, w) * count + Math.max(v, w);
    uses.set(edge, (uses.get(edge) ?? 0) + 1);
    around.set(v, [...(around.get(v) ?? []), i]);
  }));
  const bad = new Set<number>();
  for (const [edge, n] of uses) if (n > 2) bad.add(edge % count).add(Math.floor(edge / count));
  for (const [v, all] of around) if (fans(v, all.map((i) => triangles[i])) > 1) bad.add(v);
  return tetsWhere(mesh, (t) => mesh.tets.subarray(4 * t, 4 * t + 4).some((v) => bad.has(v)));
}

/** How many separate fans the triangles around a vertex make. */
function fans(v: number, triangles: number[][]): number {
  const left = triangles.map((corners) => corners.filter((w) => w !== v));
  let count = 0;
  while (left.length) {
    ++count;
    const reached = new Set(left.pop());
    for (let i = 0; i < left.length;) {
      if (!left[i].some((w) => reached.has(w))) ++i;
      else {
        left[i].forEach((w) => reached.add(w));
        left.splice(i, 1);
        i = 0;
      }
    }
  }
  return count;
}

/** Tets that a corner of another one lies in, and those of that corner. */
function overlapping({ mesh, fidelity }: Input): Partial<Problem> {
  const buckets = Buckets.ofTets(mesh, fidelity.mean_edge);
  const bad = new Set<number>();
  const corners = new Set<number>();
  for (let v = 0; v < mesh.vertices.length / 3; ++v) {
    const p = mesh.vertices.subarray(3 * v, 3 * v + 3);
    for (const t of buckets.at(p)) {
      if (mesh.tets.subarray(4 * t, 4 * t + 4).includes(v) || !inside(p, cornersAt(mesh, t), -kTouching)) continue;
      bad.add(t);
      corners.add(v);
    }
  }
  return tetsWhere(mesh, (t) => bad.has(t) || mesh.tets.subarray(4 * t, 4 * t + 4).some((v) => corners.has(v)));
}

/** Triangles of the model that no tet is near. */
function lost({ mesh, soup, fidelity }: Input): Partial<Problem> {
  const buckets = Buckets.ofTets(mesh, fidelity.mean_edge, fidelity.mean_edge);
  const found: number[] = [];
  const { vertices, triangles } = soup;
  for (let i = 0; i + 2 < triangles.length; i += 3) {
    const three = triangles.subarray(i, i + 3);
    const middle = Float32Array.from({ length: 3 }, (_, axis) => three.reduce((sum, v) => sum + vertices[3 * v + axis] / 3, 0));
    if (!middle.every(Number.isFinite)) continue;
    if (!buckets.at(middle).some((t) => inside(middle, cornersAt(mesh, t), kNear))) found.push(...three);
  }
  return { triangles: new Uint32Array(found) };
}

/** Tets whose middle lies outside of the closed model, counted by what a ray upwards leaves and enters. */
function outside({ mesh, soup, fidelity }: Input): Partial<Problem> {
  const columns = Buckets.ofColumns(soup, fidelity.mean_edge);
  const { vertices, triangles } = soup;
  return tetsWhere(mesh, (t) => {
    const corners = cornersAt(mesh, t);
    const p = [0, 1, 2].map((axis) => corners.reduce((sum, c) => sum + c[axis] / 4, 0));
    let winding = 0;
    for (const i of columns.at([p[0], p[1], 0])) {
      const three = [0, 1, 2].map((k) => vertices.subarray(3 * triangles[3 * i + k], 3 * triangles[3 * i + k] + 3));
      const hit = insideTriangle(p, three);
      if (hit && hit.height > p[2]) winding += hit.upwards ? 1 : -1;
    }
    return winding === 0;
  });
}

/** Tets that lie between parts which the model has apart. */
function joined({ mesh, soup, fidelity }: Input): Partial<Problem> {
  const nearest = Buckets.ofPoints(soup, fidelity.mean_edge);
  const part = nearest.parts();
  const owner = Int32Array.from({ length: mesh.vertices.length / 3 }, (_, v) => {
    const found = nearest.nearest(mesh.vertices.subarray(3 * v, 3 * v + 3));
    return found < 0 ? -1 : part[found];
  });
  return tetsWhere(mesh, (t) => new Set([...mesh.tets.subarray(4 * t, 4 * t + 4)].map((v) => owner[v]).filter((o) => o >= 0)).size > 1);
}

/** Those that stand for pieces: of the model without mesh, by its triangles; of the mesh, by its tets. */
const kFinders: Record<string, Finder> = {
  inverted_tets: ({ mesh }) => tetsWhere(mesh, (t) => !(volume(cornersAt(mesh, t)) > 0)),
  min_dihedral_deg: ({ mesh, limit }) => tetsWhere(mesh, (t) => dihedrals(cornersAt(mesh, t))[0] < limit),
  max_dihedral_deg: ({ mesh, limit }) => tetsWhere(mesh, (t) => dihedrals(cornersAt(mesh, t))[1] > limit),
  max_edge_ratio: ({ mesh, limit }) => tetsWhere(mesh, (t) => edgeRatio(cornersAt(mesh, t)) > limit),
  tet_volume_ratio: ({ mesh, limit }) => {
    let largest = 0;
    for (let t = 0; t < mesh.tets.length / 4; ++t) largest = Math.max(largest, volume(cornersAt(mesh, t)));
    return tetsWhere(mesh, (t) => volume(cornersAt(mesh, t)) * limit < largest);
  },
  non_manifold: touching,
  components: pieces,
  torn_pieces: pieces,
  boundary_only_share: withoutInnerVertex,
  lost_edges: lost,
  lost_pieces: lost,
  joined_pieces: joined,
  overlap_share: overlapping,
  volume_ratio: outside,
  stray_share: outside,
};

export function canShow(check: string): boolean {
  return check in kFinders;
}

export function findProblem(check: string, input: Input): Problem {
  return { tets: kNone, triangles: kNone, ...kFinders[check]?.(input) };
}
