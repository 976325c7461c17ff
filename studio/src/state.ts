// What the user chose, its history, and its place in the page's address.
import type { Box, Material, MeshOptions, Vec3 } from './core/protocol';

export type View = 'soup' | 'votes' | 'lattice' | 'tets' | 'surface';

/** What is seen of a model and its mesh, and how. */
export interface ViewSettings {
  view: View;
  edges: 'on' | 'off';
  quality: 'on' | 'off';
  /** The model around the tets. */
  ghost: 'on' | 'off';
  cut: 'off' | 'x' | 'y' | 'z';
  /** 0 to 1 along the axis. */
  cut_at: number;
  cut_side: 'high' | 'low';
  slice: 'x' | 'y' | 'z';
  slice_at: number;
}

export interface Settings extends ViewSettings {
  sample: string;
  /** Per cent of a sample's triangles that are missing. */
  damage: number;
  /** Name of a dropped file: its bytes are not in the address. */
  file: string;
  up: 'x' | 'y' | 'z';
  unit: 'm' | 'cm' | 'mm' | 'in';
  voxels: number;
  /** Null: chosen by the library. */
  k: number | null;
  cavities: 'auto' | 'fill' | 'keep';
  tets: number;
  lattice: 'five' | 'bcc';
  /** Pieces with a smaller share of the volume are dropped. */
  min_part: number;
  boundary_only: 'leave' | 'split' | 'remove';
  rho: number;
  translate: Vec3;
  rotate: Vec3;
  fit: 'off' | 'search';
  passes: number;
  strength: number;
  snap: 'on' | 'off';
  /** Degrees that smoothing leaves between two faces. */
  min_angle: number;
  /** Decimal logarithm of Young's modulus in Pa; null: so stiff that the body hardly sags. */
  stiffness: number | null;
  /** kg/m^3. */
  density: number;
  poisson: number;
  /** Where the camera is and where it looks; null: all is in the picture. Steps back do not move it. */
  camera: number[] | null;
}

export const kDefaults: Readonly<Settings> = {
  sample: '', damage: 0, file: '', up: 'z', unit: 'm',
  voxels: 96, k: null, cavities: 'auto',
  tets: 2000, lattice: 'five', min_part: 0.001, boundary_only: 'leave', rho: 0.5, translate: [0, 0, 0], rotate: [0, 0, 0], fit: 'off',
  passes: 6, strength: 1, snap: 'on', min_angle: 25,
  stiffness: null, density: 1000, poisson: 0.4,
  view: 'tets', edges: 'on', quality: 'off', ghost: 'off', cut: 'off', cut_at: 0.5, cut_side: 'high', slice: 'y', slice_at: 0.5,
  camera: null,
};

export const kUnits: Record<Settings['unit'], { metres: number; label: string }> = {
  m: { metres: 1, label: 'metres' },
  cm: { metres: 0.01, label: 'centimetres' },
  mm: { metres: 0.001, label: 'millimetres' },
  in: { metres: 0.0254, label: 'inches' },
};

const kChoices: Partial<Record<keyof Settings, readonly string[]>> = {
  up: ['x', 'y', 'z'], unit: ['m', 'cm', 'mm', 'in'], cavities: ['auto', 'fill', 'keep'], lattice: ['five', 'bcc'], boundary_only: ['leave', 'split', 'remove'],
  fit: ['off', 'search'], snap: ['on', 'off'], view: ['soup', 'votes', 'lattice', 'tets', 'surface'],
  edges: ['on', 'off'], quality: ['on', 'off'], ghost: ['on', 'off'], cut: ['off', 'x', 'y', 'z'], cut_side: ['high', 'low'], slice: ['x', 'y', 'z'],
};

/** The options of meshing that these settings stand for. */
export function meshOptions(s: Settings): MeshOptions {
  const options: MeshOptions = {
    voxels: s.voxels, cavities: s.cavities, tets: s.tets, lattice: s.lattice, rho_min: s.rho,
    translate_cells: s.translate, rotate: s.rotate, fit: s.fit, passes: s.passes, strength: s.strength, snap: s.snap,
    min_part: s.min_part, boundary_only: s.boundary_only, min_angle: s.min_angle,
  };
  if (s.k !== null) options.k = s.k;
  return options;
}

const kMeshKeys = ['voxels', 'k', 'cavities', 'tets', 'lattice', 'min_part', 'boundary_only', 'rho', 'translate', 'rotate', 'fit', 'passes', 'strength',
  'snap', 'min_angle'] as const;

/** The settings that a mesh is made with. */
export function meshSettings(s: Settings): Partial<Settings> {
  return Object.fromEntries(kMeshKeys.map((key) => [key, s[key]]));
}

const kGravity = 9.81;
/** Of its height that a body sags whose stiffness nobody chose. */
const kSag = 0.15;
export const kSoftest = 3.7;
export const kStiffest = 7;

/** Young's modulus as a power of ten, of a body of this height in metres. */
export function stiffnessOf(s: Settings, height: number): number {
  const wanted = Math.log10((s.density * kGravity * height) / kSag);
  return s.stiffness ?? Number(Math.min(kStiffest, Math.max(kSoftest, wanted)).toFixed(1));
}

/** What falls and what is written into files is of one material. */
export function materialOf(s: Settings, height: number): Material {
  return { density: s.density, young: Number((10 ** stiffnessOf(s, height)).toPrecision(3)), poisson: s.poisson };
}

/** Metres from the lowest to the highest point of a model, the way up that was chosen. */
export function heightOf({ lo, hi }: Box, s: Settings): number {
  const axis = 'xyz'.indexOf(s.up);
  return (hi[axis] - lo[axis]) * kUnits[s.unit].metres;
}

/** Only what differs from the defaults, so that addresses stay short; of a file also what else would be guessed. */
export function toAddress(s: Settings): string {
  const words = new URLSearchParams();
  const guessed: readonly string[] = s.file ? ['up', 'unit'] : [];
  for (const key of Object.keys(kDefaults) as (keyof Settings)[])
    if (key !== 'file' && (String(s[key]) !== String(kDefaults[key]) || guessed.includes(key))) words.set(key, String(s[key]));
  return words.toString().replace(/%2C/g, ',');
}

/** What cannot be understood is as by default: addresses are typed, cut and pasted by people. */
export function fromAddress(hash: string): Settings {
  const s: Record<string, unknown> = { ...kDefaults };
  for (const [key, text] of new URLSearchParams(hash.replace(/^#/, ''))) {
    if (!Object.keys(kDefaults).includes(key) || key === 'file') continue;
    const fallback = kDefaults[key as keyof Settings];
    const choices = kChoices[key as keyof Settings];
    const numbers = text.split(',').map(Number);
    if (key === 'camera') {
      if (numbers.length === 6 && numbers.every(Number.isFinite)) s[key] = numbers;
    } else if (Array.isArray(fallback)) {
      if (numbers.length === 3 && numbers.every(Number.isFinite)) s[key] = numbers;
    } else if (key === 'k' || key === 'stiffness' || typeof fallback === 'number') {
      if (text !== '' && Number.isFinite(numbers[0])) s[key] = numbers[0];
    } else if (!choices || choices.includes(text)) s[key] = text;
  }
  return s as unknown as Settings;
}

export const kViewKeys = ['view', 'edges', 'quality', 'ghost', 'cut', 'cut_at', 'cut_side', 'slice', 'slice_at'] as const;

const kMostSteps = 200;
/** Changes of one control within this time are one step back. */
const kStepMilliseconds = 700;

/** The settings, and every earlier and later state of them. */
export class Store {
  private past: Settings[] = [];
  private future: Settings[] = [];
  private lastKey = '';
  private lastTime = 0;
  private listeners: ((now: Settings, before: Settings) => void)[] = [];

  constructor(public now: Settings) {}

  onChange(listener: (now: Settings, before: Settings) => void): void {
    this.listeners.push(listener);
  }

  set(change: Partial<Settings>): void {
    const before = this.now;
    const now = { ...before, ...change };
    if (toAddress(now) === toAddress(before) && now.file === before.file) return;
    const key = Object.keys(change).join();
    const time = performance.now();
    if (key !== this.lastKey || time - this.lastTime > kStepMilliseconds || !this.past.length) this.past.push(before);
    if (this.past.length > kMostSteps) this.past.shift();
    this.lastKey = key;
    this.lastTime = time;
    this.future = [];
    this.apply(now);
  }

  /** What no step goes back to: where the camera is. */
  note(change: Pick<Settings, 'camera'>): void {
    this.apply({ ...this.now, ...change });
  }

  /** What was guessed of a model that has come belongs to the step that brought it. */
  amend(change: Partial<Settings>): void {
    this.apply({ ...this.now, ...change });
  }

  /** Leaves out the last step, as if it had not been made. */
  takeBack(): void {
    const before = this.past.pop();
    this.lastKey = '';
    if (before) this.apply(before);
  }

  /** The next change starts a step of its own: a slider was let go. */
  endStep(): void {
    this.lastKey = '';
  }

  get canUndo(): boolean {
    return this.past.length > 0;
  }
  get canRedo(): boolean {
    return this.future.length > 0;
  }

  undo(): void {
    this.travel(this.past, this.future);
  }
  redo(): void {
    this.travel(this.future, this.past);
  }

  private travel(from: Settings[], to: Settings[]): void {
    const target = from.pop();
    if (!target) return;
    to.push(this.now);
    this.lastKey = '';
    this.apply({ ...target, camera: this.now.camera });
  }

  private apply(now: Settings): void {
    const before = this.now;
    this.now = now;
    this.listeners.forEach((listener) => listener(now, before));
  }
}
