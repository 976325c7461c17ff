// Where the soup comes from: a sample, or a file that was opened. Undo comes back to both.
import type { Client } from './core/client';
import type { Settings, Store } from './state';

/** Formats whose files have y up by custom. */
const kYUp = /\.(obj|gltf|glb)$/i;

function nameOf(s: Settings): string {
  return JSON.stringify([s.sample, s.damage, s.file]);
}

export class Source {
  /** What the soup that is shown was made from. */
  private shown = nameOf({ sample: '', damage: 0, file: '' } as Settings);
  private model = '';
  private job = 0;
  /** Handles of files that were opened; their bytes stay on disk. */
  private readonly files = new Map<string, File>();

  constructor(private readonly client: Client, private readonly store: Store,
              private readonly actions: { loading(text: string): void; lost(file: string): void; nothing(): void }) {}

  openSample(name: string): void {
    this.store.set({ sample: name, file: '', up: 'z', unit: name === 'torus' ? 'cm' : 'm', damage: 0 });
    this.store.endStep();
  }

  openFile(file: File): void {
    this.files.set(file.name, file);
    this.shown = this.model = ''; // Even under the same name it may be another one.
    const before = this.store.now;
    this.store.set({ file: file.name, sample: '', damage: 0, up: kYUp.test(file.name) ? 'y' : 'z' });
    this.store.endStep();
    if (this.store.now === before) void this.load();
  }

  /** Brings what the settings name, unless it is there. */
  async load(): Promise<void> {
    const { sample, damage, file } = this.store.now;
    const wanted = nameOf(this.store.now);
    if (wanted === this.shown) return;
    if (!sample && !file) {
      this.client.cancel();
      this.job = 0;
      this.shown = wanted;
      return this.actions.nothing();
    }
    this.actions.loading(file ? `Reading ${file}` : 'Making the sample');
    if (sample) {
      this.job = this.client.ask({ type: 'load', source: { kind: 'sample', name: sample, damage: damage / 100, seed: 1 } });
      return;
    }
    // Files may be gone by now, and folders can be dropped like files.
    const bytes = await this.files.get(file)?.arrayBuffer().catch(() => null);
    if (nameOf(this.store.now) !== wanted) return;
    if (!bytes) return this.actions.lost(file);
    this.job = this.client.ask({ type: 'load', source: { kind: 'file', name: file, bytes } }, [bytes]);
  }

  /** Whether a job was the one that brought what is wanted now. */
  isWanted(job: number): boolean {
    return job === this.job;
  }

  /** The soup that was wanted is there. Returns whether it is of another model than the last one. */
  loaded(): boolean {
    const { sample, file } = this.store.now;
    const another = this.model !== `${sample}/${file}`;
    this.model = `${sample}/${file}`;
    this.shown = nameOf(this.store.now);
    return another;
  }
}
