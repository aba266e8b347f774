// The picture that the recorded rays make: shaded, or coloured by the steps that a structure takes. A click picks a ray.

import { h } from "../shared/dom";
import { count } from "../shared/format";
import { cssColour, LogScale } from "./palette";
import { readBytes } from "./bytes";
import type { Payload } from "./payload";
import type { Rays } from "./rays";
import type { Store } from "./store";
import type { Tree } from "./tree";

export class Picture {
  readonly element: HTMLElement;
  private readonly canvas = h("canvas", { tabindex: "0", role: "application" });
  private readonly source = h("select", { id: "picture-source" });
  private readonly note = h("p", { class: "note" });
  private readonly shades: Uint8Array;
  private readonly offset: number;

  constructor(
    private readonly payload: Payload,
    private readonly rays: Rays,
    private readonly trees: Tree[],
    private readonly store: Store,
  ) {
    const { width, height, shades } = payload.picture;
    this.shades = readBytes(shades);
    this.offset = 2;
    this.canvas.width = 2 * width;
    this.canvas.height = 2 * height;
    this.canvas.setAttribute("aria-label", "The scene as its camera sees it. Click, or move with the arrow keys, to pick a ray.");
    this.source.append(h("option", { value: "-1" }, "the surface"));
    trees.forEach((tree, i) => this.source.append(h("option", { value: String(i) }, `steps of ${tree.name}`)));
    this.element = h(
      "section",
      { class: "card picture" },
      h("h2", {}, "Pick a ray"),
      this.canvas,
      h("p", { class: "row" }, h("label", { for: "picture-source" }, "Picture of "), this.source),
      this.note,
    );
    this.source.addEventListener("change", () => this.draw());
    // The mouse leaves the arrow keys to the steps; who comes by keyboard moves the ray with them.
    this.canvas.addEventListener("mousedown", (event) => {
      event.preventDefault();
      if (document.activeElement instanceof HTMLElement) document.activeElement.blur();
    });
    this.canvas.addEventListener("click", (event) => this.pickAt(event));
    this.canvas.addEventListener("keydown", (event) => this.move(event));
    this.draw();
  }

  draw(): void {
    const context = this.canvas.getContext("2d");
    if (!context) return;
    const { width, height } = this.payload.picture;
    const small = h("canvas", { width: String(width), height: String(height) });
    const image = new ImageData(width, height);
    const colour = this.colours();
    for (let y = 0; y < height; ++y) {
      for (let x = 0; x < width; ++x) image.data.set(colour(x, y), 4 * (y * width + x));
    }
    small.getContext("2d")?.putImageData(image, 0, 0);
    context.imageSmoothingEnabled = true;
    context.drawImage(small, 0, 0, this.canvas.width, this.canvas.height);
    this.drawMark(context);
  }

  private colours(): (x: number, y: number) => [number, number, number, number] {
    const { width } = this.payload.picture;
    const tree = this.trees[Number(this.source.value)];
    const known = `${count(this.rays.rays.length)} rays, one in ${this.payload.rays.stride} each way, can be picked.`;
    if (!tree) {
      this.note.textContent = known;
      return (x, y) => {
        const shade = this.shades[y * width + x] ?? 0;
        return shade === 0 ? [24, 32, 48, 255] : [shade, shade, shade, 255];
      };
    }
    // The same scale for all, so that they can be compared.
    const scale = new LogScale(this.trees.map((each) => each.picture.steps));
    this.note.textContent = `Dark is ${count(scale.min)} steps (nodes and tests), bright ${count(scale.max)}. ${known}`;
    const { width: columns, height: rows, steps } = tree.picture;
    const cache = new Map<number, [number, number, number, number]>();
    return (x, y) => {
      const column = Math.min(Math.floor((x * columns) / width), columns - 1);
      const row = Math.min(Math.floor((y * rows) / this.payload.picture.height), rows - 1);
      const value = steps[row * columns + column] ?? 0;
      let colour = cache.get(value);
      if (!colour) {
        const parts = cssColour(scale.place(value) ?? 0).match(/\d+/g)!.map(Number);
        colour = [parts[0]!, parts[1]!, parts[2]!, 255];
        cache.set(value, colour);
      }
      return colour;
    };
  }

  private drawMark(context: CanvasRenderingContext2D): void {
    const { ray } = this.store.choice;
    if (ray === null) return;
    const { stride } = this.payload.rays;
    const x = 2 * ((ray % this.rays.columns) * stride + this.offset + 0.5);
    const y = 2 * (Math.floor(ray / this.rays.columns) * stride + this.offset + 0.5);
    for (const [colour, width] of [["#000", 5], ["#ff3d7f", 2.5]] as const) {
      context.strokeStyle = colour;
      context.lineWidth = width;
      context.beginPath();
      context.arc(x, y, 12, 0, 2 * Math.PI);
      context.moveTo(x - 22, y);
      context.lineTo(x - 4, y);
      context.moveTo(x + 4, y);
      context.lineTo(x + 22, y);
      context.moveTo(x, y - 22);
      context.lineTo(x, y - 4);
      context.moveTo(x, y + 4);
      context.lineTo(x, y + 22);
      context.stroke();
    }
  }

  private pickAt(event: MouseEvent): void {
    const area = this.canvas.getBoundingClientRect();
    const { width, height } = this.payload.picture;
    const place = (part: number, size: number, count: number) =>
      Math.min(Math.max(Math.round((part * size - this.offset - 0.5) / this.payload.rays.stride), 0), count - 1);
    const column = place((event.clientX - area.left) / area.width, width, this.rays.columns);
    const row = place((event.clientY - area.top) / area.height, height, this.rays.rows);
    this.store.set({ ray: row * this.rays.columns + column, step: 0 });
  }

  private move(event: KeyboardEvent): void {
    const moves: Record<string, [number, number]> = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
    const move = moves[event.key];
    if (!move) return;
    event.preventDefault();
    const { columns, rows } = this.rays;
    const at = this.store.choice.ray ?? Math.floor(rows / 2) * columns + Math.floor(columns / 2);
    const column = Math.min(Math.max((at % columns) + move[0], 0), columns - 1);
    const row = Math.min(Math.max(Math.floor(at / columns) + move[1], 0), rows - 1);
    this.store.set({ ray: row * columns + column, step: 0 });
  }
}
