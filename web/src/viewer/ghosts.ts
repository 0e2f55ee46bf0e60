/** Wireframes of boxes that are not in the scene: what disappeared, and where objects were. */

import { Group, type Vector3 } from "three";
import type { Box, Turned } from "../api/types";
import { boxMatrix } from "./boxes";
import { boxEdges, LineSet } from "./lines";

export interface Ghost {
  box: Box;
  turned: Turned | null;
}

const UNIT: Box = [-0.5, -0.5, -0.5, 0.5, 0.5, 0.5];

export class GhostBoxes {
  readonly group = new Group();
  private readonly all = new LineSet("#e5484d");
  private readonly focused = new LineSet("#ff9d00");

  constructor() {
    this.group.add(this.all.segments, this.focused.segments);
  }

  set(ghosts: readonly Ghost[], focused: Ghost | null): void {
    this.all.set(ghosts.filter((ghost) => ghost !== focused).flatMap(ghostEdges));
    this.focused.set(focused === null ? [] : ghostEdges(focused));
  }

  dispose(): void {
    this.all.dispose();
    this.focused.dispose();
  }
}

/** Returns the ends of the twelve edges, along the object's own axes. */
export function ghostEdges({ box, turned }: Ghost): Vector3[] {
  if (turned === null) return boxEdges(box);
  const matrix = boxMatrix(box, turned);
  // Edges share their corners.
  return boxEdges(UNIT).map((corner) => corner.clone().applyMatrix4(matrix));
}
