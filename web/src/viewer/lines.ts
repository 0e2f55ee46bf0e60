/** Lines: boxes around selected objects, and relations between centres. */

import { BufferAttribute, BufferGeometry, LineBasicMaterial, LineSegments, Vector3 } from "three";
import type { Box } from "../api/types";

const EDGES = [0, 1, 1, 3, 3, 2, 2, 0, 4, 5, 5, 7, 7, 6, 6, 4, 0, 4, 1, 5, 2, 6, 3, 7];

/** A set of line segments with one colour, drawn over everything. */
export class LineSet {
  readonly segments: LineSegments;

  constructor(color: string) {
    const material = new LineBasicMaterial({ color, depthTest: false, transparent: true });
    this.segments = new LineSegments(new BufferGeometry(), material);
    this.segments.renderOrder = 10;
    this.segments.frustumCulled = false;
  }

  set(points: readonly Vector3[]): void {
    const values = new Float32Array(points.flatMap((point) => [point.x, point.y, point.z]));
    this.segments.geometry.dispose();
    this.segments.geometry = new BufferGeometry();
    this.segments.geometry.setAttribute("position", new BufferAttribute(values, 3));
    this.segments.visible = points.length > 0;
  }

  dispose(): void {
    this.segments.geometry.dispose();
    (this.segments.material as LineBasicMaterial).dispose();
  }
}

/** Returns the ends of the twelve edges of a box. */
export function boxEdges([x0, y0, z0, x1, y1, z1]: Box): Vector3[] {
  const corners = [0, 1, 2, 3, 4, 5, 6, 7].map(
    (corner) => new Vector3(corner & 1 ? x1 : x0, corner & 2 ? y1 : y0, corner & 4 ? z1 : z0),
  );
  return EDGES.map((corner) => corners[corner] as Vector3);
}

export function boxCenter([x0, y0, z0, x1, y1, z1]: Box): Vector3 {
  return new Vector3((x0 + x1) / 2, (y0 + y1) / 2, (z0 + z1) / 2);
}
