// What a hurried reader wants: what to use, what `auto` would take, and who is best at what.

import { h, type Child } from "../../shared/dom";
import { bytes, duration, number } from "../../shared/format";
import { part } from "../header";
import type { CompareReport, Row } from "../types";
import { structureName } from "./controls";

export function advicePart(report: CompareReport): HTMLElement | null {
  const advice = report.advice ?? [];
  if (advice.length === 0 && !report.auto) return null;
  return part(
    "advice",
    "What to use",
    null,
    h(
      "div",
      { class: "cards" },
      advice.map(({ use, structure, why }) =>
        h(
          "div",
          { class: "card advice" },
          h("p", { class: "use" }, use),
          h("p", { class: "choice" }, structureName(structure)),
          h("p", {}, why),
        ),
      ),
    ),
    report.auto &&
      h("p", { class: "auto-choice" }, h("code", {}, "auto"), " picks ", structureName(report.auto.structure), `: ${report.auto.reason}`),
  );
}

interface Tile {
  what: string;
  figure: string;
  structure: string;
  note: string;
}

/** Who is fastest, smallest and built first. Brute force, which has no structure, takes no part in the last two. */
export function glancePart(report: CompareReport): HTMLElement | null {
  const tiles = [fastest(report), quickest(report), smallest(report), leastWork(report)].filter((tile): tile is Tile => tile !== null);
  if (tiles.length === 0) return null;
  return part(
    "glance",
    "At a glance",
    null,
    h(
      "div",
      { class: "cards tiles" },
      tiles.map(({ what, figure, structure, note }) =>
        h(
          "div",
          { class: "card tile" },
          h("p", { class: "use" }, what),
          h("p", { class: "figure" }, figure),
          h("p", { class: "choice" }, structureName(structure)),
          h("p", { class: "lead" }, note),
        ),
      ),
    ),
  );
}

function geometricMean(values: number[]): number {
  return Math.exp(values.reduce((sum, value) => sum + Math.log(value), 0) / values.length);
}

/** A figure of each structure over all kinds of rays; of those that have it for all. */
function overKinds(report: CompareReport, figure: (row: Row) => number | null | undefined): Map<string, number> {
  const kinds = new Set(report.rows.map((row) => row.rays)).size;
  const values = new Map<string, number[]>();
  for (const row of report.rows) {
    const value = figure(row);
    if (typeof value === "number" && value > 0) values.set(row.structure, [...(values.get(row.structure) ?? []), value]);
  }
  return new Map([...values].filter(([, all]) => all.length === kinds).map(([structure, all]) => [structure, geometricMean(all)]));
}

function extreme(values: Map<string, number>, sign: 1 | -1): [string, number] | null {
  const entries = [...values].filter(([structure]) => sign > 0 || structure !== "brute").sort((a, b) => sign * (b[1] - a[1]));
  return entries[0] ?? null;
}

function fastest(report: CompareReport): Tile | null {
  const speeds = overKinds(report, (row) => row.mrays_per_s?.median);
  const best = extreme(speeds, 1);
  if (!best) return null;
  const first = report.rows[0]?.structure ?? "";
  const base = speeds.get(first);
  return {
    what: "Fastest to trace",
    figure: `${number(best[1])} Mrays/s`,
    structure: best[0],
    note:
      base && first !== best[0]
        ? `${number(best[1] / base)} times ${first}; geometric mean over the kinds of rays`
        : "geometric mean over the kinds of rays",
  };
}

function runnerUp(values: Map<string, number>, best: string, text: (value: number) => string): string {
  const rest = new Map([...values].filter(([structure]) => structure !== best));
  const next = extreme(rest, -1);
  return next ? `then ${next[0]} with ${text(next[1])}` : "";
}

function quickest(report: CompareReport): Tile | null {
  const values = overKinds(report, (row) => row.build_seconds?.median);
  const best = extreme(values, -1);
  if (!best) return null;
  return { what: "Quickest to build", figure: duration(best[1]), structure: best[0], note: runnerUp(values, best[0], duration) };
}

function smallest(report: CompareReport): Tile | null {
  const values = overKinds(report, (row) => row.bytes);
  const best = extreme(values, -1);
  if (!best) return null;
  const perPrimitive = report.primitives ? `${number(best[1] / report.primitives)} bytes a primitive; ` : "";
  return { what: "Least memory", figure: bytes(best[1]), structure: best[0], note: perPrimitive + runnerUp(values, best[0], bytes) };
}

function leastWork(report: CompareReport): Tile | null {
  const values = overKinds(report, (row) => (row.nodes_per_ray ?? Number.NaN) + (row.tests_per_ray ?? Number.NaN));
  const best = extreme(values, -1);
  if (!best) return null;
  return {
    what: "Fewest steps a ray",
    figure: number(best[1]),
    structure: best[0],
    note: `nodes and tests; ${runnerUp(values, best[0], number)}`,
  };
}

/** Structures that could not be built, or not in time, or gave wrong hits: which, and why. */
export function failuresPart(report: CompareReport): HTMLElement | null {
  const reasons = new Map<string, { structure: string; error: string; kinds: string[] }>();
  for (const row of report.rows) {
    if (!row.error) continue;
    const key = `${row.structure}\n${row.error}`;
    const entry = reasons.get(key) ?? { structure: row.structure, error: row.error, kinds: [] };
    entry.kinds.push(row.rays);
    reasons.set(key, entry);
  }
  if (reasons.size === 0) return null;
  return part(
    "failures",
    "What failed",
    "These structures have no figures for the rays that are named; the others are not touched by it.",
    h(
      "ul",
      { class: "failures" },
      [...reasons.values()].map(({ structure, error, kinds }) =>
        h("li", {}, structureName(structure), h("span", { class: "lead" }, ` (${kinds.join(", ")})`), h("br"), error),
      ),
    ),
  );
}

export function notesPart(report: CompareReport): Child {
  const notes = report.notes ?? [];
  if (notes.length === 0) return null;
  return part(
    "notes",
    "Notes",
    null,
    h(
      "ul",
      {},
      notes.map((note) => h("li", {}, note)),
    ),
  );
}
