// The worker that the core runs in. Of wishes for a mesh only the newest counts: a newer one cancels the work in flight,
// through shared memory where the page is isolated, else between two stages.
import { Core, CoreError, kCancelled } from './module';
import { Mesher } from './mesher';
import { Body } from './body';
import { Player } from './player';
import type { Catalog, Reply, Request, Vec3 } from './protocol';

type MeshRequest = Extract<Request, { type: 'mesh' }>;
type Job = Extract<Request, { job: number }>;

const kFrameMilliseconds = 1000 / 60;
/** Frames that may be on their way before one of them is drawn. */
const kFramesAhead = 2;
const kProgressMilliseconds = 80;
const kInternalError = 5;

let shared: Int32Array | null = null;
let core: Core;
let mesher: Mesher;
let body: Body;
let player: Player;
const jobs: Job[] = [];
let mesh: MeshRequest | null = null;
let running = 0;
let newest = 0;
let busy = false;
let paused = false;
let undrawn = 0;
let nextFrame = 0;

function reply(message: Reply, transfer: Transferable[] = []): void {
  (self as unknown as { postMessage(m: Reply, t: Transferable[]): void }).postMessage(message, transfer);
}

// Lets messages in that have arrived; a timer would wait for four milliseconds.
const channel = new MessageChannel();
let resume: (() => void) | null = null;
channel.port1.onmessage = () => resume?.();
function breathe(): Promise<void> {
  return new Promise((done) => {
    resume = done;
    channel.port2.postMessage(0);
  });
}

function stale(job: number): boolean {
  return job < newest || (shared !== null && Atomics.load(shared, 0) > job);
}

async function start(base: string): Promise<void> {
  const threads = shared !== null && (navigator.hardwareConcurrency ?? 1) > 1;
  core = await Core.load(base, threads);
  mesher = new Mesher(core);
  body = new Body(core, mesher);
  player = new Player(core, mesher, body);
  let told = 0;
  core.onProgress = (stage, fraction) => {
    const now = performance.now();
    if (now - told > kProgressMilliseconds) {
      told = now;
      reply({ type: 'progress', job: running, stage, fraction });
    }
    return !stale(running);
  };
  reply({ type: 'ready', catalog: catalog() });
}

function catalog(): Catalog {
  const list = <T>(what: string): T => {
    core.call(what + '_list', core.result);
    return core.json<T>();
  };
  return {
    version: core.text(core.number('version')),
    threads: core.number('thread_count'),
    samples: list('sample'),
    scenes: list('scene'),
    formats: list('format'),
    engines: list('engine'),
  };
}

async function runMesh(request: MeshRequest): Promise<void> {
  const since = performance.now();
  const steps = mesher.wantsCoarse(request.options) ? [true, false] : [false];
  for (const coarse of steps) {
    for (const stage of mesher.run(request.options, coarse)) {
      if (!shared) await breathe();
      if (stale(request.job)) throw new CoreError(kCancelled, 'cancelled after ' + stage);
    }
    const result = mesher.result(coarse, request.options, request.material, request.slice, since);
    const transfer = [result.lattice, result.final].flatMap((tets) =>
      [tets.vertices.buffer, tets.tets.buffer, tets.angles.buffer]) as Transferable[];
    reply({ type: 'mesh', job: request.job, result, done: !coarse }, transfer);
    await breathe();
    if (!coarse) return;
    if (stale(request.job)) throw new CoreError(kCancelled, 'cancelled after the coarse mesh');
  }
}

function needMesh(): void {
  if (!mesher.finished) throw new CoreError(1, 'there is no finished mesh yet: wait until it is done, then try again');
}

async function runJob(request: Job): Promise<void> {
  const { job } = request;
  switch (request.type) {
    case 'mesh': return runMesh(request);
    case 'load': {
      player.stop();
      const { surface, report } = mesher.load(request.source);
      return reply({ type: 'soup', job, surface, report }, [surface.vertices.buffer, surface.triangles.buffer] as Transferable[]);
    }
    case 'slice': return mesher.finished ? reply({ type: 'slice', job, slice: mesher.slice(request.slice) }) : undefined;
    case 'embed':
      needMesh();
      return reply({ type: 'embed', job, report: body.report() });
    case 'accuracy': return mesher.finished ? reply({ type: 'accuracy', job, accuracy: mesher.accuracy() }) : undefined;
    case 'export':
      needMesh();
      return reply({ type: 'files', job, ...body.write(request.wish) });
    case 'play': {
      if (!request.wish.scene) needMesh();
      const begin = await player.start(request.wish);
      if (!player.playing) return; // Stopped before it began.
      undrawn = 0;
      paused = false;
      reply({ type: 'playing', job, start: begin });
      return sendFrame(false);
    }
    case 'material': return player.playing ? player.setMaterial(request.material) : undefined;
  }
}

async function guarded(request: Job): Promise<void> {
  running = request.job;
  try {
    await runJob(request);
  } catch (error) {
    if (error instanceof CoreError && error.status === kCancelled) reply({ type: 'cancelled', job: request.job });
    else if (error instanceof CoreError)
      reply({ type: 'error', job: request.job, message: error.message, status: error.status });
    else reply({ type: 'error', job: request.job, message: String(error), status: kInternalError });
  }
}

function sendFrame(advance: boolean): void {
  const frame = advance ? player.advance() : player.frame();
  undrawn += 1;
  nextFrame = Math.max(nextFrame + kFrameMilliseconds, performance.now() - kFrameMilliseconds);
  const transfer = frame.bodies.flatMap((b) => [b.vertices.buffer, b.normals.buffer, b.positions.buffer]) as Transferable[];
  reply({ type: 'frame', frame }, transfer);
}

/** Does what there is to do, and plays while there is nothing else. */
async function work(): Promise<void> {
  if (busy || !core) return;
  busy = true;
  for (;;) {
    const request = jobs.shift() ?? mesh;
    if (request) {
      if (request === mesh) mesh = null;
      await guarded(request);
    } else if (player.playing && !paused && undrawn < kFramesAhead) {
      const early = nextFrame - performance.now();
      if (early > 1) await new Promise((done) => setTimeout(done, early));
      else sendFrame(true);
    } else break;
    await breathe();
  }
  busy = false;
}

function control(request: Request): void {
  const live = core && player.playing;
  if (request.type === 'cancel') {
    newest = request.newest;
    mesh = null;
  } else if (request.type === 'drawn') undrawn = Math.max(0, undrawn - 1);
  else if (request.type === 'pause') paused = request.paused;
  else if (request.type === 'stop' && core) player.stop();
  else if (request.type === 'grab' && live) player.grab(request.body, request.vertex, request.target as Vec3);
  else if (request.type === 'drag' && live) player.drag(request.target as Vec3);
  else if (request.type === 'release' && live) player.release();
}

self.onmessage = async (event: MessageEvent<Request>) => {
  const request = event.data;
  if (request.type === 'start') {
    shared = request.shared;
    try {
      await start(request.base);
    } catch (error) {
      reply({ type: 'fatal', message: String(error) });
    }
  } else if (!('job' in request)) control(request);
  else if (request.type === 'mesh') {
    newest = request.job;
    mesh = request;
  } else {
    if (request.type === 'load') {
      newest = request.job;
      mesh = null;
    }
    // Of materials only the newest counts, too.
    const old = request.type === 'material' ? jobs.findIndex((job) => job.type === 'material') : -1;
    if (old >= 0) jobs.splice(old, 1);
    jobs.push(request);
  }
  void work();
};
