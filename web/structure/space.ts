// Coordinates for drawing: the scene in its middle, its longest side 10 units long, whatever its own are. Graphics work in single precision.

import { Vector3 } from "three";
import type { PayloadBox, Triple } from "./payload";

const steps = 65535;

export class Space {
  private readonly centre: Triple;
  /** Drawing units a scene unit. */
  readonly scale: number;

  constructor(bounds: PayloadBox) {
    const { lower, upper } = bounds;
    this.centre = [0, 1, 2].map((axis) => 0.5 * lower[axis]! + 0.5 * upper[axis]!) as Triple;
    const longest = Math.max(...[0, 1, 2].map((axis) => upper[axis]! - lower[axis]!));
    this.scale = longest > 0 ? 10 / longest : 1;
  }

  toDrawing(axis: number, value: number): number {
    return (value - this.centre[axis]!) * this.scale;
  }

  toScene(axis: number, value: number): number {
    return value / this.scale + this.centre[axis]!;
  }

  point(p: Triple): Vector3 {
    return new Vector3(this.toDrawing(0, p[0]), this.toDrawing(1, p[1]), this.toDrawing(2, p[2]));
  }

  /** What a 16-bit step of a box along an axis is in drawing units. */
  stepOf(bounds: PayloadBox): (axis: number, step: number) => number {
    return (axis, step) => {
      const lower = bounds.lower[axis]!;
      return this.toDrawing(axis, lower + ((bounds.upper[axis]! - lower) * step) / steps);
    };
  }
}
