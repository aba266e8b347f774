// What the reader has chosen to see; charts and tables of the page follow it.

import { familyOf } from "../../shared/theme";
import type { CompareReport, Row } from "../types";

/** Families as the page orders them. */
const familyOrder = ["brute", "octree", "kdtree", "bvh", "fast", "auto"];

export class View {
  readonly kinds: string[];
  readonly families: string[];
  private kind: string;
  private readonly hidden = new Set<string>();
  private readonly listeners: (() => void)[] = [];

  constructor(readonly report: CompareReport) {
    this.kinds = [...new Set(report.rows.map((row) => row.rays))];
    this.kind = this.kinds[0] ?? "";
    const rank = (family: string) => (familyOrder.indexOf(family) + familyOrder.length + 1) % (familyOrder.length + 1);
    this.families = [...new Set(report.rows.map((row) => familyOf(row.structure)))].sort((a, b) => rank(a) - rank(b));
  }

  /** The kind of rays that figures are of. */
  get rays(): string {
    return this.kind;
  }

  set rays(kind: string) {
    this.kind = kind;
    this.changed();
  }

  shows(structure: string): boolean {
    return !this.hidden.has(familyOf(structure));
  }

  showsFamily(family: string): boolean {
    return !this.hidden.has(family);
  }

  toggleFamily(family: string): void {
    if (!this.hidden.delete(family)) this.hidden.add(family);
    this.changed();
  }

  /** Rows of the chosen kind of rays and families, failed ones too. */
  rows(): Row[] {
    return this.report.rows.filter((row) => row.rays === this.kind && this.shows(row.structure));
  }

  onChange(listener: () => void): void {
    this.listeners.push(listener);
  }

  private changed(): void {
    for (const listener of this.listeners) listener();
  }
}

/** The rows that have a speed, fastest first. */
export function bySpeed(rows: Row[]): Row[] {
  return rows.filter((row) => row.mrays_per_s).sort((a, b) => (b.mrays_per_s?.median ?? 0) - (a.mrays_per_s?.median ?? 0));
}

/** The fastest structure of each family. */
export function bestOfFamilies(rows: Row[]): string[] {
  const best = new Map<string, string>();
  for (const row of bySpeed(rows)) {
    const family = familyOf(row.structure);
    if (!best.has(family)) best.set(family, row.structure);
  }
  return [...best.values()];
}
