// A plot of a section as a chart.

import type { EChartsOption, SeriesOption } from "echarts";
import { axis, legend, plain, tooltip } from "../shared/axes";
import { chart, type Chart } from "../shared/charts";
import { number } from "../shared/format";
import { barCategoryGap, barGap, barMaxWidth, spreadSeries, type SpreadPoint } from "../shared/spread";
import { familyOf, type Theme } from "../shared/theme";
import type { Plot, Point, Series } from "./types";

const symbols = ["circle", "rect", "triangle", "diamond"];
const dashes = ["solid", "dashed", "dotted"] as const;

/** Figures that say how two things compare: one is where they are equal. */
function isRatio(label: string): boolean {
  return /against|ratio|speed-up|times as/.test(label);
}

function isPredictedAgainstMeasured(plot: Plot): boolean {
  return (
    (/predicted|foretold/.test(plot.x.label) && /measured/.test(plot.y.label)) ||
    (/expected tests/.test(plot.x.label) && /counted tests/.test(plot.y.label)) ||
    (/ratio of areas/.test(plot.x.label) && /share/.test(plot.y.label))
  );
}

/** The colours of the families where each series is of another, else those of the page in turn. */
export function seriesColors(theme: Theme, names: string[]): string[] {
  const families = names.map(familyOf);
  const known = families.every((family) => theme.families[family]) && new Set(families).size === families.length;
  return names.map((_, index) =>
    known ? (theme.families[families[index] ?? ""] ?? theme.text) : (theme.series[index % theme.series.length] ?? theme.text),
  );
}

function usable(points: Point[], plot: Plot): Point[] {
  return points.filter(([x, y]) => y !== null && (!plot.y.log || y > 0) && (!plot.x.log || plot.x.categories || x > 0));
}

function spreads(points: Point[], log: boolean | undefined): SpreadPoint[] {
  return points.flatMap(([x, , min, max]): SpreadPoint[] =>
    typeof min === "number" && typeof max === "number" && (!log || min > 0) ? [[x, min, max]] : [],
  );
}

/** Bars lie down where names would not fit below them. */
function liesDown(plot: Plot, width: number): boolean {
  const categories = plot.x.categories ?? [];
  const longest = Math.max(0, ...categories.map((name) => Math.max(...name.split(/[ :,]/).map((word) => word.length))));
  return plot.kind === "bar" && (longest * 6.5 + 12 > width / Math.max(1, categories.length) || width < 480);
}

export function plotChart(plot: Plot, title: string): Chart {
  const kind = { line: "Line chart", scatter: "Scatter plot", bar: "Bar chart" }[plot.kind];
  const over = plot.x.label ? ` over ${plot.x.label}` : "";
  const names = plot.series.map((one) => one.name).join(", ");
  const height = (width: number) => {
    const top = legendOf(plot, width);
    if (!liesDown(plot, width)) return 310 + top;
    return 60 + top + (plot.x.categories?.length ?? 1) * (14 + plot.series.length * 14);
  };
  return chart(`${kind}: ${title}. ${plot.y.label}${over} for ${names}.`, height, (theme, width) => optionOf(plot, theme, width));
}

function legendOf(plot: Plot, width: number): number {
  const dummy = { text: "", muted: "", line: "", surface: "", accent: "", series: [], families: {} };
  return legend(
    dummy,
    plot.series.map((one) => one.name),
    width,
  ).height;
}

function optionOf(plot: Plot, theme: Theme, width: number): EChartsOption {
  const names = plot.series.map((one) => one.name);
  const colors = seriesColors(theme, names);
  const key = legend(theme, names, width);
  const down = liesDown(plot, width);
  const labelWidth = down ? Math.min(170, Math.round(width * 0.36)) : undefined;
  const ratio = isRatio(plot.y.label);
  const points = plot.series.flatMap((one) => usable(one.points, plot));
  const ys = points.flatMap(([, y, min, max]) => [y, min, max]).filter((y): y is number => typeof y === "number");
  // Where prediction and measurement are compared, both axes are alike, so that equal figures lie on the diagonal.
  const xs = points.map(([x]) => x);
  const both = plot.kind === "scatter" && isPredictedAgainstMeasured(plot) ? [...xs, ...ys] : null;
  const figures = axis(theme, {
    label: plot.y.label,
    log: plot.y.log ?? false,
    values: both ?? (ratio ? [...ys, 1] : ys),
    fromZero: plot.kind === "bar" || (plot.kind === "line" && Math.min(...ys) >= 0),
    vertical: !down,
    ...(plot.y.log && ratio && plot.kind === "bar" ? { startValue: 1 } : {}),
  });
  const places = axis(theme, {
    label: plot.x.label,
    log: plot.x.log ?? false,
    values: both ?? xs,
    vertical: down,
    ...(plot.x.categories ? { categories: plot.x.categories } : {}),
    labelWidth: labelWidth ?? Math.floor((width - 60) / Math.max(1, plot.x.categories?.length ?? 1)),
  });
  const base = down ? { ...places, inverse: true, nameGap: 8 } : { ...places, nameGap: plot.x.categories ? 8 : 28 };
  const series: SeriesOption[] = [];
  plot.series.forEach((one, index) => series.push(...seriesOf(plot, one, index, colors[index] ?? theme.text, theme.text, down)));
  if (ratio && series[0]) addLevel(series[0], down, theme);
  if (plot.kind === "scatter" && isPredictedAgainstMeasured(plot)) series.push(diagonal(points, theme));
  return {
    legend: key.option,
    grid: {
      top: key.height + (down ? 4 : 26),
      left: 4,
      right: 18,
      bottom: down ? 26 : plot.x.label ? 26 : 6,
      containLabel: true,
    },
    tooltip: tooltip(theme, hint(plot)),
    xAxis: down ? { ...figures, nameGap: 26 } : base,
    yAxis: down ? base : figures,
    series,
  } as EChartsOption;
}

function seriesOf(plot: Plot, one: Series, index: number, color: string, ink: string, down: boolean): SeriesOption[] {
  const points = usable(one.points, plot);
  const data = points.map(([x, y]) => (down ? [y, x] : [x, y])) as number[][];
  const symbol = symbols[index % symbols.length] ?? "circle";
  const marks: SeriesOption[] = [];
  if (plot.kind === "bar") marks.push({ type: "bar", name: one.name, data, color, barGap, barCategoryGap, barMaxWidth });
  else if (plot.kind === "scatter") {
    // Many marks lie on each other: smaller ones can still be told apart.
    const many = plot.series.reduce((sum, each) => sum + each.points.length, 0) > 120;
    marks.push({
      type: "scatter",
      name: one.name,
      data,
      color,
      symbol,
      symbolSize: many ? 6 : 9,
      itemStyle: { opacity: many ? 0.65 : 0.85 },
    });
  } else {
    const sorted = [...data].sort((a, b) => (a[0] ?? 0) - (b[0] ?? 0));
    const type = dashes[Math.floor(index / symbols.length) % dashes.length] ?? "solid";
    marks.push({
      type: "line",
      name: one.name,
      data: sorted,
      color,
      symbol,
      symbolSize: 7,
      lineStyle: { width: 2, type },
      emphasis: { focus: "series" },
    });
  }
  const spread = spreads(points, plot.y.log);
  if (spread.length > 0) {
    marks.push(
      spreadSeries({
        name: one.name,
        points: spread,
        color: plot.kind === "bar" ? ink : color,
        horizontal: down,
        ...(plot.kind === "bar" ? { bars: { count: plot.series.length, index } } : {}),
      }),
    );
  }
  return marks;
}

function addLevel(series: SeriesOption, down: boolean, theme: Theme): void {
  Object.assign(series, {
    markLine: {
      silent: true,
      symbol: "none",
      animation: false,
      lineStyle: { color: theme.muted, type: "dashed", width: 1 },
      label: { show: false },
      data: [down ? { xAxis: 1 } : { yAxis: 1 }],
    },
  });
}

function diagonal(points: Point[], theme: Theme): SeriesOption {
  const all = points.flatMap(([x, y]) => [x, y ?? x]);
  const ends = [Math.min(...all), Math.max(...all)];
  return {
    type: "line",
    data: ends.map((end) => [end, end]),
    symbol: "none",
    silent: true,
    lineStyle: { color: theme.muted, type: "dashed", width: 1 },
    tooltip: { show: false },
    z: 1,
  };
}

interface Hovered {
  seriesName?: string;
  seriesIndex?: number;
  marker?: string;
  value: number[];
  name?: string;
}

function hint(plot: Plot): Record<string, unknown> {
  const categories = plot.x.categories;
  const text = (item: Hovered) => {
    const [x, y] = item.value;
    return `${item.marker ?? ""}${plain(item.seriesName ?? "")}<br>${plain(plot.x.label)} ${number(x)}<br>${plain(plot.y.label)} <b>${number(y)}</b>`;
  };
  if (plot.kind === "scatter") return { trigger: "item", formatter: text };
  return {
    trigger: "axis",
    axisPointer: { type: plot.kind === "bar" ? "shadow" : "line" },
    formatter: (items: Hovered[]) => {
      const shown = items.filter((item) => item.value.length === 2);
      const first = shown[0];
      if (!first) return "";
      const at = (item: Hovered) => spreadOf(plot, item);
      const head = categories ? plain(first.name ?? "") : `${plain(plot.x.label)} ${number(first.value[0])}`;
      return [`<b>${head}</b>`, ...shown.map((item) => `${item.marker ?? ""}${plain(item.seriesName ?? "")} ${at(item)}`)].join("<br>");
    },
  };
}

/** "1.23 (1.20–1.31)" of the point that is pointed at. */
function spreadOf(plot: Plot, item: Hovered): string {
  const series = plot.series.find((one) => one.name === item.seriesName);
  const point = series?.points.find(
    ([x, y]) => (item.value[0] === x && item.value[1] === y) || (item.value[0] === y && item.value[1] === x),
  );
  const text = `<b>${number(point?.[1])}</b>`;
  return point && typeof point[2] === "number" ? `${text} (${number(point[2])}–${number(point[3])})` : text;
}
