// How fast each structure is: a bar each, fastest first, with the spread over the rounds.

import type { EChartsOption } from "echarts";
import { axis, plain, tooltip } from "../../shared/axes";
import { chart, type Chart } from "../../shared/charts";
import { number } from "../../shared/format";
import { barCategoryGap, barGap, barMaxWidth, spreadSeries, type SpreadPoint } from "../../shared/spread";
import { familyOf, type Theme } from "../../shared/theme";
import { bySpeed, type View } from "./view";

export function speedChart(view: View): Chart {
  const height = () => 50 + 26 * Math.max(1, bySpeed(view.rows()).length);
  const made = chart(
    "Bar chart: millions of rays a second by structure, fastest first, from least to most over the rounds.",
    height,
    (theme, width) => optionOf(view, theme, width),
  );
  view.onChange(made.update);
  return made;
}

function optionOf(view: View, theme: Theme, width: number): EChartsOption {
  const rows = bySpeed(view.rows());
  const labelWidth = Math.min(300, Math.round(width * 0.42));
  return {
    grid: { top: 4, left: 4, right: 24, bottom: 28, containLabel: true },
    xAxis: { ...axis(theme, { label: `Mrays/s, ${view.rays} rays`, fromZero: true }), nameGap: 26 },
    yAxis: { ...axis(theme, { label: "", categories: rows.map((row) => row.structure), labelWidth }), inverse: true },
    tooltip: tooltip(theme, {
      trigger: "axis",
      axisPointer: { type: "shadow" },
      formatter: (items: { dataIndex: number }[]) => {
        const row = rows[items[0]?.dataIndex ?? -1];
        if (!row?.mrays_per_s) return "";
        const { median, min, max } = row.mrays_per_s;
        const ratio = row.ratio_to_first ? `<br>${number(row.ratio_to_first.median)} times the first` : "";
        return `<b>${plain(row.structure)}</b><br>${number(median)} Mrays/s (${number(min)}–${number(max)})${ratio}`;
      },
    }),
    series: [
      {
        type: "bar",
        name: "Mrays/s",
        barGap,
        barCategoryGap,
        barMaxWidth,
        data: rows.map((row) => ({
          value: row.mrays_per_s?.median ?? 0,
          itemStyle: { color: theme.families[familyOf(row.structure)] ?? theme.text, borderRadius: [0, 3, 3, 0] },
        })),
      },
      spreadSeries({
        name: "Mrays/s",
        points: rows.map((row, index): SpreadPoint => [index, row.mrays_per_s?.min ?? 0, row.mrays_per_s?.max ?? 0]),
        color: theme.text,
        horizontal: true,
        bars: { count: 1, index: 0 },
      }),
    ],
  } as EChartsOption;
}
