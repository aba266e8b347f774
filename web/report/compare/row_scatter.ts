// One figure of each structure over another: a mark each, in the colour of its family, named where nothing is better in both.

import type { EChartsOption, SeriesOption } from "echarts";
import { axis, legend, plain, tooltip } from "../../shared/axes";
import { chart, type Chart } from "../../shared/charts";
import { compact } from "../../shared/format";
import { familyOf, type Theme } from "../../shared/theme";
import type { Row } from "../types";
import type { View } from "./view";

export interface Figure {
  label: string;
  value: (row: Row) => number | null | undefined;
  log: boolean;
  /** Text of a value, with its unit. */
  text: (value: number) => string;
  /** Text of a tick; none: a compact number. */
  tick?: (value: number) => string;
  /** Whether more is better. */
  more: boolean;
}

const symbols: Record<string, string> = {
  brute: "rect",
  octree: "diamond",
  kdtree: "triangle",
  bvh: "circle",
  fast: "roundRect",
  auto: "pin",
};

interface Mark {
  x: number;
  y: number;
  structure: string;
  isBest: boolean;
}

export function rowScatter(view: View, label: string, x: Figure, y: Figure): Chart {
  const made = chart(
    label,
    (width) => (width < 480 ? 380 : 420),
    (theme, width) => optionOf(view, theme, width, x, y),
  );
  view.onChange(made.update);
  return made;
}

function marksOf(view: View, x: Figure, y: Figure): Mark[] {
  const marks: Mark[] = [];
  for (const row of view.rows()) {
    const [a, b] = [x.value(row), y.value(row)];
    // A logarithmic axis has no place for zero.
    if (typeof a !== "number" || typeof b !== "number" || (x.log && a <= 0) || (y.log && b <= 0)) continue;
    marks.push({ x: a, y: b, structure: row.structure, isBest: false });
  }
  const isBetter = (one: Mark, other: Mark) => {
    const better = (figure: Figure, a: number, b: number) => (figure.more ? a - b : b - a);
    const [dx, dy] = [better(x, one.x, other.x), better(y, one.y, other.y)];
    return dx >= 0 && dy >= 0 && dx + dy > 0;
  };
  for (const mark of marks) mark.isBest = !marks.some((other) => isBetter(other, mark));
  return marks;
}

function optionOf(view: View, theme: Theme, width: number, x: Figure, y: Figure): EChartsOption {
  const marks = marksOf(view, x, y);
  const families = view.families.filter((family) => marks.some((mark) => familyOf(mark.structure) === family));
  const key = legend(theme, families, width);
  const settings = (figure: Figure, values: number[], vertical: boolean) => ({
    label: figure.label,
    log: figure.log,
    values,
    vertical,
    fromZero: true,
    format: figure.tick ?? compact,
  });
  const series = families.map((family): SeriesOption => {
    const own = marks.filter((mark) => familyOf(mark.structure) === family);
    return {
      type: "scatter",
      name: family,
      color: theme.families[family] ?? theme.text,
      symbol: symbols[family] ?? "circle",
      symbolSize: 11,
      itemStyle: { borderColor: theme.surface, borderWidth: 1 },
      data: own.map((mark) => ({
        value: [mark.x, mark.y],
        name: mark.structure,
        label: {
          show: mark.isBest,
          formatter: mark.structure,
          position: "top" as const,
          color: theme.text,
          fontSize: 11,
        },
      })),
      labelLayout: { hideOverlap: true },
    };
  });
  return {
    legend: key.option,
    grid: { top: key.height + 34, left: 4, right: 30, bottom: 28, containLabel: true },
    xAxis: axis(
      theme,
      settings(
        x,
        marks.map((mark) => mark.x),
        false,
      ),
    ),
    yAxis: axis(
      theme,
      settings(
        y,
        marks.map((mark) => mark.y),
        true,
      ),
    ),
    tooltip: tooltip(theme, {
      trigger: "item",
      formatter: (item: { name: string; value: [number, number] }) =>
        `<b>${plain(item.name)}</b><br>${plain(x.label)}: ${x.text(item.value[0])}<br>${plain(y.label)}: ${y.text(item.value[1])}`,
    }),
    series,
  } as EChartsOption;
}
