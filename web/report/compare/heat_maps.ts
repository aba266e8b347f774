// Pictures of the scene in which a pixel's colour is how many steps its ray takes: all structures side by side at one scale, whose top a
// slider moves. The place that is pointed at in one is read in all.

import { h } from "../../shared/dom";
import { count, number } from "../../shared/format";
import type { HeatMaps } from "../types";
import { colorCount, colors, gradient } from "./color_scale";
import { picker, structureName } from "./controls";
import { bestOfFamilies, type View } from "./view";

interface Picture {
  structure: string;
  steps: Uint16Array;
  canvas: HTMLCanvasElement;
  mark: HTMLElement;
  value: HTMLElement;
  element: HTMLElement;
}

/** Positions of the slider. */
const sliderSteps = 200;

export function heatMapsFigure(view: View, maps: HeatMaps): HTMLElement {
  const pictures = maps.maps.map((map) => pictureOf(map, maps, point));
  const top = Math.max(2, ...maps.maps.map((map) => map.max));
  let chosen = initial(view, pictures);

  const slider = h("input", {
    type: "range",
    min: 0,
    max: sliderSteps,
    step: 1,
    id: "heat-maximum",
    "aria-describedby": "heat-top",
    oninput: () => paintAll(),
  });
  // Steps are spread over decades, so the slider is too.
  const maximum = () => 2 * (top / 2) ** (Number(slider.value) / sliderSteps);
  const positionOf = (value: number) => Math.round((sliderSteps * Math.log(Math.max(1, value / 2))) / Math.log(Math.max(2, top / 2)));
  slider.value = String(positionOf(usualTop(pictures.filter((picture) => chosen.includes(picture.structure)))));
  const half = h("span", {});
  const end = h("output", { id: "heat-top", for: "heat-maximum" });

  function paintAll(): void {
    const value = maximum();
    half.textContent = number(value / 2);
    end.textContent = `${number(value)} steps${value < top - 0.5 ? " and more" : ""}`;
    slider.setAttribute("aria-valuetext", end.textContent);
    for (const picture of pictures) {
      picture.element.hidden = !chosen.includes(picture.structure) || !view.shows(picture.structure);
      if (!picture.element.hidden) paint(picture, value);
    }
  }

  /** Shows what all pictures have at a place; outside of them their means. */
  function point(x: number, y: number): void {
    const inside = x >= 0 && y >= 0 && x < maps.width && y < maps.height;
    for (const picture of pictures) {
      picture.mark.hidden = !inside;
      picture.mark.style.left = `${(100 * (x + 0.5)) / maps.width}%`;
      picture.mark.style.top = `${(100 * (y + 0.5)) / maps.height}%`;
      picture.value.textContent = inside
        ? `${count(picture.steps[y * maps.width + x])} steps here`
        : `${number(mean(picture.steps))} steps on average`;
    }
  }

  point(-1, -1);
  paintAll();
  view.onChange(paintAll);
  return h(
    "div",
    { class: "heat" },
    h(
      "div",
      { class: "heat-scale" },
      h("label", { for: "heat-maximum" }, "Top of the scale"),
      slider,
      h(
        "div",
        { class: "heat-legend" },
        h("div", { class: "heat-gradient", style: `background: ${gradient()}` }),
        h("div", { class: "heat-ticks" }, h("span", {}, "0"), half, end),
      ),
    ),
    picker(
      pictures.map((picture) => picture.structure),
      chosen,
      (next) => {
        chosen = next;
        paintAll();
      },
    ),
    h(
      "div",
      { class: "heat-pictures" },
      pictures.map((picture) => picture.element),
    ),
  );
}

/** At first one of each family, and all where there are few. */
function initial(view: View, pictures: Picture[]): string[] {
  const all = pictures.map((picture) => picture.structure);
  if (all.length <= 9) return all;
  const best = bestOfFamilies(view.rows());
  const chosen = all.filter((structure) => best.includes(structure));
  return chosen.length > 0 ? chosen : all.slice(0, 6);
}

/** All but one in two hundred of the pixels lie below it. */
function usualTop(pictures: Picture[]): number {
  const sample: number[] = [];
  for (const picture of pictures) {
    if (picture.structure === "brute") continue;
    for (let i = 0; i < picture.steps.length; i += 7) sample.push(picture.steps[i] ?? 0);
  }
  sample.sort((a, b) => a - b);
  return Math.max(2, sample[Math.floor(0.995 * (sample.length - 1))] ?? 2);
}

function mean(steps: Uint16Array): number {
  let sum = 0;
  for (const one of steps) sum += one;
  return sum / Math.max(1, steps.length);
}

function pictureOf(map: HeatMaps["maps"][number], maps: HeatMaps, point: (x: number, y: number) => void): Picture {
  const canvas = h("canvas", {
    width: maps.width,
    height: maps.height,
    tabindex: 0,
    role: "img",
    "aria-label": `Steps of the ray through each pixel with ${map.structure}; arrow keys read single pixels`,
  });
  const mark = h("span", { class: "heat-mark", "aria-hidden": "true" });
  const value = h("span", { class: "lead", "aria-live": "polite" });
  let [x, y] = [Math.floor(maps.width / 2), Math.floor(maps.height / 2)];
  const at = (event: PointerEvent) => {
    const box = canvas.getBoundingClientRect();
    x = Math.floor(((event.clientX - box.left) / box.width) * maps.width);
    y = Math.floor(((event.clientY - box.top) / box.height) * maps.height);
    point(x, y);
  };
  canvas.addEventListener("pointermove", at);
  canvas.addEventListener("pointerdown", at);
  canvas.addEventListener("pointerleave", () => point(-1, -1));
  canvas.addEventListener("blur", () => point(-1, -1));
  canvas.addEventListener("keydown", (event) => {
    const move = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[event.key];
    if (!move) return;
    event.preventDefault();
    const far = event.shiftKey ? 10 : 1;
    x = Math.min(maps.width - 1, Math.max(0, x + far * (move[0] ?? 0)));
    y = Math.min(maps.height - 1, Math.max(0, y + far * (move[1] ?? 0)));
    point(x, y);
  });
  const element = h(
    "figure",
    { class: "heat-picture" },
    h("div", { class: "heat-frame" }, canvas, mark),
    h("figcaption", {}, structureName(map.structure), value),
  );
  return { structure: map.structure, steps: decode(map.steps, maps.width * maps.height), canvas, mark, value, element };
}

/** Little-endian 16-bit numbers in base64; what is missing is zero. */
export function decode(base64: string, length: number): Uint16Array {
  const text = atob(base64);
  const steps = new Uint16Array(length);
  for (let i = 0; i < length && 2 * i + 1 < text.length; ++i) steps[i] = text.charCodeAt(2 * i) | (text.charCodeAt(2 * i + 1) << 8);
  return steps;
}

function paint(picture: Picture, maximum: number): void {
  const context = picture.canvas.getContext("2d");
  if (!context) return;
  const { width, height } = picture.canvas;
  const image = context.createImageData(width, height);
  const scale = (colorCount - 1) / maximum;
  for (let i = 0; i < picture.steps.length; ++i) {
    const at = 4 * Math.min(colorCount - 1, Math.round((picture.steps[i] ?? 0) * scale));
    image.data.set(colors.subarray(at, at + 4), 4 * i);
  }
  context.putImageData(image, 0, 0);
}
