// Reports in plain words. Every sentence says what is, and where something can be done about it, what.
import { heightOf, kUnits, type Settings, stiffnessOf } from '../state';
import type { Box, EmbedReport, PlayStart, Report, SoupReport } from '../core/protocol';

export type Tone = 'plain' | 'good' | 'watch';
export interface Sentence {
  text: string;
  tone: Tone;
}

/** In voxels: no reach is less than nine tenths of one. */
const kLeastBand = 0.901;

const say = (text: string, tone: Tone = 'plain'): Sentence => ({ text, tone });

export const kPictureLost = 'The graphics card has taken the picture away. It comes back by itself; if it does not, reload the page.';
export const kCannotDraw = 'This browser does not draw in 3D: WebGL 2 is missing or switched off. Switch on hardware acceleration in its settings, or take another browser. The tool works without: tetsoup mesh model.obj -o model.msh';

/** Of several files that were dropped. */
export function ofDropped(opened: string, others: number): string {
  return `${opened} is open; ${count(others, 'other file was', 'other files were')} left out. One model at a time.`;
}

/** A sample's name at the beginning of a line. */
export function title(name: string): string {
  return name.charAt(0).toUpperCase() + name.slice(1);
}

export function count(n: number, one: string, many = one + 's'): string {
  return `${n.toLocaleString('en')} ${n === 1 ? one : many}`;
}

function share(part: number): string {
  return `${(100 * part).toFixed(1)} %`;
}

/** Lengths in a unit that is not known stay as they are. */
export type Unit = Settings['unit'] | 'own';
type Wanted = Pick<Settings, 'tets' | 'cavities'> & { unit: Unit };

/** Two digits, in the unit that keeps them readable. */
export function length(value: number, unit: Unit): string {
  if (unit === 'own') return String(Number(value.toPrecision(2)));
  const metres = value * kUnits[unit].metres;
  if (metres === 0) return '0';
  const [scale, name] = metres >= 1 ? [1, 'm'] : metres >= 0.01 ? [100, 'cm'] : [1000, 'mm'];
  return `${Number((metres * scale).toPrecision(2)).toLocaleString('en')} ${name}`;
}

/** Lengths along x, y and z in the unit that suits the longest. */
function extents(box: Box, unit: Unit): string {
  const all = box.hi.map((hi, i) => hi - box.lo[i]);
  const [, name] = length(Math.max(...all), unit).split(' ');
  const scale = unit === 'own' ? 1 : kUnits[unit].metres * ({ m: 1, cm: 100, mm: 1000 }[name] ?? 1);
  return all.map((x) => Number((x * scale).toPrecision(2)).toLocaleString('en')).join(' × ') + (unit === 'own' ? '' : `\u00a0${name}`);
}

/** Metres between which nearly all is that falls, and units in the order in which they are meant. */
const kLikely = [0.01, 10] as const;
const kMeant: readonly Settings['unit'][] = ['m', 'cm', 'mm', 'in'];

/** A size that is unlikely, and the unit that makes it a likely one. */
export function ofDoubt(box: Box, unit: Settings['unit']): { text: string; unit: Settings['unit']; ask: string } | null {
  const longest = Math.max(...box.hi.map((hi, i) => hi - box.lo[i]));
  const likely = (u: Settings['unit']) => longest * kUnits[u].metres >= kLikely[0] && longest * kUnits[u].metres <= kLikely[1];
  const meant = likely(unit) ? undefined : kMeant.find(likely);
  return meant ? { text: `It is ${length(longest, unit)} long.`, unit: meant, ask: `${title(kUnits[meant].label)}?` } : null;
}

export function milliseconds(ms: number): string {
  return ms < 10 ? `${ms.toFixed(1)} ms` : ms < 2000 ? `${Math.round(ms)} ms` : `${(ms / 1000).toFixed(1)} s`;
}

export function ofSoup(r: SoupReport, unit: Unit): Sentence[] {
  const said = [say(`${count(r.used_triangles, 'triangle')}, ${extents(r.box, unit)}.`)];
  if (r.class === 'closed') said.push(say('Closed: no edge is open.', 'good'));
  if (r.boundary_edges) said.push(say(`${count(r.boundary_edges, 'open edge')}: holes are bridged, nothing to repair.`));
  if (r.non_manifold_edges) said.push(say(`${count(r.non_manifold_edges, 'edge')} with more than two triangles. That is fine.`));
  if (r.components > 1) said.push(say(`${count(r.components, 'part')} not connected by triangles.`));
  const dropped = r.zero_area + r.duplicates + r.non_finite + r.index_out_of_range;
  if (dropped) said.push(say(`${count(dropped, 'triangle')} left out: flat, doubled or not finite.`, 'watch'));
  return said;
}

export function ofVolume(r: Report, s: Wanted): Sentence[] {
  const p = r.pseudo_volume;
  const said: Sentence[] = [];
  if (!p.inside_voxels) {
    return [say('Nothing counts as inside. Lower k, or take more voxels.', 'watch')];
  }
  const how = p.automatic ? `k = ${p.k.toFixed(3)}, chosen for you` : `k = ${p.k.toFixed(3)}`;
  said.push(say(`${how}: gaps up to ${length(2 * p.band, s.unit)} count as closed.`));
  if (!p.automatic && p.band_voxels < kLeastBand) said.push(say('A k as high as yours reaches less far than a voxel, so all from here to 1 are the same. More voxels make a difference.', 'watch'));
  if (p.largest_closure > 0 && r.soup.boundary_edges)
    said.push(say(`Holes were closed up to ${length(p.largest_closure, s.unit)}.`));
  said.push(say(`${count(p.inside_voxels, 'voxel')} of ${length(r.grid.voxel_size, s.unit)} lie inside.`));
  if (p.cavity_voxels) said.push(say(`${count(p.cavity_voxels, 'voxel')} of enclosed space ${s.cavities !== 'keep' ? 'were filled' : 'stay hollow'}.`));
  if (p.soup_covered < 0.9) said.push(say(`Only ${Math.round(100 * p.soup_covered)} % of the triangles touch the inside. Lower k to take in more.`, 'watch'));
  return said;
}

/** What matters most of a mesh; the rest is with the stage that made it. */
export function ofMesh(r: Report, s: Wanted): Sentence[] {
  const { lattice: l, quality: q, pseudo_volume: p } = r;
  if (!p.inside_voxels) return ofVolume(r, s);
  if (!l.tet_count) return ofLattice(r, s);
  const said = [say(`Edges of ${length(l.mean_edge, s.unit)} on average, angles from ${q.min_dihedral_deg.toFixed(0)}° to ${q.max_dihedral_deg.toFixed(0)}°.`)];
  if (Math.abs(l.tet_count / s.tets - 1) > 0.1) said.push(say(`You asked for ${s.tets.toLocaleString('en')}: this shape allows no closer number.`, 'watch'));
  if (p.soup_covered < 0.9) said.push(say(`Only ${Math.round(100 * p.soup_covered)} % of the triangles touch the inside. Lower k to take in more.`, 'watch'));
  return said;
}

export function ofLattice(r: Report, s: Wanted): Sentence[] {
  const l = r.lattice;
  if (!l.tet_count) return [say('No tet is left. Lower the share that must be inside, or ask for more tets.', 'watch')];
  const said = [say(`${count(l.tet_count, 'tet')} with edges of ${length(l.mean_edge, s.unit)} on average.`)];
  if (l.overlap_unfitted > 0) said.push(say(`The best place that was found overlaps the volume by ${share(l.overlap)}; as given, it was ${share(l.overlap_unfitted)}.`));
  const off = Math.abs(l.tet_count / s.tets - 1);
  if (off > 0.1) said.push(say(`You asked for ${s.tets.toLocaleString('en')}: this shape allows no closer number.`, 'watch'));
  if (l.thin_tets) said.push(say(`${count(l.thin_tets, 'tet')} kept where the shape is thinner than a cell.`));
  if (l.topology.touching_mended) said.push(say(`${count(l.topology.touching_mended, 'place')} mended where tets met in a point or an edge only.`));
  if (l.topology.parts_dropped) said.push(say(`${count(l.topology.parts_dropped, 'crumb')} dropped.`));
  return said;
}

export function ofSmoothing(r: Report): Sentence[] {
  const q = r.quality;
  if (!q.tet_count) return [];
  const good = r.readiness.passed;
  const said = [say(`Smallest angle ${q.min_dihedral_deg.toFixed(0)}°, largest ${q.max_dihedral_deg.toFixed(0)}°.`, good ? 'good' : 'plain')];
  const kept = 100 * (q.volume / r.lattice.kept_volume - 1);
  said.push(say(`Volume ${Math.abs(kept) < 0.05 ? 'kept' : `${kept > 0 ? '+' : '−'}${Math.abs(kept).toFixed(1)} % against the lattice`}.`));
  if (good) said.push(say('Ready for simulation: every check passes.', 'good'));
  if (q.components > 1) said.push(say(`The mesh has ${count(q.components, 'piece')}.`));
  return said;
}

export function ofEmbedding(r: EmbedReport, unit: Unit): Sentence[] {
  const e = r.embedding;
  const all = e.inside + e.outside;
  const said = [say(`${count(all, 'vertex', 'vertices')} of the model hang on the tets; ${Math.round((100 * e.inside) / Math.max(all, 1))} % lie inside one.`)];
  if (e.outside) said.push(say(`The others follow the nearest tet, at most ${length(e.max_distance, unit)} away.`));
  if (e.non_finite) said.push(say(`${count(e.non_finite, 'vertex', 'vertices')} are not finite and stay behind.`, 'watch'));
  return said;
}

export function ofPlay(start: PlayStart): Sentence[] {
  const said = [say(`${start.title}. Drag a body with the mouse or a finger to pull it.`)];
  const drawn = [...start.bodies, ...start.obstacles].reduce((sum, skin) => sum + skin.triangles.length / 3, 0);
  if (drawn < start.triangleCount)
    said.push(say(`No graphics card draws for this page, so ${drawn.toLocaleString('en')} of ${count(start.triangleCount, 'triangle')} are drawn. Nothing else changes.`));
  return said;
}

export function pascals(young: number): string {
  const [value, unit] = young >= 1e6 ? [young / 1e6, 'MPa'] : [young / 1e3, 'kPa'];
  return `${Number(value.toPrecision(2))} ${unit}`;
}

const kGravity = 9.81;
/** Of its height that a body may sag under its own weight before that is said. */
const kMuchSag = 0.2;

/** How large and heavy the body is, and whether it holds itself up. */
export function ofBody(r: Report, s: Settings): Sentence[] {
  const metres = kUnits[s.unit].metres;
  const extent = r.soup.box.hi.map((hi, i) => hi - r.soup.box.lo[i]);
  const mass = s.density * r.quality.volume * metres ** 3;
  const weight = mass < 1 ? `${Number((1000 * mass).toPrecision(2))} g` : `${Number(mass.toPrecision(2)).toLocaleString('en')} kg`;
  const said = [say(`${length(Math.max(...extent), s.unit)} long, ${weight}.`)];
  const height = heightOf(r.soup.box, s);
  const sag = (s.density * kGravity * height) / 10 ** stiffnessOf(s, height);
  if (sag > kMuchSag) said.push(say(sag > 0.9 ? 'So large and so soft it collapses under its own weight. Take it stiffer.'
    : `So large and so soft it sags by some ${Math.round(100 * sag)}\u00a0% under its own weight.`, 'watch'));
  return said;
}

/** What a stiffness feels like. */
export function likeWhat(young: number): string {
  return young < 1.5e4 ? 'jelly' : young < 8e4 ? 'soft foam' : young < 5e5 ? 'soft rubber' : young < 3e6 ? 'rubber' : 'hard rubber';
}

/** The library's errors name an option of scene files; the page says what to do about it. */
export function ofError(message: string, status: number): string {
  if (status === 1 && /^(mesh\.)?voxels = /.test(message)) return ofTooManyVoxels(message);
  if (status === 4) return 'The memory of this page is used up. Choose fewer voxels or tets, or reload the page.';
  if (status === 2 && /lies in another file/.test(message))
    return 'This file keeps its geometry in another file, which a page cannot follow. Save it as one .glb, and open that.';
  if (status === 2) return `This file cannot be read: ${message.trim().replace(/[.?!]*$/, '')}. Export it again as OBJ, STL, PLY, OFF, GLB, 3MF or DAE.`;
  if (status === 5) return `Something went wrong inside tetsoup: ${sentence(message)} Reload the page; if it happens again, please report it.`;
  return sentence(message.replace(/^mesh\./, ''));
}

/** Of a grid that has more voxels than memory, or than can be counted. */
function ofTooManyVoxels(message: string): string {
  const most = /must be at most (\d+) to fit into/.exec(message)?.[1];
  return `So many voxels do not fit into this page's memory. ${most ? `At most ${most} do` : 'A few hundred do'}: choose fewer voxels.`;
}

/** With a capital and a full stop. */
export function sentence(text: string): string {
  const trimmed = text.trim();
  return trimmed.charAt(0).toUpperCase() + trimmed.slice(1) + (/[.!?]$/.test(trimmed) ? '' : '.');
}

/** A stage that tries several ways is at its end several times, so that ends are not said. */
export function ofProgress(stage: string, fraction: number): string {
  const percent = Math.round(100 * fraction);
  return stageName(stage) + (percent > 0 && percent < 100 ? ` ${percent} %` : '');
}

const kStageNames: Record<string, string> = {
  soup: 'Looking at the soup', distance: 'Measuring distances', pseudo_volume: 'Deciding what is inside',
  lattice: 'Filling with tets', smooth: 'Smoothing', embed: 'Hanging the surface', quality: 'Measuring the mesh',
};
/** What a stage does, while it does it. */
export function stageName(stage: string): string {
  return kStageNames[stage.replace(/ /g, '_')] ?? stage.charAt(0).toUpperCase() + stage.slice(1);
}

