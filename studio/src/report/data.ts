// What a report holds, in the element `tetsoup-report`. Arrays are base64 of little-endian numbers.
//
//   {
//     "title": "bunny.ply", "version": "0.1.0", "up": "z", "metres_per_unit": 1,
//     "mesh": {"vertices": float32 xyz, "tets": uint32 abcd, "angles": float32, the smallest of each tet in degrees},
//     "surface": {"vertices": float32 xyz, "triangles": uint32 abc} or null,
//     "report": as `tetsoup mesh --json` writes it; each member but "quality" may be missing
//   }
import type { Report, Surface, Tets } from '../core/protocol';

export interface ReportData {
  title: string;
  version: string;
  up: 'x' | 'y' | 'z';
  metres_per_unit: number;
  mesh: Tets;
  surface: Surface | null;
  report: Partial<Report> & { options?: Record<string, unknown>; iou_pseudo_volume?: number };
}

function bytes(text: string): ArrayBuffer {
  const binary = atob(text);
  const out = new Uint8Array(binary.length);
  for (let i = 0; i < binary.length; ++i) out[i] = binary.charCodeAt(i);
  return out.buffer;
}

/** Null where the page is the empty template. */
export function readReport(): ReportData | null {
  const raw = JSON.parse(document.getElementById('tetsoup-report')?.textContent ?? '{}');
  if (!raw.mesh) return null;
  const { mesh, surface } = raw;
  return {
    ...raw,
    mesh: {
      vertices: new Float32Array(bytes(mesh.vertices)),
      tets: new Uint32Array(bytes(mesh.tets)),
      angles: new Float32Array(bytes(mesh.angles)),
    },
    surface: surface && { vertices: new Float32Array(bytes(surface.vertices)), triangles: new Uint32Array(bytes(surface.triangles)) },
  };
}
