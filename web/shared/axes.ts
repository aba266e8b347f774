// Axes, legends and the room round a plot, alike in all charts.

import type { EChartsOption } from "echarts";
import { compact } from "./format";
import type { Theme } from "./theme";

export interface AxisSettings {
  label: string;
  log?: boolean;
  categories?: string[];
  /** All values on the axis, to choose the ends and ticks of a logarithmic one. */
  values?: number[];
  /** Text of a tick. */
  format?: (value: number) => string;
  /** Where bars begin. */
  startValue?: number;
  /** From zero unless logarithmic. */
  fromZero?: boolean;
  vertical?: boolean;
  /** Pixels for the labels of categories. */
  labelWidth?: number;
}

/** Ends of a logarithmic axis about the values, and what its ticks are powers of: two where the range is narrow. */
export function logarithmicRange(values: number[]): { min: number; max: number; logBase: number } {
  const positive = values.filter((value) => value > 0 && Number.isFinite(value));
  if (positive.length === 0) return { min: 1, max: 10, logBase: 10 };
  const least = Math.min(...positive);
  const most = Math.max(...positive);
  const logBase = most / least < 20 ? 2 : 10;
  const exponent = (value: number) => Math.log(value) / Math.log(logBase);
  const min = logBase ** Math.floor(exponent(least) + 1e-9);
  const max = logBase ** Math.ceil(exponent(most) - 1e-9);
  return { min, max: max > min ? max : min * logBase, logBase };
}

/** An axis of ECharts. */
export function axis(theme: Theme, settings: AxisSettings): Record<string, unknown> {
  const { label, log, categories, vertical } = settings;
  const format = settings.format ?? compact;
  const shared = {
    name: label,
    // That of the upright axis stands above it, to be read without turning the head.
    nameLocation: vertical ? ("end" as const) : ("middle" as const),
    nameTextStyle: { color: theme.muted, fontSize: 12, ...(vertical ? { align: "left" as const, padding: [0, 0, 0, -16] } : {}) },
    nameGap: vertical ? 14 : 28,
    axisLine: { show: !vertical, lineStyle: { color: theme.line } },
    axisTick: { show: false },
    splitLine: { show: true, lineStyle: { color: theme.line, opacity: 0.6 } },
    nameMoveOverlap: false,
    inverse: false,
  };
  if (categories) {
    return {
      ...shared,
      type: "category",
      data: categories,
      splitLine: { show: false },
      axisLabel: {
        color: theme.text,
        fontSize: 11,
        interval: 0,
        lineHeight: 13,
        ...(settings.labelWidth ? { width: settings.labelWidth, overflow: "break" } : {}),
        formatter: (name: string) => (settings.labelWidth ? inLines(name, Math.floor(settings.labelWidth / 6)) : name),
      },
    };
  }
  const label_ = { color: theme.muted, fontSize: 11, hideOverlap: true, formatter: format };
  if (log) return { ...shared, type: "log", ...logarithmicRange(settings.values ?? []), ...start(settings), axisLabel: label_ };
  return { ...shared, type: "value", scale: !settings.fromZero, ...start(settings), axisLabel: label_ };
}

function start(settings: AxisSettings): { startValue?: number } {
  return settings.startValue === undefined ? {} : { startValue: settings.startValue };
}

/** The name of a structure in lines of about so many characters, broken after ':' and ','. */
export function inLines(name: string, width: number): string {
  const lines: string[] = [];
  for (const part of name.split(/(?<=[:, ])/)) {
    const last = lines.at(-1);
    if (last !== undefined && last.length + part.length <= width) lines[lines.length - 1] = last + part;
    else lines.push(part);
  }
  return lines.join("\n");
}

/** A legend above the plot, and the pixels that it takes. */
export function legend(theme: Theme, names: string[], width: number): { option: EChartsOption["legend"]; height: number } {
  if (names.length < 2) return { option: { show: false }, height: 8 };
  let lines = 1;
  let used = 0;
  for (const name of names) {
    const size = 44 + 6.5 * name.length;
    if (used > 0 && used + size > width - 16) {
      ++lines;
      used = 0;
    }
    used += size;
  }
  return {
    option: {
      data: names,
      top: 0,
      left: 0,
      width: width - 8,
      itemGap: 14,
      itemWidth: 18,
      itemHeight: 9,
      textStyle: { color: theme.text, fontSize: 12 },
      inactiveColor: theme.line,
    },
    height: lines * 22 + 8,
  };
}

/** The hint that appears where a chart is pointed at: what of ECharts' settings, in the looks of the page. */
export function tooltip(theme: Theme, settings: Record<string, unknown>): Record<string, unknown> {
  return {
    ...settings,
    confine: true,
    backgroundColor: theme.surface,
    borderColor: theme.line,
    textStyle: { color: theme.text, fontSize: 12 },
    extraCssText: "max-width:min(24rem,80vw);white-space:normal;box-shadow:0 2px 10px rgb(0 0 0/.18)",
  };
}

/** Text that is no markup, for hints. */
export function plain(text: string): string {
  return text.replace(/[&<>"]/g, (c) => `&#${c.charCodeAt(0)};`);
}
