// A simulation that plays: the meshed body that falls on the ground, or a built-in scene.
import type { Core } from './module';
import type { BodyFrame, BodyShape, Frame, Material, PlayStart, PlayWish, Report, Skin, Surface, Vec3 } from './protocol';
import type { Body } from './body';
import type { Mesher } from './mesher';

/** Of lengths, in metres, a body is played in its own size; else one metre long. */
const kPlayed = [0.05, 20] as const;
/** Of its size. */
const kDropHeight = 0.35;
const kStep = 1 / 60;
/** A handful of vertices is pulled, so that a pull does not tear at a single one. */
const kGrabbed = 8;
/** The pull of a body's length in multiples of its weight. */
const kPull = 12;
const kGravity = 9.81;
/** Triangles that a processor draws in some ten milliseconds. */
const kMostTriangles = 10000;
const kAllThreads = 0;
/** Of a body that is dropped, besides what the page says of its material. */
const kFeel = { damping_time: 0.004, friction: 0.8 };
const kWater: Material = { density: 1000, young: 63000, poisson: 0.4 };
/** A squeezed body that became stiff at once would fly off: its stiffness changes by at most this factor a frame, */
const kStiffening = 1.1;
/** and of its speed this much is left. */
const kCalmed = 0.3;

interface SceneBody {
  material?: Partial<Material>;
}

export class Player {
  private simulation = 0;
  private wish: PlayWish | null = null;
  private springs: { spring: number; offset: Vec3 }[] = [];
  private bodyCount = 0;
  private mass = 1;
  private size = 1;
  /** As it is, and as it shall be. */
  private material: Material | null = null;
  private wanted: Material | null = null;
  /** Of a scene, since it began. */
  private frames = 0;

  constructor(private readonly core: Core, private readonly mesher: Mesher, private readonly body: Body) {}

  get playing(): boolean {
    return this.simulation !== 0;
  }

  async start(wish: PlayWish): Promise<PlayStart> {
    this.stop();
    this.wish = wish;
    this.frames = 0;
    this.wanted = null;
    const title = this.build(wish.material);
    const { core } = this;
    core.call('simulation_body_count', this.simulation, core.result);
    this.bodyCount = core.word();
    core.call('simulation_report', this.simulation, core.result);
    const report = core.json<{ tet_count: number }>();
    const [bodies, obstacles] = [this.shapes(), this.obstacles()];
    const triangleCount = [...bodies, ...obstacles].reduce((sum, skin) => sum + skin.triangles.length / 3, 0);
    if (wish.drawnBy === 'processor') {
      const surfaces = this.frame().bodies;
      await spare([...bodies.map((body, i) => ({ ...surfaces[i], skin: body })), ...obstacles.map((o) => ({ ...o, skin: o }))], triangleCount);
    }
    return { bodies, obstacles, tetCount: report.tet_count, triangleCount, title, size: this.size };
  }

  /** From the next frames on. A scene's bodies are made anew for it, which takes long, so they change in one go. */
  setMaterial(material: Material): void {
    if (this.wish?.scene) this.change(material, 1);
    else this.wanted = material;
  }

  /** One frame's way to the wanted material. */
  private approach(wanted: Material): void {
    const now = this.material?.young ?? wanted.young;
    const young = Math.min(now * kStiffening, Math.max(now / kStiffening, wanted.young));
    this.change({ ...wanted, young }, kCalmed);
    if (young === wanted.young) this.wanted = null;
  }

  /** Everything stays where it is, of another material, and as fast as it is but for a factor. */
  private change(material: Material, kept: number): void {
    const { core } = this;
    const state: Float32Array<ArrayBuffer>[][] = [];
    for (let body = 0; body < this.bodyCount; ++body) state.push(['positions', 'velocities'].map((what) => {
      core.call('simulation_' + what, this.simulation, body, core.result);
      return core.floats();
    }));
    this.release();
    const old = this.simulation;
    this.build(material);
    core.number('simulation_destroy', old);
    for (const [, velocities] of state) velocities.forEach((v, i) => (velocities[i] = kept * v));
    if (this.wish?.scene) core.call('scene_seek', this.simulation, this.frames);
    state.forEach((arrays, body) => arrays.forEach((values, i) => core.withBytes(new Uint8Array(values.buffer), (at) =>
      core.call(i === 0 ? 'simulation_set_positions' : 'simulation_set_velocities', this.simulation, body, at,
        values.length / 3))));
  }

  private build(material: Material | null): string {
    const { wish } = this;
    this.material = material;
    this.core.number('set_thread_count', kAllThreads);
    const title = wish?.scene ? this.loadScene(wish.scene, material) : this.dropBody(material ?? kWater);
    // Steps are short, and whoever waits between them for the next loop would keep the core that draws.
    if (wish?.drawnBy === 'processor') this.core.number('set_thread_count', 1);
    return title;
  }

  private loadScene(name: string, material: Material | null): string {
    const { core } = this;
    core.withTexts([name], (text) => core.call('scene_text', text, core.result));
    const scene = core.json<{ title?: string; bodies: SceneBody[] }>();
    if (material) scene.bodies.forEach((body) => (body.material = { ...body.material, ...material }));
    core.withTexts([JSON.stringify(scene)], (text) =>
      core.call('scene_load', text, 0, core.progress, 0, core.result));
    this.simulation = core.word();
    this.mass = 20;
    this.size = 1;
    return scene.title ?? name;
  }

  private dropBody(material: Material): string {
    const { core } = this;
    const up = this.wish?.up ?? 2;
    const { soup, quality } = this.mesher.report as Report;
    const extent = soup.box.hi.map((hi, i) => hi - soup.box.lo[i]);
    const longest = Math.max(...extent);
    const size = longest * (this.wish?.metres ?? 1);
    this.size = size >= kPlayed[0] && size <= kPlayed[1] ? size : 1;
    const scale = this.size / longest;
    this.mass = material.density * quality.volume * scale ** 3;
    const middle = soup.box.lo.map((lo, i) => (lo + soup.box.hi[i]) / 2);
    // Quarter turns: with y up, one about x brings (x, y, z) to (x, -z, y); with x up, one about y brings it to (-z, y, x).
    const turned = [[-middle[2], middle[1]], [middle[0], -middle[2]], [middle[0], middle[1]]][up];
    const lowest = soup.box.lo[up];
    const place = {
      scale,
      rotate: [[0, -90, 0], [90, 0, 0], [0, 0, 0]][up],
      translate: [-scale * turned[0], -scale * turned[1], kDropHeight * this.size - scale * lowest],
    };
    const model = this.body.get();
    core.withTexts(['{}'], (options) => core.call('simulation_create', options, core.result));
    this.simulation = core.word();
    core.withTexts([JSON.stringify({ ...kFeel, ...material }), JSON.stringify(place)], (material, where) =>
      core.call('simulation_add_model', this.simulation, model, material, where, core.result));
    core.withDoubles([0, 0, 1], (normal) =>
      core.call('simulation_add_plane', this.simulation, normal, 0, kFeel.friction));
    return this.size === size ? 'The body falls on the ground' : 'The body falls on the ground, as if it were 1 m long';
  }

  private shapes(): BodyShape[] {
    const { core } = this;
    return Array.from({ length: this.bodyCount }, (_, body) => {
      core.call('simulation_tets', this.simulation, body, core.result);
      const tets = core.indices();
      core.call('simulation_triangles', this.simulation, body, core.result);
      return { tets, triangles: core.indices(), outward: false };
    });
  }

  private obstacles(): (Skin & Surface)[] {
    const { core } = this;
    if (!this.wish?.scene) return [];
    core.call('scene_obstacle_count', this.simulation, core.result);
    return Array.from({ length: core.word() }, (_, i) => {
      core.call('scene_obstacle', this.simulation, i, core.result, core.result + 12);
      return { vertices: core.floats(), triangles: core.indices(12), outward: false };
    });
  }

  advance(): Frame {
    const { core } = this;
    const since = performance.now();
    if (this.wanted) this.approach(this.wanted);
    if (this.wish?.scene) {
      core.call('scene_advance', this.simulation);
      ++this.frames;
    } else core.call('simulation_step', this.simulation, kStep);
    return { ...this.frame(), simulateMilliseconds: performance.now() - since };
  }

  frame(): Frame {
    const { core } = this;
    const bodies: BodyFrame[] = [];
    for (let body = 0; body < this.bodyCount; ++body) {
      core.call('simulation_surface', this.simulation, body, core.result, core.result + 12);
      const [vertices, normals] = [core.floats(), core.floats(12)];
      core.call('simulation_positions', this.simulation, body, core.result);
      bodies.push({ vertices, normals, positions: core.floats() });
    }
    return { bodies, simulateMilliseconds: 0 };
  }

  grab(body: number, vertex: number, target: Vec3): void {
    this.release();
    const { core } = this;
    core.call('simulation_positions', this.simulation, body, core.result);
    const positions = core.floats();
    const at = (i: number): Vec3 => [positions[3 * i], positions[3 * i + 1], positions[3 * i + 2]];
    const centre = at(vertex);
    const distance = (i: number) => Math.hypot(...at(i).map((x, axis) => x - centre[axis]));
    const near = Array.from({ length: positions.length / 3 }, (_, i) => i)
      .sort((a, b) => distance(a) - distance(b)).slice(0, kGrabbed);
    const stiffness = (kPull * this.mass * kGravity) / near.length / this.size;
    for (const i of near) {
      const offset = at(i).map((x, axis) => x - centre[axis]) as Vec3;
      const goal = target.map((x, axis) => x + offset[axis]);
      core.withDoubles(goal, (to) =>
        core.call('simulation_add_spring', this.simulation, body, i, to, stiffness, core.result));
      this.springs.push({ spring: core.word(), offset });
    }
  }

  drag(target: Vec3): void {
    for (const { spring, offset } of this.springs)
      this.core.withDoubles(target.map((x, axis) => x + offset[axis]), (to) =>
        this.core.call('simulation_move_spring', this.simulation, spring, to));
  }

  release(): void {
    for (const { spring } of this.springs) this.core.call('simulation_remove_spring', this.simulation, spring);
    this.springs = [];
  }

  stop(): void {
    this.springs = [];
    this.core.number('simulation_destroy', this.simulation);
    this.core.number('set_thread_count', kAllThreads);
    this.simulation = 0;
  }
}

interface Drawn {
  vertices: Float32Array;
  skin: Skin;
}

/** Leaves of all that is drawn so many triangles as a processor draws in time. */
async function spare(drawn: Drawn[], triangleCount: number): Promise<void> {
  const { thin, facesOutward } = await import('./thin');
  for (const { vertices, skin } of drawn) {
    const share = skin.triangles.length / 3 / triangleCount;
    skin.triangles = await thin(vertices, skin.triangles, Math.ceil(share * kMostTriangles));
    skin.outward = facesOutward(vertices, skin.triangles);
  }
}
