/** The boxes of objects, shown until their meshes arrive, and for scenes without meshes. */

import {
  BoxGeometry,
  Color,
  InstancedMesh,
  type Intersection,
  Matrix4,
  MeshLambertMaterial,
  type Raycaster,
} from "three";
import type { Box, ObjectIndex } from "../api/types";
import type { Appearance } from "./meshes";
import { linear } from "./meshes";

const MIN_SIDE = 0.002;
const HIDDEN = new Matrix4().makeScale(0, 0, 0);

export class BoxBatch {
  readonly mesh: InstancedMesh;
  private readonly objects: ObjectIndex[];
  private readonly matrices: Matrix4[];
  private readonly natural: Color[];

  constructor(boxes: readonly (Box | null)[], colors: readonly ([number, number, number] | null)[]) {
    this.objects = boxes.flatMap((box, index) => (box === null ? [] : [index]));
    this.matrices = this.objects.map((object) => boxMatrix(boxes[object] as Box));
    this.natural = this.objects.map((object) => new Color(...(colors[object] ?? [0.5, 0.5, 0.5])));
    this.mesh = new InstancedMesh(new BoxGeometry(), new MeshLambertMaterial(), Math.max(1, this.objects.length));
    this.mesh.count = this.objects.length;
    this.mesh.frustumCulled = false;
    this.matrices.forEach((matrix, id) => {
      this.mesh.setMatrixAt(id, matrix);
    });
  }

  /** Applies an appearance to all boxes; those of objects for which `isReplaced` holds are hidden. */
  paint(appearance: (object: ObjectIndex) => Appearance, isReplaced: (object: ObjectIndex) => boolean): void {
    const color = new Color();
    this.objects.forEach((object, id) => {
      const { isVisible, color: given, opacity } = appearance(object);
      const isShown = isVisible && opacity >= 1 && !isReplaced(object);
      this.mesh.setMatrixAt(id, isShown ? (this.matrices[id] as Matrix4) : HIDDEN);
      if (given === null) color.copy(this.natural[id] as Color);
      else color.setRGB(...linear(given));
      this.mesh.setColorAt(id, color);
    });
    this.mesh.instanceMatrix.needsUpdate = true;
    if (this.mesh.instanceColor !== null) this.mesh.instanceColor.needsUpdate = true;
    this.mesh.boundingSphere = null;
  }

  pick(raycaster: Raycaster): { object: ObjectIndex; distance: number } | null {
    const hits: Intersection[] = raycaster.intersectObject(this.mesh, false);
    const first = hits[0];
    const object = this.objects[first?.instanceId ?? -1];
    return first === undefined || object === undefined ? null : { object, distance: first.distance };
  }

  dispose(): void {
    this.mesh.geometry.dispose();
    (this.mesh.material as MeshLambertMaterial).dispose();
    this.mesh.dispose();
  }
}

function boxMatrix([x0, y0, z0, x1, y1, z1]: Box): Matrix4 {
  const side = (lower: number, upper: number) => Math.max(upper - lower, MIN_SIDE);
  return new Matrix4()
    .makeScale(side(x0, x1), side(y0, y1), side(z0, z1))
    .setPosition((x0 + x1) / 2, (y0 + y1) / 2, (z0 + z1) / 2);
}
