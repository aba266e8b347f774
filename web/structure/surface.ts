// The triangles of the scene, and the primitives that rays were tested against.

import { BufferAttribute, BufferGeometry } from "three";
import { ByteReader, readBytes, readVarints } from "./bytes";
import type { Payload } from "./payload";
import type { Space } from "./space";

/** Shared by all pictures of the scene. */
export function surfaceOf(payload: Payload, space: Space): BufferGeometry {
  const toDrawing = space.stepOf(payload.bounds);
  const vertices = new ByteReader(payload.triangles.vertices);
  const positions = new Float32Array(vertices.length / 2);
  for (let i = 0; i < positions.length; ++i) positions[i] = toDrawing(i % 3, vertices.u16());
  const indices = new ByteReader(payload.triangles.indices);
  const corners = new Uint32Array(3 * payload.triangles.shown);
  let last = 0;
  for (let i = 0; i < corners.length; ++i) {
    last += indices.signed();
    corners[i] = last;
  }
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(positions, 3));
  geometry.setIndex(new BufferAttribute(corners, 1));
  geometry.computeBoundingSphere();
  return geometry;
}

/** What is said of how the triangles are drawn. */
export function surfaceNote(payload: Payload, format: (value: number) => string): string {
  const { total, shown, grid, one_in } = payload.triangles;
  if (grid === 0 && one_in === 1) return "";
  const thinned = one_in > 1 ? ` One in ${format(one_in)} was looked at.` : "";
  return (
    `Of the scene's ${format(total)} triangles ${format(shown)} are drawn: vertices that share a cell of a grid, ${format(grid)} cells ` +
    `along the longest side, are joined.${thinned} Structures, counts and rays are those of all triangles.`
  );
}

export type PrimitiveKind = "triangle" | "sphere" | "instance";

const primitiveKinds: PrimitiveKind[] = ["triangle", "sphere", "instance"];

/** The primitives that recorded rays were tested against. */
export class TestedPrimitives {
  private readonly kinds: Uint8Array;
  private readonly ids: Float64Array;
  private readonly instances: Float64Array;
  private readonly shapes: Float32Array;
  private readonly firsts: Uint32Array;

  constructor(payload: Payload, space: Space) {
    const { count, kinds, ids, instances, shapes } = payload.tested;
    this.kinds = readBytes(kinds);
    this.instances = readVarints(instances, count);
    this.ids = new Float64Array(count);
    this.firsts = new Uint32Array(count + 1);
    const idReader = new ByteReader(ids);
    let last = 0;
    for (let i = 0; i < count; ++i) {
      last += idReader.signed();
      this.ids[i] = last;
      this.firsts[i + 1] = this.firsts[i]! + (this.kind(i) === "triangle" ? 9 : 6);
    }
    const toDrawing = space.stepOf(payload.bounds);
    const shapeReader = new ByteReader(shapes);
    this.shapes = new Float32Array(this.firsts[count]!);
    // Points are three numbers each, whatever they belong to.
    for (let i = 0; i < this.shapes.length; ++i) this.shapes[i] = toDrawing(i % 3, shapeReader.u16());
  }

  kind(tested: number): PrimitiveKind {
    return primitiveKinds[this.kinds[tested] ?? 0]!;
  }

  /** The primitive in words. */
  name(tested: number, format: (value: number) => string): string {
    const instance = this.instances[tested] ?? 0;
    const place = instance > 0 ? ` of instance ${format(instance - 1)}` : "";
    return `${this.kind(tested)} ${format(this.ids[tested] ?? 0)}${place}`;
  }

  /** Three corners of a triangle; of others the lower and upper ends of a box. */
  shape(tested: number): Float32Array {
    return this.shapes.subarray(this.firsts[tested]!, this.firsts[tested + 1]!);
  }
}
