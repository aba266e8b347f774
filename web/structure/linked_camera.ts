// One camera for all pictures: turning one turns them all.

import { PerspectiveCamera, Vector3 } from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import type { Payload } from "./payload";
import type { Space } from "./space";

const pictureAspect = 16 / 9;

export class LinkedCamera {
  readonly camera: PerspectiveCamera;
  readonly target = new Vector3();
  private readonly controls: OrbitControls[] = [];
  private readonly fieldOfView: number;
  private readonly home: { eye: Vector3; target: Vector3 };

  constructor(
    payload: Payload,
    space: Space,
    centreDistance: number,
    private readonly onMove: () => void,
  ) {
    const { eye, forward, up, vertical_field_of_view } = payload.camera;
    this.fieldOfView = vertical_field_of_view;
    this.camera = new PerspectiveCamera((vertical_field_of_view * 180) / Math.PI, pictureAspect, 0.002, 2000);
    // Turning goes about the axis that is nearest to the camera's up.
    const axis = [0, 1, 2].reduce((best, i) => (Math.abs(up[i]!) > Math.abs(up[best]!) ? i : best), 0);
    this.camera.up.set(0, 0, 0).setComponent(axis, Math.sign(up[axis]!) || 1);
    const start = space.point(eye);
    this.home = { eye: start, target: start.clone().addScaledVector(new Vector3(...forward), centreDistance) };
    this.camera.position.copy(start);
    this.target.copy(this.home.target);
    this.camera.lookAt(this.target);
  }

  control(canvas: HTMLCanvasElement): OrbitControls {
    const controls = new OrbitControls(this.camera, canvas);
    controls.target = this.target;
    controls.addEventListener("change", this.onMove);
    controls.update();
    this.controls.push(controls);
    return controls;
  }

  /** A narrower view than the scene's shows as much from side to side, and more above and below. */
  setAspect(aspect: number): void {
    this.camera.aspect = aspect;
    const narrowing = Math.max(1, pictureAspect / aspect);
    this.camera.fov = (2 * Math.atan(Math.tan(this.fieldOfView / 2) * narrowing) * 180) / Math.PI;
    this.camera.updateProjectionMatrix();
  }

  distance(): number {
    return this.camera.position.distanceTo(this.target);
  }

  /** Back to the scene's camera. */
  goHome(): void {
    this.moveTo(this.home.eye, this.home.target);
  }

  /** Looks at a stretch of a ray from aside. */
  lookAside(from: Vector3, to: Vector3): void {
    const along = to.clone().sub(from);
    const length = Math.max(along.length(), 1e-3);
    const middle = from.clone().lerp(to, 0.6);
    const side = along.clone().cross(this.camera.up);
    if (side.lengthSq() < 1e-12) side.set(1, 0, 0);
    const away = side.normalize().multiplyScalar(0.85).addScaledVector(this.camera.up, 0.45).addScaledVector(along, -0.25 / length);
    const reach = (0.75 * length) / Math.tan((this.camera.fov * Math.PI) / 360);
    this.moveTo(middle.clone().addScaledVector(away.normalize(), Math.min(Math.max(reach, 0.01), 30)), middle);
  }

  private moveTo(eye: Vector3, target: Vector3): void {
    this.camera.position.copy(eye);
    this.target.copy(target);
    this.camera.lookAt(target);
    this.camera.updateMatrixWorld();
    for (const controls of this.controls) controls.update();
    this.onMove();
  }
}
