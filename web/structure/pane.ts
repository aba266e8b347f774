// A picture of one structure in three dimensions.

import {
  AmbientLight, Color, DirectionalLight, DoubleSide, Mesh, MeshLambertMaterial, Raycaster, Scene, Vector2, WebGLRenderer, type BufferGeometry,
} from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { h } from "../shared/dom";
import { count } from "../shared/format";
import { Boxes } from "./boxes";
import type { LinkedCamera } from "./linked_camera";
import type { LogScale } from "./palette";
import { RayDrawing, type RayColours } from "./ray_drawing";
import { stretchIn, type Ray } from "./rays";
import { shownNodes, shownNote, type Shown } from "./shown";
import type { Choice } from "./store";
import type { Tree } from "./tree";

export interface PaneColours extends RayColours {
  background: Color;
  surface: Color;
}

export class Pane {
  readonly element: HTMLElement;
  readonly rayDrawing = new RayDrawing();
  readonly controls: OrbitControls | null = null;
  onPickNode: (node: number | null) => void = () => {};
  onPickPoint: (raycaster: Raycaster) => void = () => {};
  private readonly canvas = h("canvas", { tabindex: "0" });
  private readonly note = h("p", { class: "note" });
  private readonly state = h("p", { class: "pane-step", "aria-live": "polite" });
  private readonly renderer: WebGLRenderer | null;
  private readonly scene = new Scene();
  private readonly nodes = new Boxes(2, "where not hidden");
  private readonly selection = new Boxes(4, "always");
  private readonly light = new DirectionalLight(0xffffff, 2.2);
  private readonly material = new MeshLambertMaterial({ side: DoubleSide, flatShading: true });
  private shown: Shown | null = null;
  private lastPick: { x: number; y: number; turn: number } | null = null;

  constructor(
    readonly tree: Tree,
    surface: BufferGeometry,
    private readonly linked: LinkedCamera,
  ) {
    this.canvas.setAttribute("aria-label", `${tree.name} in three dimensions: drag to turn, pinch or scroll to come closer, click to pick`);
    this.element = h(
      "section",
      { class: "pane" },
      h("h2", {}, tree.name),
      h("p", { class: "pane-figures" }, figuresOf(tree)),
      h("div", { class: "pane-picture" }, this.canvas, this.state),
      this.note,
    );
    this.renderer = makeRenderer(this.canvas);
    if (!this.renderer) {
      this.canvas.replaceWith(h("p", { class: "missing" }, "The browser cannot draw in three dimensions here (WebGL is off). All else works."));
      return;
    }
    this.scene.add(new AmbientLight(0xffffff, 1.1), this.light, new Mesh(surface, this.material));
    this.scene.add(this.nodes.group, this.selection.group, this.rayDrawing.group);
    this.selection.setOpacity(1, 0.18);
    this.controls = linked.control(this.canvas);
    this.listen();
  }

  setSize(width: number, height: number): void {
    this.renderer?.setPixelRatio(Math.min(window.devicePixelRatio, 2));
    this.renderer?.setSize(width, height, false);
  }

  setColours(colours: PaneColours): void {
    this.scene.background = colours.background;
    this.material.color.copy(colours.surface);
  }

  showNodes(choice: Choice, scale: LogScale): void {
    this.shown = shownNodes(this.tree, choice, scale);
    this.nodes.set(this.shown.boxes, this.shown.colours);
    this.setOpacities(choice);
    this.note.textContent = shownNote(this.tree, this.shown, choice, count);
  }

  setOpacities(choice: Choice): void {
    // Beside a ray the nodes that it comes to count.
    const nodeOpacity = choice.nodeOpacity * (choice.ray === null ? 1 : 0.25);
    // Glass behind glass adds up: level behind level, and box behind box.
    const levels = choice.to - choice.from + 1;
    const behind = Math.cbrt(Math.max((this.shown?.drawn ?? 0) / levels / 100, 1));
    this.nodes.setOpacity(nodeOpacity, (0.12 * nodeOpacity ** 2) / levels / behind);
    this.material.opacity = choice.sceneOpacity;
    this.material.visible = choice.sceneOpacity > 0;
    const isTransparent = choice.sceneOpacity < 1;
    if (this.material.transparent !== isTransparent) {
      this.material.transparent = isTransparent;
      this.material.depthWrite = !isTransparent;
      this.material.needsUpdate = true;
    }
  }

  select(node: number | null, colour: Color): void {
    const box = node === null ? [] : this.tree.box.subarray(6 * node, 6 * node + 6);
    this.selection.set(box, Float32Array.from(colour.clone().convertLinearToSRGB().toArray()));
  }

  setStateText(text: string): void {
    this.state.textContent = text;
  }

  draw(): void {
    if (!this.renderer) return;
    this.rayDrawing.setThickness(0.0022 * this.linked.distance());
    // The light comes along with the eye.
    this.light.position.set(0.3, 0.6, 1).applyQuaternion(this.linked.camera.quaternion);
    this.renderer.render(this.scene, this.linked.camera);
  }

  private listen(): void {
    let down: PointerEvent | null = null;
    this.canvas.addEventListener("pointerdown", (event) => (down = event));
    this.canvas.addEventListener("pointerup", (event) => {
      const isClick = down !== null && Math.hypot(event.clientX - down.clientX, event.clientY - down.clientY) < 5 && down.button === 0;
      down = null;
      if (isClick) this.pick(event);
    });
  }

  private pick(event: PointerEvent): void {
    const area = this.canvas.getBoundingClientRect();
    const place = new Vector2((2 * (event.clientX - area.left)) / area.width - 1, 1 - (2 * (event.clientY - area.top)) / area.height);
    const raycaster = new Raycaster();
    raycaster.setFromCamera(place, this.linked.camera);
    this.onPickPoint(raycaster);
    // A further click at the same place picks the next node there.
    const isSame = this.lastPick && Math.hypot(event.clientX - this.lastPick.x, event.clientY - this.lastPick.y) < 4;
    this.lastPick = { x: event.clientX, y: event.clientY, turn: isSame ? this.lastPick!.turn + 1 : 0 };
    const found = this.nodesAt({ origin: raycaster.ray.origin, direction: raycaster.ray.direction, distance: null });
    this.onPickNode(found.length > 0 ? found[this.lastPick.turn % found.length]! : null);
  }

  /** The drawn nodes that a ray meets: the deepest level first, and of one level the nearest. */
  private nodesAt(ray: Ray): number[] {
    const { nodes, boxes } = this.shown ?? { nodes: [], boxes: [] };
    const entries = new Map<number, number>();
    nodes.forEach((node, i) => {
      const stretch = stretchIn(ray, boxes.slice(6 * i, 6 * i + 6));
      if (stretch) entries.set(node, Math.min(stretch.from, entries.get(node) ?? Infinity));
    });
    const { depth } = this.tree;
    return [...entries.keys()].sort((a, b) => depth[b]! - depth[a]! || entries.get(a)! - entries.get(b)!);
  }
}

function makeRenderer(canvas: HTMLCanvasElement): WebGLRenderer | null {
  try {
    return new WebGLRenderer({ canvas, antialias: true });
  } catch {
    return null;
  }
}

function figuresOf(tree: Tree): string {
  const tests = tree.metrics.tests[0]! / tree.sampledRays;
  const steps = tree.picture.steps.reduce((sum, value) => sum + value, 0) / tree.picture.steps.length;
  return `${count(tree.total)} nodes, depth ${String(tree.figures.depth)}, ${steps.toFixed(1)} steps and ${tests.toFixed(1)} tests per ray`;
}
