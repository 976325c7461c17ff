// The page: what the user does becomes settings, settings become wishes to the worker, and replies become pictures.
import { Client } from './core/client';
import type { Catalog, Material, MeshResult, PlayStart, Reply, Report, Slice, SoupReport, Surface, Tets, Vec3 } from './core/protocol';
import { Address } from './address';
import { Play } from './play';
import { Source } from './source';
import type { Checked } from './ui/checks';
import { fromAddress, heightOf, kUnits, materialOf, meshOptions, meshSettings, type Settings, kViewKeys, Store, toAddress } from './state';
import { Theme } from './theme';
import { guessUp } from './up';
import { el, icon } from './ui/dom';
import { acceptDrops, emptyState, kAccepted } from './ui/empty';
import { download, downloadFiles, ExportDialog, type ExportChoice } from './ui/export_dialog';
import { Header } from './ui/header';
import { keysDialog, listenToKeys } from './ui/keys';
import { makeNotice } from './ui/notice';
import { Panels } from './ui/panels';
import { Verdict } from './ui/verdict';
import { asCommand, asPython } from './ui/recipe';
import { Viewport } from './ui/viewport';
import * as words from './ui/words';
import { ModelView } from './view/model_view';
import { findProblem } from './view/problems';
import { Stage } from './view/stage';

/** What can be opened, by its name. */
const kModel = /\.(obj|stl|ply|off|gltf|glb|3mf|dae)$/i;
/** Milliseconds without a change, after which there is time for more. */
const kRest = 400;
const kUpAxis = { x: 0, y: 1, z: 2 } as const;

export class App {
  private readonly store = new Store(fromAddress(location.hash));
  private readonly viewport: Viewport;
  private readonly stage: Stage;
  private readonly view: ModelView;
  private readonly play: Play;
  private readonly theme: Theme;
  private readonly client: Client;
  private readonly source: Source;
  private panels: Panels | null = null;
  private exporter: ExportDialog | null = null;
  private empty: HTMLElement;
  private soup: SoupReport | null = null;
  private report: Report | null = null;
  private slice: Slice | null = null;
  private meshDone = false;
  private meshJob = 0;
  private sliceJob = 0;
  private accuracyJob = 0;
  private accuracyTimer = 0;
  private surface: Surface | null = null;
  /** Settings that the last finished mesh of this soup was made with. */
  private meshed: Partial<Settings> | null = null;
  private wished: Partial<Settings> | null = null;
  private mesh: Tets | null = null;
  private wishedAt = 0;
  private exportStem = '';
  /** The status line of the mesh that is shown. */
  private finished = '';
  private readonly picker = el('input', { type: 'file', accept: kAccepted, hidden: true, 'aria-label': 'Model file', onchange: () => this.pickFile() });
  private readonly keys = keysDialog();
  private readonly address = new Address();
  private readonly notice = makeNotice();
  private readonly verdict = new Verdict({
    apply: (change) => {
      this.store.set(change);
      this.store.endStep();
    },
    mark: (check) => this.mark(check),
    opened: () => this.askAccuracy(),
  });
  private readonly drop = el('button', { type: 'button', id: 'drop', disabled: true, onclick: () => this.startPlaying(null) }, icon('play'), 'Drop it');
  private readonly header: Header;

  constructor(private readonly root: HTMLElement) {
    this.viewport = new Viewport({
      change: (part) => this.store.set(part), done: () => this.store.endStep(), look: () => this.showLook(), fit: () => this.fitByHand(),
      pause: () => this.play.pause(), cancel: () => this.cancel(), reset: () => this.play.reset(), stop: () => this.stopPlaying(),
    }, undefined, { buttons: [this.verdict.chip, this.drop], card: this.verdict.card });
    this.header = new Header({
      open: () => this.picker.click(), undo: () => this.store.undo(), redo: () => this.store.redo(),
      help: () => this.help(), copyLink: () => void this.copyLink(), toggleTheme: () => this.theme.toggle(), export: () => this.openExport(),
    });
    this.empty = emptyState(null, () => this.picker.click(), () => undefined, () => undefined);
    this.viewport.element.append(this.empty, this.notice.element);
    this.root.append(el('a', { class: 'skip', href: '#model', onclick: (event) => this.skip(event) }, 'Skip to the model'), this.header.element, el('aside', { 'aria-label': 'Settings' }), this.viewport.element, this.picker, this.keys);
    this.stage = new Stage(this.viewport.canvas, 'The model in 3D. Arrow keys turn it, plus and minus zoom.');
    this.stage.onLook = (camera) => {
      this.root.dataset.camera = camera.join(' ');
      if (!this.play.on && this.soup) this.store.note({ camera });
    };
    this.stage.onLost = (lost) => (lost ? this.notice.complain(words.kPictureLost) : this.notice.hide());
    this.view = new ModelView(this.stage,
      (translate, rotate) => this.store.set({ translate, rotate }), () => this.store.endStep());
    this.client = new Client((reply) => this.onReply(reply));
    this.source = new Source(this.client, this.store, {
      loading: (text) => this.viewport.setStatus(text, true),
      lost: (file) => this.onLost(file),
      nothing: () => this.showNothing(),
    });
    this.play = new Play(this.client, this.stage, this.viewport,
      () => ({ up: kUpAxis[this.store.now.up], metres: kUnits[this.store.now.unit].metres, material: this.material() }), () => this.showLook(),
      ({ frames, framesPerSecond, simulate, draw, box }) => Object.assign(this.root.dataset, { frames, fps: framesPerSecond.toFixed(1),
        simulate: simulate.toFixed(1), draw: draw.toFixed(1), box: box.map((x) => x.toFixed(3)).join(' ') }));
    this.theme = new Theme((dark) => this.paint(dark));
    this.theme.apply();
    this.store.onChange((now, before) => this.onSettings(now, before));
    this.listen();
  }

  private listen(): void {
    acceptDrops((files, address) => void this.openDropped(files, address));
    addEventListener('hashchange', () => {
      const wanted = fromAddress(location.hash);
      if (!wanted.sample) wanted.file = this.store.now.file;
      if (toAddress(wanted) !== toAddress(this.store.now)) this.store.set(wanted);
    });
    listenToKeys({
      undo: () => this.store.undo(), redo: () => this.store.redo(), fit: () => this.fitByHand(),
      view: (view) => this.soup && !this.play.on && this.store.set({ view }),
      turn: () => this.soup && !this.play.on && this.turn(), cut: () => this.soup && !this.play.on && this.viewport.toggleCut(),
      quality: () => this.soup && !this.play.on && this.store.set({ quality: this.store.now.quality === 'on' ? 'off' : 'on' }),
      play: () => (this.play.on ? this.play.pause() : this.drop.disabled ? undefined : this.startPlaying(null)),
      reset: () => this.play.on && this.play.reset(), leave: () => this.leave(), help: () => this.help(),
    });
  }

  private help(): void {
    if (!this.keys.open) this.keys.showModal();
  }

  /** To the picture, or to what there is before there is one. */
  private skip(event: Event): void {
    event.preventDefault();
    (this.empty.hidden ? this.stage.renderer.domElement : this.empty.querySelector('button'))?.focus();
  }

  private leave(): void {
    if (!this.notice.element.hidden) this.notice.hide();
    else if (this.verdict.open) this.verdict.close();
    else if (this.play.on) this.stopPlaying();
    else this.panels?.setGizmo(null);
  }

  /** The next axis is up. */
  private turn(): void {
    this.store.set({ up: ({ x: 'y', y: 'z', z: 'x' } as const)[this.store.now.up] });
    this.store.endStep();
  }

  /** Ends what takes long. The settings become those of the mesh that is shown, if there is one. */
  private cancel(): void {
    this.client.cancel();
    this.viewport.setStatus('Cancelled');
    if (this.root.dataset.state === 'preparing') this.root.dataset.state = this.meshDone ? 'done' : '';
    else {
      this.root.dataset.state = 'cancelled';
      if (this.meshed) this.store.set(this.meshed);
    }
  }

  // --- what the worker says ------------------------------------------------------------------------------------------

  private onReply(reply: Reply): void {
    switch (reply.type) {
      case 'ready': return this.onReady(reply.catalog);
      case 'fatal': return this.notice.complain(`The mesher could not be started: ${reply.message}. It needs a browser from 2022 or later, and a page served over http.`);
      case 'soup': return this.source.asks(reply.job) ? this.onSoup(reply.surface, reply.report) : undefined;
      case 'mesh': return reply.job === this.meshJob ? this.onMesh(reply.result, reply.done) : undefined;
      case 'slice': return reply.job === this.sliceJob ? this.showSlice(reply.slice) : undefined;
      case 'progress': return this.onProgress(reply.stage, reply.fraction);
      case 'accuracy': return reply.job === this.accuracyJob ? this.verdict.showAccuracy(reply.accuracy) : undefined;
      case 'embed':
        this.viewport.setStatus(this.finished);
        return this.panels?.report('embedding', '', words.ofEmbedding(reply.report, this.store.now.unit));
      case 'files':
        this.viewport.setStatus(this.finished);
        downloadFiles(this.exportStem, reply.files);
        return this.exporter?.done(this.exportStem, reply.files, reply.usage);
      case 'playing': return this.onPlaying(reply.start);
      case 'frame': return this.play.frame(reply.frame);
      case 'cancelled': return reply.job === this.meshJob ? this.viewport.setStatus('') : undefined;
      case 'error': return this.onError(reply.job, reply.message, reply.status);
    }
  }

  private onProgress(stage: string, fraction: number): void {
    const { state } = this.root.dataset;
    if (state === 'cancelled') return;
    this.viewport.setStatus(words.ofProgress(stage, fraction), true, state === 'busy' || state === 'coarse' || state === 'preparing');
  }

  private onReady(catalog: Catalog): void {
    this.panels = new Panels(this.store, {
      open: () => this.picker.click(), sample: (name) => this.source.openSample(name), gizmo: (mode) => this.view.showFrame(mode),
      embed: () => this.client.ask({ type: 'embed' }), showSurface: () => this.store.set({ view: 'surface' }), play: (scene) => this.startPlaying(scene),
    }, catalog);
    this.root.querySelector('aside')?.replaceWith(this.panels.element);
    const empty = emptyState(catalog, () => this.picker.click(), (name) => this.source.openSample(name), () => this.startPlaying('robots-on-tree'));
    this.empty.replaceWith(empty);
    this.empty = empty;
    this.exporter = new ExportDialog(catalog, (choice) => this.export(choice), () => void this.savePicture(),
      (choice, language) => void this.copyRecipe(choice, language));
    this.root.append(this.exporter.element);
    this.root.dataset.threads = String(catalog.threads);
    this.viewport.show(this.store.now);
    const served = new URLSearchParams(location.search).get('model');
    if (this.store.now.sample) void this.source.load();
    else if (served) void this.openServed(served);
  }

  /** One model at a time: what else was dropped is said. */
  private async openDropped(files: File[], address: string): Promise<void> {
    if (!files.length) return this.openAddress(address);
    const known = files.filter((file) => kModel.test(file.name));
    const first = known[0] ?? files[0];
    this.source.openFile(first);
    if (files.length > 1) this.notice.tell(words.ofDropped(first.name, files.length - 1));
  }

  private async openAddress(address: string): Promise<void> {
    const name = decodeURIComponent(new URL(address, location.href).pathname.split('/').pop() || 'model');
    this.viewport.setStatus(`Fetching ${name}`, true);
    const bytes = await fetch(address).then((answer) => (answer.ok ? answer.arrayBuffer() : null)).catch(() => null);
    if (bytes) this.source.openFile(new File([bytes], name));
    else this.fail(`${name} could not be fetched: the other site does not hand it to pages, or it is not there. Save it, and drop the file.`);
  }

  /** The model that `tetsoup studio FILE` serves beside the page. */
  private async openServed(name: string): Promise<void> {
    const answer = await fetch(`model/${encodeURIComponent(name)}`);
    if (answer.ok) this.source.openFile(new File([await answer.arrayBuffer()], name));
    else this.notice.complain(`${name} is not there any more. Open a file, or choose a sample.`);
  }

  private onSoup(surface: { vertices: Float32Array; triangles: Uint32Array }, report: SoupReport): void {
    this.stopPlaying();
    this.guessUp(surface);
    this.soup = report;
    this.surface = surface;
    this.mesh = this.meshed = null;
    const another = this.source.loaded();
    this.report = null;
    this.meshDone = false;
    this.root.dataset.state = 'soup';
    this.empty.hidden = true;
    this.viewport.setModel(true);
    // Vertices are counted from the origin, the report's box is not.
    const near = (corner: Vec3) => corner.map((x, i) => x - report.origin[i]) as Vec3;
    this.view.setSoup(surface, { lo: near(report.box.lo), hi: near(report.box.hi) });
    const { now } = this.store;
    this.header.setModel(now.file || `${words.title(now.sample)}${now.damage ? `, ${now.damage} % damaged` : ''}`);
    this.panels?.report('embedding', '', []);
    this.showReports();
    this.stage.setUp(kUpAxis[now.up]);
    this.viewport.show(now);
    this.showLook();
    this.stage.resize();
    // A view that was chosen stays while triangles are taken away; a link has one.
    if (another) this.fit();
    if (another && now.camera) this.stage.look(now.camera);
    this.updateButtons();
    this.askMesh();
  }

  /** Once for each file: whoever turns it afterwards knows better. */
  private guessUp(surface: Surface): void {
    const custom = this.source.guessed;
    this.source.guessed = null;
    if (custom && custom === this.store.now.up) this.store.amend({ up: guessUp(surface.vertices, custom) });
  }

  private onMesh(result: MeshResult, done: boolean): void {
    this.report = result.report;
    this.slice = result.slice;
    this.meshDone = done;
    if (done) this.meshed = this.wished;
    this.mesh = result.final;
    this.view.setMesh(result);
    this.view.placeFrame(this.store.now.translate, this.store.now.rotate);
    this.showReports();
    this.showLook();
    this.updateButtons();
    const job = this.meshJob;
    this.stage.onDrawn(() => {
      // What failed or was asked for since then has been said.
      if (job !== this.meshJob || this.root.dataset.state === 'error') return;
      const time = performance.now() - this.wishedAt;
      this.finished = done ? `${words.count(result.report.quality.tet_count, 'tet')} in ${words.milliseconds(time)}` : '';
      this.viewport.setStatus(this.finished || 'Coarse answer, refining', !done, !done);
      this.viewport.status.title = Object.entries(result.report.seconds).map(([stage, s]) => `${words.stageName(stage)}: ${words.milliseconds(1000 * s)}`).join('\n');
      Object.assign(this.root.dataset, { state: done ? 'done' : 'coarse', tets: result.report.quality.tet_count, volume: result.report.quality.volume, job: this.meshJob,
        ms: time.toFixed(1), core: result.milliseconds.toFixed(1), seconds: JSON.stringify(result.report.seconds) });
    });
  }

  private onError(job: number, message: string, status: number): void {
    const text = words.ofError(message, status);
    if (this.exporter?.element.open) return this.exporter.failed(text);
    const wasSource = this.source.isLast(job);
    if (wasSource) this.store.takeBack();
    this.fail(text);
    // A file that could not be read has cancelled the mesh of what is still there.
    if (wasSource && !this.meshDone) this.askMesh();
  }

  private onLost(file: string): void {
    this.store.takeBack();
    this.fail(`${file} cannot be read: it is not there any more, or not a file. Open it again.`);
  }

  private fail(text: string): void {
    this.notice.complain(text);
    this.viewport.setStatus(this.meshDone ? this.finished : '');
    this.root.dataset.state = 'error';
  }

  // --- what the user does ----------------------------------------------------------------------------------------------

  private onSettings(now: Settings, before: Settings): void {
    if (now.camera === before.camera) this.notice.hide();
    this.address.write(toAddress(now));
    this.panels?.show(now);
    this.header.setHistory(this.store.canUndo, this.store.canRedo);
    const differs = (...keys: (keyof Settings)[]) => keys.some((key) => String(now[key]) !== String(before[key]));
    if (differs(...kViewKeys)) {
      this.viewport.show(now);
      this.showLook();
      if (now.view === 'votes' && differs('view', 'slice', 'slice_at')) this.askSlice();
    }
    if (differs('up')) {
      this.stage.setUp(kUpAxis[now.up]);
      this.fitByHand();
    }
    if (differs('stiffness', 'density', 'poisson')) this.play.setMaterial(this.material());
    if (differs('unit', 'up', 'density', 'stiffness')) this.showReports();
    if (differs('sample', 'damage', 'file')) return void this.source.load();
    if (JSON.stringify(meshOptions(now)) !== JSON.stringify(meshOptions(before))) {
      this.view.placeFrame(now.translate, now.rotate);
      this.stage.draw();
      this.askMesh();
    }
  }

  private pickFile(): void {
    const file = this.picker.files?.[0];
    this.picker.value = '';
    if (file) this.source.openFile(file);
  }

  /** Back to the page without a model. */
  private showNothing(): void {
    this.stopPlaying();
    this.soup = this.report = this.slice = null;
    this.meshDone = false;
    this.meshJob = 0;
    this.header.setModel('');
    this.empty.hidden = false;
    this.viewport.setModel(false);
    this.viewport.setStatus('');
    this.panels?.clear();
    this.verdict.show(null, this.store.now);
    this.root.dataset.state = '';
    this.showLook();
    this.updateButtons();
  }

  private askMesh(): void {
    if (!this.soup) return;
    this.stopPlaying();
    this.meshDone = false;
    this.wishedAt = performance.now();
    this.wished = meshSettings(this.store.now);
    this.root.dataset.state = 'busy';
    this.updateButtons();
    this.panels?.report('embedding', '', []);
    this.meshJob = this.client.ask({ type: 'mesh', options: meshOptions(this.store.now), slice: this.viewport.cut, material: this.material() });
  }

  private askSlice(): void {
    if (this.meshDone) this.sliceJob = this.client.ask({ type: 'slice', slice: this.viewport.cut });
  }

  /** Takes longer than a step of a slider may, so it waits until nobody turns anything. */
  private askAccuracy(): void {
    clearTimeout(this.accuracyTimer);
    if (!this.verdict.open) return;
    this.accuracyTimer = setTimeout(() => {
      if (this.meshDone && !this.play.on) this.accuracyJob = this.client.ask({ type: 'accuracy' });
    }, kRest);
  }

  private mark(check: Checked | null): string {
    const { mesh, surface: soup, report } = this;
    if (!mesh || !soup || !report) return '';
    const problem = check && findProblem(check.name, { mesh, soup, fidelity: report.fidelity, limit: check.limit });
    this.view.mark(mesh, soup, problem);
    if (problem && this.store.now.view !== 'tets') this.store.set({ view: 'tets' });
    else this.showLook();
    if (!problem) return '';
    const [tets, triangles] = [problem.tets.length, problem.triangles.length / 3];
    return tets + triangles === 0 ? 'No single tet shows it.' : tets ? `${words.count(tets, 'tet')} marked.` : `${words.count(triangles, 'triangle')} of the model marked.`;
  }

  private startPlaying(scene: string | null): void {
    this.notice.hide();
    this.root.dataset.state = 'preparing';
    this.play.begin(scene);
  }

  private onPlaying(start: PlayStart): void {
    this.empty.hidden = true;
    this.viewport.setModel(true);
    this.play.started(start);
    this.root.classList.add('playing');
    this.stage.resize();
    this.root.dataset.state = 'playing';
    this.panels?.reportPlay(words.ofPlay(start));
  }

  private stopPlaying(): void {
    if (!this.play.on) return;
    this.play.stop();
    this.root.classList.remove('playing');
    this.panels?.reportPlay([]);
    this.viewport.setStatus(this.meshDone ? this.finished : '');
    this.root.dataset.state = this.meshDone ? 'done' : '';
    if (!this.soup) {
      this.empty.hidden = false;
      this.viewport.setModel(false);
    }
    this.fit();
  }

  private material(): Material {
    const { now } = this.store;
    return materialOf(now, this.soup ? heightOf(this.soup.box, now) : 1);
  }

  private openExport(): void {
    const { file, sample } = this.store.now;
    this.exporter?.open((file || sample || 'mesh').replace(/\.[^.]*$/, ''));
  }

  private export(choice: ExportChoice): void {
    const { up, unit } = this.store.now;
    this.exportStem = choice.stem;
    const wish = { ...choice, up: kUpAxis[up], metresPerUnit: kUnits[unit].metres, material: this.material() };
    this.client.ask({ type: 'export', wish });
  }

  private async savePicture(): Promise<void> {
    const picture = await this.stage.picture();
    if (picture) download(`${this.store.now.file || this.store.now.sample || 'tetsoup'}.png`, picture);
  }

  private async copyRecipe(choice: ExportChoice, language: 'command' | 'python'): Promise<void> {
    const text = language === 'python' ? asPython(this.store.now, choice, this.material()) : asCommand(this.store.now, choice, this.material());
    const copied = await navigator.clipboard.writeText(text).then(() => true, () => false);
    this.exporter?.recipe(text, copied);
  }

  private async copyLink(): Promise<void> {
    try {
      await navigator.clipboard.writeText(location.href);
      this.notice.tell(this.store.now.file ? 'Link copied. It holds the settings; whoever opens it drops the file themselves.' : 'Link copied. It makes the same mesh, to the bit.');
    } catch {
      this.notice.tell('Copy the address of this page: it holds all settings.');
    }
  }

  // --- what is shown ---------------------------------------------------------------------------------------------------

  private showReports(): void {
    if (!this.soup) return;
    this.panels?.showReports(this.soup, this.report);
    this.verdict.show(this.report, this.store.now);
    this.askAccuracy();
  }

  private showLook(): void {
    const { look } = this.viewport;
    this.view.show(look, !this.play.on && this.soup !== null);
    this.viewport.setEdges(this.view.soup.drawsEdges);
    this.play.look(this.viewport.playTets);
    this.viewport.showLegend(this.play.on ? null : this.report, this.slice, this.theme.dark);
  }

  private showSlice(slice: Slice): void {
    this.slice = slice;
    this.view.setSlice(slice);
    this.showLook();
  }

  private paint(dark: boolean): void {
    this.stage.setDark(dark);
    this.view.setPalette(dark);
    this.play.view.setPalette();
    this.showLook();
  }

  /** All in the picture again, also for whoever follows a link. */
  private fitByHand(): void {
    this.store.note({ camera: null });
    this.fit();
  }

  private fit(): void {
    if (this.play.on) this.play.view.fit();
    else this.stage.fit(this.view.box);
  }

  private updateButtons(): void {
    const ready = this.meshDone && (this.report?.quality.tet_count ?? 0) > 0;
    this.panels?.setReady(ready);
    this.drop.disabled = !ready;
    this.exporter?.setReady(ready);
  }
}
