// Camera, lights and drawing on demand; what is shown is put into `model` or `scene` by others.
import {
  Box3, Color, DirectionalLight, Group, HemisphereLight, PerspectiveCamera, Raycaster, Scene, Vector2, Vector3,
  WebGLRenderer,
} from 'three';
import { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';
import { kDark, kLight, type Palette } from './colors';

const kFieldOfView = 32;
/** From where a model is first seen: a bit from the right, a bit from above. */
const kFirstLook = new Vector3(0.62, -1, 0.42);
const kMargin = 1.12;
const kLongestDraw = 2000;
/** Pixels drawn for one of the page at most, along a side. */
const kMostPixels = 2;
/** Where a processor draws, a picture that stays for so many milliseconds is drawn once more, of at most so many pixels. */
const kRest = 600;
const kFinePixels = 4e6;

function drawsInSoftware(): boolean {
  const gl = document.createElement('canvas').getContext('webgl2');
  let name = String(gl?.getParameter(gl.RENDERER) ?? '');
  // Who draws is said by an extension only in browsers of one family; the others deprecate it.
  const info = name === 'WebKit WebGL' ? gl?.getExtension('WEBGL_debug_renderer_info') : null;
  if (info) name = String(gl?.getParameter(info.UNMASKED_RENDERER_WEBGL));
  gl?.getExtension('WEBGL_lose_context')?.loseContext();
  return /swiftshader|llvmpipe|software|basic render/i.test(name);
}

/** Whether this browser draws for pages at all. */
export function canDraw(): boolean {
  const gl = document.createElement('canvas').getContext('webgl2');
  gl?.getExtension('WEBGL_lose_context')?.loseContext();
  return gl !== null;
}

export class Stage {
  readonly scene = new Scene();
  /** In the model's own coordinates; turned so that its up is the scene's z. */
  readonly model = new Group();
  readonly camera = new PerspectiveCamera(kFieldOfView, 1, 0.01, 1000);
  readonly controls: OrbitControls;
  readonly renderer: WebGLRenderer;
  readonly drawnBy = drawsInSoftware() ? 'processor' : 'gpu';
  palette: Palette = kLight;
  /** From the call to the finished picture, as the last one that was waited for took. */
  drawMilliseconds = 0;
  private readonly light = new DirectionalLight(0xffffff, 2.0);
  private wanted = false;
  private resting = 0;
  private afterDraw: (() => void)[] = [];
  /** The graphics card has taken the picture away, or gives it back. */
  /** Somebody has moved the camera. */
  onLook: (camera: number[]) => void = () => undefined;
  onLost: (lost: boolean) => void = () => undefined;

  constructor(private readonly host: HTMLElement, label: string) {
    // Where a processor draws, smooth edges cost as much as all the rest.
    this.renderer = new WebGLRenderer({ antialias: this.drawnBy === 'gpu' });
    this.renderer.localClippingEnabled = true;
    const canvas = this.renderer.domElement;
    canvas.tabIndex = 0;
    canvas.setAttribute('role', 'img');
    canvas.setAttribute('aria-label', label);
    host.append(canvas);
    this.camera.up.set(0, 0, 1);
    this.camera.add(this.light);
    this.light.position.set(0.5, 0.8, 1);
    this.scene.add(this.camera, new HemisphereLight(0xffffff, 0xa8a29a, 1.9), this.model);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.enableDamping = false;
    this.controls.addEventListener('change', () => this.draw());
    this.controls.addEventListener('end', () => this.noteLook());
    canvas.addEventListener('keydown', (event) => this.onKey(event));
    // What was on the graphics card is put there again by three; the picture is drawn by us.
    canvas.addEventListener('webglcontextlost', () => this.onLost(true));
    canvas.addEventListener('webglcontextrestored', () => {
      this.onLost(false);
      this.draw();
    });
    new ResizeObserver(() => this.resize()).observe(host);
    this.resize();
  }

  setDark(dark: boolean): void {
    this.palette = dark ? kDark : kLight;
    this.scene.background = new Color(this.palette.background);
    this.draw();
  }

  /** Turns the model: 0, 1, 2 for x, y, z up. */
  setUp(axis: number): void {
    this.model.rotation.set(axis === 1 ? Math.PI / 2 : 0, axis === 0 ? -Math.PI / 2 : 0, 0);
    this.model.updateMatrixWorld(true);
    this.draw();
  }

  resize(): void {
    const { clientWidth, clientHeight } = this.host;
    if (!clientWidth || !clientHeight) return;
    this.renderer.setSize(clientWidth, clientHeight);
    this.camera.aspect = clientWidth / clientHeight;
    this.camera.updateProjectionMatrix();
    this.draw();
  }

  /** Looks at a box of the model's coordinates, or of the scene's. */
  fit(box: Box3, inScene = false, look: Vector3 = kFirstLook): void {
    if (box.isEmpty()) return;
    const world = inScene ? box.clone() : box.clone().applyMatrix4(this.model.matrixWorld);
    const centre = world.getCenter(new Vector3());
    const direction = look.clone().normalize();
    const distance = this.distanceFor(world, centre, direction);
    const radius = world.getSize(new Vector3()).length() / 2;
    this.controls.target.copy(centre);
    this.camera.position.copy(centre).addScaledVector(direction, distance);
    this.camera.near = Math.max(distance - 6 * radius, radius / 100);
    this.camera.far = distance + 12 * radius;
    this.controls.minDistance = radius / 10;
    this.controls.maxDistance = 8 * radius;
    this.camera.updateProjectionMatrix();
    this.controls.update();
    this.draw();
  }

  /** The camera's place and what it looks at, in so many digits that a link stays short. */
  private noteLook(): void {
    this.onLook([...this.camera.position, ...this.controls.target].map((x) => Number(x.toPrecision(4))));
  }

  look([x, y, z, ...target]: number[]): void {
    this.camera.position.set(x, y, z);
    this.controls.target.fromArray(target);
    this.controls.update();
    this.draw();
  }

  /** The nearest place from which all corners are in the picture. */
  private distanceFor(box: Box3, centre: Vector3, direction: Vector3): number {
    const right = new Vector3().crossVectors(this.camera.up, direction).normalize();
    const up = new Vector3().crossVectors(direction, right);
    const vertical = Math.tan((kFieldOfView * Math.PI) / 360);
    const horizontal = vertical * this.camera.aspect;
    let distance = 0;
    for (let i = 0; i < 8; ++i) {
      const corner = new Vector3(i & 1 ? box.max.x : box.min.x, i & 2 ? box.max.y : box.min.y, i & 4 ? box.max.z : box.min.z).sub(centre);
      const towards = corner.dot(direction);
      distance = Math.max(distance, towards + Math.abs(corner.dot(right)) / horizontal, towards + Math.abs(corner.dot(up)) / vertical);
    }
    return distance * kMargin;
  }

  draw(): void {
    if (this.wanted) return;
    this.wanted = true;
    requestAnimationFrame(() => {
      this.wanted = false;
      this.drawNow();
    });
  }

  onDrawn(done: () => void): void {
    this.afterDraw.push(done);
  }

  drawNow(): void {
    const since = performance.now();
    this.render(devicePixelRatio);
    clearTimeout(this.resting);
    if (this.drawnBy === 'processor') this.resting = setTimeout(() => this.renderFine(), kRest);
    const done = this.afterDraw;
    this.afterDraw = [];
    if (!done.length) return;
    // Calls only queue work: the picture is there when a fence behind them is.
    const gl = this.renderer.getContext() as WebGL2RenderingContext;
    const fence = gl.fenceSync(gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
    gl.flush();
    const look = () => {
      const drawn = !fence || gl.getSyncParameter(fence, gl.SYNC_STATUS) === gl.SIGNALED;
      if (!drawn && performance.now() - since < kLongestDraw) return void setTimeout(look, 1);
      gl.deleteSync(fence);
      this.drawMilliseconds = performance.now() - since;
      done.forEach((f) => f());
    };
    setTimeout(look, 0);
  }

  /** @param wanted  Pixels drawn for one of the page, along a side. */
  private render(wanted: number): void {
    const ratio = Math.min(wanted, kMostPixels);
    if (this.renderer.getPixelRatio() !== ratio) this.renderer.setPixelRatio(ratio);
    this.renderer.render(this.scene, this.camera);
  }

  private renderFine(): void {
    const { clientWidth, clientHeight } = this.host;
    this.render(Math.max(devicePixelRatio, Math.sqrt(kFinePixels / (clientWidth * clientHeight + 1))));
  }

  rayAt(x: number, y: number): Raycaster {
    const box = this.renderer.domElement.getBoundingClientRect();
    const ray = new Raycaster();
    ray.setFromCamera(new Vector2(((x - box.left) / box.width) * 2 - 1, 1 - ((y - box.top) / box.height) * 2), this.camera);
    return ray;
  }

  picture(): Promise<Blob | null> {
    // In one go: what was drawn is gone once the browser has shown it.
    if (this.drawnBy === 'processor') this.renderFine();
    else this.render(devicePixelRatio);
    return new Promise((done) => this.renderer.domElement.toBlob(done, 'image/png'));
  }

  /** Arrows turn, plus and minus come closer and go away. */
  private onKey(event: KeyboardEvent): void {
    const turn = Math.PI / 24;
    const offset = this.camera.position.clone().sub(this.controls.target);
    const side = new Vector3().crossVectors(this.camera.up, offset).normalize();
    const polar = offset.angleTo(this.camera.up);
    if (event.key === 'ArrowLeft') offset.applyAxisAngle(this.camera.up, -turn);
    else if (event.key === 'ArrowRight') offset.applyAxisAngle(this.camera.up, turn);
    else if (event.key === 'ArrowUp' && polar > 2 * turn) offset.applyAxisAngle(side, -turn);
    else if (event.key === 'ArrowDown' && polar < Math.PI - 2 * turn) offset.applyAxisAngle(side, turn);
    else if (event.key === '+' || event.key === '=') offset.multiplyScalar(0.9);
    else if (event.key === '-') offset.multiplyScalar(1 / 0.9);
    else return;
    event.preventDefault();
    this.camera.position.copy(this.controls.target).add(offset);
    this.controls.update();
    this.noteLook();
  }
}
