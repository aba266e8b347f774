// The rays of the picture that can be looked at one by one.

import { Vector3 } from "three";
import { ByteReader } from "./bytes";
import type { Payload, Triple } from "./payload";
import type { Space } from "./space";

export interface Ray {
  /** In drawing units; the direction is of unit length, so distances are those along it. */
  origin: Vector3;
  direction: Vector3;
  /** Where it meets the scene, or null. */
  distance: number | null;
}

export class Rays {
  readonly columns: number;
  readonly rows: number;
  readonly rays: Ray[] = [];
  /** Drawing units a unit of recorded distances. */
  readonly scale: number;

  constructor(payload: Payload, space: Space) {
    const { columns, rows, lines, distances } = payload.rays;
    this.columns = columns;
    this.rows = rows;
    this.scale = space.scale;
    const lineReader = new ByteReader(lines);
    const distanceReader = new ByteReader(distances);
    const triple = (): Triple => [lineReader.float(), lineReader.float(), lineReader.float()];
    for (let i = 0; i < columns * rows; ++i) {
      const origin = space.point(triple());
      const direction = new Vector3(...triple()).normalize();
      const distance = distanceReader.float();
      this.rays.push({ origin, direction, distance: Number.isFinite(distance) ? distance * space.scale : null });
    }
  }

  /** The ray whose hit is nearest to a point, or null where none hits. */
  nearestTo(point: Vector3): number | null {
    let nearest: number | null = null;
    let least = Infinity;
    const at = new Vector3();
    this.rays.forEach((ray, i) => {
      if (ray.distance === null) return;
      const distance = at.copy(ray.direction).multiplyScalar(ray.distance).add(ray.origin).distanceToSquared(point);
      if (distance < least) {
        least = distance;
        nearest = i;
      }
    });
    return nearest;
  }
}

/** Where a ray is in a box: from and to which distance, or null where it misses. The box is as in Tree.box. */
export function stretchIn(ray: Ray, box: ArrayLike<number>): { from: number; to: number } | null {
  let from = 0;
  let to = Infinity;
  for (let axis = 0; axis < 3; ++axis) {
    const origin = ray.origin.getComponent(axis);
    const direction = ray.direction.getComponent(axis);
    const a = (box[axis]! - origin) / direction;
    const b = (box[3 + axis]! - origin) / direction;
    // NaN, of a ray that lies in a plane, sets no limit.
    if (Math.min(a, b) > from) from = Math.min(a, b);
    if (Math.max(a, b) < to) to = Math.max(a, b);
  }
  return from <= to ? { from, to } : null;
}
