// Triangles: the soup as it came, the surface that hangs on the tets, what bodies fall onto.
import {
  BufferAttribute, BufferGeometry, DoubleSide, FrontSide, Group, LineBasicMaterial, LineSegments, Mesh, MeshLambertMaterial, Plane,
  Vector3,
} from 'three';
import { room } from './room';
import type { Clip } from './tet_layer';

/**
 * Smooth normals are means of those around a vertex. Where faces lie back to back or edge-on they cancel each other, or
 * point away from who looks: there the face's own normal is taken, which the picture's derivatives know.
 */
const kSoundNormal = `
#ifdef FLAT_SHADED
  #include <normal_fragment_begin>
#else
  vec3 faceNormal = normalize(cross(dFdx(vViewPosition), dFdy(vViewPosition)));
  vec3 normal = dot(vNormal, faceNormal) < 0.0 ? -vNormal : vNormal;
  float size = length(normal);
  normal = size > 0.1 && dot(normal, faceNormal) > 0.25 * size ? normal / size : faceNormal;
  vec3 nonPerturbedNormal = normal;
#endif`;

function sound(material: MeshLambertMaterial): MeshLambertMaterial {
  material.onBeforeCompile = (shader) => {
    shader.fragmentShader = shader.fragmentShader.replace('#include <normal_fragment_begin>', kSoundNormal);
  };
  return material;
}

export class SurfaceLayer extends Group {
  readonly material = sound(new MeshLambertMaterial({ side: DoubleSide, flatShading: true, polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1 }));
  private readonly edgeMaterial = new LineBasicMaterial({ transparent: true, opacity: 0.35 });
  readonly mesh = new Mesh(new BufferGeometry(), this.material);
  private wires: LineSegments | null = null;
  private wired = false;
  /** More edges than these are not drawn. */
  mostEdges = Infinity;

  constructor() {
    super();
    this.add(this.mesh);
  }

  set(vertices: Float32Array, triangles: Uint32Array): void {
    this.release();
    this.mesh.geometry = new BufferGeometry();
    this.mesh.geometry.setAttribute('position', new BufferAttribute(vertices, 3));
    // Files may hold any index; those that point nowhere are not drawn.
    const count = vertices.length / 3;
    const sound = triangles.every((v) => v < count) ? triangles : kept(triangles, count);
    this.mesh.geometry.setIndex(new BufferAttribute(sound, 1));
    this.setLook(this.wired);
  }

  /** The same triangles elsewhere, smooth where there are normals. */
  move(vertices: Float32Array, normals: Float32Array): void {
    const { geometry } = this.mesh;
    room(geometry, 'position', vertices.length).set(vertices);
    if (normals.length) room(geometry, 'normal', normals.length).set(normals);
    const flat = normals.length === 0;
    if (this.material.flatShading !== flat) {
      this.material.flatShading = flat;
      this.material.needsUpdate = true;
    }
    // Where it is now would have to be found anew for every picture.
    this.mesh.frustumCulled = false;
  }

  /** Of triangles that all face outwards, the backs are never seen. */
  setOutward(outward: boolean): void {
    this.material.side = outward ? FrontSide : DoubleSide;
    this.material.needsUpdate = true;
  }

  /** Gives back what it has on the GPU. */
  release(): void {
    this.mesh.geometry.dispose();
    this.wires?.geometry.dispose();
    this.wires?.removeFromParent();
    this.wires = null;
  }

  setColors(face: string, edge: string, opacity = 1): void {
    this.material.color.set(face);
    this.edgeMaterial.color.set(edge);
    this.material.opacity = opacity;
    this.material.transparent = opacity < 1;
    this.material.depthWrite = opacity === 1;
  }

  /** Whether its edges are few enough to be drawn: two triangles have three, where they are not loose. */
  get drawsEdges(): boolean {
    return (this.mesh.geometry.index?.count ?? 0) / 2 <= this.mostEdges;
  }

  setLook(wanted: boolean): void {
    this.wired = wanted;
    const edges = wanted && this.drawsEdges;
    if (edges && !this.wires && this.mesh.geometry.index) {
      const lines = new BufferGeometry();
      lines.setAttribute('position', this.mesh.geometry.getAttribute('position'));
      lines.setIndex(new BufferAttribute(edgesOf(this.mesh.geometry.index.array as Uint32Array, lines.getAttribute('position').count), 1));
      this.wires = new LineSegments(lines, this.edgeMaterial);
      this.add(this.wires);
    }
    if (this.wires) this.wires.visible = edges;
  }

  /** The plane of `clip` in this layer's own coordinates. */
  setClip(clip: Clip | null): void {
    const planes: Plane[] = [];
    if (clip) {
      const normal = new Vector3().setComponent(clip.axis, -clip.sign);
      this.updateWorldMatrix(true, false);
      planes.push(new Plane(normal, clip.sign * clip.at).applyMatrix4(this.matrixWorld));
    }
    this.material.clippingPlanes = this.edgeMaterial.clippingPlanes = planes;
  }
}

/** Ends of the edges of triangles, each edge once: those of each vertex to later ones are gathered, then told apart. */
function edgesOf(triangles: Uint32Array, vertexCount: number): Uint32Array {
  const first = new Uint32Array(vertexCount + 2);
  const eachEdge = (take: (low: number, high: number) => void) => {
    for (let i = 0; i < triangles.length; i += 3) {
      const [a, b, c] = [triangles[i], triangles[i + 1], triangles[i + 2]];
      if (a !== b) take(Math.min(a, b), Math.max(a, b));
      if (b !== c) take(Math.min(b, c), Math.max(b, c));
      if (c !== a) take(Math.min(c, a), Math.max(c, a));
    }
  };
  eachEdge((low) => ++first[low + 2]);
  for (let v = 2; v < first.length; ++v) first[v] += first[v - 1];
  const others = new Uint32Array(triangles.length);
  eachEdge((low, high) => (others[first[low + 1]++] = high));
  const ends = new Uint32Array(2 * triangles.length);
  let count = 0;
  for (let v = 0; v < vertexCount; ++v) {
    // There are few of them, so that looking at all that were taken is the fastest.
    const begin = count;
    for (let i = first[v]; i < first[v + 1]; ++i) {
      let at = begin + 1;
      while (at < count && ends[at] !== others[i]) at += 2;
      if (at < count) continue;
      ends[count++] = v;
      ends[count++] = others[i];
    }
  }
  return ends.slice(0, count);
}

function kept(triangles: Uint32Array, count: number): Uint32Array {
  const out: number[] = [];
  for (let i = 0; i < triangles.length; i += 3) {
    const three = triangles.subarray(i, i + 3);
    if (three.every((v) => v < count)) out.push(...three);
  }
  return new Uint32Array(out);
}
