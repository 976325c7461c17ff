// Where the soup comes from: a sample, or a file that was opened. Undo comes back to both.
import type { Client } from './core/client';
import type { Source as SoupSource } from './core/protocol';
import type { Settings, Store } from './state';

/** Formats whose files have y up, or are in millimetres, by custom. */
const kYUp = /\.(obj|gltf|glb)$/i;
const kMillimetres = /\.3mf$/i;

function nameOf(s: Settings): string {
  return JSON.stringify([s.sample, s.damage, s.file]);
}

export class Source {
  /** What the soup that is shown was made from, and of which model it is. */
  private shown = nameOf({ sample: '', damage: 0, file: '' } as Settings);
  private model = '';
  /** The model that was asked for, and the first job that asked for it: while damage moves, each answer is shown. */
  private asked = '';
  private first = Infinity;
  private last = 0;
  /** The model's up is a custom, and may be guessed better once the model is there. */
  guessed: 'y' | 'z' | null = null;
  /** Handles of files that were opened; their bytes stay on disk. */
  private readonly files = new Map<string, File>();

  constructor(private readonly client: Client, private readonly store: Store,
              private readonly actions: { loading(text: string): void; lost(file: string): void; nothing(): void }) {}

  openSample(name: string): void {
    this.guessed = null;
    this.store.set({ sample: name, file: '', up: 'z', unit: name === 'torus' ? 'cm' : 'm', damage: 0, camera: null });
    this.store.endStep();
  }

  openFile(file: File): void {
    this.files.set(file.name, file);
    // Even under the same name it may be another one.
    if (file.name === this.store.now.file) this.shown = this.model = this.asked = '';
    const before = this.store.now;
    // What the address says holds for the file that it was made with; what another model was like does not.
    const told = new URLSearchParams(before.sample || before.file ? '' : location.hash.slice(1));
    this.guessed = told.has('up') ? null : kYUp.test(file.name) ? 'y' : 'z';
    const up = this.guessed ?? before.up;
    const unit = told.has('unit') ? before.unit : kMillimetres.test(file.name) ? 'mm' : 'm';
    this.store.set({ file: file.name, sample: '', damage: 0, up, unit, camera: told.has('camera') ? before.camera : null });
    this.store.endStep();
    if (this.store.now === before) void this.load();
  }

  /** Brings what the settings name, unless it is there. */
  async load(): Promise<void> {
    const { sample, damage, file } = this.store.now;
    const wanted = nameOf(this.store.now);
    if (wanted === this.shown) return;
    if (this.asked !== `${sample}/${file}`) this.first = Infinity;
    this.asked = `${sample}/${file}`;
    if (!sample && !file) {
      this.client.cancel();
      this.shown = wanted;
      return this.actions.nothing();
    }
    this.actions.loading(file ? `Reading ${file}` : 'Making the sample');
    if (sample) return this.ask({ kind: 'sample', name: sample, damage: damage / 100, seed: 1 });
    // Files may be gone by now, and folders can be dropped like files.
    const bytes = await this.files.get(file)?.arrayBuffer().catch(() => null);
    if (nameOf(this.store.now) !== wanted) return;
    if (!bytes) return this.actions.lost(file);
    this.ask({ kind: 'file', name: file, bytes }, [bytes]);
  }

  private ask(source: SoupSource, transfer: Transferable[] = []): void {
    this.last = this.client.ask({ type: 'load', source }, transfer);
    this.first = Math.min(this.first, this.last);
  }

  /** Whether a job asked for the model that is wanted now. */
  asks(job: number): boolean {
    return job >= this.first;
  }

  /** Whether a job was the last to ask for a model. */
  isLast(job: number): boolean {
    return job === this.last;
  }

  /** The soup that was wanted is there. Returns whether it is of another model than the last one. */
  loaded(): boolean {
    const another = this.model !== this.asked;
    this.model = this.asked;
    this.shown = nameOf(this.store.now);
    return another;
  }
}
