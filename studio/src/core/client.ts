// The page's side of the worker: numbers jobs, says which is newest, and hands replies to whom they concern.
import type { Reply, Request } from './protocol';

type WithoutJob<T> = T extends { job: number } ? Omit<T, 'job'> : never;
export type Wish = WithoutJob<Request>;

export class Client {
  private readonly worker: Worker;
  private readonly shared: Int32Array | null;
  private job = 0;

  constructor(onReply: (reply: Reply) => void) {
    this.worker = new Worker(new URL('./worker.ts', import.meta.url), { type: 'module' });
    this.shared = self.crossOriginIsolated ? new Int32Array(new SharedArrayBuffer(4)) : null;
    this.worker.onmessage = (event: MessageEvent<Reply>) => onReply(event.data);
    this.worker.onerror = (event) => onReply({ type: 'fatal', message: event.message || 'the worker did not start' });
    this.send({ type: 'start', base: document.baseURI.replace(/#.*$/, ''), shared: this.shared });
  }

  /** Asks for work; a new mesh or soup cancels the mesh in flight. Returns the job's number. */
  ask(wish: Wish, transfer: Transferable[] = []): number {
    const job = ++this.job;
    if (wish.type === 'mesh' || wish.type === 'load') this.cancel(job);
    this.send({ ...wish, job } as Request, transfer);
    return job;
  }

  cancel(newest = ++this.job): void {
    if (this.shared) Atomics.store(this.shared, 0, newest);
    this.send({ type: 'cancel', newest });
  }

  send(request: Request, transfer: Transferable[] = []): void {
    this.worker.postMessage(request, transfer);
  }
}
