// Which nodes of a structure are drawn, and as what.

import { colourAt, type LogScale } from "./palette";
import type { Choice } from "./store";
import type { Tree } from "./tree";

/** More at once are neither told apart nor drawn fluently on a phone. */
const mostDrawn = 6000;

export interface Shown {
  /** One entry a box: nodes with several planes have as many. */
  nodes: number[];
  boxes: number[];
  colours: Float32Array;
  /** Nodes of the page in the range of levels, drawn or not. */
  inRange: number;
  drawn: number;
}

export function shownNodes(tree: Tree, choice: Choice, scale: LogScale): Shown {
  const { from, to, metric, drawAs } = choice;
  const asPlanes = drawAs === "planes" && tree.hasPlanes;
  let candidates: number[] = [];
  let inRange = 0;
  for (let i = 0; i < tree.count; ++i) {
    if (tree.depth[i]! < from || tree.depth[i]! > to) continue;
    ++inRange;
    if (!asPlanes || tree.cutAxes[i] !== 0) candidates.push(i);
  }
  if (candidates.length > mostDrawn) {
    const area = tree.metrics.area;
    candidates = candidates.sort((a, b) => area[b]! - area[a]!).slice(0, mostDrawn);
  }
  const nodes: number[] = [];
  const boxes: number[] = [];
  for (const i of candidates) {
    const box = tree.box.subarray(6 * i, 6 * i + 6);
    if (!asPlanes) {
      nodes.push(i);
      boxes.push(...box);
      continue;
    }
    for (let axis = 0; axis < 3; ++axis) {
      if (!((tree.cutAxes[i]! >> axis) & 1)) continue;
      const at = boxes.length;
      nodes.push(i);
      boxes.push(...box);
      const plane = Math.min(Math.max(tree.planes[3 * i + axis]!, box[axis]!), box[3 + axis]!);
      boxes[at + axis] = plane;
      boxes[at + 3 + axis] = plane;
    }
  }
  const colours = new Float32Array(3 * nodes.length);
  const values = tree.metrics[metric];
  nodes.forEach((node, i) => {
    const place = scale.place(values[node]!);
    // What no ray came to is grey.
    const colour = place === null ? [128, 128, 128] : colourAt(place);
    for (let channel = 0; channel < 3; ++channel) colours[3 * i + channel] = colour[channel]! / 255;
  });
  return { nodes, boxes, colours, inRange, drawn: candidates.length };
}

/** What is said of nodes that are not drawn; empty where all are. */
export function shownNote(tree: Tree, shown: Shown, choice: Choice, format: (value: number) => string): string {
  const notes: string[] = [];
  if (choice.drawAs === "planes" && !tree.hasPlanes) notes.push("Boxes: this structure has no planes.");
  if (shown.drawn === mostDrawn) notes.push(`${format(mostDrawn)} of ${format(shown.inRange)} nodes are drawn, the largest.`);
  if (choice.to > tree.completeDepth && tree.count < tree.total)
    notes.push(`Below level ${tree.completeDepth} only nodes that recorded rays come to are in this page.`);
  return notes.join(" ");
}

/** The level to begin with: in each structure the deepest that is there as a whole and has few enough nodes to be told apart, below the first few; between
 * them the mean. */
export function firstLevel(trees: Tree[]): number {
  const goodCount = 160;
  const fewNodes = 8;
  const best = trees.map((tree) => {
    const counts = new Array<number>(tree.maxDepth + 1).fill(0);
    for (let i = 0; i < tree.count; ++i) ++counts[tree.depth[i]!]!;
    let level = 0;
    for (let depth = 0; depth <= tree.completeDepth && counts[depth]! <= goodCount; ++depth) level = depth;
    const next = counts[level + 1] ?? 0;
    return counts[level]! < fewNodes && next > 0 && next <= mostDrawn && level < tree.completeDepth ? level + 1 : level;
  });
  return Math.round(best.reduce((sum, level) => sum + level, 0) / best.length);
}
