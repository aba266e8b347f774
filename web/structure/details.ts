// The numbers of the selected node.

import type { Space } from "./space";
import type { Store } from "./store";
import { element, integer, percent, short } from "./text";
import type { Tree } from "./tree";

const axes = ["x", "y", "z"];

export class Details {
  readonly element = element("section", { class: "card details", "aria-live": "polite" });

  constructor(
    private readonly trees: Tree[],
    private readonly space: Space,
    private readonly store: Store,
  ) {
    this.show();
  }

  show(): void {
    const { selected } = this.store.choice;
    const heading = element("h2", {}, "Node");
    if (!selected) {
      this.element.replaceChildren(
        heading,
        element("p", { class: "note" }, "Click a box, or a tile of the map below. Clicking a place again picks the next larger box there."),
      );
      return;
    }
    const tree = this.trees[selected.tree]!;
    const table = element("table", {}, ...this.rows(tree, selected.node).map(([name, value]) => element("tr", {}, element("th", { scope: "row" }, name), element("td", {}, value))));
    this.element.replaceChildren(heading, this.path(tree, selected.tree, selected.node), table, this.children(tree, selected.tree, selected.node));
  }

  private rows(tree: Tree, node: number): [string, string][] {
    const { visits, tests, references, area } = tree.metrics;
    const isLeaf = tree.isLeaf[node] === 1;
    const corner = (end: number) => axes.map((_, axis) => short(this.space.toScene(axis, tree.box[6 * node + 3 * end + axis]!))).join(", ");
    const share = area[0]! > 0 ? area[node]! / area[0]! : 1;
    const rows: [string, string][] = [
      ["structure", tree.name],
      ["node", `${integer(node)}, ${isLeaf ? "a leaf" : "interior"}, level ${tree.depth[node]}`],
      ["lower corner", corner(0)],
      ["upper corner", corner(1)],
      ["surface area", `${short(area[node]! / this.space.scale ** 2)}, ${percent(share)} of the root's`],
      [isLeaf ? "references" : "references below", integer(references[node]!)],
      ["visits", `${integer(visits[node]!)}, ${short(visits[node]! / tree.sampledRays)} per ray`],
      [isLeaf ? "tests" : "tests below", `${integer(tests[node]!)}, ${short(tests[node]! / tree.sampledRays)} per ray`],
    ];
    if (isLeaf && visits[node]! > 0) rows.push(["tests per visit", short(tests[node]! / visits[node]!)]);
    const rootVisits = visits[0]!;
    if (rootVisits > 0 && node > 0)
      rows.push(["chance of a visit", `${percent(visits[node]! / rootVisits)} of rays that meet the root; ${percent(share)} by the ratio of areas`]);
    for (let axis = 0; axis < 3; ++axis) {
      if ((tree.cutAxes[node]! >> axis) & 1)
        rows.push([`plane across ${axes[axis]}`, short(this.space.toScene(axis, tree.planes[3 * node + axis]!))]);
    }
    return rows;
  }

  private path(tree: Tree, treeNumber: number, node: number): HTMLElement {
    const nodes = tree.pathTo(node);
    const shown = nodes.length > 6 ? [nodes[0]!, -1, ...nodes.slice(-4)] : nodes;
    return element(
      "nav",
      { class: "path", "aria-label": "The node and those above it" },
      ...shown.map((at) => (at < 0 ? element("span", {}, "…") : this.link(treeNumber, at, at === 0 ? "root" : integer(at), at === node))),
    );
  }

  private children(tree: Tree, treeNumber: number, node: number): HTMLElement {
    const list = tree.children[node]!;
    const missing = tree.childCount[node]! - list.length;
    const parts: Node[] = [...list].slice(0, 16).map((child) => this.link(treeNumber, child, `${integer(child)}${tree.isLeaf[child] ? " (leaf)" : ""}`, false));
    if (missing > 0) parts.push(element("span", { class: "note" }, `${integer(missing)} not in this page`));
    if (parts.length === 0) return element("p", { class: "note" }, "No children.");
    return element("nav", { class: "path", "aria-label": "Children" }, element("span", {}, "Children:"), ...parts);
  }

  private link(tree: number, node: number, text: string, isCurrent: boolean): HTMLElement {
    const button = element("button", { type: "button" }, text);
    if (isCurrent) button.setAttribute("aria-current", "true");
    button.addEventListener("click", () => this.store.set({ selected: { tree, node } }));
    return button;
  }
}
