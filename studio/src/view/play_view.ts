// Bodies that move, what they fall onto, and the hand that pulls them.
import {
  Box3, BufferAttribute, BufferGeometry, Fog, GridHelper, Group, Line, LineBasicMaterial, Plane, Vector3,
} from 'three';
import type { Frame, PlayStart, Vec3 } from '../core/protocol';
import type { Stage } from './stage';
import { SurfaceLayer } from './surface_layer';
import { TetLayer } from './tet_layer';

/** The ground has so many lines along a side, half a body's length from each other, about; mist hides where they end. */
const kLines = 40;
/** Where mist begins and where nothing is seen any more, in distances of the camera. */
const kMist = [1.15, 3];

/** Half of a size, as a round number. */
function lineGap(size: number): number {
  const power = 10 ** Math.floor(Math.log10(size / 2));
  return power * ([5, 2, 1].find((step) => step * power <= size / 2) ?? 1);
}

export interface Hand {
  grab(body: number, vertex: number, target: Vec3): void;
  drag(target: Vec3): void;
  release(): void;
}

interface Shown {
  surface: SurfaceLayer;
  tets: TetLayer;
  positions: Float32Array;
}

export class PlayView extends Group {
  private bodies: Shown[] = [];
  private obstacles: SurfaceLayer[] = [];
  private grid: GridHelper | null = null;
  private showTets = false;
  private pulling: { plane: Plane; body: number; vertex: number } | null = null;
  private readonly rope = new Line(new BufferGeometry().setAttribute('position', new BufferAttribute(new Float32Array(6), 3)), new LineBasicMaterial());
  private readonly target = new Vector3();
  private fitted = false;
  private kept = false;
  private placed = false;
  private size = 1;

  constructor(private readonly stage: Stage, hand: Hand) {
    super();
    this.visible = false;
    this.rope.visible = false;
    this.rope.frustumCulled = false;
    this.add(this.rope);
    stage.scene.add(this);
    this.listen(hand);
  }

  start(start: PlayStart): void {
    this.empty();
    this.size = start.size;
    this.bodies = start.bodies.map((shape) => {
      const surface = new SurfaceLayer();
      const tets = new TetLayer();
      this.add(surface, tets);
      surface.userData.shape = shape;
      return { surface, tets, positions: new Float32Array() };
    });
    this.obstacles = start.obstacles.map((obstacle) => {
      const layer = new SurfaceLayer();
      layer.set(obstacle.vertices, obstacle.triangles);
      layer.setOutward(obstacle.outward);
      this.add(layer);
      return layer;
    });
    this.placed = false;
    this.fitted = this.kept;
    this.kept = false;
    this.visible = true;
    this.setPalette();
  }

  empty(): void {
    for (const layer of [...this.obstacles, ...this.bodies.flatMap((b) => [b.surface, b.tets])]) {
      layer.removeFromParent();
      layer.release();
    }
    this.bodies = [];
    this.obstacles = [];
    this.visible = false;
    this.rope.visible = false;
    this.pulling = null;
    this.stage.scene.fog = null;
  }

  setPalette(): void {
    const { palette } = this.stage;
    this.bodies.forEach((b, i) => {
      const color = palette.bodies[i % palette.bodies.length];
      b.surface.setColors(color, palette.edge);
      b.tets.setPalette(palette, color);
    });
    this.obstacles.forEach((o) => o.setColors(palette.obstacle, palette.edge));
    if (this.stage.scene.fog) this.stage.scene.fog.color.set(palette.background);
    this.rope.material.color.set(palette.accent);
    this.grid?.removeFromParent();
    this.grid?.dispose();
    const gap = lineGap(this.size);
    this.grid = new GridHelper(kLines * gap, kLines, palette.grid, palette.grid);
    this.grid.rotation.x = Math.PI / 2;
    this.add(this.grid);
  }

  setLook(tets: boolean): void {
    this.showTets = tets;
    this.bodies.forEach((b) => {
      b.surface.visible = !tets;
      b.tets.setLook({ edges: true, quality: false, opened: false });
      b.tets.show(tets);
      if (tets && b.positions.length) b.tets.move(b.positions);
    });
    this.stage.draw();
  }

  show(frame: Frame): void {
    frame.bodies.forEach((moved, i) => {
      const body = this.bodies[i];
      if (!body) return;
      const shape = body.surface.userData.shape as PlayStart['bodies'][number];
      if (!body.positions.length) {
        body.surface.set(moved.vertices, shape.triangles);
        body.surface.setOutward(shape.outward);
        body.tets.set({ vertices: moved.positions, tets: shape.tets, angles: null });
      }
      body.positions = moved.positions;
      body.surface.move(moved.vertices, moved.normals);
      if (this.showTets) body.tets.move(moved.positions);
    });
    if (!this.placed) {
      this.placed = true;
      this.setLook(this.showTets);
      if (this.fitted) this.mist();
      else this.fit();
      this.fitted = true;
    }
    this.drawRope();
    this.stage.draw();
  }

  /** Whether the next start leaves the camera where it is. */
  keepLook(kept: boolean): void {
    this.kept = kept;
  }

  boxOfFirst(): number[] {
    const box = new Box3().setFromArray(this.bodies[0]?.positions ?? []);
    return [...box.min.toArray(), ...box.max.toArray()];
  }

  fit(): void {
    const box = new Box3();
    this.bodies.forEach((b) => box.union(new Box3().setFromArray(b.positions)));
    this.obstacles.forEach((o) => box.expandByObject(o));
    const size = box.getSize(new Vector3());
    box.min.z = Math.min(box.min.z, 0);
    const side = Math.max(size.x, size.y, 0.6 * this.size) * 0.12;
    box.expandByVector(new Vector3(side, side, 0));
    this.stage.fit(box, true, new Vector3(0.45, -1, 0.32));
    this.mist();
  }

  private mist(): void {
    const distance = this.stage.camera.position.distanceTo(this.stage.controls.target);
    this.stage.scene.fog = new Fog(this.stage.palette.background, kMist[0] * distance, kMist[1] * distance);
  }

  private drawRope(): void {
    const { pulling } = this;
    this.rope.visible = pulling !== null;
    if (!pulling) return;
    const p = this.bodies[pulling.body]?.positions ?? [];
    const at = this.rope.geometry.getAttribute('position') as BufferAttribute;
    at.setXYZ(0, p[3 * pulling.vertex], p[3 * pulling.vertex + 1], p[3 * pulling.vertex + 2]);
    at.setXYZ(1, this.target.x, this.target.y, this.target.z);
    at.needsUpdate = true;
  }

  private listen(hand: Hand): void {
    const canvas = this.stage.renderer.domElement;
    canvas.addEventListener('pointerdown', (event) => {
      if (!this.visible || event.button !== 0) return;
      const found = this.pick(event.clientX, event.clientY);
      if (!found) return;
      event.stopImmediatePropagation();
      canvas.setPointerCapture(event.pointerId);
      const away = this.stage.camera.getWorldDirection(new Vector3());
      this.pulling = { plane: new Plane().setFromNormalAndCoplanarPoint(away, found.point), body: found.body, vertex: found.vertex };
      this.target.copy(found.point);
      hand.grab(found.body, found.vertex, found.point.toArray());
    }, { capture: true });
    canvas.addEventListener('pointermove', (event) => {
      if (!this.pulling) return;
      const ray = this.stage.rayAt(event.clientX, event.clientY).ray;
      if (!ray.intersectPlane(this.pulling.plane, this.target)) return;
      this.target.z = Math.max(this.target.z, 0);
      hand.drag(this.target.toArray());
      this.drawRope();
    });
    const letGo = () => {
      if (!this.pulling) return;
      this.pulling = null;
      this.drawRope();
      hand.release();
    };
    for (const name of ['pointerup', 'pointercancel', 'lostpointercapture']) canvas.addEventListener(name, letGo);
  }

  /** The vertex of a body's tets that is nearest to where the pointer meets the body. */
  private pick(x: number, y: number): { body: number; vertex: number; point: Vector3 } | null {
    const meshes = this.bodies.map((b) => b.surface.mesh);
    // Hidden surfaces can be pulled as well: the tets are drawn in their place.
    meshes.forEach((mesh) => mesh.geometry.computeBoundingSphere());
    const hit = this.stage.rayAt(x, y).intersectObjects(meshes, false)[0];
    if (!hit) return null;
    const body = meshes.indexOf(hit.object as (typeof meshes)[number]);
    const p = this.bodies[body].positions;
    let [vertex, least] = [0, Infinity];
    for (let i = 0; i < p.length; i += 3) {
      const d = (p[i] - hit.point.x) ** 2 + (p[i + 1] - hit.point.y) ** 2 + (p[i + 2] - hit.point.z) ** 2;
      if (d < least) [vertex, least] = [i / 3, d];
    }
    return { body, vertex, point: hit.point };
  }
}
