// Which faces of a tet mesh are to be seen when some tets are cut away: those of a tet that stands, towards one that
// does not. Whole tets are cut, so that what is seen is what is there.

/** Corners of the face opposite each corner, counter-clockwise from outside of a positive tet. */
const kFaces = [[1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1]];

export class TetFaces {
  /** The tet behind each of a tet's four faces; -1 on the boundary. */
  private readonly neighbours: Int32Array;
  readonly count: number;

  constructor(readonly tets: Uint32Array, vertexCount: number) {
    this.count = tets.length / 4;
    this.neighbours = new Int32Array(tets.length).fill(-1);
    const open = new Map<number | string, number>();
    // Three vertex numbers fit into a number's 53 bits up to here.
    const small = vertexCount < 200000;
    for (let face = 0; face < tets.length; ++face) {
      const [a, b, c] = this.corners(face).sort((x, y) => x - y);
      const key = small ? (a * vertexCount + b) * vertexCount + c : `${a},${b},${c}`;
      const other = open.get(key);
      if (other === undefined) open.set(key, face);
      else {
        this.neighbours[face] = other >> 2;
        this.neighbours[other] = face >> 2;
        open.delete(key);
      }
    }
  }

  /** Vertices of a face: 4 times its tet and the number of the corner it is opposite to. */
  corners(face: number): [number, number, number] {
    const first = face & ~3;
    const [a, b, c] = kFaces[face & 3];
    return [this.tets[first + a], this.tets[first + b], this.tets[first + c]];
  }

  boundary(): Uint32Array {
    return new Uint32Array(this.boundaryFaces().flat());
  }

  boundaryFaces(): [number, number, number][] {
    const faces: [number, number, number][] = [];
    this.neighbours.forEach((behind, face) => behind < 0 && faces.push(this.corners(face)));
    return faces;
  }

  /** One for each vertex of the boundary, zero for the others. */
  boundaryVertices(vertexCount: number): Uint8Array {
    const outer = new Uint8Array(vertexCount);
    this.boundaryFaces().forEach((corners) => corners.forEach((v) => (outer[v] = 1)));
    return outer;
  }

  /** For each tet the number of the piece it belongs to, by common faces, and how many tets each piece has. */
  pieces(): { piece: Int32Array; sizes: number[] } {
    const piece = new Int32Array(this.count).fill(-1);
    const sizes: number[] = [];
    for (let first = 0; first < this.count; ++first) {
      if (piece[first] >= 0) continue;
      const open = [first];
      piece[first] = sizes.length;
      let size = 0;
      for (let tet = open.pop(); tet !== undefined; tet = open.pop()) {
        ++size;
        for (const other of this.neighbours.subarray(4 * tet, 4 * tet + 4)) {
          if (other < 0 || piece[other] >= 0) continue;
          piece[other] = sizes.length;
          open.push(other);
        }
      }
      sizes.push(size);
    }
    return { piece, sizes };
  }

  cornersOf(faces: Uint32Array): Uint32Array {
    const corners = new Uint32Array(3 * faces.length);
    faces.forEach((face, i) => corners.set(this.corners(face), 3 * i));
    return corners;
  }

  /** Faces to be seen, and whether each is one that the cut laid open. */
  visible(stands: (tet: number) => boolean): { faces: Uint32Array; cut: Uint8Array } {
    const here = new Uint8Array(this.count);
    for (let tet = 0; tet < this.count; ++tet) here[tet] = stands(tet) ? 1 : 0;
    const faces: number[] = [];
    const cut: number[] = [];
    for (let face = 0; face < this.tets.length; ++face) {
      if (!here[face >> 2]) continue;
      const behind = this.neighbours[face];
      if (behind >= 0 && here[behind]) continue;
      faces.push(face);
      cut.push(behind >= 0 ? 1 : 0);
    }
    return { faces: new Uint32Array(faces), cut: new Uint8Array(cut) };
  }
}
