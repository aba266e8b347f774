// A ray in a picture of a structure, as far as it has been stepped: where it goes, the nodes that it has come to, and what it was tested against.

import {
  BufferAttribute, BufferGeometry, Color, CylinderGeometry, DoubleSide, Group, Line, LineBasicMaterial, Mesh, MeshBasicMaterial, Quaternion,
  SphereGeometry, Vector3,
} from "three";
import { Boxes } from "./boxes";
import { stretchIn, type Ray, type Rays } from "./rays";
import type { TestedPrimitives } from "./surface";
import type { Step, Trace } from "./traces";
import type { Tree } from "./tree";

export interface RayColours {
  ray: Color;
  visited: Color;
  current: Color;
  miss: Color;
  hit: Color;
}

const upwards = new Vector3(0, 1, 0);

/** Where a step is: a box as in Tree.box. */
function boxOfStep(tree: Tree, step: Step): ArrayLike<number> | null {
  if (step.kind === "gap") return tree.octantBox(step.node, step.octant);
  return step.node >= 0 ? tree.box.subarray(6 * step.node, 6 * step.node + 6) : null;
}

/** Whether a step finds a hit itself, not by way of an instance's object. */
function hits(step: Step, tested: TestedPrimitives): boolean {
  return step.hit !== null && tested.kind(step.tested) !== "instance";
}

/** How far along the ray a step is. */
function distanceOfStep(tree: Tree, ray: Ray, step: Step, scale: number, tested: TestedPrimitives): number {
  if (step.hit !== null && hits(step, tested)) return step.hit * scale;
  const box = boxOfStep(tree, step);
  return (box && stretchIn(ray, box)?.from) ?? 0;
}

export class RayDrawing {
  readonly group = new Group();
  private readonly visited = new Boxes(5, "always");
  private readonly current = new Boxes(6, "always");
  private readonly testedBox = new Boxes(7, "always");
  private readonly whole = new Line(new BufferGeometry(), new LineBasicMaterial({ transparent: true, opacity: 0.7, depthTest: false }));
  private readonly travelled = new Mesh(new CylinderGeometry(1, 1, 1, 8), new MeshBasicMaterial({ depthTest: false, transparent: true }));
  private readonly front = new Mesh(new SphereGeometry(1, 16, 12), new MeshBasicMaterial({ depthTest: false, transparent: true }));
  private readonly triangles = new Mesh(
    new BufferGeometry(),
    new MeshBasicMaterial({ vertexColors: true, side: DoubleSide, transparent: true, opacity: 0.5, depthTest: false }),
  );

  constructor() {
    this.visited.setOpacity(0.75, 0);
    this.current.setOpacity(1, 0.22);
    this.testedBox.setOpacity(1, 0.25);
    this.whole.renderOrder = 8;
    this.triangles.renderOrder = 9;
    this.travelled.renderOrder = 10;
    this.front.renderOrder = 11;
    for (const object of [this.whole, this.travelled, this.front, this.triangles]) object.frustumCulled = false;
    this.group.add(
      this.visited.group, this.current.group, this.testedBox.group, this.whole, this.travelled, this.front, this.triangles,
    );
    this.group.visible = false;
  }

  hide(): void {
    this.group.visible = false;
  }

  /** After `taken` steps. */
  show(tree: Tree, rays: Rays, ray: Ray, trace: Trace, taken: number, tested: TestedPrimitives, colours: RayColours): void {
    this.group.visible = true;
    const done = trace.steps.slice(0, taken);
    const last = done.at(-1);
    const end = ray.distance ?? (stretchIn(ray, tree.box.subarray(0, 6))?.to ?? 10) + 1;
    const at = (distance: number) => ray.origin.clone().addScaledVector(ray.direction, distance);
    this.whole.geometry.dispose();
    this.whole.geometry = new BufferGeometry().setFromPoints([ray.origin, at(end)]);
    this.whole.material.color.copy(colours.ray);

    const reached = last ? Math.min(distanceOfStep(tree, ray, last, rays.scale, tested), end) : 0;
    const middle = at(reached / 2);
    this.travelled.position.copy(middle);
    this.travelled.quaternion.copy(new Quaternion().setFromUnitVectors(upwards, ray.direction));
    this.travelled.scale.set(1, Math.max(reached, 1e-6), 1);
    this.travelled.material.color.copy(colours.ray);
    this.front.position.copy(at(reached));
    this.front.material.color.copy(last && hits(last, tested) ? colours.hit : colours.ray);

    const places = new Map<string, ArrayLike<number>>();
    for (const step of done) {
      const box = step.kind === "test" ? null : boxOfStep(tree, step);
      if (box) places.set(`${step.node}/${step.kind === "gap" ? step.octant : ""}`, box);
    }
    const currentBox = last ? boxOfStep(tree, last) : null;
    fill(this.visited, [...places.values()], colours.visited);
    fill(this.current, currentBox ? [currentBox] : [], colours.current);
    this.showTested(done, last, tested, colours);
  }

  /** The thickness of the ray and its front, in drawing units. */
  setThickness(radius: number): void {
    this.travelled.scale.x = radius;
    this.travelled.scale.z = radius;
    this.front.scale.setScalar(2.5 * radius);
  }

  private showTested(done: Step[], last: Step | undefined, tested: TestedPrimitives, colours: RayColours): void {
    const closest = [...done].reverse().find((step) => hits(step, tested));
    const shown = done.filter((step) => step.kind === "test" && (step === last || step === closest));
    const colourOf = (step: Step) => (hits(step, tested) ? colours.hit : colours.miss);
    const triangles = shown.filter((step) => tested.kind(step.tested) === "triangle");
    const others = shown.filter((step) => tested.kind(step.tested) !== "triangle");
    fill(this.testedBox, others.map((step) => tested.shape(step.tested)), others[0] ? colourOf(others.at(-1)!) : colours.miss);
    this.triangles.visible = triangles.length > 0;
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(Float32Array.from(triangles.flatMap((step) => [...tested.shape(step.tested)])), 3));
    geometry.setAttribute(
      "color",
      new BufferAttribute(Float32Array.from(triangles.flatMap((step) => [0, 1, 2].flatMap(() => colourOf(step).toArray()))), 3),
    );
    this.triangles.geometry.dispose();
    this.triangles.geometry = geometry;
  }
}

function fill(boxes: Boxes, list: ArrayLike<number>[], colour: Color): void {
  const [r, g, b] = colour.clone().convertLinearToSRGB().toArray() as [number, number, number];
  boxes.set(
    list.flatMap((box) => Array.from(box)),
    Float32Array.from(list.flatMap(() => [r, g, b])),
  );
}
