// What the reader has chosen, and who is told when it changes.

import type { Metric } from "./tree";

export interface Choice {
  /** Levels whose nodes are drawn, both included. */
  from: number;
  to: number;
  metric: Metric;
  drawAs: "boxes" | "planes";
  nodeOpacity: number;
  sceneOpacity: number;
  /** What a click into a picture of the structure picks. */
  picks: "node" | "ray";
  selected: { tree: number; node: number } | null;
  ray: number | null;
  /** How many of the ray's steps have been taken: 0 is before the first. */
  step: number;
  /** The structure that the treemap shows. */
  mapped: number;
}

type Listener = (changed: ReadonlySet<keyof Choice>) => void;

export class Store {
  private readonly listeners: Listener[] = [];

  constructor(readonly choice: Choice) {}

  set(change: Partial<Choice>): void {
    const changed = new Set<keyof Choice>();
    for (const key of Object.keys(change) as (keyof Choice)[]) if (change[key] !== this.choice[key]) changed.add(key);
    if (changed.size === 0) return;
    Object.assign(this.choice, change);
    for (const listener of this.listeners) listener(changed);
  }

  onChange(listener: Listener): void {
    this.listeners.push(listener);
  }
}

/** Whether any of some keys has changed. */
export function touches(changed: ReadonlySet<keyof Choice>, ...keys: (keyof Choice)[]): boolean {
  return keys.some((key) => changed.has(key));
}
