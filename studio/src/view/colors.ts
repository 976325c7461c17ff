// Colours of the views. One accent; angles go from orange (flat) over sand to teal (round), which stay apart for
// people who confuse red and green.
import { Color } from 'three';

export interface Palette {
  background: string;
  surface: string;
  tets: string;
  cut: string;
  lattice: string;
  edge: string;
  grid: string;
  obstacle: string;
  /** What a check is about. */
  marked: string;
  accent: string;
  /** Of bodies that play, one after the other. */
  bodies: readonly string[];
}

export const kLight: Palette = {
  background: '#eef0f3', surface: '#c9ced6', tets: '#b9c4d0', cut: '#7fb8b4', lattice: '#c4c9d4', edge: '#1f2a37',
  grid: '#b5bcc6', obstacle: '#8f8a7d', marked: '#e0651f', accent: '#0f766e',
  bodies: ['#86bdb8', '#dba96f', '#a3aedb', '#cf9aa8'],
};
export const kDark: Palette = {
  background: '#14181d', surface: '#8f98a5', tets: '#7d8b9b', cut: '#3f9a93', lattice: '#838b99', edge: '#05080b',
  grid: '#39424d', obstacle: '#7a7466', marked: '#f2813a', accent: '#2dd4bf',
  bodies: ['#4f9f98', '#c08a4c', '#7f8cc4', '#b57889'],
};

/** Degrees of the angles that the colours of quality stand for: below 20 the verdict objects, and so does the colour. */
export const kAngleStops: readonly (readonly [number, string])[] =
  [[10, '#b8400e'], [20, '#e08a3c'], [25, '#dcd3ae'], [40, '#6fb3a8'], [60, '#0f766e']];

const kTable = kAngleStops.map(([at, color]) => ({ at, color: new Color(color) }));

export function angleColor(degrees: number, out: Color): Color {
  let i = 1;
  while (i < kTable.length - 1 && degrees > kTable[i].at) ++i;
  const [low, high] = [kTable[i - 1], kTable[i]];
  const t = Math.min(1, Math.max(0, (degrees - low.at) / (high.at - low.at)));
  return out.copy(low.color).lerp(high.color, t);
}

export function gradient(stops: readonly (readonly [number, string])[]): string {
  const [first, last] = [stops[0][0], stops[stops.length - 1][0]];
  return `linear-gradient(90deg, ${stops.map(([at, c]) => `${c} ${(100 * (at - first)) / (last - first)}%`).join(', ')})`;
}

/** Of votes: none is paper, all is ink; the band in which a surface is felt is orange. */
export const kVoteStops: Record<'light' | 'dark', readonly (readonly [number, string])[]> = {
  light: [[0, '#ffffff'], [0.5, '#bfdcd9'], [0.5001, '#5aa8a1'], [1, '#0b4f4a']],
  dark: [[0, '#1b2128'], [0.5, '#24504e'], [0.5001, '#2f8f88'], [1, '#b5f0e8']],
};
export const kBandColor = '#e07b28';
