// Room for numbers on the GPU that change often: made once, then only filled again.
import { BufferAttribute, type BufferGeometry, DynamicDrawUsage } from 'three';

/**
 * The numbers of a geometry's attribute, three to a vertex, to be written anew before the next picture. As long as
 * their count stays, so does their place on the GPU.
 */
export function room(geometry: BufferGeometry, name: string, length: number): Float32Array {
  let attribute = geometry.getAttribute(name) as BufferAttribute | undefined;
  if (attribute?.array.length !== length) {
    // What an attribute has on the GPU is given back only with its geometry; the other attributes return by themselves.
    geometry.dispose();
    attribute = new BufferAttribute(new Float32Array(length), 3);
    geometry.setAttribute(name, attribute);
  }
  attribute.setUsage(DynamicDrawUsage).needsUpdate = true;
  return attribute.array as Float32Array;
}

/** Other corners for the same vertices. */
export function setCorners(geometry: BufferGeometry, corners: Uint32Array): void {
  geometry.dispose();
  geometry.setIndex(new BufferAttribute(corners, 1));
}
