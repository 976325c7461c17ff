// The checks of a mesh as the page says them: name, value and limit in words, and what can be turned here to pass them.
import type { Check, Report } from '../core/protocol';
import type { Settings } from '../state';
import { count } from './words';

export interface Fix {
  label: string;
  change: Partial<Settings>;
}
interface Told {
  title: string;
  say(value: number): string;
  /** Why it matters, or what it comes from. */
  why: string;
  fixes(s: Settings, report: Report): Fix[];
}
export interface Checked {
  name: string;
  title: string;
  /** Value and limit. */
  found: string;
  why: string;
  fixes: Fix[];
  passed: boolean;
  limit: number;
}

const kMostVoxels = 512;
const kMostTets = 100000;
const kLowShare = 0.2;
const kCrumb = 0.05;

const number = (x: number) => Number(x.toPrecision(3)).toLocaleString('en');
const degrees = (x: number) => `${number(x)}°`;
const share = (x: number) => `${Number((100 * x).toPrecision(2))} %`;
const times = (x: number) => `${number(x)} times`;
const edges = (x: number) => `${number(x)} edges of a tet`;

function moreVoxels(s: Settings): Fix {
  const voxels = Math.min(2 * s.voxels, Math.max(kMostVoxels, s.voxels));
  return { label: `${voxels} voxels`, change: { voxels } };
}
function moreTets(s: Settings): Fix {
  const tets = Math.min(2 * s.tets, Math.max(kMostTets, s.tets));
  return { label: count(tets, 'tet'), change: { tets } };
}
function moreOfBoth(s: Settings): Fix {
  const [voxels, tets] = [moreVoxels(s), moreTets(s)];
  return { label: `${voxels.label} and ${tets.label}`, change: { ...voxels.change, ...tets.change } };
}
const lowerShare: Fix = { label: `Share inside ${kLowShare}`, change: { rho: kLowShare } };
const dropCrumbs: Fix = { label: 'Drop crumbs', change: { min_part: kCrumb } };
const searchPlace: Fix = { label: 'Search the best place', change: { fit: 'search' } };
const fewerPasses = (s: Settings): Fix => ({ label: count(Math.floor(s.passes / 2), 'pass', 'passes'), change: { passes: Math.floor(s.passes / 2) } });
function sharperLimit(s: Settings): Fix {
  const min_angle = Math.min(45, Math.max(25, s.min_angle + 5));
  return { label: `No angle below ${min_angle}°`, change: { min_angle } };
}

const rounder = (s: Settings): Fix[] => [sharperLimit(s), fewerPasses(s), moreTets(s)];

const kTold: Record<string, Told> = {
  tet_count: { title: 'Tets', say: number, why: 'Nothing here has a volume.', fixes: (s) => [moreVoxels(s), lowerShare] },
  inverted_tets: { title: 'Tets without a volume', say: number, why: 'No engine takes them.', fixes: () => [searchPlace] },
  min_dihedral_deg: { title: 'Smallest angle between faces', say: degrees, why: 'Flat tets lock, and need short time steps.', fixes: rounder },
  max_dihedral_deg: { title: 'Largest angle between faces', say: degrees, why: 'Flat tets lock, and need short time steps.', fixes: rounder },
  max_edge_ratio: { title: 'Longest over shortest edge', say: times, why: 'Stretched tets are stiff one way and soft another.', fixes: rounder },
  tet_volume_ratio: { title: 'Largest over smallest tet', say: times, why: 'A tiny tet makes time steps short for all.', fixes: rounder },
  non_manifold: { title: 'Places where the boundary touches itself', say: number, why: 'Contacts and surfaces do not know what is outside there.',
    fixes: (s) => [moreTets(s), searchPlace] },
  components: { title: 'Pieces that share no face', say: number, why: 'What is one body in the model falls apart when it moves.',
    fixes: (s) => [lowerShare, moreTets(s), dropCrumbs] },
  boundary_only_share: { title: 'Tets without an inner vertex', say: share, why: 'Thin parts of one layer of tets are too stiff.',
    fixes: (s) => [moreTets(s), { label: 'Split them', change: { boundary_only: 'split' } }] },
  lost_edges: { title: 'Longest stretch of the model without mesh', say: edges, why: 'It is thinner than a voxel or than a tet.',
    fixes: (s) => [moreVoxels(s), lowerShare, moreTets(s)] },
  lost_pieces: { title: 'Pieces of the model without mesh', say: number, why: 'They are smaller than what is kept.',
    fixes: (s) => [{ label: 'Keep small pieces', change: { min_part: 0 } }, moreTets(s)] },
  torn_pieces: { title: 'Pieces that the model has in one', say: number, why: 'They fall apart when they move.',
    fixes: (s) => [lowerShare, moreTets(s), dropCrumbs] },
  joined_pieces: { title: 'Pieces joined that the model has apart', say: number, why: 'They move as one. The gap between them is narrower than a voxel or a tet.',
    fixes: (s) => [moreOfBoth(s)] },
  overlap_share: { title: 'Share of the mesh that lies in it twice', say: share, why: 'Contacts begin there before anything moves.',
    fixes: (s) => [{ label: 'Do not draw to the shape', change: { snap: 'off' } }, fewerPasses(s), moreTets(s)] },
  volume_share: { title: 'Volume over the model’s', say: times, why: 'Thin parts have no tets.',
    fixes: (s) => [moreVoxels(s), lowerShare, moreTets(s)] },
  volume_ratio: { title: 'Volume over the model’s', say: times, why: 'Walls are thicker than the model’s, or what is open was filled.',
    fixes: (s) => [moreVoxels(s), moreTets(s), { label: 'Leave hollow', change: { cavities: 'keep' } }] },
  stray_share: { title: 'Share of the mesh away from the model', say: share, why: 'A vessel, a room or a gap was filled.',
    fixes: (s) => [moreVoxels(s), { label: 'Leave hollow', change: { cavities: 'keep' } }] },
  tunnels: { title: 'Holes through the mesh', say: number, why: 'Some are not in the model: thin walls have gaps.',
    fixes: (s) => [lowerShare, moreVoxels(s), moreTets(s)] },
  tilted_share: { title: 'Share of a flat surface that is dented', say: share, why: 'The lattice meets flat sides at a slant.',
    fixes: (s) => [searchPlace, moreTets(s)] },
};

function differs(change: Partial<Settings>, s: Settings): boolean {
  return Object.entries(change).some(([key, value]) => value !== s[key as keyof Settings]);
}

function told(name: string, check: Check, s: Settings, report: Report): Checked {
  const { title, say, why, fixes } = kTold[name] ?? { title: name.replace(/_/g, ' '), say: number, why: check.advice, fixes: () => [] };
  const limit = check.at_least ?? check.at_most ?? 0;
  const value = check.value === null ? 'without end' : say(check.value);
  return { name, title, why, limit, passed: check.passed, found: `${value}, ${check.at_least === undefined ? 'at most' : 'at least'} ${say(limit)}`,
    fixes: check.passed ? [] : fixes(s, report).filter((fix) => differs(fix.change, s)) };
}

/** All checks, those that fail first. Two that say the same of the same pieces are one. */
export function checksOf(report: Report, s: Settings): Checked[] {
  const { checks } = report.readiness;
  const twice = checks.components?.passed === false && checks.torn_pieces?.passed === false;
  const all = Object.entries(checks).filter(([name]) => !(twice && name === 'torn_pieces')).map(([name, check]) => told(name, check, s, report));
  return [...all.filter((check) => !check.passed), ...all.filter((check) => check.passed)];
}

/** What the tool's options are called here. */
const kNames: readonly (readonly [RegExp, string])[] = [
  [/--tets auto tries how many/g, 'try twice as many'], [/--voxels (\d+)/g, '$1 voxels'], [/--cells \d+/g, 'more tets'],
  [/--rho-min \(?([\d.]+)\)?/g, 'share inside of $1'], [/--rho-min/g, 'share inside'], [/--min-part ([\d.]+)/g, 'smallest part of $1'], [/--snap off/g, '“Draw to the shape” off'],
  [/--passes/g, 'passes'], [/--cavities keep/g, '“Leave hollow” for enclosed space'], [/--density/g, 'density'], [/--metres-per-unit [\d.]+/g, 'unit'],
  [/--translate, --rotate|--fit, --rotate/g, '“Place of the lattice”'], [/--band-voxels [\d.]+/g, 'a lower k'], [/--tets/g, 'tets'],
];

/** The library's notes, in this page's words; what a check says already is left out. */
export function notesOf(report: Report): string[] {
  const said = /of the model (has|have) no tets|of the model have|times the model's|stands outside the model|falls into|joined to others|through the mesh|lie in each other|is dented/;
  return report.notes.filter((note) => !said.test(note)).map((note) => kNames.reduce((text, [flag, name]) => text.replace(flag, name), note));
}
