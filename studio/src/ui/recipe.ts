// The same mesh without this page: as commands of the tool, and as Python. They give the same bits.
import type { Material } from '../core/protocol';
import { kDefaults, kUnits, type Settings } from '../state';
import type { ExportChoice } from './export_dialog';

/** Voxels that the tool takes where nothing is said; this page begins with fewer. */
const kToolVoxels = 128;

function quoted(name: string): string {
  return /^[\w./-]+$/.test(name) && !name.startsWith('-') ? name : `'${name.replace(/'/g, "'\\''")}'`;
}

function changed(s: Settings, key: keyof Settings): boolean {
  return String(s[key]) !== String(kDefaults[key]);
}

/** Flags of `tetsoup mesh` for all that is not as it would be anyway. */
function flags(s: Settings): string[] {
  const out: string[] = [];
  const add = (wanted: boolean, ...words: (string | number)[]) => wanted && out.push(words.join(' '));
  add(s.voxels !== kToolVoxels, '--voxels', s.voxels);
  add(s.k !== null, '--k', s.k ?? '');
  add(changed(s, 'cavities'), '--cavities', s.cavities);
  add(true, '--tets', s.tets);
  add(changed(s, 'lattice'), '--lattice', s.lattice);
  add(changed(s, 'rho'), '--rho-min', s.rho);
  add(changed(s, 'min_part'), '--min-part', s.min_part);
  add(changed(s, 'boundary_only'), '--boundary-only', s.boundary_only);
  add(changed(s, 'translate'), `--translate=${s.translate}`);
  add(changed(s, 'rotate'), `--rotate=${s.rotate}`);
  add(s.fit === 'search', '--fit');
  add(changed(s, 'passes'), '--passes', s.passes);
  add(changed(s, 'snap'), '--snap', s.snap);
  add(changed(s, 'strength') && s.snap === 'off', '--strength', s.strength);
  add(changed(s, 'min_angle'), '--min-angle', s.min_angle);
  return out;
}

function materialFlags(s: Settings, { density, young, poisson }: Material): string[] {
  return [`--up ${s.up}`, `--density ${density}`, `--young ${young}`, `--poisson ${poisson}`, `--metres-per-unit ${kUnits[s.unit].metres}`];
}

export function asCommand(s: Settings, choice: ExportChoice, material: Material): string {
  const input = s.file || `${s.sample}.obj`;
  const sample = `tetsoup sample ${s.sample} -o ${input}${s.damage ? ` --damage ${s.damage / 100}` : ''}\n`;
  const as = choice.engine ? `--for ${choice.engine}` : `--format ${choice.format}`;
  return `${s.file ? '' : sample}${['tetsoup mesh', quoted(input), '-o', quoted(choice.name), as, ...flags(s), ...materialFlags(s, material)].join(' ')}`;
}

export function asPython(s: Settings, choice: ExportChoice, { density, young, poisson }: Material): string {
  const radians = (degrees: number) => `math.radians(${degrees})`;
  const options: Record<string, string> = { voxels: String(s.voxels), tets: String(s.tets) };
  const text = (x: string) => JSON.stringify(x);
  if (s.k !== null) options.k = String(s.k);
  if (changed(s, 'cavities')) options.cavities = text(s.cavities);
  if (changed(s, 'lattice')) options.lattice = text(s.lattice);
  if (changed(s, 'rho')) options.rho_min = String(s.rho);
  if (changed(s, 'min_part')) options.min_part = String(s.min_part);
  if (changed(s, 'boundary_only')) options.boundary_only = text(s.boundary_only);
  if (changed(s, 'translate')) options.translate_cells = `(${s.translate.join(', ')})`;
  if (changed(s, 'rotate')) options.rotate = `(${s.rotate.map(radians).join(', ')})`;
  if (s.fit === 'search') options.fit = text(s.fit);
  if (changed(s, 'passes')) options.passes = String(s.passes);
  if (changed(s, 'snap')) options.snap = text(s.snap);
  if (changed(s, 'strength') && s.snap === 'off') options.strength = String(s.strength);
  if (changed(s, 'min_angle')) options.min_dihedral = radians(s.min_angle);
  const given = Object.entries(options).map(([key, value]) => `, ${key}=${value}`).join('');
  const soup = s.file ? text(s.file) : `tetsoup.sample(${text(s.sample)}${s.damage ? `, damage=${s.damage / 100}` : ''})`;
  const how = choice.engine ? `engine=${text(choice.engine)}` : `format=${text(choice.format ?? '')}`;
  const imports = given.includes('math.') ? 'import math\n\nimport tetsoup\n' : 'import tetsoup\n';
  return `${imports}\nmesh = tetsoup.tetrahedralize(${soup}${given})\n`
    + `mesh.save(${text(choice.name)}, ${how}, up=${text(s.up)}, density=${density}, young=${young}, poisson=${poisson}, metres_per_unit=${kUnits[s.unit].metres})\n`;
}
