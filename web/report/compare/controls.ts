// The bar that stays in sight: which rays and which families of structures the page shows.

import { breakable, h } from "../../shared/dom";
import { familyOf } from "../../shared/theme";
import type { View } from "./view";

/** `parts` are the ids of what can be jumped to. */
export function controlBar(view: View, parts: string[]): HTMLElement {
  const kinds = view.kinds.map((kind) =>
    h("button", { type: "button", "data-rays": kind, "aria-pressed": String(kind === view.rays), onclick: () => (view.rays = kind) }, kind),
  );
  const families = view.families.map((family) =>
    h(
      "button",
      { type: "button", "data-family": family, "aria-pressed": "true", onclick: () => view.toggleFamily(family) },
      familyDot(family),
      family,
    ),
  );
  view.onChange(() => {
    for (const button of kinds) button.setAttribute("aria-pressed", String(button.dataset["rays"] === view.rays));
    for (const button of families) button.setAttribute("aria-pressed", String(view.showsFamily(button.dataset["family"] ?? "")));
  });
  return h(
    "div",
    { class: "bar controls screen-only" },
    h(
      "div",
      { class: "control" },
      h("span", { class: "control-name" }, "Rays"),
      h("div", { class: "segments", role: "group", "aria-label": "Kind of rays" }, kinds),
    ),
    h(
      "div",
      { class: "control" },
      h("span", { class: "control-name" }, "Show"),
      h("div", { class: "chips", role: "group", "aria-label": "Families of structures" }, families),
    ),
    h(
      "nav",
      { class: "jump", "aria-label": "Parts of the report" },
      parts.map((id) => h("a", { href: `#${id}` }, id.replace("-", " "))),
    ),
  );
}

/** A dot in the colour of a family. */
export function familyDot(family: string): HTMLElement {
  return h("span", { class: "dot", style: `--dot: var(--family-${family})`, "aria-hidden": "true" });
}

/** The name of a structure with the dot of its family, which may be broken into lines. */
export function structureName(structure: string): HTMLElement {
  return h("span", { class: "structure" }, familyDot(familyOf(structure)), breakable(structure));
}

/** Boxes to choose structures by, folded away; calls back with those that are chosen. */
export function picker(structures: string[], chosen: string[], changed: (chosen: string[]) => void): HTMLElement {
  const boxes = structures.map((structure) => {
    const box = h("input", { type: "checkbox", checked: chosen.includes(structure), onchange: () => report() });
    box.value = structure;
    return box;
  });
  function report(): void {
    changed(boxes.filter((box) => box.checked).map((box) => box.value));
  }
  const all = (checked: boolean) => () => {
    boxes.forEach((box) => (box.checked = checked));
    report();
  };
  return h(
    "details",
    { class: "picker screen-only" },
    h("summary", {}, "Choose structures"),
    h(
      "div",
      { class: "picker-all" },
      h("button", { type: "button", onclick: all(true) }, "all"),
      h("button", { type: "button", onclick: all(false) }, "none"),
    ),
    h(
      "div",
      { class: "picker-boxes" },
      boxes.map((box) => h("label", {}, box, structureName(box.value))),
    ),
  );
}
