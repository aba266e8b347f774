// Many axis-aligned boxes in two draw calls: their edges as lines and their faces as glass. A box without extent along an axis is a plane.

import {
  BufferAttribute, DoubleSide, Group, InstancedBufferAttribute, InstancedBufferGeometry, LineSegments, Mesh, ShaderMaterial,
} from "three";

/** A cube's corners: bit 0, 1, 2 of a number is set where x, y, z is 1. */
const corner = (i: number) => [i & 1, (i >> 1) & 1, (i >> 2) & 1];
const edges = [0, 1, 2, 3, 4, 5, 6, 7, 0, 2, 1, 3, 4, 6, 5, 7, 0, 4, 1, 5, 2, 6, 3, 7];
const faces = [
  0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4, 2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5,
];

const vertexShader = `
attribute vec3 lower;
attribute vec3 size;
attribute vec3 tint;
varying vec3 colour;
void main() {
  colour = tint;
  gl_Position = projectionMatrix * modelViewMatrix * vec4(lower + position * size, 1.0);
}`;
const fragmentShader = `
uniform float opacity;
varying vec3 colour;
void main() {
  gl_FragColor = vec4(colour, opacity);
}`;

function material(depthTest: boolean): ShaderMaterial {
  return new ShaderMaterial({
    vertexShader, fragmentShader, uniforms: { opacity: { value: 1 } }, transparent: true, depthTest, depthWrite: false, side: DoubleSide,
  });
}

export class Boxes {
  readonly group = new Group();
  private readonly lineMaterial: ShaderMaterial;
  private readonly faceMaterial: ShaderMaterial;
  private readonly lines: LineSegments;
  private readonly glass: Mesh;

  /** Of a higher order are drawn over those of a lower. */
  constructor(order: number, seen: "where not hidden" | "always") {
    this.lineMaterial = material(seen !== "always");
    this.faceMaterial = material(seen !== "always");
    this.lines = new LineSegments(new InstancedBufferGeometry(), this.lineMaterial);
    this.glass = new Mesh(new InstancedBufferGeometry(), this.faceMaterial);
    for (const object of [this.glass, this.lines]) {
      object.frustumCulled = false;
      object.renderOrder = order;
      this.group.add(object);
    }
    this.group.visible = false;
  }

  /** Boxes as lower x, y, z and upper x, y, z each; colours as red, green and blue from 0 to 1. */
  set(boxes: ArrayLike<number>, colours: Float32Array): void {
    const count = boxes.length / 6;
    const lower = new Float32Array(3 * count);
    const size = new Float32Array(3 * count);
    for (let i = 0; i < count; ++i) {
      for (let axis = 0; axis < 3; ++axis) {
        lower[3 * i + axis] = boxes[6 * i + axis]!;
        size[3 * i + axis] = boxes[6 * i + 3 + axis]! - boxes[6 * i + axis]!;
      }
    }
    const shared = { lower, size, tint: colours };
    this.fill(this.lines, edges, shared, count);
    this.fill(this.glass, faces, shared, count);
    this.group.visible = count > 0;
  }

  setOpacity(lines: number, glass: number): void {
    this.lineMaterial.uniforms.opacity!.value = lines;
    this.faceMaterial.uniforms.opacity!.value = glass;
    this.lines.visible = lines > 0;
    this.glass.visible = glass > 0;
  }

  private fill(object: LineSegments | Mesh, corners: number[], columns: Record<string, Float32Array>, count: number): void {
    const geometry = new InstancedBufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(Float32Array.from(corners.flatMap(corner)), 3));
    for (const [name, column] of Object.entries(columns)) geometry.setAttribute(name, new InstancedBufferAttribute(column, 3));
    geometry.instanceCount = count;
    object.geometry.dispose();
    object.geometry = geometry;
  }
}
