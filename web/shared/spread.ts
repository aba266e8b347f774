// Marks from the least to the most of a figure, beside the mark of its median.

import type { CustomSeriesOption, CustomSeriesRenderItem } from "echarts";

/** Where one mark goes: at that place along the axis of what is compared, from the least to the most. */
export type SpreadPoint = [at: number, min: number, max: number];

interface Settings {
  name: string;
  points: SpreadPoint[];
  color: string;
  /** Whether figures run to the right, as with horizontal bars. */
  horizontal?: boolean;
  /** The bars that stand side by side for each category, and which of them this is. */
  bars?: { count: number; index: number };
}

export const barGap = "12%";
export const barCategoryGap = "28%";
export const barMaxWidth = 26;

/** A series of error bars. It belongs to the series of the same name, and leaves with it when the legend is clicked. */
export function spreadSeries(settings: Settings): CustomSeriesOption {
  const { horizontal, bars } = settings;
  const renderItem: CustomSeriesRenderItem = (_, api) => {
    const at = Number(api.value(0));
    const least = api.coord(horizontal ? [api.value(1), at] : [at, api.value(1)]);
    const most = api.coord(horizontal ? [api.value(2), at] : [at, api.value(2)]);
    const layout = bars ? api.barLayout({ count: bars.count, barGap, barCategoryGap, barMaxWidth })?.[bars.index] : undefined;
    const offset = layout?.offsetCenter ?? 0;
    const cap = Math.min(4, (layout?.width ?? 8) / 2);
    const [x1, y1, x2, y2] = horizontal
      ? [least[0] ?? 0, (least[1] ?? 0) + offset, most[0] ?? 0, (most[1] ?? 0) + offset]
      : [(least[0] ?? 0) + offset, least[1] ?? 0, (most[0] ?? 0) + offset, most[1] ?? 0];
    const style = { stroke: settings.color, lineWidth: 1.25, opacity: 0.85 };
    const line = (a: number, b: number, c: number, d: number) => ({
      type: "line" as const,
      shape: { x1: a, y1: b, x2: c, y2: d },
      style,
    });
    const caps = horizontal
      ? [line(x1, y1 - cap, x1, y1 + cap), line(x2, y2 - cap, x2, y2 + cap)]
      : [line(x1 - cap, y1, x1 + cap, y1), line(x2 - cap, y2, x2 + cap, y2)];
    return { type: "group", children: [line(x1, y1, x2, y2), ...caps] };
  };
  return {
    type: "custom",
    name: settings.name,
    renderItem,
    data: settings.points,
    encode: horizontal ? { x: [1, 2], y: 0 } : { x: 0, y: [1, 2] },
    silent: true,
    tooltip: { show: false },
    z: 4,
    color: settings.color,
  };
}
