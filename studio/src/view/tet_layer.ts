// A tet mesh as it is seen: flat faces, their edges, cut by a plane, coloured plainly or by each tet's smallest angle.
import {
  BufferGeometry, Color, Group, LineBasicMaterial, LineSegments, Mesh, MeshLambertMaterial,
} from 'three';
import { angleColor, type Palette } from './colors';
import { room, setCorners } from './room';
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
  private faces: Uint32Array = new Uint32Array();
  private corners: Uint32Array = new Uint32Array();
  private cut: Uint8Array = new Uint8Array();
  private clip: Clip | null = null;
  private byQuality = false;
  private onlyOpened = false;
  private stale = false;
  private plain = new Color();
  private opened = new Color();

  constructor() {
    super();
    // Both are in the picture nearly always, and to find out whether they are costs more.
    this.mesh.frustumCulled = this.edges.frustumCulled = false;
    this.add(this.mesh, this.edges);
    this.visible = false;
  }

  set(input: TetInput): void {
    this.input = input;
    this.topology = null;
    this.refresh(true);
  }

  show(visible: boolean): void {
    this.visible = visible;
    this.refresh(this.stale);
  }

  /** What is hidden is brought up to date when it is seen. */
  private refresh(stale: boolean): void {
    this.stale = stale && !this.visible;
    if (stale && this.visible) this.cutAway();
  }

  setPalette(palette: Palette, plain: string): void {
    this.plain.set(plain);
    this.opened.set(palette.cut);
    this.edgeMaterial.color.set(palette.edge);
    this.paint();
  }

  /** @param look.opened  Only the faces that the cut laid open, as where a surface is drawn around them. */
  setLook(look: { edges: boolean; quality: boolean; opened: boolean }): void {
    this.edges.visible = look.edges;
    if (this.onlyOpened !== look.opened) {
      this.onlyOpened = look.opened;
      this.refresh(true);
    }
    if (this.byQuality === look.quality) return;
    this.byQuality = look.quality;
    this.paint();
  }

  setClip(clip: Clip | null): void {
    if (JSON.stringify(clip) === JSON.stringify(this.clip)) return;
    this.clip = clip;
    this.refresh(true);
  }

  private cutAway(): void {
    const { input, clip } = this;
    if (!input) return;
    this.topology ??= new TetFaces(input.tets, input.vertices.length / 3);
    const { tets, vertices } = input;
    const stands = (tet: number): boolean => {
      if (!clip) return true;
      let sum = 0;
      for (let i = 0; i < 4; ++i) sum += vertices[3 * tets[4 * tet + i] + clip.axis];
      return clip.sign * (sum / 4 - clip.at) <= 0;
    };
    ({ faces: this.faces, cut: this.cut } = this.topology.visible(stands));
    if (this.onlyOpened) {
      this.faces = this.faces.filter((_, i) => this.cut[i]);
      this.cut = this.cut.filter((cut) => cut);
    }
    this.corners = this.topology.cornersOf(this.faces);
    this.place(input.vertices);
    this.paint();
    setCorners(this.edges.geometry, this.findEdges());
  }

  /** Moves the vertices; faces and colours stay. */
  move(vertices: Float32Array): void {
    this.place(vertices);
  }

  release(): void {
    this.mesh.geometry.dispose();
    this.edges.geometry.dispose();
  }

  /** The faces that are seen, each with corners of its own, for it has a normal and a colour of its own. */
  private place(p: Float32Array): void {
    const { geometry } = this.mesh;
    const { faces, corners } = this;
    const positions = room(geometry, 'position', 3 * corners.length);
    const normals = room(geometry, 'normal', 3 * corners.length);
    for (let i = 0; i < faces.length; ++i) {
      const [a, b, c] = [3 * corners[3 * i], 3 * corners[3 * i + 1], 3 * corners[3 * i + 2]];
      const [ux, uy, uz] = [p[b] - p[a], p[b + 1] - p[a + 1], p[b + 2] - p[a + 2]];
      const [vx, vy, vz] = [p[c] - p[a], p[c + 1] - p[a + 1], p[c + 2] - p[a + 2]];
      const [nx, ny, nz] = [uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx];
      const size = Math.hypot(nx, ny, nz) || 1;
      for (let corner = 0; corner < 3; ++corner) {
        const [from, to] = [3 * corners[3 * i + corner], 9 * i + 3 * corner];
        [positions[to], positions[to + 1], positions[to + 2]] = [p[from], p[from + 1], p[from + 2]];
        [normals[to], normals[to + 1], normals[to + 2]] = [nx / size, ny / size, nz / size];
      }
    }
    room(this.edges.geometry, 'position', p.length).set(p);
  }

  private paint(): void {
    if (this.stale) return;
    const count = this.faces.length;
    const colors = room(this.mesh.geometry, 'color', 9 * count);
    const color = new Color();
    const angles = this.byQuality ? this.input?.angles : null;
    for (let i = 0; i < count; ++i) {
      if (angles) angleColor(angles[this.faces[i] >> 2], color);
      else color.copy(this.cut[i] ? this.opened : this.plain);
      for (let corner = 0; corner < 3; ++corner) color.toArray(colors, 9 * i + 3 * corner);
    }
  }

  private findEdges(): Uint32Array {
    const ends: number[] = [];
    const { corners } = this;
    const single = new Set<number>();
    const count = (this.input?.vertices.length ?? 0) / 3;
    for (let i = 0; i < corners.length; ++i) {
      const [a, b] = [corners[i], corners[i % 3 === 2 ? i - 2 : i + 1]];
      // The faces that are seen close up to a surface, in which every edge comes once in each direction.
      if (a < b) ends.push(a, b);
      // Those that a cut laid open have a rim, whose edges come in one direction only.
      if (this.onlyOpened && !single.delete(b * count + a)) single.add(a * count + b);
    }
    for (const edge of single) if (edge % count < edge / count) ends.push(Math.floor(edge / count), edge % count);
    return new Uint32Array(ends);
  }
}
