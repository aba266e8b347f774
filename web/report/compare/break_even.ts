// Time to an image: building and tracing together, over the rays that are traced; and from how many rays on which structure is the best.

import type { EChartsOption, SeriesOption } from "echarts";
import { axis, plain, tooltip } from "../../shared/axes";
import { chart } from "../../shared/charts";
import { h } from "../../shared/dom";
import { compact, count, duration, secondsTick } from "../../shared/format";
import { familyOf, type Theme } from "../../shared/theme";
import type { BreakEven } from "../types";
import { structureName } from "./controls";
import type { View } from "./view";

type Scale = "time" | "against the best";

export function breakEvenFigure(view: View): HTMLElement | null {
  const all = view.report.break_even ?? [];
  if (all.length === 0) return null;
  const current = () => all.find((one) => one.rays === view.rays);
  let scale: Scale = "time";
  const made = chart(
    "Line chart, both axes logarithmic: time to build and trace, over the number of rays, a line for each structure.",
    (width) => (width < 480 ? 380 : 440),
    (theme) => {
      const data = current();
      return data ? optionOf(view, data, theme, scale) : {};
    },
  );
  const scales = (["time", "against the best"] as const).map((one) =>
    h("button", { type: "button", "aria-pressed": String(one === scale), onclick: () => choose(one) }, one),
  );
  function choose(next: Scale): void {
    scale = next;
    for (const button of scales) button.setAttribute("aria-pressed", String(button.textContent === scale));
    made.update();
  }
  const list = h("ol", { class: "best-from" });
  const none = h("p", { class: "lead" }, "There are no such figures for these rays.");
  const figure = h(
    "div",
    {},
    list,
    h("div", { class: "segments screen-only", role: "group", "aria-label": "What the chart shows" }, scales),
    made.element,
  );
  const update = () => {
    const data = current();
    list.replaceChildren(...(data ? bestList(data) : []));
    none.hidden = Boolean(data);
    figure.hidden = !data;
    made.update();
  };
  update();
  view.onChange(update);
  return h("div", {}, figure, none);
}

function raysText(rays: number): string {
  return rays < 1000 ? count(rays) : compact(rays);
}

function bestList(data: BreakEven): HTMLElement[] {
  return data.best.map(({ from_rays, structure }, index) => {
    const next = data.best[index + 1];
    const from = index === 0 ? "" : `from ${raysText(from_rays)} `;
    const to = next ? `${index === 0 ? "up " : ""}to ${raysText(next.from_rays)} rays` : index === 0 ? "for any number of rays" : "rays on";
    return h("li", {}, h("span", { class: "range" }, from + to), structureName(structure));
  });
}

/** Rays at the ends of the picture: a decade or two about all changes of the best, and at least from a thousand to a million. */
function ends(data: BreakEven): [number, number] {
  const changes = data.best.map((one) => one.from_rays).filter((rays) => rays > 0);
  const least = Math.max(1, Math.min(1e3, ...changes.map((rays) => rays / 10)));
  const most = Math.max(1e6, ...changes.map((rays) => rays * 50));
  return [10 ** Math.floor(Math.log10(least)), 10 ** Math.ceil(Math.log10(most))];
}

function optionOf(view: View, data: BreakEven, theme: Theme, scale: Scale): EChartsOption {
  const [least, most] = ends(data);
  const steps = 72;
  const rays = Array.from({ length: steps + 1 }, (_, index) => least * (most / least) ** (index / steps));
  const best = new Set(data.best.map((one) => one.structure));
  const curves = data.curves.filter((curve) => view.shows(curve.structure));
  const seconds = (curve: BreakEven["curves"][number], n: number) => curve.build_seconds + n * curve.seconds_per_ray;
  const fastest = (n: number) => Math.min(...data.curves.map((curve) => seconds(curve, n)));
  const isRelative = scale === "against the best";
  const time = (curve: BreakEven["curves"][number], n: number) => (isRelative ? seconds(curve, n) / fastest(n) : seconds(curve, n));
  // What is hopelessly slow leaves the picture rather than flatten the rest.
  const ceiling = isRelative ? 10 : 100 * fastest(most);
  const times = curves.flatMap((curve) => [time(curve, least), time(curve, most)]).map((one) => Math.min(one, ceiling));
  const series = curves.map((curve): SeriesOption => {
    const isBest = best.has(curve.structure);
    return {
      type: "line",
      name: curve.structure,
      color: theme.families[familyOf(curve.structure)] ?? theme.text,
      data: rays.map((n) => [n, time(curve, n)]).filter((point) => (point[1] ?? 0) <= 1.5 * ceiling),
      clip: true,
      symbol: "none",
      lineStyle: { width: isBest ? 3 : 1, opacity: isBest ? 1 : 0.45 },
      emphasis: { focus: "series", lineStyle: { width: 3, opacity: 1 } },
      triggerLineEvent: true,
      z: isBest ? 3 : 2,
    };
  });
  const crossings = data.best.slice(1).flatMap(({ from_rays, structure }) => {
    const curve = data.curves.find((one) => one.structure === structure);
    return curve && view.shows(structure) ? [{ value: [from_rays, time(curve, from_rays)], name: structure }] : [];
  });
  series.push({
    type: "scatter",
    name: "break even",
    data: crossings,
    symbolSize: 9,
    color: theme.text,
    z: 5,
    label: {
      show: true,
      position: "bottom",
      distance: 8,
      color: theme.text,
      fontSize: 11,
      formatter: (item) => raysText((item.value as number[])[0] ?? 0),
    },
    labelLayout: { hideOverlap: true },
  });
  return {
    grid: { top: 30, left: 4, right: 22, bottom: 28, containLabel: true },
    xAxis: { ...axis(theme, { label: `${data.rays} rays traced`, log: true, values: [least, most] }), min: least, max: most },
    yAxis: axis(theme, {
      label: isRelative ? "time to build and trace, against the best" : "time to build and trace",
      log: true,
      values: isRelative ? [1, ...times] : times,
      vertical: true,
      format: isRelative ? (value) => `${compact(value)}×` : secondsTick,
    }),
    tooltip: tooltip(theme, {
      trigger: "item",
      formatter: (item: { seriesName: string; seriesType: string; name: string; value?: number[] }) => {
        if (item.seriesType === "scatter") return `From ${raysText(item.value?.[0] ?? 0)} rays on<br><b>${plain(item.name)}</b>`;
        const curve = data.curves.find((one) => one.structure === item.seriesName);
        if (!curve) return "";
        return `<b>${plain(item.seriesName)}</b><br>built in ${duration(curve.build_seconds)}<br>${duration(curve.seconds_per_ray)} a ray`;
      },
    }),
    series,
  } as EChartsOption;
}
