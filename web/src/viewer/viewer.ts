/** The 3D view of a scene. It draws when something has changed, and is idle otherwise. */

import { type Signal, signal } from "@preact/signals";
import {
  AmbientLight,
  DirectionalLight,
  HemisphereLight,
  Plane,
  type Ray,
  Raycaster,
  Scene,
  type Texture,
  Vector2,
  Vector3,
  WebGLRenderer,
} from "three";
import type { Box, ObjectIndex, SceneData, TextureUse } from "../api/types";
import type { Eye } from "./appearance";
import { boundsOf } from "./bounds";
import { BoxBatch } from "./boxes";
import { Cameras, type ViewName } from "./cameras";
import { MAX_PIXEL_RATIO } from "./firstPicture";
import { type Ghost, GhostBoxes } from "./ghosts";
import { boxCenter, boxEdges, LineSet } from "./lines";
import { LIGHTS, radiusOf } from "./look";
import { type Appearance, bestHit, MeshBatches, readParts } from "./meshes";
import { LabelOverlay, type OverlayLabel } from "./overlay";

/** One relation to draw from the selection to another object. */
export interface RelationLine {
  from: ObjectIndex;
  to: ObjectIndex;
  text: string;
}

export interface ViewerEvents {
  onPick(object: ObjectIndex | null, isAdding: boolean): void;
  onHover(object: ObjectIndex | null, x: number, y: number): void;
  /** The browser has taken the graphics context away, or has given it back. */
  onContext(isLost: boolean): void;
  /** The scene is drawn for the first time. */
  onFirstFrame(): void;
}

const HOVER_MS = 60;
const CLICK_PIXELS = 4;
const OUTSIDE = 1e6;
/** More boxes than these hide what they mark. */
const MAX_BOXES = 60;
/** Share of the distance to the target by which the viewer moves until what hides the selection is found anew. */
const MOVE_SHARE = 0.15;
/** Cosine of the angle by which the view turns until that and near walls are found anew. */
const TURN_STEP = Math.cos(Math.PI / 18);

export class Viewer {
  readonly cameras: Cameras;
  /** Changes in steps, see `TURN_STEP`. */
  readonly eye: Signal<Eye> = signal({ position: new Vector3(), direction: new Vector3(0, 0, 1) });
  /** Milliseconds of the last frame on the CPU. */
  frameMs = 0;
  private readonly renderer: WebGLRenderer;
  private readonly scene = new Scene();
  private readonly boxes: BoxBatch;
  private readonly meshes = new MeshBatches();
  private readonly textures = new Map<number, Texture>();
  private readonly selection = new LineSet("#ff9d00");
  private readonly relations = new LineSet("#ff9d00");
  private readonly hidden = new LineSet("#8a93a0");
  private readonly ghosts = new GhostBoxes();
  private readonly overlay: LabelOverlay;
  private readonly cut = new Plane(new Vector3(0, 0, -1), OUTSIDE);
  private readonly light = new DirectionalLight("#ffffff", LIGHTS.lamp.intensity);
  private readonly resizer: ResizeObserver;
  private appearance: (object: ObjectIndex) => Appearance = () => ({ isVisible: true, color: null, opacity: 1 });
  private isPlain = true;
  private request = 0;
  private hoverTimer = 0;
  private pressed = new Vector2();
  private readonly size = new Vector2();

  /** Throws if the browser has no WebGL 2. */
  constructor(
    private readonly host: HTMLElement,
    private readonly data: SceneData,
    private readonly events: ViewerEvents,
  ) {
    const canvas = document.createElement("canvas");
    canvas.setAttribute("aria-label", "3D view of the scene");
    canvas.setAttribute("role", "img");
    this.renderer = new WebGLRenderer({ canvas, antialias: true, alpha: true, powerPreference: "high-performance" });
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, MAX_PIXEL_RATIO));
    this.renderer.clippingPlanes = [this.cut];
    host.append(canvas);
    const labels = document.createElement("div");
    labels.className = "overlay";
    host.append(labels);
    this.overlay = new LabelOverlay(labels);
    this.cameras = new Cameras(canvas, () => this.invalidate());
    this.boxes = new BoxBatch(data.objects.box, data.objects.color, data.objects.turned);
    this.scene.add(this.boxes.group, this.selection.segments, this.relations.segments, this.hidden.segments);
    this.scene.add(this.ghosts.group);
    const { sky, ground, intensity } = LIGHTS.hemisphere;
    this.scene.add(new AmbientLight("#ffffff", LIGHTS.ambient), new HemisphereLight(sky, ground, intensity));
    this.scene.add(this.light, this.light.target);
    this.resizer = new ResizeObserver(() => this.resize());
    this.resizer.observe(host);
    this.listen(canvas);
    this.watchContext(canvas);
    this.resize();
    const bounds = this.boundsOf(null);
    if (bounds !== null) this.cameras.frame(bounds, "perspective", true);
    this.paint();
  }

  /** Adds one GLB file; its objects replace their boxes. Returns the textures that it uses. */
  async addFile(data: ArrayBuffer): Promise<TextureUse[]> {
    const parts = await readParts(data);
    for (const batch of this.meshes.add(parts)) this.scene.add(batch);
    this.paint();
    return parts.flatMap(({ texture }) => (texture === null ? [] : [texture]));
  }

  /** Adds the image of a texture. */
  addTexture(index: number, texture: Texture): void {
    this.textures.set(index, texture);
    this.meshes.setTextures(this.textures);
    this.paint();
  }

  /** Sets how objects look. */
  setAppearance(appearance: (object: ObjectIndex) => Appearance, isPlain: boolean): void {
    this.appearance = appearance;
    this.isPlain = isPlain;
    this.paint();
  }

  private paint(): void {
    this.meshes.paint(this.appearance, this.isPlain);
    this.boxes.paint(this.appearance, (object) => this.meshes.has(object));
    this.invalidate();
  }

  setSelection(objects: readonly ObjectIndex[]): void {
    const boxes = objects.map((object) => this.data.objects.box[object]).filter((box) => box != null);
    this.selection.set(boxes.length > MAX_BOXES ? [] : boxes.flatMap(boxEdges));
    this.invalidate();
  }

  /** Shows the edges of what is hidden because it is before the selection. */
  setHidden(objects: readonly ObjectIndex[]): void {
    const boxes = objects
      .filter((object) => this.data.objects.shell[object] === "")
      .map((object) => this.data.objects.box[object]);
    this.hidden.set(boxes.slice(0, MAX_BOXES).flatMap((box) => (box == null ? [] : boxEdges(box))));
    this.invalidate();
  }

  /** Shows boxes of what is not in the scene any more; the focused one stands out. */
  setGhosts(ghosts: readonly Ghost[], focused: Ghost | null): void {
    this.ghosts.set(ghosts, focused);
    this.invalidate();
  }

  /** Looks at a box. */
  frameBox(box: Box): void {
    this.cameras.frame(withSurroundings(box), null);
  }

  /** Shows relation lines and labels. */
  setAnnotations(lines: readonly RelationLine[], labels: readonly OverlayLabel[]): void {
    const shown: OverlayLabel[] = [...labels];
    const points: Vector3[] = [];
    for (const { from, to, text } of lines) {
      const [start, end] = [this.centerOf(from), this.centerOf(to)];
      if (start === null || end === null) continue;
      points.push(start, end);
      shown.push({ at: start.clone().lerp(end, 0.5), text, kind: "relation" });
    }
    this.relations.set(points);
    this.overlay.show(shown);
    this.invalidate();
  }

  centerOf(object: ObjectIndex): Vector3 | null {
    const box = this.data.objects.box[object];
    return box == null ? null : boxCenter(box);
  }

  /** Looks at objects, or at everything for null. */
  frame(objects: readonly ObjectIndex[] | null, view: ViewName | null = null): void {
    const bounds = this.boundsOf(objects);
    if (bounds !== null) this.cameras.frame(objects === null ? bounds : withSurroundings(bounds), view);
  }

  /** Returns whether a ray meets the meshes of an object nearer than a distance. */
  meets(object: ObjectIndex, ray: Ray, distance: number): boolean {
    return this.meshes.meets(object, ray, distance);
  }

  /** Hides everything above a height; `share` is between 0 (floor) and 1 (nothing hidden). */
  setCut(share: number): void {
    const bounds = this.boundsOf(null);
    this.cut.constant = share >= 1 || bounds === null ? OUTSIDE : bounds[2] + share * (bounds[5] - bounds[2]);
    this.invalidate();
  }

  private boundsOf(objects: readonly ObjectIndex[] | null): Box | null {
    return boundsOf(this.data.objects, objects ?? undefined);
  }

  private listen(canvas: HTMLCanvasElement): void {
    canvas.addEventListener("pointerdown", (event) => {
      this.pressed.set(event.clientX, event.clientY);
    });
    canvas.addEventListener("pointerup", (event) => {
      const moved = this.pressed.distanceTo(new Vector2(event.clientX, event.clientY));
      if (event.button !== 0 || moved > CLICK_PIXELS) return;
      this.events.onPick(this.pick(event), event.shiftKey || event.ctrlKey || event.metaKey);
    });
    canvas.addEventListener("pointermove", (event) => {
      clearTimeout(this.hoverTimer);
      if (event.buttons !== 0) return;
      this.hoverTimer = window.setTimeout(() => {
        this.events.onHover(this.pick(event), event.offsetX, event.offsetY);
      }, HOVER_MS);
    });
    canvas.addEventListener("pointerleave", () => {
      clearTimeout(this.hoverTimer);
      this.events.onHover(null, 0, 0);
    });
  }

  /** The renderer uploads everything again with the first frame after the context is back. */
  private watchContext(canvas: HTMLCanvasElement): void {
    canvas.addEventListener("webglcontextlost", (event) => {
      // Otherwise the browser does not give it back.
      event.preventDefault();
      this.events.onContext(true);
    });
    canvas.addEventListener("webglcontextrestored", () => {
      this.events.onContext(false);
      this.paint();
    });
  }

  private pick(event: PointerEvent): ObjectIndex | null {
    const { width, height } = this.renderer.domElement.getBoundingClientRect();
    const point = new Vector2((2 * event.offsetX) / width - 1, 1 - (2 * event.offsetY) / height);
    const raycaster = new Raycaster();
    raycaster.setFromCamera(point, this.cameras.active);
    // What is cut away cannot be clicked.
    const top = this.cut.constant;
    return bestHit([this.meshes.pick(raycaster, top), this.boxes.pick(raycaster, top)])?.object ?? null;
  }

  private resize(): void {
    const { clientWidth, clientHeight } = this.host;
    if (clientWidth === 0 || clientHeight === 0) return;
    // The observer reports the first size, too, and a new drawing buffer takes tens of milliseconds.
    if (this.size.width === clientWidth && this.size.height === clientHeight) return;
    this.size.set(clientWidth, clientHeight);
    this.renderer.setSize(clientWidth, clientHeight);
    this.cameras.resize(clientWidth, clientHeight);
  }

  invalidate(): void {
    if (this.request === 0) this.request = requestAnimationFrame(() => this.draw());
  }

  /** Draws now and waits until the picture is there; returns the milliseconds it took. For measurements. */
  drawAndWait(): number {
    const start = performance.now();
    this.draw();
    const gl = this.renderer.getContext();
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
    return performance.now() - start;
  }

  get textureCount(): number {
    return this.textures.size;
  }

  get drawCalls(): number {
    return this.renderer.info.render.calls;
  }

  get triangles(): number {
    return this.renderer.info.render.triangles;
  }

  private draw(): void {
    this.request = 0;
    const start = performance.now();
    const camera = this.cameras.active;
    const direction = camera.position.clone().sub(this.cameras.controls.target).normalize();
    const { position, direction: before } = this.eye.value;
    const hasMoved =
      camera.position.distanceTo(position) > MOVE_SHARE * camera.position.distanceTo(this.cameras.controls.target);
    if (hasMoved || direction.dot(before) < TURN_STEP)
      this.eye.value = { position: camera.position.clone(), direction };
    // The light comes from over the viewer's shoulder.
    this.light.position.copy(camera.position).add(new Vector3(0, 0, LIGHTS.lamp.above));
    this.light.target.position.copy(this.cameras.controls.target);
    this.renderer.render(this.scene, camera);
    this.overlay.place(camera, this.host.clientWidth, this.host.clientHeight);
    if (this.frameMs === 0) this.events.onFirstFrame();
    this.frameMs = performance.now() - start;
  }

  dispose(): void {
    cancelAnimationFrame(this.request);
    clearTimeout(this.hoverTimer);
    this.resizer.disconnect();
    this.cameras.dispose();
    this.meshes.dispose();
    for (const texture of this.textures.values()) texture.dispose();
    this.boxes.dispose();
    this.selection.dispose();
    this.relations.dispose();
    this.hidden.dispose();
    this.ghosts.dispose();
    this.renderer.dispose();
    this.host.replaceChildren();
  }
}

/** Surroundings tell what a thing is. */
function withSurroundings(box: Box): Box {
  const added = 0.5 * radiusOf(box) + 0.15;
  return box.map((value, axis) => (axis < 3 ? value - added : value + added)) as Box;
}
