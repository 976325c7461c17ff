// A layer of voxels: how many rays call each of them inside, and where a surface is felt.
import { Color, DataTexture, DoubleSide, Mesh, MeshBasicMaterial, NearestFilter, PlaneGeometry, SRGBColorSpace } from 'three';
import type { Slice } from '../core/protocol';
import { kBandColor, kVoteStops } from './colors';

/** Across axis 0, 1, 2: the axes that a row's voxels and the rows run along. */
const kRunning = [[1, 2], [0, 2], [0, 1]] as const;

export class SliceLayer extends Mesh<PlaneGeometry, MeshBasicMaterial> {
  private slice: Slice | null = null;
  private dark = false;
  private stale = false;

  constructor() {
    super(new PlaneGeometry(1, 1), new MeshBasicMaterial({ side: DoubleSide, toneMapped: false }));
    this.visible = false;
    this.matrixAutoUpdate = false;
  }

  setDark(dark: boolean): void {
    this.dark = dark;
    this.show(this.visible, true);
  }

  set(slice: Slice): void {
    this.slice = slice;
    this.show(this.visible, true);
  }

  /** What is hidden is painted when it is seen. */
  show(visible: boolean, stale = this.stale): void {
    this.visible = visible;
    this.stale = stale && !visible;
    if (this.slice && stale && visible) this.update(this.slice);
  }

  private update(slice: Slice): void {
    const texture = new DataTexture(this.paint(slice), slice.width, slice.height);
    texture.colorSpace = SRGBColorSpace;
    texture.magFilter = texture.minFilter = NearestFilter;
    texture.needsUpdate = true;
    this.material.map?.dispose();
    this.material.map = texture;
    this.material.needsUpdate = true;
    this.place(slice);
  }

  private paint(slice: Slice): Uint8Array {
    const rays = slice.grid.rays || 26;
    const table = this.colors(rays);
    const pixels = new Uint8Array(4 * slice.votes.length);
    slice.votes.forEach((votes, i) => {
      const from = 8 * votes + (slice.distance[i] <= slice.grid.band ? 4 : 0);
      for (let channel = 0; channel < 4; ++channel) pixels[4 * i + channel] = table[from + channel];
    });
    return pixels;
  }

  /** Bytes of red, green, blue and opacity for each number of votes, away from triangles and near one. */
  private colors(rays: number): Uint8Array {
    const stops = kVoteStops[this.dark ? 'dark' : 'light'].map(([at, c]) => ({ at, color: new Color().setStyle(c, '') }));
    const band = new Color().setStyle(kBandColor, '');
    const table = new Uint8Array(8 * (rays + 1));
    const color = new Color();
    for (let votes = 0; votes <= rays; ++votes) {
      const share = votes / rays;
      const [low, high] = share > 0.5 ? [stops[2], stops[3]] : [stops[0], stops[1]];
      color.copy(low.color).lerp(high.color, (share - low.at) / (high.at - low.at));
      for (const to of [8 * votes, 8 * votes + 4]) {
        table.set([255 * color.r, 255 * color.g, 255 * color.b, 255].map(Math.round), to);
        color.lerp(band, 0.7);
      }
    }
    return table;
  }

  private place({ grid, axis, layer, width, height }: Slice): void {
    const h = grid.voxelSize;
    const [u, v] = kRunning[axis];
    const m = this.matrix.identity().elements;
    m[0] = m[5] = m[10] = 0;
    m[u] = width * h;
    m[4 + v] = height * h;
    m[8 + axis] = 1;
    m[12 + u] = grid.origin[u] + ((width - 1) / 2) * h;
    m[12 + v] = grid.origin[v] + ((height - 1) / 2) * h;
    m[12 + axis] = grid.origin[axis] + layer * h;
    this.matrixWorldNeedsUpdate = true;
  }
}
