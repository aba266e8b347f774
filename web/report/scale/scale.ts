// The report of `grove compare --scale`: how building, memory and the work of rays grow with the number of primitives.

import { chart } from "../../shared/charts";
import { h } from "../../shared/dom";
import { axis, legend, tooltip } from "../../shared/axes";
import { bytes, bytesTick, compact, count, duration, missing, number, secondsTick } from "../../shared/format";
import { sortableTable, type Column } from "../../shared/table";
import { familyOf, type Theme } from "../../shared/theme";
import { structureName } from "../compare/controls";
import { header, part } from "../header";
import { sectionElement } from "../section";
import type { Fit, ScaleReport, ScaleRow } from "../types";
import type { EChartsOption, SeriesOption } from "echarts";

interface Figure {
  id: string;
  title: string;
  lead: string;
  label: string;
  value: (row: ScaleRow) => number | null | undefined;
  text: (value: number | null | undefined) => string;
  tick: (value: number) => string;
  log: boolean;
}

const figures: Figure[] = [
  {
    id: "build",
    title: "Build time",
    lead: "Wall clock, all threads. A slope of one is time in proportion to the primitives.",
    label: "time to build",
    value: (row) => row.build_seconds,
    text: duration,
    tick: secondsTick,
    log: true,
  },
  {
    id: "memory",
    title: "Memory",
    lead: "Of the structure, without the geometry.",
    label: "memory",
    value: (row) => row.bytes,
    text: bytes,
    tick: bytesTick,
    log: true,
  },
  {
    id: "steps",
    title: "Steps a ray",
    lead: "Nodes that a ray visits and primitives that it tests, on average; exact.",
    label: "steps a ray (nodes + tests)",
    value: (row) => row.steps_per_ray ?? sum(row.nodes_per_ray, row.tests_per_ray),
    text: number,
    tick: compact,
    log: true,
  },
  {
    id: "speed",
    title: "Speed",
    lead: "What the clock says: steps cost more once the structure outgrows the caches.",
    label: "Mrays/s",
    value: (row) => (typeof row.mrays_per_s === "object" ? row.mrays_per_s?.median : row.mrays_per_s),
    text: number,
    tick: compact,
    log: true,
  },
];

function sum(a: number | null | undefined, b: number | null | undefined): number | null {
  return typeof a === "number" && typeof b === "number" ? a + b : null;
}

export function scalePage(report: ScaleReport): HTMLElement {
  const structures = [...new Set(report.rows.map((row) => row.structure))];
  const sizes = report.sizes ?? [...new Set(report.rows.map((row) => row.primitives))].sort((a, b) => a - b);
  const failed = report.rows.filter((row) => row.error);
  const first = sizes[0];
  const last = sizes.at(-1);
  return h(
    "main",
    { class: "scale" },
    header(
      report,
      "grove compare --scale",
      report.scene,
      [`${count(structures.length)} structures on one generated scene, from ${compact(first ?? 0)} to ${compact(last ?? 0)} primitives.`],
      [
        ["Sizes", sizes.map(compact).join(", ")],
        ...(report.rays ? [["Rays", `${report.ray_count ? `${count(report.ray_count)} ` : ""}${report.rays}`] as [string, string]] : []),
      ],
    ),
    report.complete === false &&
      h("p", { class: "warning", role: "note" }, "The run was interrupted: these are the sizes that were finished."),
    (report.fits ?? []).length > 0 &&
      part(
        "fits",
        "How fast it grows",
        "Exponents of the power laws that fit best: a figure grows as the number of primitives to this power. R² of 1 is a perfect fit.",
        fitsTable(report.fits ?? []),
      ),
    figures
      .filter((figure) => report.rows.some((row) => typeof figure.value(row) === "number"))
      .map((figure) => part(figure.id, figure.title, figure.lead, figureChart(report, structures, figure))),
    // Sections of a plot alone repeat what is drawn above.
    (report.sections ?? [])
      .filter((section) => section.table ?? section.text)
      .map((section, index) =>
        part(`section-${index + 1}`, section.title, null, h("div", { class: "card padded" }, sectionElement(section, { heading: false }))),
      ),
    part("figures", "All figures", "Sort by any column.", rowsTable(report.rows)),
    failed.length > 0 &&
      part(
        "failures",
        "What failed",
        null,
        h(
          "ul",
          { class: "failures" },
          failed.map((row) => h("li", {}, structureName(row.structure), ` with ${count(row.primitives)} primitives: ${row.error}`)),
        ),
      ),
    (report.notes ?? []).length > 0 &&
      part(
        "notes",
        "Notes",
        null,
        h(
          "ul",
          {},
          (report.notes ?? []).map((note) => h("li", {}, note)),
        ),
      ),
  );
}

function figureChart(report: ScaleReport, structures: string[], figure: Figure): HTMLElement {
  const height = (width: number) => 360 + (width < 480 ? 60 : 0);
  const label = `Line chart, both axes logarithmic: ${figure.label} over the number of primitives, a line for each structure.`;
  return chart(label, height, (theme, width) => optionOf(report, structures, figure, theme, width)).element;
}

const symbols = ["circle", "rect", "triangle", "diamond"];
const dashes = ["solid", "dashed", "dotted"] as const;

function optionOf(report: ScaleReport, structures: string[], figure: Figure, theme: Theme, width: number): EChartsOption {
  const points = (structure: string) =>
    report.rows
      .filter((row) => row.structure === structure && (figure.value(row) ?? 0) > 0)
      .map((row) => [row.primitives, figure.value(row) ?? 0] as [number, number])
      .sort((a, b) => a[0] - b[0]);
  const key = legend(theme, structures, width);
  const inFamily = new Map<string, number>();
  const series = structures.map((structure): SeriesOption => {
    const family = familyOf(structure);
    const before = inFamily.get(family) ?? 0;
    inFamily.set(family, before + 1);
    return {
      type: "line",
      name: structure,
      color: theme.families[family] ?? theme.text,
      data: points(structure),
      symbol: symbols[before % symbols.length] ?? "circle",
      symbolSize: 7,
      lineStyle: { width: 2, type: dashes[before % dashes.length] ?? "solid" },
      emphasis: { focus: "series" },
    };
  });
  const all = structures.flatMap(points);
  return {
    legend: key.option,
    grid: { top: key.height + 28, left: 4, right: 22, bottom: 28, containLabel: true },
    xAxis: axis(theme, { label: "primitives", log: true, values: all.map(([x]) => x) }),
    yAxis: axis(theme, { label: figure.label, log: figure.log, values: all.map(([, y]) => y), vertical: true, format: figure.tick }),
    tooltip: tooltip(theme, {
      trigger: "axis",
      formatter: (items: { marker: string; seriesName: string; value: [number, number] }[]) => {
        const sorted = [...items].sort((a, b) => b.value[1] - a.value[1]);
        const head = `<b>${count(items[0]?.value[0])} primitives</b>`;
        return [head, ...sorted.map((item) => `${item.marker}${item.seriesName} <b>${figure.text(item.value[1])}</b>`)].join("<br>");
      },
    }),
    series,
  } as EChartsOption;
}

type FitRow = NonNullable<ScaleReport["fits"]>[number];

/** A factor of zero stands for figures that no law can be fitted to. */
function isFitted(fit: Fit | null | undefined): boolean {
  return fit !== null && fit !== undefined && fit.factor !== 0;
}

function fitsTable(fits: FitRow[]): HTMLElement {
  const exponent = (title: string, fit: (row: FitRow) => Fit | null | undefined): Column<FitRow>[] => [
    {
      title,
      hint: `Exponent of ${title.toLowerCase()} over the number of primitives`,
      numeric: true,
      ascending: true,
      value: (row) => (isFitted(fit(row)) ? (fit(row)?.exponent ?? null) : null),
      cell: (row) => (isFitted(fit(row)) ? h("b", {}, "n", h("sup", {}, (fit(row)?.exponent ?? 0).toFixed(2))) : missing),
    },
    {
      title: "R²",
      numeric: true,
      value: (row) => (isFitted(fit(row)) ? (fit(row)?.r_squared ?? null) : null),
      cell: (row) => (isFitted(fit(row)) ? number(fit(row)?.r_squared) : missing),
    },
  ];
  return sortableTable<FitRow>(
    [
      { title: "Structure", ascending: true, value: (row) => row.structure, cell: (row) => structureName(row.structure) },
      ...exponent("Build", (row) => row.build),
      ...exponent("Memory", (row) => row.memory),
      ...exponent("Steps", (row) => row.steps),
    ],
    fits,
    { caption: "Exponents of growth by structure" },
  ).element;
}

function rowsTable(rows: ScaleRow[]): HTMLElement {
  const columns: Column<ScaleRow>[] = [
    { title: "Structure", ascending: true, value: (row) => row.structure, cell: (row) => structureName(row.structure) },
    { title: "Primitives", numeric: true, ascending: true, value: (row) => row.primitives, cell: (row) => count(row.primitives) },
    ...figures.map((figure): Column<ScaleRow> => ({
      title: figure.title,
      numeric: true,
      ascending: true,
      value: (row) => figure.value(row) ?? null,
      cell: (row) => figure.text(figure.value(row)),
    })),
  ];
  const table = sortableTable(columns, rows, { caption: "Figures by structure and size" });
  table.element.classList.add("tall");
  return table.element;
}
