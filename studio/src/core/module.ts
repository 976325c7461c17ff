// The WebAssembly module behind the C interface: calls, texts, views. Nobody else touches the heap.
import type { Grid, Vec3 } from './protocol';

interface Emscripten {
  HEAPU8: Uint8Array;
  FS: {
    readFile(path: string): Uint8Array;
    unlink(path: string): void;
    mkdir(path: string): void;
    readdir(path: string): string[];
  };
  UTF8ToString(pointer: number): string;
  stringToUTF8(text: string, pointer: number, size: number): void;
  lengthBytesUTF8(text: string): number;
  addFunction(f: (...args: number[]) => number, signature: string): number;
  [name: string]: unknown;
}
type Create = (options: Record<string, unknown>) => Promise<Emscripten>;

const kOk = 0;
export const kUnreadable = 2;
export const kCancelled = 3;
const kOutOfMemory = 4;

/** A status other than OK, with the library's own words. */
export class CoreError extends Error {
  constructor(readonly status: number, message: string) {
    super(message);
  }
}

const kMemory = { initial: 1024, maximum: 32768 };
const kResultBytes = 96;

export class Core {
  /** Where functions leave their results. */
  readonly result: number;
  readonly progress: number;
  onProgress: (stage: string, fraction: number) => boolean = () => true;

  private constructor(private readonly module: Emscripten, private readonly memory: WebAssembly.Memory | null) {
    this.result = this.allocate(kResultBytes);
    this.progress = module.addFunction(
      (stage, fraction) => (this.onProgress(module.UTF8ToString(stage), fraction) ? 1 : 0), 'iidi');
  }

  /** @param base  Where `core/` and `core-threads/` are. Threads need shared memory, so an isolated page. */
  static async load(base: string, threads: boolean): Promise<Core> {
    const folder = new URL(threads ? 'core-threads/' : 'core/', base).href;
    const create = ((await import(/* @vite-ignore */ folder + 'tetsoup.js')) as { default: Create }).default;
    // Another thread may grow shared memory, which the module's own views would not see; ours are made when needed.
    const memory = threads ? new WebAssembly.Memory({ ...kMemory, shared: true }) : null;
    const options: Record<string, unknown> = {
      locateFile: (name: string) => folder + name,
      mainScriptUrlOrBlob: folder + 'tetsoup.js',
      printErr: () => undefined,
    };
    if (memory) options.wasmMemory = memory;
    const module = await create(options);
    module.FS.mkdir('/out');
    return new Core(module, memory);
  }

  private get buffer(): ArrayBufferLike {
    return this.memory ? this.memory.buffer : this.module.HEAPU8.buffer;
  }

  /** Calls a function that returns a status; throws where it is not OK. */
  call(name: string, ...args: number[]): void {
    const status = this.number(name, ...args);
    if (status === kOk) return;
    throw new CoreError(status, this.text(this.number('last_error')));
  }

  number(name: string, ...args: number[]): number {
    return (this.module['_tetsoup_' + name] as (...args: number[]) => number)(...args);
  }

  text(pointer: number): string {
    return this.module.UTF8ToString(pointer);
  }

  allocate(bytes: number): number {
    const pointer = (this.module._malloc as (n: number) => number)(bytes);
    if (!pointer) throw new CoreError(kOutOfMemory, 'this does not fit into the memory of this page');
    return pointer;
  }

  free(pointer: number): void {
    (this.module._free as (p: number) => void)(pointer);
  }

  /** Runs `body` with texts as C has them, null staying null. */
  withTexts<T>(texts: (string | null)[], body: (...pointers: number[]) => T): T {
    const pointers: number[] = [];
    try {
      for (const text of texts) {
        const size = text === null ? 0 : this.module.lengthBytesUTF8(text) + 1;
        pointers.push(text === null ? 0 : this.allocate(size));
        if (text !== null) this.module.stringToUTF8(text, pointers[pointers.length - 1], size);
      }
      return body(...pointers);
    } finally {
      pointers.forEach((pointer) => pointer && this.free(pointer));
    }
  }

  withBytes<T>(bytes: Uint8Array, body: (pointer: number) => T): T {
    const pointer = this.allocate(Math.max(bytes.byteLength, 8));
    try {
      new Uint8Array(this.buffer).set(bytes, pointer);
      return body(pointer);
    } finally {
      this.free(pointer);
    }
  }

  withDoubles<T>(values: readonly number[], body: (pointer: number) => T): T {
    return this.withBytes(new Uint8Array(new Float64Array(values).buffer), body);
  }

  word(offset = 0): number {
    return new DataView(this.buffer).getUint32(this.result + offset, true);
  }

  json<T>(): T {
    return JSON.parse(this.text(this.word())) as T;
  }

  private rows(offset: number): { data: number; count: number } {
    return { data: this.word(offset), count: this.word(offset + 4) * this.word(offset + 8) };
  }

  /** Copies of views at the place of results. */
  floats(offset = 0): Float32Array<ArrayBuffer> {
    const { data, count } = this.rows(offset);
    return new Float32Array(new Float32Array(this.buffer, data, count));
  }

  indices(offset = 0): Uint32Array<ArrayBuffer> {
    const { data, count } = this.rows(offset);
    return new Uint32Array(new Uint32Array(this.buffer, data, count));
  }

  rowWidth(offset = 0): number {
    return this.word(offset + 8);
  }

  rowCount(offset = 0): number {
    return this.word(offset + 4);
  }

  grid(): Grid {
    const view = new DataView(this.buffer, this.result);
    const double = (i: number) => view.getFloat64(8 * i, true);
    const int = (i: number) => view.getInt32(48 + 4 * i, true);
    return {
      origin: [double(0), double(1), double(2)] as Vec3,
      voxelSize: double(3),
      band: double(5),
      size: [int(0), int(1), int(2)] as Vec3,
      rays: int(4),
    };
  }

  /** Reads what was written, and removes it. */
  takeFile(path: string): Uint8Array<ArrayBuffer> {
    const bytes = new Uint8Array(this.module.FS.readFile(path));
    this.module.FS.unlink(path);
    return bytes;
  }
}
