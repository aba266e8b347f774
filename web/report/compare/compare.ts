// The report of `grove compare`: what to use, then all figures of each structure on the chosen kind of rays.

import { h } from "../../shared/dom";
import { bytes, bytesTick, count, number } from "../../shared/format";
import { header, part } from "../header";
import { sectionElement } from "../section";
import type { CompareReport } from "../types";
import { breakEvenFigure } from "./break_even";
import { controlBar } from "./controls";
import { heatMapsFigure } from "./heat_maps";
import { stepsHistogram } from "./histogram";
import { rowScatter, type Figure } from "./row_scatter";
import { rowsTable } from "./rows_table";
import { speedChart } from "./speed_chart";
import { advicePart, failuresPart, glancePart, notesPart } from "./summary";
import { View } from "./view";

const memory: Figure = { label: "memory", value: (row) => row.bytes, log: true, text: bytes, tick: bytesTick, more: false };
const speed: Figure = { label: "Mrays/s", value: (row) => row.mrays_per_s?.median, log: false, text: number, more: true };
const nodes: Figure = { label: "nodes a ray", value: (row) => row.nodes_per_ray, log: true, text: number, more: false };
const tests: Figure = { label: "tests a ray", value: (row) => row.tests_per_ray, log: true, text: number, more: false };

export function comparePage(report: CompareReport): HTMLElement {
  const view = new View(report);
  const structures = new Set(report.rows.map((row) => row.structure)).size;
  const histogram = stepsHistogram(view);
  const breakEven = breakEvenFigure(view);
  const kindOfRays = h("b", {});
  const nameKind = () => (kindOfRays.textContent = view.rays);
  nameKind();
  view.onChange(nameKind);
  const parts = [
    part(
      "speed",
      "Speed",
      ["Millions of ", kindOfRays, " rays a second: the median over the rounds, and from the least to the most."],
      speedChart(view).element,
    ),
    part("figures", "All figures", h("span", { class: "screen-only" }, "Sort by any column; it scrolls sideways."), rowsTable(view)),
    part(
      "memory",
      "Memory against speed",
      "Named are the structures that none beats in both.",
      rowScatter(view, "Scatter plot: speed over memory, a mark for each structure.", memory, speed).element,
    ),
    part(
      "work",
      "Where the work goes",
      "Nodes that rays visit and primitives that they test, counted exactly. Fewer of both is to the left and below.",
      rowScatter(view, "Scatter plot: tests a ray over nodes a ray, a mark for each structure.", nodes, tests).element,
    ),
    histogram &&
      part(
        "steps",
        "Steps of single rays",
        "A mean hides the few rays that take long. At first the fastest structure of each family is shown.",
        histogram,
      ),
    breakEven &&
      part(
        "break-even",
        "Time to an image",
        "Cheap builds win while few rays are traced, good ones when many are. Thick lines are the best somewhere; dots are where the best changes.",
        breakEven,
      ),
    report.heat_maps &&
      report.heat_maps.maps.length > 0 &&
      part(
        "heat-maps",
        "Where rays work hard",
        "Steps (nodes + tests) of the ray through each pixel, all structures at one scale.",
        heatMapsFigure(view, report.heat_maps),
      ),
    (report.predictions ?? []).length > 0 &&
      part(
        "predictions",
        "Predicted and measured",
        "What cost models say, against the clock.",
        (report.predictions ?? []).map((section) => h("div", { class: "card padded" }, sectionElement(section))),
      ),
    report.matched_memory &&
      part(
        "matched-memory",
        "At the same memory",
        null,
        h("div", { class: "card padded" }, sectionElement(report.matched_memory, { heading: report.matched_memory.title !== "" })),
      ),
    notesPart(report),
  ].filter((one): one is HTMLElement => one instanceof HTMLElement);
  return h(
    "main",
    { class: "compare" },
    header(
      report,
      "grove compare",
      report.scene,
      [
        `${count(structures)} structures on the same scene and the same rays. Every hit was checked before anything was timed, and structures took turns, round by round.`,
      ],
      [
        ...(report.primitives === undefined ? [] : [["Primitives", count(report.primitives)] as [string, string]]),
        ...(report.ray_count === undefined ? [] : [["Rays of each kind", count(report.ray_count)] as [string, string]]),
        ...(report.rounds === undefined ? [] : [["Rounds", count(report.rounds)] as [string, string]]),
      ],
    ),
    report.complete === false &&
      h("p", { class: "warning", role: "note" }, "The run was interrupted: these are the rows that were finished."),
    advicePart(report),
    glancePart(report),
    failuresPart(report),
    controlBar(
      view,
      parts.map((one) => one.id),
    ),
    parts,
  );
}
