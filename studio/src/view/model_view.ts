// All that can be seen of a soup and its mesh, and which of it is shown.
import { Box3, BoxGeometry, EdgesGeometry, Euler, Group, LineBasicMaterial, LineSegments, Vector3 } from 'three';
import { TransformControls } from 'three/examples/jsm/controls/TransformControls.js';
import type { Box, MeshResult, Slice, Surface, Tets, Vec3 } from '../core/protocol';
import type { View } from '../state';
import { SliceLayer } from './slice_layer';
import type { Stage } from './stage';
import { SurfaceLayer } from './surface_layer';
import { TetFaces } from './tet_faces';
import type { Problem } from './problems';
import { type Clip, TetLayer } from './tet_layer';

export interface Look {
  view: View;
  edges: boolean;
  quality: boolean;
  /** The soup, thinly, around what is shown. */
  ghost: boolean;
  clip: { on: boolean; axis: number; position: number; flip: boolean };
}

const kGhostOpacity = 0.16;
/** Where a processor draws, lines cost it several microseconds each. */
const kMostEdges = 150000;
/** Of the mesh around what is marked in it. */
const kShadowOpacity = 0.3;
/** Of the box that stands for the lattice's frame, in cells. */
const kFrameCells = 2;
/** Of x, y, z, and of the one that is held. */
const kAxisColors = ['#c2410c', '#4d7c0f', '#1d4ed8', '#e07b28'] as const;

export class ModelView {
  readonly soup = new SurfaceLayer();
  readonly ghost = new SurfaceLayer();
  readonly lattice = new TetLayer();
  readonly final = new TetLayer();
  readonly slice = new SliceLayer();
  /** What a check is about, within what is shown thinly. */
  private readonly markedTets = new TetLayer();
  private readonly markedTriangles = new SurfaceLayer();
  private shadow = new SurfaceLayer();
  private marked = false;
  readonly box = new Box3();
  private readonly frame = new Group();
  private readonly gizmo: TransformControls;
  private cell = 1;
  private framing = false;
  private centre = new Vector3();
  private hasMesh = false;

  constructor(private readonly stage: Stage, onFrame: (translate: Vec3, rotate: Vec3) => void, onFrameDone: () => void) {
    if (stage.drawnBy === 'processor') this.soup.mostEdges = kMostEdges;
    stage.model.add(this.soup, this.ghost, this.lattice, this.final, this.slice, this.frame, this.markedTets, this.markedTriangles, this.shadow);
    // Seen through the model, in whose middle it is.
    this.frame.add(new LineSegments(new EdgesGeometry(new BoxGeometry(kFrameCells, kFrameCells, kFrameCells)),
      new LineBasicMaterial({ color: '#e07b28', depthTest: false, transparent: true })));
    this.gizmo = new TransformControls(stage.camera, stage.renderer.domElement);
    this.gizmo.setSpace('local');
    this.gizmo.size = 0.9;
    this.gizmo.setColors(...kAxisColors);
    this.gizmo.addEventListener('change', () => stage.draw());
    this.gizmo.addEventListener('dragging-changed', (event) => {
      stage.controls.enabled = !event.value;
      if (!event.value) onFrameDone();
    });
    this.gizmo.addEventListener('objectChange', () => onFrame(...this.readFrame()));
    stage.scene.add(this.gizmo.getHelper());
    this.showFrame(null);
  }

  setSoup(surface: Surface, box: Box): void {
    this.soup.set(surface.vertices, surface.triangles);
    this.ghost.set(surface.vertices, surface.triangles);
    this.box.set(new Vector3(...box.lo), new Vector3(...box.hi));
    this.box.getCenter(this.centre);
    this.hasMesh = false;
  }

  setMesh(result: MeshResult): void {
    this.lattice.set(result.lattice);
    this.final.set(result.final);
    this.cell = result.report.lattice.cell_size;
    this.hasMesh = true;
    if (result.slice) this.slice.set(result.slice);
  }

  /** The finished mesh alone, as reports have it. */
  setFinal(tets: Tets): void {
    this.final.set(tets);
    this.hasMesh = true;
  }

  /** Marks a part of the finished mesh, or of the soup; null: nothing. */
  mark(mesh: Tets, soup: Surface, problem: Problem | null): void {
    this.marked = problem !== null;
    if (!problem) return;
    const tets = new Uint32Array(4 * problem.tets.length);
    problem.tets.forEach((t, i) => tets.set(mesh.tets.subarray(4 * t, 4 * t + 4), 4 * i));
    this.markedTets.set({ vertices: mesh.vertices, tets, angles: null });
    this.markedTriangles.set(soup.vertices, problem.triangles);
    this.shadow.set(mesh.vertices, new TetFaces(mesh.tets, mesh.vertices.length / 3).boundary());
  }

  setSlice(slice: Slice): void {
    this.slice.set(slice);
  }

  setPalette(dark: boolean): void {
    const { palette } = this.stage;
    this.soup.setColors(palette.surface, palette.edge);
    this.ghost.setColors(palette.surface, palette.edge, kGhostOpacity);
    this.lattice.setPalette(palette, palette.lattice);
    this.final.setPalette(palette, palette.tets);
    this.slice.setDark(dark);
    this.markedTets.setPalette(palette, palette.marked);
    this.markedTriangles.setColors(palette.marked, palette.edge);
    this.shadow.setColors(palette.tets, palette.edge, kShadowOpacity);
  }

  /** The plane of a look in the model's coordinates. */
  clipOf(look: Look): Clip | null {
    const { on, axis, position, flip } = look.clip;
    if (!on) return null;
    const low = this.box.min.getComponent(axis);
    const high = this.box.max.getComponent(axis);
    return { axis, at: low + position * (high - low), sign: flip ? -1 : 1 };
  }

  show(look: Look, visible: boolean): void {
    const { view } = look;
    const clip = this.clipOf(look);
    const mesh = visible && this.hasMesh;
    this.soup.visible = visible && (view === 'soup' || view === 'surface' || !this.hasMesh);
    this.soup.setLook(look.edges && view === 'soup');
    this.soup.setClip(view === 'surface' || view === 'soup' ? clip : null);
    this.ghost.visible = visible && this.hasMesh && (view === 'votes' || (look.ghost && (view === 'tets' || view === 'lattice')));
    this.slice.show(mesh && view === 'votes');
    const final = view === 'tets' || (view === 'surface' && clip !== null);
    for (const [layer, wanted] of [[this.lattice, view === 'lattice'], [this.final, final]] as const) {
      layer.setLook({ edges: look.edges, quality: look.quality && view !== 'surface', opened: view === 'surface' });
      layer.setClip(clip);
      layer.show(mesh && wanted);
    }
    const marks = mesh && this.marked && view === 'tets';
    if (marks) this.final.show(false);
    this.markedTets.show(marks);
    this.markedTriangles.visible = this.shadow.visible = marks;
    for (const layer of [this.markedTets, this.markedTriangles, this.shadow]) layer.setClip(clip);
    this.updateFrame(visible);
    this.stage.draw();
  }

  /** The gizmo that moves or turns the lattice's frame; null: none. */
  showFrame(mode: 'translate' | 'rotate' | null): void {
    this.framing = mode !== null;
    if (mode) {
      this.gizmo.setMode(mode);
      this.gizmo.attach(this.frame);
    } else this.gizmo.detach();
    this.updateFrame(true);
    this.stage.draw();
  }

  private updateFrame(visible: boolean): void {
    this.frame.visible = this.framing && visible && this.hasMesh;
    this.gizmo.enabled = this.frame.visible;
    this.gizmo.getHelper().visible = this.frame.visible;
  }

  placeFrame(translate: Vec3, rotate: Vec3): void {
    if (this.gizmo.dragging) return;
    // Turned about x, then y, then z, all of them standing still.
    this.frame.setRotationFromEuler(new Euler(...rotate.map((d) => (d * Math.PI) / 180) as Vec3, 'ZYX'));
    this.frame.scale.setScalar(this.cell);
    this.frame.position.copy(new Vector3(...translate).multiplyScalar(this.cell).applyQuaternion(this.frame.quaternion)).add(this.centre);
  }

  private readFrame(): [Vec3, Vec3] {
    const shift = this.frame.position.clone().sub(this.centre).applyQuaternion(this.frame.quaternion.clone().invert())
      .divideScalar(this.cell).clampScalar(-1, 1);
    const turn = new Euler().setFromQuaternion(this.frame.quaternion, 'ZYX');
    const round = (x: number, digits: number) => Number(x.toFixed(digits)) + 0;
    return [shift.toArray().map((x) => round(x, 2)) as Vec3,
      [turn.x, turn.y, turn.z].map((x) => round((x * 180) / Math.PI, 0)) as Vec3];
  }
}
