// A soup and its two pipelines: the wanted one, and a coarse one that answers first where the wanted one would be slow.
// Two, because running one with other options would throw away what it remembers.
import { type Core, CoreError, kUnreadable } from './module';
import type {
  Accuracy, Grid, Material, MeshOptions, MeshResult, Report, Slice, SliceWish, Source, SoupReport, Surface, Tets,
} from './protocol';

const kCoarseVoxels = 48;
/** Above this a step feels slow, and a coarse answer comes first. */
const kSlowMilliseconds = 150;
/** Half of what WebAssembly can have: the rest is for meshes, copies and the simulation. */
const kGridBytes = 1024 * 1024 * 1024;
const kMinDihedral = 1;
const kNoTriangle = 'it holds no usable triangle';

const kStages = ['distance', 'pseudo_volume', 'lattice', 'smooth'] as const;
/** The first stage that an option reaches; all others reach the lattice. */
const kStageOfOption: Record<string, number> = {
  voxels: 0, k: 1, cavities: 1, rays: 1, placement: 1, passes: 3, strength: 3, snap: 3, min_angle: 3, max_angle: 3,
};

export class Mesher {
  soup = 0;
  private fine = 0;
  private coarse = 0;
  private last: { options: MeshOptions; report: Report } | null = null;
  /** Counts finished fine meshes, so that copies of the mesh know when they are stale. */
  version = 0;
  finished = false;

  constructor(private readonly core: Core) {}

  load(source: Source): { surface: Surface; report: SoupReport } {
    const { core } = this;
    const soup = this.read(source);
    core.call('soup_report', soup, core.result);
    const report = core.json<SoupReport>();
    // What was there before stays, as with a file that cannot be read.
    if (report.class === 'empty') {
      core.number('soup_destroy', soup);
      throw new CoreError(kUnreadable, kNoTriangle);
    }
    this.clear();
    this.soup = soup;
    core.call('soup_vertices', soup, core.result);
    core.call('soup_triangles', soup, core.result + 12);
    return { surface: { vertices: core.floats(), triangles: core.indices(12) }, report };
  }

  private read(source: Source): number {
    const { core } = this;
    if (source.kind === 'sample')
      core.withTexts([source.name], (name) =>
        core.call('soup_sample', name, source.damage, source.seed, core.result));
    else {
      const bytes = new Uint8Array(source.bytes);
      core.withBytes(bytes, (pointer) => core.withTexts([source.name], (name) =>
        core.call('soup_parse', pointer, bytes.byteLength, name, core.result)));
    }
    return core.word();
  }

  private clear(): void {
    for (const pipeline of [this.fine, this.coarse]) this.core.number('pipeline_destroy', pipeline);
    this.core.number('soup_destroy', this.soup);
    this.soup = this.fine = this.coarse = 0;
    this.last = null;
    this.finished = false;
    this.version += 1;
  }

  private create(): number {
    const { core } = this;
    core.call('pipeline_create', this.soup, core.progress, 0, core.result);
    const pipeline = core.word();
    core.call('pipeline_set_memory_limit', pipeline, kGridBytes);
    return pipeline;
  }

  /** Of the last finished mesh. */
  get report(): Report | undefined {
    return this.last?.report;
  }

  get pipeline(): number {
    return this.fine;
  }

  /** Milliseconds that these options will take, judged by what the stages took that they reach. */
  expected(options: MeshOptions): number {
    if (!this.last) return Number(options.voxels) > 2 * kCoarseVoxels ? Infinity : 0;
    const keys = new Set([...Object.keys(options), ...Object.keys(this.last.options)]);
    let first: number = kStages.length;
    for (const key of keys)
      if (String(options[key]) !== String(this.last.options[key])) first = Math.min(first, kStageOfOption[key] ?? 2);
    const growth = first === 0 ? (Number(options.voxels) / Number(this.last.options.voxels)) ** 3 : 1;
    return kStages.slice(first).reduce((sum, stage) => sum + 1000 * growth * (this.last?.report.seconds[stage] ?? 0), 0);
  }

  wantsCoarse(options: MeshOptions): boolean {
    return Number(options.voxels) > kCoarseVoxels && this.expected(options) > kSlowMilliseconds;
  }

  /** Yields between stages, where a worker without shared memory looks for newer wishes. */
  *run(options: MeshOptions, coarse: boolean): Generator<string> {
    const { core } = this;
    if (coarse && !this.coarse) this.coarse = this.create();
    if (!coarse && !this.fine) this.fine = this.create();
    const pipeline = coarse ? this.coarse : this.fine;
    const wanted = coarse ? { ...options, voxels: kCoarseVoxels } : options;
    if (!coarse) this.finished = false;
    for (let stage = 1; stage <= kStages.length; ++stage) {
      core.withTexts([JSON.stringify(wanted)], (text) =>
        core.call('pipeline_run_until', pipeline, stage, text, core.progress, 0));
      yield kStages[stage - 1];
    }
    if (coarse) return;
    this.version += 1;
    this.finished = true;
  }

  result(coarse: boolean, options: MeshOptions, material: Material, wish: SliceWish | null, since: number): MeshResult {
    const pipeline = coarse ? this.coarse : this.fine;
    const { core } = this;
    core.withTexts([JSON.stringify(material)], (text) => core.call('pipeline_report', pipeline, text, core.result));
    const report = core.json<Report>();
    if (!coarse) this.last = { options, report };
    return {
      lattice: this.tets(pipeline, 0),
      final: this.tets(pipeline, 1),
      report,
      slice: wish && this.slice(wish, pipeline),
      milliseconds: performance.now() - since,
    };
  }

  private tets(pipeline: number, mesh: number): Tets {
    const { core } = this;
    core.call('pipeline_vertices', pipeline, mesh, core.result);
    const vertices = core.floats();
    core.call('pipeline_tets', pipeline, mesh, core.result);
    const tets = core.indices();
    core.call('pipeline_tet_quality', pipeline, mesh, kMinDihedral, core.result);
    return { vertices, tets, angles: core.floats() };
  }

  accuracy(): Accuracy {
    this.core.call('pipeline_accuracy', this.fine, this.core.result);
    return this.core.json<Accuracy>();
  }

  private grid(pipeline: number): Grid {
    this.core.call('pipeline_grid', pipeline, this.core.result);
    return this.core.grid();
  }

  slice(wish: SliceWish, pipeline = this.fine): Slice {
    const { core } = this;
    const grid = this.grid(pipeline);
    const layer = Math.min(grid.size[wish.axis] - 1, Math.max(0, Math.round(wish.position * grid.size[wish.axis] - 0.5)));
    core.call('pipeline_slice', pipeline, 1, wish.axis, layer, core.result);
    const [width, height] = [core.rowWidth(), core.rowCount()];
    const votes = core.floats();
    core.call('pipeline_slice', pipeline, 0, wish.axis, layer, core.result);
    return { axis: wish.axis, layer, width, height, votes, distance: core.floats(), grid };
  }
}
