// A tet mesh as it is seen: flat faces, their edges, cut by a plane, coloured plainly or by each tet's smallest angle.
import {
  BufferAttribute, BufferGeometry, Color, Group, LineBasicMaterial, LineSegments, Mesh, MeshLambertMaterial,
} from 'three';
import { angleColor, type Palette } from './colors';
import { TetFaces } from './tet_faces';

export interface TetInput {
  vertices: Float32Array;
  tets: Uint32Array;
  angles: Float32Array | null;
}
/** Tets whose centre is on the side where `sign * (p[axis] - at)` is positive are cut away. */
export interface Clip {
  axis: number;
  at: number;
  sign: number;
}

export class TetLayer extends Group {
  private readonly faceMaterial = new MeshLambertMaterial({ vertexColors: true, polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1 });
  private readonly edgeMaterial = new LineBasicMaterial({ transparent: true, opacity: 0.55 });
  private readonly mesh = new Mesh(new BufferGeometry(), this.faceMaterial);
  private readonly edges = new LineSegments(new BufferGeometry(), this.edgeMaterial);
  private input: TetInput | null = null;
  private topology: TetFaces | null = null;
  private faces = new Uint32Array();
  private cut = new Uint8Array();
  private clip: Clip | null = null;
  private byQuality = false;
  private plain = new Color();
  private opened = new Color();
  visibleTets = 0;

  constructor() {
    super();
    this.add(this.mesh, this.edges);
  }

  set(input: TetInput): void {
    this.input = input;
    this.topology = null;
    this.cutAway();
  }

  setPalette(palette: Palette, plain: string): void {
    this.plain.set(plain);
    this.opened.set(palette.cut);
    this.edgeMaterial.color.set(palette.edge);
    this.paint();
  }

  setLook(look: { edges: boolean; faces: boolean; quality: boolean }): void {
    this.edges.visible = look.edges;
    this.mesh.visible = look.faces;
    this.edgeMaterial.opacity = look.faces ? 0.55 : 0.8;
    if (this.byQuality === look.quality) return;
    this.byQuality = look.quality;
    this.paint();
  }

  setClip(clip: Clip | null): void {
    if (JSON.stringify(clip) === JSON.stringify(this.clip)) return;
    this.clip = clip;
    this.cutAway();
  }

  private cutAway(): void {
    const { input, clip } = this;
    if (!input) return;
    this.topology ??= new TetFaces(input.tets, input.vertices.length / 3);
    const { tets, vertices } = input;
    let shown = 0;
    const stands = (tet: number): boolean => {
      if (!clip) return ++shown > 0;
      let sum = 0;
      for (let i = 0; i < 4; ++i) sum += vertices[3 * tets[4 * tet + i] + clip.axis];
      const away = clip.sign * (sum / 4 - clip.at) > 0;
      if (!away) ++shown;
      return !away;
    };
    ({ faces: this.faces, cut: this.cut } = this.topology.visible(stands) as { faces: Uint32Array<ArrayBuffer>; cut: Uint8Array<ArrayBuffer> });
    this.visibleTets = shown;
    this.place(vertices);
    this.paint();
    this.drawEdges();
  }

  /** Moves the vertices; faces and colours stay. */
  move(vertices: Float32Array): void {
    this.place(vertices);
    this.drawEdges(vertices);
  }

  private place(p: Float32Array): void {
    const count = this.faces.length;
    const positions = new Float32Array(9 * count);
    const normals = new Float32Array(9 * count);
    for (let i = 0; i < count; ++i) {
      const [a, b, c] = (this.topology as TetFaces).corners(this.faces[i]).map((v) => 3 * v);
      const [ux, uy, uz] = [p[b] - p[a], p[b + 1] - p[a + 1], p[b + 2] - p[a + 2]];
      const [vx, vy, vz] = [p[c] - p[a], p[c + 1] - p[a + 1], p[c + 2] - p[a + 2]];
      let [nx, ny, nz] = [uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx];
      const size = Math.hypot(nx, ny, nz) || 1;
      [nx, ny, nz] = [nx / size, ny / size, nz / size];
      [a, b, c].forEach((from, corner) => {
        const to = 9 * i + 3 * corner;
        for (let axis = 0; axis < 3; ++axis) positions[to + axis] = p[from + axis];
        normals.set([nx, ny, nz], to);
      });
    }
    const { geometry } = this.mesh;
    geometry.setAttribute('position', new BufferAttribute(positions, 3));
    geometry.setAttribute('normal', new BufferAttribute(normals, 3));
    if (count) geometry.computeBoundingSphere();
  }

  private paint(): void {
    const count = this.faces.length;
    const colors = new Float32Array(9 * count);
    const color = new Color();
    const angles = this.byQuality ? this.input?.angles : null;
    for (let i = 0; i < count; ++i) {
      if (angles) angleColor(angles[this.faces[i] >> 2], color);
      else color.copy(this.cut[i] ? this.opened : this.plain);
      for (let corner = 0; corner < 3; ++corner) color.toArray(colors, 9 * i + 3 * corner);
    }
    this.mesh.geometry.setAttribute('color', new BufferAttribute(colors, 3));
  }

  private drawEdges(p = this.input?.vertices ?? new Float32Array()): void {
    const ends: number[] = [];
    for (const face of this.faces) {
      const corners = (this.topology as TetFaces).corners(face);
      for (let i = 0; i < 3; ++i) {
        const [a, b] = [corners[i], corners[(i + 1) % 3]];
        // The faces that are seen close up to a surface, in which every edge comes once in each direction.
        if (a < b) ends.push(p[3 * a], p[3 * a + 1], p[3 * a + 2], p[3 * b], p[3 * b + 1], p[3 * b + 2]);
      }
    }
    this.edges.geometry.setAttribute('position', new BufferAttribute(new Float32Array(ends), 3));
    if (ends.length) this.edges.geometry.computeBoundingSphere();
  }
}
