// The tree as nested rectangles, sized by what is in a node and coloured as the boxes are; it follows the selection and changes it.

import { TreemapChart } from "echarts/charts";
import { TooltipComponent } from "echarts/components";
import * as echarts from "echarts/core";
import { CanvasRenderer } from "echarts/renderers";
import { h } from "../shared/dom";
import { count, number } from "../shared/format";
import { cssColour, LogScale } from "./palette";
import type { Store } from "./store";
import type { Metric, Tree } from "./tree";

echarts.use([TreemapChart, TooltipComponent, CanvasRenderer]);

/** More tiles at once are specks. */
const mostTiles = 700;

interface Tile {
  name: string;
  node: number;
  value: number;
  itemStyle: { color: string; borderColor?: string; borderWidth?: number; gapWidth?: number };
  children?: Tile[];
}

/** In as few characters as tell the size. */
function tileLabel(value: number): string {
  if (value < 1000) return count(value);
  const [unit, factor] = value < 1e6 ? ["k", 1e3] : ["M", 1e6];
  const size = value / Number(factor);
  return `${size < 10 ? size.toFixed(1) : size.toFixed(0)}${unit}`;
}

export class Treemap {
  readonly element: HTMLElement;
  private readonly box = h("div", { class: "treemap-box", role: "img" });
  private readonly which = h("select", { id: "treemap-structure" });
  private readonly size = h("select", { id: "treemap-size" }, h("option", { value: "references" }, "references"), h("option", { value: "tests" }, "tests"));
  private readonly up = h("button", { type: "button", class: "wide" }, "Out");
  private readonly down = h("button", { type: "button", class: "wide" }, "Into the selected node");
  private readonly whole = h("button", { type: "button", class: "wide" }, "All");
  private readonly note = h("p", { class: "note" });
  private readonly chart: echarts.ECharts;
  private root = 0;
  /** Children of the root that have no tile. */
  private leftOut = 0;
  private inMap = new Set<number>();

  constructor(
    private readonly trees: Tree[],
    private readonly store: Store,
    private readonly scaleOf: (metric: Metric) => LogScale,
  ) {
    trees.forEach((tree, i) => this.which.append(h("option", { value: String(i) }, tree.name)));
    this.element = h(
      "section",
      { class: "card treemap" },
      h("h2", {}, "Map of the tree"),
      h(
        "p",
        { class: "row" },
        h("label", { for: "treemap-structure" }, "Structure "), this.which,
        h("label", { for: "treemap-size" }, "Size by "), this.size,
        this.down, this.up, this.whole,
      ),
      this.box,
      this.note,
    );
    this.chart = echarts.init(this.box, undefined, { renderer: "canvas" });
    new ResizeObserver(() => this.chart.resize()).observe(this.box);
    this.chart.on("click", (event) => {
      const node = (event.data as Tile | undefined)?.node;
      if (node !== undefined) this.store.set({ selected: { tree: this.store.choice.mapped, node } });
    });
    this.which.addEventListener("change", () => this.store.set({ mapped: Number(this.which.value) }));
    this.size.addEventListener("change", () => this.draw());
    this.up.addEventListener("click", () => this.goTo(Math.max(this.tree().parent[this.root]!, 0)));
    this.down.addEventListener("click", () => this.goTo(this.selected() ?? this.root));
    this.whole.addEventListener("click", () => this.goTo(0));
  }

  /** Another structure. */
  change(): void {
    this.which.value = String(this.store.choice.mapped);
    this.root = 0;
    this.draw();
  }

  /** Another node is selected: it is brought into the map. */
  follow(): void {
    const node = this.selected();
    if (node !== null) {
      const path = this.tree().pathTo(node);
      if (!this.inMap.has(node)) this.root = path[Math.max(path.length - 4, 0)]!;
    }
    this.draw();
  }

  draw(): void {
    const tree = this.tree();
    const selected = this.selected();
    const root = this.tiles(tree, selected);
    const style = getComputedStyle(document.documentElement);
    const text = style.getPropertyValue("--text").trim();
    this.up.disabled = this.root === 0;
    this.whole.disabled = this.root === 0;
    this.down.disabled = selected === null || selected === this.root || tree.children[selected]!.length === 0;
    this.box.setAttribute("aria-label", `Treemap of ${tree.name} below node ${this.root}`);
    const metric = this.store.choice.metric;
    this.chart.setOption(
      {
        animation: false,
        textStyle: { fontFamily: "inherit", color: text },
        tooltip: {
          formatter: (item: { data?: Tile }) => (item.data ? this.describe(tree, item.data.node) : ""),
          confine: true,
          backgroundColor: style.getPropertyValue("--surface").trim(),
          borderColor: style.getPropertyValue("--line").trim(),
          textStyle: { color: text },
        },
        series: [
          {
            type: "treemap",
            data: [root],
            left: 0, right: 0, top: 0, bottom: 0,
            roam: false,
            nodeClick: false,
            breadcrumb: { show: false },
            visibleMin: 1,
            label: {
              show: true, color: "#fff", textBorderColor: "#000", textBorderWidth: 2, fontSize: 10,
              ellipsis: "…",
              formatter: (item: { data?: unknown }) => tileLabel((item.data as Tile).value),
            },
            upperLabel: { show: false },
            // Fading a frame without a colour of its own, under a mouse that moves on, is an error of ECharts.
            emphasis: { disabled: true },
            levels: Array.from({ length: 24 }, (_, level) => ({ itemStyle: { gapWidth: level < 4 ? 3 - level / 2 : 1, borderWidth: level < 2 ? 2 : 1 } })),
          },
        ],
      },
      { notMerge: true },
    );
    const where = this.root === 0 ? "the whole tree" : `node ${count(this.root)} at level ${tree.depth[this.root]} and what is below`;
    this.note.textContent = `${where[0]!.toUpperCase()}${where.slice(1)}, ${count(this.inMap.size)} nodes; coloured by ${metric}.${this.leftOut > 0 ? ` ${count(this.leftOut)} smaller children have no tile.` : ""}`;
  }

  private goTo(node: number): void {
    this.root = node;
    this.draw();
  }

  private tree(): Tree {
    return this.trees[this.store.choice.mapped]!;
  }

  private selected(): number | null {
    const { selected, mapped } = this.store.choice;
    return selected?.tree === mapped ? selected.node : null;
  }

  /** Tiles from the root down, level by level, until there are enough. */
  private tiles(tree: Tree, selected: number | null): Tile {
    const sizes = tree.metrics[this.size.value as "references" | "tests"];
    const colours = tree.metrics[this.store.choice.metric];
    const scale = this.scaleOf(this.store.choice.metric);
    const make = (node: number): Tile => {
      const place = scale.place(colours[node]!);
      const tile: Tile = { name: count(node), node, value: sizes[node]!, itemStyle: { color: place === null ? "#808080" : cssColour(place) } };
      if (node === selected) Object.assign(tile.itemStyle, { borderColor: "#ff3d7f", borderWidth: 3 });
      else tile.itemStyle.borderColor = tile.itemStyle.color;
      return tile;
    };
    const root = make(this.root);
    this.inMap = new Set([this.root]);
    this.leftOut = 0;
    let level = [root];
    while (level.length > 0 && this.inMap.size < mostTiles) {
      const next: Tile[] = [];
      for (const tile of level) {
        let children = [...tree.children[tile.node]!].filter((child) => sizes[child]! > 0);
        if (tile === root && children.length > mostTiles) {
          this.leftOut = children.length - mostTiles;
          children = children.sort((a, b) => sizes[b]! - sizes[a]!).slice(0, mostTiles);
        }
        if (children.length === 0 || this.inMap.size + children.length > mostTiles + 1) continue;
        tile.children = children.map(make);
        for (const child of children) this.inMap.add(child);
        next.push(...tile.children);
      }
      level = next;
    }
    return root;
  }

  private describe(tree: Tree, node: number): string {
    const { visits, tests, references } = tree.metrics;
    return (
      `<b>node ${count(node)}</b>, level ${tree.depth[node]}${tree.isLeaf[node] ? ", a leaf" : ""}<br>` +
      `${count(references[node]!)} references, ${count(visits[node]!)} visits, ${number(tests[node]!)} tests`
    );
  }
}
