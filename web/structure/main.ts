// The page of `grove inspect --html`: structures over a scene in three dimensions, and rays stepped through them.

import "../shared/base.css";
import "./style.css";
import { Color, Mesh, MeshBasicMaterial, Vector3 } from "three";
import { readData } from "../shared/data";
import { h } from "../shared/dom";
import { count } from "../shared/format";
import { Details } from "./details";
import { LinkedCamera } from "./linked_camera";
import { LogScale } from "./palette";
import { Pane, type PaneColours } from "./pane";
import { isPayload, type Payload } from "./payload";
import { Picture } from "./picture";
import { Rays, stretchIn } from "./rays";
import { firstLevel } from "./shown";
import { Space } from "./space";
import { describeState, Stepper } from "./stepper";
import { Store, touches } from "./store";
import { surfaceNote, surfaceOf, TestedPrimitives } from "./surface";
import { Toolbar } from "./toolbar";
import type { Trace } from "./traces";
import { Tree, type Metric } from "./tree";
import { Treemap } from "./treemap";

const dark = window.matchMedia("(prefers-color-scheme: dark)");

function paneColours(): PaneColours {
  const style = getComputedStyle(document.documentElement);
  const colour = (name: string) => new Color(style.getPropertyValue(name).trim());
  return {
    background: colour("--stage"), surface: colour("--mesh"), ray: colour("--ray"), visited: colour("--visited"),
    current: colour("--current"), miss: colour("--miss"), hit: colour("--hit"),
  };
}

function header(payload: Payload): HTMLElement {
  const { machine } = payload;
  const date = payload.date.replace("T", " ").replace("Z", " UTC");
  const commit = machine.commit ? `, commit ${machine.commit.slice(0, 12)}` : "";
  return h(
    "header",
    {},
    h("h1", {}, `Structures over ${payload.scene}`),
    h("p", {}, `${count(payload.primitives)} primitives. `, h("code", {}, payload.command)),
    h("p", { class: "note" }, `${machine.cpu}, ${machine.compiler}${commit}, ${date}`),
  );
}

function notes(payload: Payload, trees: Tree[]): HTMLElement {
  const rays = count(trees[0]!.sampledRays);
  const list = [
    `Visits and tests are those of ${rays} rays through the scene's camera, one a pixel of the picture; a leaf is visited when it is entered, or when its cell is come to from a neighbour.`,
    surfaceNote(payload, count),
    ...trees.filter((tree) => tree.count < tree.total).map((tree) =>
      `${tree.name}: ${count(tree.count)} of ${count(tree.total)} nodes are in this page: all to level ${tree.completeDepth}, and below it those that recorded rays come to.`),
    ...trees.filter((tree) => tree.sampledRays !== trees[0]!.sampledRays).map((tree) =>
      `${tree.name}: only ${count(tree.sampledRays)} rays, as they take many steps.`),
    trees.some((tree) => tree.hasTopLevel && tree.objectsShown)
      ? "The scene has instances. The structure over them is the root and what is below it; the structures of their objects hang below the root, too, one for each instance in its place." : "",
    trees.some((tree) => tree.hasTopLevel && !tree.objectsShown)
      ? "The scene has instances, and their objects too many nodes together: only the structure over the instances is shown. Steps in objects are counted in the picture alone." : "",
    trees.some((tree) => /bounds=(obb|sphere)/.test(tree.name)) ? "Oriented boxes and spheres are drawn as the axis-aligned boxes around them." : "",
  ];
  return h("section", { class: "notes" }, h("h2", {}, "Notes"), h("ul", {}, ...list.filter(Boolean).map((text) => h("li", {}, text))));
}

function start(root: HTMLElement, payload: Payload): void {
  const space = new Space(payload.bounds);
  const rays = new Rays(payload, space);
  const tested = new TestedPrimitives(payload, space);
  const trees = payload.structures.map((structure) => new Tree(structure, space, rays.rays.length));
  const deepest = Math.max(...trees.map((tree) => tree.maxDepth));
  const level = firstLevel(trees);
  const store = new Store({
    from: level, to: level, metric: "visits", drawAs: "boxes", nodeOpacity: 0.8, sceneOpacity: 1, picks: "node", selected: null, ray: null, step: 0,
    mapped: 0,
  });
  // One scale for all structures; of nodes that stand for themselves, which the root does not.
  const scales = new Map<Metric, LogScale>();
  const scaleOf = (metric: Metric) => {
    const known = scales.get(metric) ?? new LogScale(trees.map((tree) => tree.metrics[metric]));
    scales.set(metric, known);
    return known;
  };

  let isDue = false;
  const panes: Pane[] = [];
  const redraw = () => {
    if (isDue) return;
    isDue = true;
    requestAnimationFrame(() => {
      isDue = false;
      for (const pane of panes) pane.draw();
    });
  };
  const middle = rays.rays[Math.floor(rays.rows / 2) * rays.columns + Math.floor(rays.columns / 2)]!;
  const linked = new LinkedCamera(payload, space, middle.distance ?? middle.origin.length(), redraw);
  const surface = surfaceOf(payload, space);
  panes.push(...trees.map((tree) => new Pane(tree, surface, linked)));

  let traces: Trace[] = [];
  const lookAside = () => {
    const ray = rays.rays[store.choice.ray ?? -1];
    if (!ray) return;
    const stretch = stretchIn(ray, trees[0]!.box.subarray(0, 6));
    const from = stretch?.from ?? 0;
    const to = ray.distance ?? stretch?.to ?? from + 10;
    const at = (distance: number) => new Vector3().copy(ray.direction).multiplyScalar(distance).add(ray.origin);
    linked.lookAside(at(from), at(to));
  };
  const stepper = new Stepper(store, lookAside);
  const details = new Details(trees, space, store);
  const picture = new Picture(payload, rays, trees, store);
  const treemap = new Treemap(trees, store, scaleOf);
  const toolbar = new Toolbar(store, deepest, scaleOf, trees.some((tree) => tree.hasPlanes), () => linked.goHome());

  const grid = h("div", { class: "panes" }, ...panes.map((pane) => pane.element));
  grid.style.setProperty("--count", String(Math.min(panes.length, 3)));
  root.replaceChildren(
    header(payload),
    toolbar.element,
    h("main", {}, grid, stepper.element, h("div", { class: "below" }, picture.element, details.element), treemap.element),
    notes(payload, trees),
  );

  let colours = paneColours();
  const showNodes = () => panes.forEach((pane) => pane.showNodes(store.choice, scaleOf(store.choice.metric)));
  const showSelection = () => {
    const { selected } = store.choice;
    panes.forEach((pane, i) => pane.select(selected?.tree === i ? selected.node : null, colours.current));
  };
  const showRay = () => {
    const ray = rays.rays[store.choice.ray ?? -1];
    panes.forEach((pane, i) => {
      const trace = traces[i];
      if (!ray || !trace) {
        pane.rayDrawing.hide();
        pane.setStateText("");
        return;
      }
      pane.rayDrawing.show(trees[i]!, rays, ray, trace, store.choice.step, tested, colours);
      pane.setStateText(describeState(trees[i]!, trace, store.choice.step, tested));
    });
  };
  store.onChange((changed) => {
    if (touches(changed, "from", "to", "metric", "drawAs")) showNodes();
    if (touches(changed, "nodeOpacity", "sceneOpacity", "ray")) panes.forEach((pane) => pane.setOpacities(store.choice));
    if (changed.has("ray")) {
      const { ray, sceneOpacity } = store.choice;
      // A ray goes on inside of things.
      if (sceneOpacity === 1 && traces.length === 0) store.set({ sceneOpacity: 0.5 });
      traces = ray === null ? [] : trees.map((tree) => tree.traces.trace(ray));
      stepper.setLength(ray === null ? null : Math.max(...traces.map((trace) => trace.steps.length)));
      picture.draw();
      lookAside();
    }
    if (touches(changed, "ray", "step")) {
      showRay();
      stepper.show();
    }
    if (changed.has("selected")) {
      const { selected } = store.choice;
      if (selected && selected.tree !== store.choice.mapped) store.set({ mapped: selected.tree });
      showSelection();
      details.show();
      treemap.follow();
    }
    if (changed.has("mapped")) treemap.change();
    if (changed.has("metric")) treemap.draw();
    redraw();
  });

  const surfaceMesh = new Mesh(surface, new MeshBasicMaterial({ side: 2 }));
  panes.forEach((pane, i) => {
    pane.onPickNode = (node) => {
      if (store.choice.picks === "node") store.set({ selected: node === null ? null : { tree: i, node } });
    };
    pane.onPickPoint = (raycaster) => {
      if (store.choice.picks !== "ray") return;
      const met = raycaster.intersectObject(surfaceMesh)[0];
      const ray = met ? rays.nearestTo(met.point) : null;
      if (ray !== null) store.set({ ray, step: 0 });
    };
  });

  const fit = () => {
    for (const pane of panes) {
      const area = pane.element.querySelector(".pane-picture")!.getBoundingClientRect();
      pane.setSize(area.width, area.height);
      linked.setAspect(area.width / Math.max(area.height, 1));
    }
    redraw();
  };
  new ResizeObserver(fit).observe(grid);
  const paint = () => {
    colours = paneColours();
    panes.forEach((pane) => pane.setColours(colours));
    showSelection();
    showRay();
    treemap.draw();
    redraw();
  };
  dark.addEventListener("change", paint);
  fit();
  showNodes();
  paint();
}

const root = document.getElementById("view");
if (root) {
  const data = readData();
  if (isPayload(data) && data.structures.length > 0) start(root, data);
  else root.textContent = "There is nothing to show: the page holds no data that it knows.";
}
