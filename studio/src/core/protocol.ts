// What the page and the worker with the core say to each other. Arrays are copies, and are handed over, not shared.

export type Vec3 = [number, number, number];

/** Keys of a body's "mesh" in scene files. */
export type MeshOptions = Record<string, number | string | Vec3>;

export type Source =
  | { kind: 'sample'; name: string; damage: number; seed: number }
  | { kind: 'file'; name: string; bytes: ArrayBuffer };

export interface Listed {
  name: string;
  summary: string;
}
export interface Format extends Listed {
  extension: string;
}
export interface Engine extends Format {
  title: string;
  usage: string;
}
export interface Catalog {
  version: string;
  threads: number;
  samples: Listed[];
  scenes: Listed[];
  formats: Format[];
  engines: Engine[];
}

export interface Box {
  lo: Vec3;
  hi: Vec3;
}
export interface SoupReport {
  class: 'closed' | 'open' | 'soup' | 'empty';
  triangle_count: number;
  used_triangles: number;
  index_out_of_range: number;
  non_finite: number;
  duplicates: number;
  zero_area: number;
  components: number;
  boundary_edges: number;
  non_manifold_edges: number;
  inconsistent_edges: number;
  box: Box;
  origin: [number, number, number];
}
export interface Quality {
  vertex_count: number;
  tet_count: number;
  inverted_tets: number;
  volume: number;
  min_dihedral_deg: number;
  max_dihedral_deg: number;
  dihedral_histogram: number[];
  mean_ratio_mean: number;
  mean_ratio_min: number;
  components: number;
  boundary_triangles: number;
  boundary_manifold: boolean;
}
/** How the mesh fits to the soup: `tetsoup mesh --json` has more of it. */
export interface Fidelity {
  mean_edge: number;
  closed: boolean;
  soup_volume: number;
  volume_ratio: number;
  soup_pieces: number;
  mesh_pieces: number;
  apart_pairs: number;
  apart_share: number;
}
/** What only a look at every voxel and at the whole boundary tells. */
export interface Accuracy {
  iou_pseudo_volume: number;
  boundary_distance_edges: { mean: number; percentile95: number };
}
export interface Check {
  /** Null where there is no finite one. */
  value: number | null;
  at_least?: number;
  at_most?: number;
  passed: boolean;
  advice: string;
}
/** Members of `tetsoup mesh --json`, as many as are up to date. */
export interface Report {
  soup: SoupReport;
  grid: { size: Vec3; voxel_size: number; memory_bytes: number; pad: number };
  pseudo_volume: {
    k: number;
    band: number;
    band_voxels: number;
    automatic: boolean;
    inside_voxels: number;
    cavity_voxels: number;
    largest_closure: number;
    volume: number;
    soup_covered: number;
  };
  lattice: {
    cell_size: number;
    mean_edge: number;
    cells: Vec3;
    tet_count: number;
    thin_tets: number;
    overlap: number;
    overlap_unfitted: number;
    kept_volume: number;
    topology: { touching_mended: number; parts_dropped: number; bubbles_filled: number };
  };
  smooth: { passes: number; volume_before: number; volume_after: number; snapped: boolean };
  lattice_quality: Quality;
  quality: Quality;
  fidelity: Fidelity;
  notes: string[];
  readiness: { passed: boolean; checks: Record<string, Check>; mass_kg: number; stable_time_step_s: number };
  seconds: Record<string, number>;
}

export interface Surface {
  vertices: Float32Array;
  triangles: Uint32Array;
}
export interface Tets {
  vertices: Float32Array;
  tets: Uint32Array;
  /** Smallest dihedral angle of each tet, degrees. */
  angles: Float32Array;
}
export interface Grid {
  origin: Vec3;
  voxelSize: number;
  band: number;
  size: Vec3;
  rays: number;
}
export interface Slice {
  axis: number;
  layer: number;
  width: number;
  height: number;
  votes: Float32Array;
  distance: Float32Array;
  grid: Grid;
}
export interface MeshResult {
  lattice: Tets;
  final: Tets;
  report: Report;
  slice: Slice | null;
  milliseconds: number;
}
export interface SliceWish {
  axis: number;
  /** 0 to 1 along the axis. */
  position: number;
}

export interface OutFile {
  name: string;
  bytes: Uint8Array;
}
export interface ExportWish {
  name: string;
  format?: string;
  engine?: string;
  up: number;
  metresPerUnit: number;
  material: Material;
}
export interface Material {
  density: number;
  young: number;
  poisson: number;
}

export interface PlayWish {
  /** A built-in scene, or the body that was meshed. */
  scene: string | null;
  up: number;
  /** Of a unit of the body that was meshed. */
  metres: number;
  /** Null: as the scene has it. */
  material: Material | null;
  /** Who draws: a processor that does is spared triangles, and has the second core to itself. */
  drawnBy: 'gpu' | 'processor';
}
/** Triangles to be drawn, and whether their backs are never seen. */
export interface Skin {
  triangles: Uint32Array;
  outward: boolean;
}
export interface BodyShape extends Skin {
  tets: Uint32Array;
}
export interface PlayStart {
  bodies: BodyShape[];
  obstacles: (Skin & Surface)[];
  tetCount: number;
  triangleCount: number;
  title: string;
  /** Length of the body's longest side, metres; what is drawn around it goes by it. */
  size: number;
}
export interface BodyFrame {
  vertices: Float32Array;
  normals: Float32Array;
  positions: Float32Array;
}
export interface Frame {
  bodies: BodyFrame[];
  simulateMilliseconds: number;
}

export type Request =
  | { type: 'start'; base: string; shared: Int32Array | null }
  | { type: 'load'; job: number; source: Source }
  | { type: 'mesh'; job: number; options: MeshOptions; slice: SliceWish | null; material: Material }
  | { type: 'slice'; job: number; slice: SliceWish }
  | { type: 'embed'; job: number }
  | { type: 'accuracy'; job: number }
  | { type: 'export'; job: number; wish: ExportWish }
  | { type: 'play'; job: number; wish: PlayWish }
  | { type: 'material'; job: number; material: Material }
  | { type: 'cancel'; newest: number }
  | { type: 'drawn' }
  | { type: 'pause'; paused: boolean }
  | { type: 'grab'; body: number; vertex: number; target: Vec3 }
  | { type: 'drag'; target: Vec3 }
  | { type: 'release' }
  | { type: 'stop' };

export interface EmbedReport {
  embedding: { inside: number; outside: number; max_distance: number; non_finite: number };
}

export type Reply =
  | { type: 'ready'; catalog: Catalog }
  | { type: 'fatal'; message: string }
  | { type: 'progress'; job: number; stage: string; fraction: number }
  | { type: 'soup'; job: number; surface: Surface; report: SoupReport }
  | { type: 'mesh'; job: number; result: MeshResult; done: boolean }
  | { type: 'slice'; job: number; slice: Slice }
  | { type: 'embed'; job: number; report: EmbedReport }
  | { type: 'accuracy'; job: number; accuracy: Accuracy }
  | { type: 'files'; job: number; files: OutFile[]; usage: string }
  | { type: 'playing'; job: number; start: PlayStart }
  | { type: 'frame'; frame: Frame }
  | { type: 'cancelled'; job: number }
  | { type: 'error'; job: number; message: string; status: number };
