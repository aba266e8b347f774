// One structure: its nodes, as columns of numbers, in depth-first order.

import { ByteReader, readBytes, readVarints } from "./bytes";
import type { PayloadStructure } from "./payload";
import type { Space } from "./space";
import { Traces } from "./traces";

export type Metric = "visits" | "tests" | "area" | "references";

const leafBit = 8;

export class Tree {
  readonly name: string;
  readonly count: number;
  readonly total: number;
  readonly completeDepth: number;
  readonly maxDepth: number;
  readonly sampledRays: number;
  readonly hasTopLevel: boolean;
  readonly objectsShown: boolean;
  readonly figures: Record<string, unknown>;
  readonly parent: Int32Array;
  readonly depth: Uint16Array;
  /** Lower x, y, z and upper x, y, z of each node, in drawing units. */
  readonly box: Float32Array;
  readonly isLeaf: Uint8Array;
  /** Bit a is set where a cell is cut across axis a, at planes[3 * node + a]. */
  readonly cutAxes: Uint8Array;
  readonly planes: Float32Array;
  /** Children that the structure has, and those that are in the page. */
  readonly childCount: Float64Array;
  readonly children: Int32Array[];
  readonly metrics: Record<Metric, Float64Array>;
  readonly traces: Traces;
  /** The steps of each ray of a picture, row by row. */
  readonly picture: { width: number; height: number; steps: Float64Array };
  readonly hasPlanes: boolean;

  constructor(data: PayloadStructure, space: Space, rayCount: number) {
    const { nodes } = data;
    const count = nodes.count;
    this.name = data.structure;
    this.count = count;
    this.total = nodes.total;
    this.completeDepth = nodes.complete_depth;
    this.sampledRays = data.sampled_rays;
    this.hasTopLevel = data.has_top_level;
    this.objectsShown = data.objects_shown;
    this.figures = data.figures;

    const distances = readVarints(nodes.parents, count);
    this.parent = Int32Array.from(distances, (distance, i) => (i === 0 ? -1 : i - distance));
    this.depth = new Uint16Array(count);
    const lists: number[][] = Array.from({ length: count }, () => []);
    for (let i = 1; i < count; ++i) {
      this.depth[i] = this.depth[this.parent[i]!]! + 1;
      lists[this.parent[i]!]!.push(i);
    }
    this.children = lists.map((list) => Int32Array.from(list));
    this.maxDepth = this.depth.reduce((deepest, depth) => Math.max(deepest, depth), 0);

    const toDrawing = space.stepOf(data.bounds);
    const boxes = new ByteReader(nodes.boxes);
    this.box = new Float32Array(6 * count);
    for (let i = 0; i < 6 * count; ++i) this.box[i] = toDrawing(i % 3, boxes.u16());

    const kinds = readBytes(nodes.kinds);
    this.isLeaf = kinds.map((kind) => (kind & leafBit ? 1 : 0));
    this.cutAxes = kinds.map((kind) => kind & 7);
    this.hasPlanes = this.cutAxes.some((axes) => axes !== 0);
    const planes = new ByteReader(nodes.planes);
    this.planes = new Float32Array(3 * count);
    for (let i = 0; i < count; ++i) {
      for (let axis = 0; axis < 3; ++axis) if ((this.cutAxes[i]! >> axis) & 1) this.planes[3 * i + axis] = toDrawing(axis, planes.u16());
    }

    this.childCount = readVarints(nodes.children, count);
    const area = new Float64Array(count);
    for (let i = 0; i < count; ++i) area[i] = this.areaOf(i);
    this.metrics = {
      visits: readVarints(nodes.visits, count),
      tests: readVarints(nodes.tests, count),
      references: readVarints(nodes.references, count),
      area,
    };
    this.traces = new Traces(data.traces, rayCount);
    const { width, height, steps } = data.picture;
    this.picture = { width, height, steps: readVarints(steps, width * height) };
  }

  /** In squared drawing units. */
  private areaOf(i: number): number {
    const [x, y, z] = [0, 1, 2].map((axis) => this.box[6 * i + 3 + axis]! - this.box[6 * i + axis]!) as [number, number, number];
    return 2 * (x * y + y * z + z * x);
  }

  /** The node and all above it, from the root on. */
  pathTo(node: number): number[] {
    const path: number[] = [];
    for (let at = node; at >= 0; at = this.parent[at]!) path.unshift(at);
    return path;
  }

  /** Where an octant of a node is: lower and upper ends in drawing units. */
  octantBox(node: number, octant: number): number[] {
    const box = [...this.box.subarray(6 * node, 6 * node + 6)];
    for (let axis = 0; axis < 3; ++axis) {
      if (!((this.cutAxes[node]! >> axis) & 1)) continue;
      const plane = Math.min(Math.max(this.planes[3 * node + axis]!, box[axis]!), box[3 + axis]!);
      box[((octant >> axis) & 1) === 1 ? axis : 3 + axis] = plane;
    }
    return box;
  }
}
