/** Perspective and orthographic views of one scene, with smooth flights between them. */

import { OrthographicCamera, PerspectiveCamera, Vector3 } from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import type { Box } from "../api/types";
import { DEPTH, distanceTo, FIELD_OF_VIEW, middleOf, radiusOf, START_DIRECTION } from "./look";

export type ViewName = "perspective" | "top" | "front" | "left";

const FLIGHT_MS = 280;
/** Steps of the keys: radians, share of the height of the view, factor. */
const KEY_STEP = { orbit: Math.PI / 24, pan: 0.08, zoom: 0.85 };
const DIRECTIONS: Record<ViewName, Vector3> = {
  perspective: new Vector3(...START_DIRECTION),
  // Not exactly from above, where the direction of "up" on the screen would be undefined.
  top: new Vector3(0, -0.0005, 1).normalize(),
  front: new Vector3(0, -1, 0),
  left: new Vector3(-1, 0, 0),
};

export class Cameras {
  readonly perspective = new PerspectiveCamera(FIELD_OF_VIEW, 1, 0.01, 1000);
  readonly orthographic = new OrthographicCamera(-1, 1, 1, -1, -1000, 1000);
  readonly controls: OrbitControls;
  view: ViewName = "perspective";
  private aspect = 1;
  private flight = 0;

  constructor(
    element: HTMLElement,
    private readonly onChange: () => void,
  ) {
    for (const camera of [this.perspective, this.orthographic]) camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.perspective, element);
    this.controls.enableDamping = false;
    this.controls.screenSpacePanning = true;
    this.controls.zoomToCursor = true;
    this.controls.addEventListener("change", onChange);
    this.controls.addEventListener("start", () => cancelAnimationFrame(this.flight));
  }

  get active(): PerspectiveCamera | OrthographicCamera {
    return this.view === "perspective" ? this.perspective : this.orthographic;
  }

  resize(width: number, height: number): void {
    this.aspect = width / Math.max(height, 1);
    this.perspective.aspect = this.aspect;
    this.perspective.updateProjectionMatrix();
    this.setOrthographicHeight(this.orthographic.top - this.orthographic.bottom);
    this.onChange();
  }

  /** Looks at a box from the direction of a view; keeps the current direction if `view` is null. */
  frame(box: Box, view: ViewName | null, isInstant = prefersReducedMotion()): void {
    const before = this.active;
    if (view !== null) this.view = view;
    const direction =
      view === null ? before.position.clone().sub(this.controls.target).normalize() : DIRECTIONS[view].clone();
    if (direction.lengthSq() === 0) direction.copy(DIRECTIONS.perspective);
    const center = new Vector3(...middleOf(box));
    const radius = radiusOf(box);
    const distance = distanceTo(radius, this.aspect);
    this.perspective.near = distance / DEPTH;
    this.perspective.far = distance * DEPTH;
    this.perspective.updateProjectionMatrix();
    if (this.view !== "perspective") {
      const fill = Math.min(this.aspect, 1);
      this.orthographic.zoom = 1;
      this.setOrthographicHeight((2.1 * radius) / fill);
    }
    this.controls.object = this.active;
    const position = center.clone().addScaledVector(direction, distance);
    this.fly(position, center, isInstant || this.active !== before);
  }

  /** Moves the viewer by steps to the right and up around the target, moves both, or goes nearer by steps up. */
  steer(movement: "orbit" | "pan" | "zoom", right: number, up: number): void {
    cancelAnimationFrame(this.flight);
    const { controls } = this;
    if (movement === "orbit") {
      controls.rotateLeft(-right * KEY_STEP.orbit);
      controls.rotateUp(up * KEY_STEP.orbit);
    } else if (movement === "pan") {
      const pixels = KEY_STEP.pan * (controls.domElement?.clientHeight ?? 0);
      controls.pan(-right * pixels, up * pixels);
    } else {
      controls.dollyIn(KEY_STEP.zoom ** up);
    }
  }

  private setOrthographicHeight(height: number): void {
    const half = (height || 2) / 2;
    Object.assign(this.orthographic, {
      top: half,
      bottom: -half,
      left: -half * this.aspect,
      right: half * this.aspect,
    });
    this.orthographic.updateProjectionMatrix();
  }

  private fly(position: Vector3, target: Vector3, isInstant: boolean): void {
    cancelAnimationFrame(this.flight);
    const camera = this.active;
    const from = { position: camera.position.clone(), target: this.controls.target.clone() };
    const start = performance.now();
    const step = () => {
      const time = isInstant ? 1 : Math.min(1, (performance.now() - start) / FLIGHT_MS);
      const eased = time * time * (3 - 2 * time);
      camera.position.lerpVectors(from.position, position, eased);
      this.controls.target.lerpVectors(from.target, target, eased);
      this.controls.update();
      this.onChange();
      if (time < 1) this.flight = requestAnimationFrame(step);
    };
    step();
  }

  dispose(): void {
    cancelAnimationFrame(this.flight);
    this.controls.dispose();
  }
}

function prefersReducedMotion(): boolean {
  return matchMedia("(prefers-reduced-motion: reduce)").matches;
}
