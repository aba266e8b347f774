// How many rays take how many steps: what the means hide.

import type { EChartsOption, SeriesOption } from "echarts";
import { axis, legend, tooltip } from "../../shared/axes";
import { chart } from "../../shared/charts";
import { h } from "../../shared/dom";
import { count } from "../../shared/format";
import { familyOf, type Theme } from "../../shared/theme";
import type { Row } from "../types";
import { picker } from "./controls";
import { bestOfFamilies, type View } from "./view";

const dashes = ["solid", "dashed", "dotted"] as const;

/** The chart with boxes to choose structures by, or nothing where no row has a histogram. */
export function stepsHistogram(view: View): HTMLElement | null {
  const structures = [...new Set(view.report.rows.filter((row) => row.steps_histogram).map((row) => row.structure))];
  if (structures.length === 0) return null;
  let chosen = bestOfFamilies(view.rows()).filter((structure) => structure !== "brute" || structures.length < 4);
  const rows = () => view.rows().filter((row) => row.steps_histogram && chosen.includes(row.structure));
  const made = chart("Line chart: share of the rays by the steps that they take, a line for each structure.", 360, (theme, width) =>
    optionOf(rows(), theme, width),
  );
  view.onChange(made.update);
  return h(
    "div",
    {},
    made.element,
    picker(structures, chosen, (next) => {
      chosen = next;
      made.update();
    }),
  );
}

function optionOf(rows: Row[], theme: Theme, width: number): EChartsOption {
  const bins = [...new Set(rows.flatMap((row) => (row.steps_histogram ?? []).map(([from]) => from)))].sort((a, b) => a - b);
  const names = rows.map((row) => row.structure);
  const key = legend(theme, names, width);
  const seen = new Map<string, number>();
  const series = rows.map((row): SeriesOption => {
    const histogram = new Map(row.steps_histogram ?? []);
    const rays = [...histogram.values()].reduce((sum, value) => sum + value, 0);
    const family = familyOf(row.structure);
    const before = seen.get(family) ?? 0;
    seen.set(family, before + 1);
    return {
      type: "line",
      name: row.structure,
      color: theme.families[family] ?? theme.text,
      data: bins.map((from) => (100 * (histogram.get(from) ?? 0)) / Math.max(1, rays)),
      symbol: "none",
      step: "middle",
      lineStyle: { width: 2, type: dashes[before % dashes.length] ?? "solid" },
      areaStyle: { opacity: 0.07 },
      emphasis: { focus: "series" },
    };
  });
  const last = (index: number) => (bins[index + 1] ?? 0) - 1;
  const binName = (index: number) => {
    const from = bins[index] ?? 0;
    if (index + 1 >= bins.length) return `${count(from)} and more`;
    return last(index) > from ? `${count(from)}–${count(last(index))}` : count(from);
  };
  return {
    legend: key.option,
    grid: { top: key.height + 26, left: 4, right: 18, bottom: 28, containLabel: true },
    xAxis: {
      ...axis(theme, { label: "steps of a ray (nodes + tests), from", categories: bins.map(count) }),
      boundaryGap: false,
      axisLabel: { color: theme.muted, fontSize: 11, hideOverlap: true },
    },
    yAxis: axis(theme, { label: "% of the rays", fromZero: true, vertical: true }),
    tooltip: tooltip(theme, {
      trigger: "axis",
      formatter: (items: { dataIndex: number; marker: string; seriesName: string; value: number }[]) =>
        [
          `<b>${binName(items[0]?.dataIndex ?? 0)} steps</b>`,
          ...items.map((item) => `${item.marker}${item.seriesName} <b>${item.value.toPrecision(3)} %</b>`),
        ].join("<br>"),
    }),
    series,
  } as EChartsOption;
}
