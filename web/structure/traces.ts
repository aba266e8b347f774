// What each recorded ray did in a structure.

import { ByteReader, unzigzag } from "./bytes";

export type StepKind = "node" | "cell" | "gap" | "leaf" | "test";

export interface Step {
  kind: StepKind;
  /** Of a gap the node that it is an octant of; of a test the leaf that the ray is in, or -1. */
  node: number;
  /** Of a gap. */
  octant: number;
  /** Of a test: the number of the primitive among the tested ones. */
  tested: number;
  /** Of a test that found the closest hit yet: its distance. */
  hit: number | null;
}

export interface Trace {
  steps: Step[];
  /** There were more than the page keeps. */
  isCut: boolean;
}

const kinds: StepKind[] = ["node", "cell", "gap", "leaf", "test", "test"];
const closestYet = 5;

export class Traces {
  private readonly reader: ByteReader;
  private readonly offsets: number[] = [];

  constructor(base64: string, rayCount: number) {
    this.reader = new ByteReader(base64);
    for (let ray = 0; ray < rayCount; ++ray) {
      this.offsets.push(this.reader.at);
      this.read(null);
    }
  }

  /** The steps of a ray, in order. */
  trace(ray: number): Trace {
    this.reader.at = this.offsets[ray] ?? 0;
    const steps: Step[] = [];
    return { steps, isCut: this.read(steps) };
  }

  private read(steps: Step[] | null): boolean {
    const { reader } = this;
    const count = reader.varint();
    const isCut = reader.byte() !== 0;
    let node = 0;
    let tested = 0;
    let leaf = -1;
    for (let i = 0; i < count; ++i) {
      const word = reader.varint();
      const code = word % 8;
      const distance = unzigzag(Math.floor(word / 8));
      const kind = kinds[code]!;
      let octant = 0;
      let hit: number | null = null;
      if (kind === "test") {
        tested += distance;
        if (code === closestYet) hit = reader.float();
      } else {
        node += distance;
        if (kind === "gap") octant = reader.byte();
        leaf = kind === "leaf" ? node : -1;
      }
      steps?.push({ kind, node: kind === "test" ? leaf : node, octant, tested, hit });
    }
    return isCut;
  }
}
