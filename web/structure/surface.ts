// The triangles of the scene, and the primitives that rays were tested against.

import { BufferAttribute, BufferGeometry } from "three";
import { ByteReader } from "./bytes";
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

/** The primitives that recorded rays were tested against. */
export class TestedPrimitives {
  readonly kind: "triangle" | "sphere" | "instance";
  private readonly ids: Float64Array;
  private readonly shapes: Float32Array;
  private readonly numbers: number;

  constructor(payload: Payload, space: Space) {
    const { kind, count, ids, shapes } = payload.tested;
    this.kind = kind;
    this.numbers = kind === "triangle" ? 9 : 6;
    this.ids = new Float64Array(count);
    const idReader = new ByteReader(ids);
    let last = 0;
    for (let i = 0; i < count; ++i) {
      last += idReader.signed();
      this.ids[i] = last;
    }
    const toDrawing = space.stepOf(payload.bounds);
    const shapeReader = new ByteReader(shapes);
    this.shapes = new Float32Array(this.numbers * count);
    for (let i = 0; i < this.shapes.length; ++i) this.shapes[i] = toDrawing(i % 3, shapeReader.u16());
  }

  id(tested: number): number {
    return this.ids[tested] ?? 0;
  }

  /** Three corners of a triangle; of others the lower and upper ends of a box. */
  shape(tested: number): Float32Array {
    return this.shapes.subarray(this.numbers * tested, this.numbers * (tested + 1));
  }
}
