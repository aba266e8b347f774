// The bar that steps the picked ray through all structures, forwards and backwards.

import { h } from "../shared/dom";
import { count, number } from "../shared/format";
import type { Store } from "./store";
import type { TestedPrimitives } from "./surface";
import type { Step, Trace } from "./traces";
import type { Tree } from "./tree";

const kindNames = { node: "steps through node", cell: "comes to the cell of leaf", gap: "passes an empty octant of node", leaf: "enters leaf" };

/** A step in words. */
export function describeStep(tree: Tree, step: Step, tested: TestedPrimitives): string {
  if (step.kind === "test") {
    if (tested.kind(step.tested) === "instance") {
      const outcome = step.hit === null ? "without a closer hit" : `with a hit at ${number(step.hit)}`;
      return `goes into ${tested.name(step.tested, count)}, to come back ${outcome}`;
    }
    const outcome = step.hit === null ? "no closer hit" : `hit at ${number(step.hit)}, the closest yet`;
    return `tests ${tested.name(step.tested, count)}: ${outcome}`;
  }
  const level = `level ${tree.depth[step.node] ?? "?"}`;
  const size = tree.isLeaf[step.node] ? `, ${count(tree.metrics.references[step.node] ?? 0)} references` : "";
  return `${kindNames[step.kind]} ${count(step.node)} (${level}${size})`;
}

/** What the walk has come to after some steps, in one line. */
export function describeState(tree: Tree, trace: Trace, taken: number, tested: TestedPrimitives): string {
  const total = trace.steps.length;
  if (total === 0) return "The ray misses the structure: no step.";
  const done = Math.min(taken, total);
  const tests = trace.steps.slice(0, done).filter((step) => step.kind === "test").length;
  const leaves = trace.steps.slice(0, done).filter((step) => step.kind === "leaf").length;
  const so = `${done - tests - leaves} nodes, ${leaves} leaves, ${tests} tests so far`;
  if (done === 0) return `Before the first of ${count(total)} steps`;
  const end = done === total ? (trace.isCut ? " (further steps are not kept)" : " (the end)") : "";
  const hit = trace.steps.slice(0, done).filter((step) => step.hit !== null).at(-1)?.hit;
  const found = hit == null ? "nothing hit yet" : `closest hit at ${number(hit)}`;
  return `${count(done)}/${count(total)}${end}: ${describeStep(tree, trace.steps[done - 1]!, tested)}. ${so}, ${found}`;
}

export class Stepper {
  readonly element: HTMLElement;
  private readonly slider = h("input", { type: "range", min: "0", max: "0", value: "0", "aria-label": "Steps taken" });
  private readonly count = h("output", {});
  private readonly buttons: HTMLButtonElement[] = [];
  private readonly hint = h("p", { class: "note" }, "Pick a ray in the picture, or in a view with “click picks a ray”, to step it through the structures.");
  private readonly play: HTMLButtonElement;
  private timer: number | null = null;
  private last = 0;

  constructor(
    private readonly store: Store,
    lookAside: () => void,
  ) {
    const button = (sign: string, name: string, act: () => void) => {
      const result = h("button", { type: "button", title: name, "aria-label": name }, sign);
      result.addEventListener("click", act);
      this.buttons.push(result);
      return result;
    };
    const first = button("|◀", "First step (Home)", () => this.go(0));
    const previous = button("‹", "Previous step (left arrow)", () => this.move(-1));
    this.play = button("Play", "Play (space)", () => this.togglePlay());
    this.play.classList.add("wide");
    const next = button("›", "Next step (right arrow)", () => this.move(1));
    const end = button("▶|", "Last step (End)", () => this.go(this.last));
    const aside = button("From aside", "Look at the ray from aside", lookAside);
    aside.classList.add("wide");
    this.slider.addEventListener("input", () => this.go(Number(this.slider.value)));
    this.element = h(
      "section",
      { class: "card stepper", "aria-label": "Steps of the ray" },
      h("div", { class: "row" }, first, previous, this.play, next, end, this.slider, this.count, aside),
      this.hint,
    );
    document.addEventListener("keydown", (event) => this.onKey(event));
    this.setLength(null);
  }

  /** How many steps the longest walk of the picked ray has; null without a ray. */
  setLength(length: number | null): void {
    this.last = length ?? 0;
    this.slider.max = String(this.last);
    for (const button of [...this.buttons, this.slider]) button.toggleAttribute("disabled", length === null);
    this.hint.hidden = length !== null;
    if (length === null) this.stop();
    this.show();
  }

  show(): void {
    const { step } = this.store.choice;
    this.slider.value = String(step);
    this.count.textContent = `${count(step)} / ${count(this.last)}`;
    if (step >= this.last) this.stop();
  }

  private go(step: number): void {
    this.store.set({ step: Math.min(Math.max(step, 0), this.last) });
  }

  private move(by: number): void {
    this.stop();
    this.go(this.store.choice.step + by);
  }

  private togglePlay(): void {
    if (this.timer !== null) {
      this.stop();
      return;
    }
    if (this.store.choice.step >= this.last) this.go(0);
    // About half a minute for a long walk.
    this.timer = window.setInterval(() => this.go(this.store.choice.step + 1), Math.min(400, Math.max(60, 20000 / (this.last + 1))));
    this.play.textContent = "Pause";
  }

  private stop(): void {
    if (this.timer !== null) window.clearInterval(this.timer);
    this.timer = null;
    this.play.textContent = "Play";
  }

  private onKey(event: KeyboardEvent): void {
    if (this.store.choice.ray === null || event.altKey || event.ctrlKey || event.metaKey) return;
    const target = event.target;
    // What has keys of its own keeps them.
    if (target instanceof HTMLElement && target.closest("input, select, [role=application], [role=slider]")) return;
    if (event.key === " " && target instanceof HTMLButtonElement) return;
    const acts: Record<string, () => void> = {
      ArrowRight: () => this.move(1),
      ArrowLeft: () => this.move(-1),
      Home: () => this.go(0),
      End: () => this.go(this.last),
      " ": () => this.togglePlay(),
    };
    const act = acts[event.key];
    if (!act) return;
    event.preventDefault();
    act();
  }
}
