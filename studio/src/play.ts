// Playing: from the button to moving bodies, with the times that simulating and drawing take.
import type { Client } from './core/client';
import type { Frame, Material, PlayStart, Vec3 } from './core/protocol';
import type { Stage } from './view/stage';
import { PlayView } from './view/play_view';
import type { Viewport } from './ui/viewport';
import { milliseconds } from './ui/words';

/** Times are averages of so many frames. */
const kAveraged = 20;
/** A scene's bodies are made anew for another material: once nobody has changed it for so many milliseconds. */
const kSettled = 300;

export interface PlayStats {
  frames: number;
  framesPerSecond: number;
  simulate: number;
  draw: number;
  /** Around the first body: least and greatest x, y, z, in metres. */
  box: number[];
}

export class Play {
  readonly view: PlayView;
  on = false;
  paused = false;
  readonly stats: PlayStats = { frames: 0, framesPerSecond: 0, simulate: 0, draw: 0, box: [] };
  private scene: string | null = null;
  private changing = 0;
  private arrivals: { at: number; simulate: number; draw: number }[] = [];

  constructor(private readonly client: Client, private readonly stage: Stage, private readonly viewport: Viewport,
              private readonly settings: () => { up: number; metres: number; material: Material }, private readonly changed: () => void,
              private readonly noted: (stats: PlayStats) => void) {
    this.view = new PlayView(stage, {
      grab: (body, vertex, target: Vec3) => client.send({ type: 'grab', body, vertex, target }),
      drag: (target: Vec3) => client.send({ type: 'drag', target }),
      release: () => client.send({ type: 'release' }),
    });
  }

  begin(scene: string | null, keepLook = false): void {
    this.view.keepLook(keepLook);
    this.scene = scene;
    this.viewport.setStatus(scene ? 'Meshing the scene' : 'Preparing the body', true, scene !== null);
    const { up, metres, material } = this.settings();
    this.client.ask({ type: 'play', wish: { scene, up, metres, material: scene ? null : material, drawnBy: this.stage.drawnBy } });
  }

  started(start: PlayStart): void {
    this.on = true;
    this.paused = false;
    this.arrivals = [];
    this.stats.frames = 0;
    this.view.start(start);
    this.viewport.setPlaying(true);
    this.viewport.setPaused(false);
    this.changed();
  }

  frame(frame: Frame): void {
    if (!this.on) return;
    this.view.show(frame);
    this.stage.onDrawn(() => {
      this.client.send({ type: 'drawn' });
      this.note(frame);
    });
  }

  private note(frame: Frame): void {
    this.arrivals.push({ at: performance.now(), simulate: frame.simulateMilliseconds, draw: this.stage.drawMilliseconds });
    if (this.arrivals.length > kAveraged) this.arrivals.shift();
    const { arrivals, stats } = this;
    const mean = (key: 'simulate' | 'draw') => arrivals.reduce((sum, a) => sum + a[key], 0) / arrivals.length;
    stats.frames += 1;
    stats.simulate = mean('simulate');
    stats.draw = mean('draw');
    stats.box = this.view.boxOfFirst();
    const time = arrivals[arrivals.length - 1].at - arrivals[0].at;
    stats.framesPerSecond = time > 0 ? (1000 * (arrivals.length - 1)) / time : 0;
    this.noted(stats);
    if (stats.frames % 6 !== 1) return;
    this.viewport.setStatus(`${Math.round(stats.framesPerSecond)} frames/s · simulating ${milliseconds(stats.simulate)}, drawing ${milliseconds(stats.draw)}`);
  }

  pause(): void {
    this.paused = !this.paused;
    this.client.send({ type: 'pause', paused: this.paused });
    this.viewport.setPaused(this.paused);
  }

  /** From the beginning, seen from where it is seen now. */
  reset(): void {
    this.begin(this.scene, true);
  }

  setMaterial(material: Material): void {
    clearTimeout(this.changing);
    if (!this.on) return;
    const ask = () => this.client.ask({ type: 'material', material });
    if (this.scene) this.changing = setTimeout(ask, kSettled);
    else ask();
  }

  look(tets: boolean): void {
    this.view.setLook(tets);
  }

  stop(): void {
    if (!this.on) return;
    this.on = false;
    clearTimeout(this.changing);
    this.client.send({ type: 'stop' });
    this.view.empty();
    this.viewport.setPlaying(false);
    this.changed();
  }
}
