// The numbers of the selected node.

import { h } from "../shared/dom";
import { count, number } from "../shared/format";
import type { Space } from "./space";
import type { Store } from "./store";
import type { Tree } from "./tree";
import { percent } from "./text";

const axes = ["x", "y", "z"];

export class Details {
  readonly element = h("section", { class: "card details", "aria-live": "polite" });

  constructor(
    private readonly trees: Tree[],
    private readonly space: Space,
    private readonly store: Store,
  ) {
    this.show();
  }

  show(): void {
    const { selected } = this.store.choice;
    const heading = h("h2", {}, "Node");
    if (!selected) {
      this.element.replaceChildren(
        heading,
        h("p", { class: "note" }, "Click a box, or a tile of the map below. Clicking a place again picks the next box there: the deepest level comes first, and of one level the nearest."),
      );
      return;
    }
    const tree = this.trees[selected.tree]!;
    const table = h("table", {}, h("tbody", {}, ...this.rows(tree, selected.node).map(([name, value]) => h("tr", {}, h("th", { scope: "row" }, name), h("td", {}, value)))));
    this.element.replaceChildren(heading, this.path(tree, selected.tree, selected.node), table, this.children(tree, selected.tree, selected.node));
  }

  private rows(tree: Tree, node: number): [string, string][] {
    const { visits, tests, references, area } = tree.metrics;
    const isLeaf = tree.isLeaf[node] === 1;
    const corner = (end: number) => axes.map((_, axis) => number(this.space.toScene(axis, tree.box[6 * node + 3 * end + axis]!))).join(", ");
    const share = area[0]! > 0 ? area[node]! / area[0]! : 1;
    const rows: [string, string][] = [
      ["structure", tree.name],
      ["node", `${count(node)}, ${isLeaf ? "a leaf" : "interior"}, level ${tree.depth[node]}`],
      ["lower corner", corner(0)],
      ["upper corner", corner(1)],
      ["surface area", `${number(area[node]! / this.space.scale ** 2)}, ${percent(share)} of the root's`],
      [isLeaf ? "references" : "references below", count(references[node]!)],
      ["visits", `${count(visits[node]!)}, ${number(visits[node]! / tree.sampledRays)} per ray`],
      [isLeaf ? "tests" : "tests below", `${count(tests[node]!)}, ${number(tests[node]! / tree.sampledRays)} per ray`],
    ];
    if (isLeaf && visits[node]! > 0) rows.push(["tests per visit", number(tests[node]! / visits[node]!)]);
    const rootVisits = visits[0]!;
    if (rootVisits > 0 && node > 0)
      rows.push(["chance of a visit", `${percent(visits[node]! / rootVisits)} of rays that meet the root; ${percent(share)} by the ratio of areas`]);
    for (let axis = 0; axis < 3; ++axis) {
      if ((tree.cutAxes[node]! >> axis) & 1)
        rows.push([`plane across ${axes[axis]}`, number(this.space.toScene(axis, tree.planes[3 * node + axis]!))]);
    }
    return rows;
  }

  private path(tree: Tree, treeNumber: number, node: number): HTMLElement {
    const nodes = tree.pathTo(node);
    const shown = nodes.length > 6 ? [nodes[0]!, -1, ...nodes.slice(-4)] : nodes;
    return h(
      "nav",
      { class: "path", "aria-label": "The node and those above it" },
      ...shown.map((at) => (at < 0 ? h("span", {}, "…") : this.link(treeNumber, at, at === 0 ? "root" : count(at), at === node))),
    );
  }

  private children(tree: Tree, treeNumber: number, node: number): HTMLElement {
    const list = tree.children[node]!;
    const missing = tree.childCount[node]! - list.length;
    const parts: Node[] = [...list].slice(0, 16).map((child) => this.link(treeNumber, child, `${count(child)}${tree.isLeaf[child] ? " (leaf)" : ""}`, false));
    if (missing > 0) parts.push(h("span", { class: "note" }, `${count(missing)} not in this page`));
    if (parts.length === 0) return h("p", { class: "note" }, "No children.");
    return h("nav", { class: "path", "aria-label": "Children" }, h("span", {}, "Children:"), ...parts);
  }

  private link(tree: number, node: number, text: string, isCurrent: boolean): HTMLElement {
    const button = h("button", { type: "button" }, text);
    if (isCurrent) button.setAttribute("aria-current", "true");
    button.addEventListener("click", () => this.store.set({ selected: { tree, node } }));
    return button;
  }
}
