// Charts that are drawn when they come into view, follow the width and the colours of the page, and are all there on paper.

import type { ECharts, EChartsOption } from "echarts";
import { h } from "./dom";
import { echarts } from "./echarts";
import { currentTheme, onPrint, onThemeChange, type Theme } from "./theme";

/** What a chart shows, for the colours and the width in pixels that it has. */
export type ChartMaker = (theme: Theme, width: number) => EChartsOption;

export interface Chart {
  element: HTMLElement;
  /** Draws anew: what the maker looks at has changed. */
  update: () => void;
}

interface Entry {
  element: HTMLElement;
  make: ChartMaker;
  height: (width: number) => number;
  instance: ECharts | null;
  width: number;
}

/** As wide as charts are on paper: A4 without its margins. */
const paperWidth = 680;

const entries = new Map<Element, Entry>();
let printing = false;

// A little before they are seen, so that they are there when they are.
const seen = new IntersectionObserver(
  (changes) => {
    for (const change of changes) {
      const entry = entries.get(change.target);
      if (entry && change.isIntersecting) draw(entry);
    }
  },
  { rootMargin: "400px 0px" },
);

const resized = new ResizeObserver((changes) => {
  if (printing) return;
  for (const change of changes) {
    const entry = entries.get(change.target);
    if (entry?.instance && Math.abs(entry.element.clientWidth - entry.width) >= 1) draw(entry);
  }
});

/** A chart of that height in pixels, or one that depends on its width. `label` says in a sentence what it shows. */
export function chart(label: string, height: number | ((width: number) => number), make: ChartMaker): Chart {
  const element = h("div", { class: "chart", role: "img", "aria-label": label });
  const entry: Entry = { element, make, height: typeof height === "number" ? () => height : height, instance: null, width: 0 };
  // Room is kept for what is not drawn yet, so that the page does not jump.
  element.style.height = `${entry.height(640)}px`;
  entries.set(element, entry);
  seen.observe(element);
  resized.observe(element);
  return {
    element,
    update: () => {
      if (entry.instance) draw(entry);
    },
  };
}

function draw(entry: Entry): void {
  const width = printing ? Math.min(paperWidth, entry.element.clientWidth || paperWidth) : entry.element.clientWidth;
  if (width === 0) return;
  const height = entry.height(width);
  entry.width = width;
  entry.element.style.height = `${height}px`;
  if (!entry.instance) {
    entry.instance = echarts.init(entry.element, null, { renderer: "svg", width, height });
  } else {
    entry.instance.resize({ width, height });
  }
  const theme = currentTheme();
  entry.instance.setOption({ ...common(theme), ...entry.make(theme, width) }, { notMerge: true });
}

function common(theme: Theme): EChartsOption {
  return {
    animation: false,
    color: theme.series,
    textStyle: { color: theme.text, fontFamily: getComputedStyle(document.body).fontFamily, fontSize: 12 },
  };
}

function drawAll(onlyDrawn: boolean): void {
  for (const entry of entries.values()) {
    if (!entry.element.isConnected) {
      entry.instance?.dispose();
      entries.delete(entry.element);
    } else if (entry.instance || !onlyDrawn) {
      draw(entry);
    }
  }
}

onThemeChange(() => drawAll(true));
onPrint(
  () => {
    printing = true;
    drawAll(false);
  },
  () => {
    printing = false;
    drawAll(true);
  },
);
