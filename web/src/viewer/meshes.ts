/** Meshes of the scene in a few draw calls: an opaque and a transparent batch for each GLB file and texture. */

import {
  BatchedMesh,
  BufferGeometry,
  DoubleSide,
  type Intersection,
  type Matrix4,
  Mesh,
  MeshLambertMaterial,
  type Object3D,
  type Ray,
  Raycaster,
  Sphere,
  type Texture,
  Vector4,
} from "three";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";
import type { ObjectIndex, TextureUse } from "../api/types";
import type { Rgb } from "../state/colors";
import { linear } from "./look";

/** How one object is drawn. */
export interface Appearance {
  isVisible: boolean;
  /** Replaces the colours of the materials; null keeps them. */
  color: Rgb | null;
  /** 1 for solid; less draws it as a ghost. */
  opacity: number;
}

interface Instance {
  batch: BatchedMesh;
  id: number;
  object: ObjectIndex;
  isGhost: boolean;
}

/** What a ray meets first. */
export interface Hit {
  object: ObjectIndex;
  distance: number;
  /** Ghosts are hit only if there is nothing solid on the ray. */
  isGhost: boolean;
}

/** Returns the hit that a click means. */
export function bestHit(hits: readonly (Hit | null)[]): Hit | null {
  const found = hits.filter((hit) => hit !== null);
  found.sort((a, b) => Number(a.isGhost) - Number(b.isGhost) || a.distance - b.distance);
  return found[0] ?? null;
}

interface Part {
  geometry: BufferGeometry;
  texture: TextureUse | null;
  matrix: Matrix4;
  object: ObjectIndex;
}

const loader = new GLTFLoader();

/** Reads one GLB file of the server. */
export async function readParts(data: ArrayBuffer): Promise<Part[]> {
  const { scene } = await loader.parseAsync(data, "");
  scene.updateMatrixWorld(true);
  const parts: Part[] = [];
  scene.traverse((node: Object3D) => {
    if (!(node instanceof Mesh)) return;
    // A node with one primitive is the mesh itself; the number of its object is on it or on the group above.
    const object = (node.userData["object"] ?? node.parent?.userData["object"] ?? -1) as number;
    const geometry = node.geometry as BufferGeometry;
    const texture = typeof geometry.userData["texture"] === "number" ? (geometry.userData as TextureUse) : null;
    parts.push({ geometry, texture, matrix: node.matrixWorld.clone(), object });
  });
  return parts;
}

/** All meshes that have arrived, and how to colour, hide and hit them. */
export class MeshBatches {
  readonly batches: BatchedMesh[] = [];
  private readonly instances: Instance[] = [];
  private readonly ofObject = new Map<ObjectIndex, Instance[]>();
  private textures: ReadonlyMap<number, Texture> = new Map();
  private readonly hit = new Map<BatchedMesh, Instance[]>();

  /** Adds the parts of one file; returns its batches, to be put into the scene. */
  add(parts: Part[]): BatchedMesh[] {
    const groups = new Map<string, Part[]>();
    for (const part of parts) {
      const key = `${part.texture?.texture ?? -1} ${isTransparent(part.geometry)}`;
      const known = groups.get(key);
      if (known === undefined) groups.set(key, [part]);
      else known.push(part);
    }
    return [...groups.values()].map((group) => this.addBatch(group));
  }

  /** Shows the images of textures that have arrived where objects have the colours of their materials. */
  setTextures(textures: ReadonlyMap<number, Texture>): void {
    this.textures = textures;
  }

  private addBatch(parts: Part[]): BatchedMesh {
    const texture = parts[0]?.texture ?? null;
    const isClear = parts[0] !== undefined && isTransparent(parts[0].geometry);
    const geometries = [...new Set(parts.map((part) => part.geometry))];
    const vertices = sum(geometries.map((geometry) => geometry.attributes["position"]?.count ?? 0));
    const indices = sum(geometries.map((geometry) => geometry.index?.count ?? 0));
    const material = new MeshLambertMaterial({ vertexColors: true, side: DoubleSide, transparent: isClear });
    const batch = new BatchedMesh(parts.length, vertices, indices, material);
    batch.sortObjects = isClear;
    const ids = new Map(geometries.map((geometry) => [geometry, batch.addGeometry(geometry)]));
    const own: Instance[] = [];
    for (const part of parts) {
      const id = batch.addInstance(ids.get(part.geometry) as number);
      batch.setMatrixAt(id, part.matrix);
      const instance = { batch, id, object: part.object, isGhost: false };
      own[id] = instance;
      this.instances.push(instance);
      const known = this.ofObject.get(part.object);
      if (known === undefined) this.ofObject.set(part.object, [instance]);
      else known.push(instance);
    }
    Object.assign(batch.userData, { isClear, texture });
    this.hit.set(batch, own);
    this.batches.push(batch);
    return batch;
  }

  has(object: ObjectIndex): boolean {
    return this.ofObject.has(object);
  }

  /** Applies an appearance to all instances; `isPlain` keeps the colours of the materials. */
  paint(appearance: (object: ObjectIndex) => Appearance, isPlain: boolean): void {
    const color = new Vector4();
    let hasGhosts = false;
    for (const instance of this.instances) {
      const { batch, id, object } = instance;
      const { isVisible, color: given, opacity } = appearance(object);
      batch.setVisibleAt(id, isVisible);
      const [red, green, blue] = given === null ? [1, 1, 1] : linear(given);
      batch.setColorAt(id, color.set(red, green, blue, opacity));
      instance.isGhost = opacity < 1;
      hasGhosts ||= isVisible && opacity < 1;
    }
    for (const batch of this.batches) {
      const material = batch.material as MeshLambertMaterial;
      const isClear = batch.userData["isClear"] === true;
      // Ghosts by hashed transparency need no sorting.
      const alphaHash = hasGhosts && !isClear;
      const use = batch.userData["texture"] as TextureUse | null;
      const map = (isPlain && use !== null && this.textures.get(use.texture)) || null;
      const vertexColors = isPlain && map === null;
      if (material.alphaHash === alphaHash && material.vertexColors === vertexColors && material.map === map) continue;
      const [red, green, blue] = map === null || use === null ? [1, 1, 1] : use.scale;
      material.color.setRGB(red, green, blue);
      Object.assign(material, { alphaHash, vertexColors, map, needsUpdate: true });
    }
  }

  /** Returns what a ray means among the visible objects below a height. */
  pick(raycaster: Raycaster, top: number): Hit | null {
    const hits: Intersection[] = [];
    for (const batch of this.batches) raycaster.intersectObject(batch, false, hits);
    return bestHit(
      hits.map(({ object: batch, batchId, distance, point }) => {
        const instance = this.hit.get(batch as BatchedMesh)?.[batchId ?? -1];
        if (instance === undefined || instance.object < 0 || point.z > top) return null;
        return { object: instance.object, distance, isGhost: instance.isGhost };
      }),
    );
  }

  /** Returns whether a ray meets an object, visible or not, nearer than a distance. */
  meets(object: ObjectIndex, ray: Ray, distance: number): boolean {
    const raycaster = new Raycaster(ray.origin, ray.direction, 0, distance);
    return (this.ofObject.get(object) ?? []).some(({ batch, id }) => {
      const part = new Mesh(new BufferGeometry(), batch.material);
      const geometry = batch.getGeometryIdAt(id);
      const range = batch.getGeometryRangeAt(geometry);
      if (range === null) return false;
      part.geometry.attributes = batch.geometry.attributes;
      part.geometry.setIndex(batch.geometry.index).setDrawRange(range.start, range.count);
      part.geometry.boundingSphere = batch.getBoundingSphereAt(geometry, new Sphere());
      batch.getMatrixAt(id, part.matrixWorld);
      return raycaster.intersectObject(part, false).length > 0;
    });
  }

  dispose(): void {
    for (const batch of this.batches) {
      batch.dispose();
      (batch.material as MeshLambertMaterial).dispose();
    }
  }
}

const transparency = new WeakMap<BufferGeometry, boolean>();

function isTransparent(geometry: BufferGeometry): boolean {
  const known = transparency.get(geometry);
  if (known !== undefined) return known;
  const colors = geometry.attributes["color"];
  let found = false;
  if (colors !== undefined && colors.itemSize === 4) {
    for (let i = 0; i < colors.count && !found; i++) found = colors.getW(i) < 0.99;
  }
  transparency.set(geometry, found);
  return found;
}

function sum(values: number[]): number {
  return values.reduce((total, value) => total + value, 0);
}
