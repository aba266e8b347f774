// What is drawn and how: levels, colours, opacities.

import { h } from "../shared/dom";
import { count, number } from "../shared/format";
import { gradient, type LogScale } from "./palette";
import { touches, type Store } from "./store";
import type { Metric } from "./tree";

const metricNames: Record<Metric, string> = {
  visits: "visits by rays",
  tests: "tests by rays, at and below",
  area: "surface area",
  references: "references, at and below",
};

export class Toolbar {
  readonly element: HTMLElement;
  private readonly from: HTMLInputElement;
  private readonly to: HTMLInputElement;
  private readonly levels = h("output", { id: "levels" });
  private readonly range = h("span", { class: "two-handed" });
  private readonly legendLow = h("span", {});
  private readonly legendHigh = h("span", {});

  constructor(
    private readonly store: Store,
    private readonly deepest: number,
    private readonly scaleOf: (metric: Metric) => LogScale,
    hasPlanes: boolean,
    goHome: () => void,
  ) {
    const { choice } = store;
    this.from = this.handle("First level shown", choice.from);
    this.to = this.handle("Last level shown", choice.to);
    this.range.append(h("span", { class: "track" }), this.from, this.to);
    this.from.addEventListener("input", () => store.set({ from: Number(this.from.value), to: Math.max(choice.to, Number(this.from.value)) }));
    this.to.addEventListener("input", () => store.set({ to: Number(this.to.value), from: Math.min(choice.from, Number(this.to.value)) }));

    const home = h("button", { type: "button", class: "wide" }, "Scene's camera");
    home.addEventListener("click", goHome);
    const bar = h("span", { class: "legend-bar", role: "img", "aria-label": "Colours from few to many, on a logarithmic scale" });
    bar.style.background = gradient;
    this.element = h(
      "section",
      { class: "card toolbar", "aria-label": "What is shown" },
      h("div", { class: "field" }, h("span", { class: "name" }, "Levels ", this.levels), this.range),
      this.choices("Colour by", "metric", metricNames),
      h("div", { class: "field legend" }, h("span", { class: "name" }, "Colours"), h("span", { class: "row" }, this.legendLow, bar, this.legendHigh)),
      ...(hasPlanes ? [this.choices("Nodes as", "drawAs", { boxes: "boxes", planes: "planes that cut them" })] : []),
      this.opacity("Nodes", "nodeOpacity"),
      this.opacity("Surface", "sceneOpacity"),
      this.choices("A click picks", "picks", { node: "a node", ray: "a ray" }),
      h("div", { class: "field" }, h("span", { class: "name" }, "View"), home),
    );
    store.onChange((changed) => {
      if (touches(changed, "from", "to", "metric")) this.show();
    });
    this.show();
  }

  private show(): void {
    const { from, to, metric } = this.store.choice;
    this.from.value = String(from);
    this.to.value = String(to);
    this.levels.textContent = from === to ? String(from) : `${from} to ${to}`;
    const share = (level: number) => `${(100 * level) / Math.max(this.deepest, 1)}%`;
    this.range.style.setProperty("--from", share(from));
    this.range.style.setProperty("--to", share(to));
    const scale = this.scaleOf(metric);
    const format = metric === "area" ? number : count;
    this.legendLow.textContent = format(scale.min);
    this.legendHigh.textContent = format(scale.max);
  }

  private handle(name: string, value: number): HTMLInputElement {
    return h("input", { type: "range", min: "0", max: String(this.deepest), step: "1", value: String(value), "aria-label": name });
  }

  private choices<K extends "metric" | "drawAs" | "picks">(name: string, key: K, options: Record<string, string>): HTMLElement {
    const select = h("select", { id: `choose-${key}` });
    for (const [value, text] of Object.entries(options)) select.append(h("option", { value }, text));
    select.value = this.store.choice[key];
    select.addEventListener("change", () => this.store.set({ [key]: select.value }));
    return h("div", { class: "field" }, h("label", { class: "name", for: select.id }, name), select);
  }

  private opacity(name: string, key: "nodeOpacity" | "sceneOpacity"): HTMLElement {
    const slider = h("input", { type: "range", min: "0", max: "1", step: "0.05", value: String(this.store.choice[key]), id: `opacity-${key}` });
    slider.addEventListener("input", () => this.store.set({ [key]: Number(slider.value) }));
    this.store.onChange((changed) => {
      if (changed.has(key)) slider.value = String(this.store.choice[key]);
    });
    return h("div", { class: "field small" }, h("label", { class: "name", for: slider.id }, `${name}’ opacity`.replace("e’", "e’s")), slider);
  }
}
