// One scale of colours for numbers that span orders of magnitude, the same in all structures.

/** Viridis (van der Walt and Smith 2015) at nine places: it grows in lightness, so it reads without colour too. */
const stops: [number, number, number][] = [
  [68, 1, 84], [71, 44, 122], [59, 81, 139], [44, 113, 142], [33, 144, 141], [39, 173, 129], [92, 200, 99], [170, 220, 50], [253, 231, 37],
];

/** Red, green and blue from 0 to 255 at a place from 0 to 1. */
export function colourAt(place: number): [number, number, number] {
  const at = Math.min(Math.max(place, 0), 1) * (stops.length - 1);
  const i = Math.min(Math.floor(at), stops.length - 2);
  const from = stops[i]!;
  const to = stops[i + 1]!;
  return [0, 1, 2].map((channel) => from[channel]! + (to[channel]! - from[channel]!) * (at - i)) as [number, number, number];
}

export function cssColour(place: number): string {
  return `rgb(${colourAt(place).map(Math.round).join(" ")})`;
}

export const gradient = `linear-gradient(to right, ${stops.map((stop) => `rgb(${stop.join(" ")})`).join(", ")})`;

/** A logarithmic scale from the least positive value to the greatest; zero is below it. */
export class LogScale {
  readonly min: number;
  readonly max: number;

  constructor(columns: Iterable<ArrayLike<number>>) {
    let min = Infinity;
    let max = 0;
    for (const column of columns) {
      for (let i = 0; i < column.length; ++i) {
        const value = column[i]!;
        if (value > 0 && value < min) min = value;
        if (value > max) max = value;
      }
    }
    this.max = max;
    this.min = Math.min(min, max);
  }

  /** From 0 to 1; null for zero and below. */
  place(value: number): number | null {
    if (!(value > 0)) return null;
    return this.max > this.min ? Math.log(value / this.min) / Math.log(this.max / this.min) : 1;
  }
}
