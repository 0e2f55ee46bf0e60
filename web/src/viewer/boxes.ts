/** The boxes of objects, shown until their meshes arrive, and for scenes without meshes. */

import {
  BoxGeometry,
  Color,
  Group,
  InstancedMesh,
  Matrix4,
  MeshLambertMaterial,
  Quaternion,
  type Raycaster,
  Vector3,
} from "three";
import type { Box, ObjectIndex, Turned } from "../api/types";
import { GHOST_OPACITY, linear, MIN_SIDE, NO_COLOR } from "./look";
import { type Appearance, bestHit, type Hit } from "./meshes";

const HIDDEN = new Matrix4().makeScale(0, 0, 0);

export class BoxBatch {
  /** Two meshes: solid boxes and ghosts. */
  readonly group = new Group();
  private readonly solid: InstancedMesh;
  private readonly ghosts: InstancedMesh;
  private readonly objects: ObjectIndex[];
  private readonly matrices: Matrix4[];
  private readonly natural: Color[];

  constructor(
    boxes: readonly (Box | null)[],
    colors: readonly ([number, number, number] | null)[],
    turned: readonly (Turned | null)[] = [],
  ) {
    this.objects = boxes.flatMap((box, index) => (box === null ? [] : [index]));
    this.matrices = this.objects.map((object) => boxMatrix(boxes[object] as Box, turned[object] ?? null));
    this.natural = this.objects.map((object) => new Color(...(colors[object] ?? NO_COLOR)));
    const geometry = new BoxGeometry();
    this.solid = this.makeMesh(geometry, new MeshLambertMaterial());
    this.ghosts = this.makeMesh(
      geometry,
      new MeshLambertMaterial({ transparent: true, opacity: GHOST_OPACITY, depthWrite: false }),
    );
    this.group.add(this.solid, this.ghosts);
  }

  private makeMesh(geometry: BoxGeometry, material: MeshLambertMaterial): InstancedMesh {
    const mesh = new InstancedMesh(geometry, material, Math.max(1, this.objects.length));
    mesh.count = this.objects.length;
    mesh.frustumCulled = false;
    return mesh;
  }

  /** Applies an appearance to all boxes; those of objects for which `isReplaced` holds are hidden. */
  paint(appearance: (object: ObjectIndex) => Appearance, isReplaced: (object: ObjectIndex) => boolean): void {
    const color = new Color();
    let hasGhosts = false;
    this.objects.forEach((object, id) => {
      const { isVisible, color: given, opacity } = appearance(object);
      const matrix = isVisible && !isReplaced(object) ? (this.matrices[id] as Matrix4) : HIDDEN;
      const isGhost = opacity < 1;
      hasGhosts ||= isGhost && matrix !== HIDDEN;
      if (given === null) color.copy(this.natural[id] as Color);
      else color.setRGB(...linear(given));
      for (const [mesh, isShown] of [[this.solid, !isGhost] as const, [this.ghosts, isGhost] as const]) {
        mesh.setMatrixAt(id, isShown ? matrix : HIDDEN);
        mesh.setColorAt(id, color);
      }
    });
    this.ghosts.visible = hasGhosts;
    for (const mesh of [this.solid, this.ghosts]) {
      mesh.instanceMatrix.needsUpdate = true;
      if (mesh.instanceColor !== null) mesh.instanceColor.needsUpdate = true;
      mesh.boundingSphere = null;
    }
  }

  /** Returns what a ray means among the visible boxes below a height. */
  pick(raycaster: Raycaster, top: number): Hit | null {
    return bestHit(
      raycaster.intersectObject(this.group, true).map(({ object: mesh, instanceId, distance, point }) => {
        const object = this.objects[instanceId ?? -1];
        if (object === undefined || point.z > top) return null;
        return { object, distance, isGhost: mesh === this.ghosts };
      }),
    );
  }

  dispose(): void {
    for (const mesh of [this.solid, this.ghosts]) {
      mesh.geometry.dispose();
      (mesh.material as MeshLambertMaterial).dispose();
      mesh.dispose();
    }
  }
}

/** Returns the matrix of a unit cube that fills a box, or the box along the object's own axes in the middle of it. */
export function boxMatrix([x0, y0, z0, x1, y1, z1]: Box, turned: Turned | null): Matrix4 {
  const sides = turned === null ? [x1 - x0, y1 - y0, z1 - z0] : turned.slice(4);
  const [width, depth, height] = sides.map((side) => Math.max(side, MIN_SIDE)) as [number, number, number];
  const rotation = turned === null ? new Quaternion() : new Quaternion(...turned.slice(0, 4)).normalize();
  return new Matrix4().compose(
    new Vector3((x0 + x1) / 2, (y0 + y1) / 2, (z0 + z1) / 2),
    rotation,
    new Vector3(width, depth, height),
  );
}
