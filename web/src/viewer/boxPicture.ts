/** Draws the boxes of a scene as the view shows them first: same camera, lights, colours; on the CPU, without WebGL. */

import type { Box, ObjectIndex, SceneData, Turned } from "../api/types";
import { rgb } from "../state/colors";
import { REST } from "../state/palette";
import { boundsOf } from "./bounds";
import { cutAway, ghostsOf } from "./cutaway";
import {
  DEPTH,
  distanceTo,
  encode,
  FIELD_OF_VIEW,
  GHOST_OPACITY,
  LIGHTS,
  linear,
  MIN_SIDE,
  middleOf,
  NO_COLOR,
  radiusOf,
  START_DIRECTION,
  type Triple,
  unit,
} from "./look";
import { type Corner, type Pixels, Raster } from "./raster";

/** Returns the picture, `width` × `height` pixels. */
export function drawBoxes(data: SceneData, width: number, height: number): Pixels {
  const { objects } = data;
  const bounds = boundsOf(objects);
  const canvas = new Raster(width, height);
  if (bounds === null) return canvas.finish();
  const camera = new StartCamera(bounds, width, height);
  const [x, y] = START_DIRECTION;
  const hidden = cutAway(data, { x, y });
  const ghosts = ghostsOf(data);
  const draw = (object: ObjectIndex, opacity: number) => {
    const box = objects.box[object];
    if (box == null || hidden.has(object)) return;
    const color = data.has_comparison ? linear(rgb(REST)) : (objects.color[object] ?? NO_COLOR);
    const middle = middleOf(box);
    const axes = halfAxes(box, objects.turned[object] ?? null);
    for (let axis = 0; axis < 3; axis++) {
      const [along, first, second] = [0, 1, 2].map((next) => axes[(axis + next) % 3]) as [Triple, Triple, Triple];
      for (const sign of [1, -1]) {
        const face = moved(middle, along, sign);
        if (!camera.sees(face, along, sign)) continue;
        const corners = AROUND.map(([u, v]) => moved(moved(face, first, sign * u), second, v));
        canvas.fill(camera.project(corners), camera.shade(color, scaled(unit(along), sign)), opacity);
      }
    }
  };
  objects.box.forEach((_, object) => {
    if (!ghosts.has(object)) draw(object, 1);
  });
  objects.box.forEach((_, object) => {
    if (ghosts.has(object)) draw(object, GHOST_OPACITY);
  });
  return canvas.finish();
}

/** Returns the three axes of a box from its middle to its sides, along the object's own axes if it is turned. */
function halfAxes(box: Box, turned: Turned | null): Triple[] {
  const sizes = turned === null ? [box[3] - box[0], box[4] - box[1], box[5] - box[2]] : turned.slice(4);
  const axes = turned === null ? IDENTITY : axesOf(turned);
  return axes.map((axis, place) => scaled(axis, Math.max(sizes[place] as number, MIN_SIDE) / 2));
}

const IDENTITY: readonly Triple[] = [
  [1, 0, 0],
  [0, 1, 0],
  [0, 0, 1],
];

/** Signs of the other two axes at the corners of a side, counter-clockwise seen from outside. */
const AROUND = [
  [1, 1],
  [-1, 1],
  [-1, -1],
  [1, -1],
] as const;

/** Returns the own axes of a quaternion x, y, z, w in world coordinates. */
function axesOf(turned: Turned): Triple[] {
  const length = Math.hypot(turned[0], turned[1], turned[2], turned[3]) || 1;
  const [x, y, z, w] = turned.slice(0, 4).map((value) => value / length) as [number, number, number, number];
  return [
    [1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)],
    [2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)],
    [2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y)],
  ];
}

/** The camera and the lights of the view at its start. */
class StartCamera {
  private readonly eye: Triple;
  private readonly right: Triple;
  private readonly up: Triple;
  private readonly forward: Triple;
  private readonly lamp: Triple;
  private readonly near: number;
  private readonly far: number;
  private readonly focal: number;

  constructor(
    bounds: Box,
    private readonly width: number,
    private readonly height: number,
  ) {
    const distance = distanceTo(radiusOf(bounds), width / height);
    const [x, y, z] = START_DIRECTION;
    const [centerX, centerY, centerZ] = middleOf(bounds);
    this.eye = [centerX + distance * x, centerY + distance * y, centerZ + distance * z];
    this.forward = [-x, -y, -z];
    this.right = unit([-y, x, 0]);
    this.up = cross(this.right, this.forward);
    this.lamp = unit([distance * x, distance * y, distance * z + LIGHTS.lamp.above]);
    this.near = distance / DEPTH;
    this.far = distance * DEPTH;
    this.focal = height / 2 / Math.tan((FIELD_OF_VIEW / 2) * (Math.PI / 180));
  }

  /** Returns whether a point of a surface is seen from outside. */
  sees([x, y, z]: Triple, outwards: Triple, sign: number): boolean {
    return sign * dot([this.eye[0] - x, this.eye[1] - y, this.eye[2] - z], outwards) > 0;
  }

  /** Returns a polygon in pixels, with the inverse distance of each corner; empty if it is too near or too far. */
  project(corners: readonly Triple[]): Corner[] {
    const seen = corners.map(([x, y, z]): Triple => {
      const offset: Triple = [x - this.eye[0], y - this.eye[1], z - this.eye[2]];
      return [dot(offset, this.right), dot(offset, this.up), dot(offset, this.forward)];
    });
    if (seen.every(([, , depth]) => depth > this.far)) return [];
    return clipNear(seen, this.near).map(([x, y, depth]) => [
      this.width / 2 + (this.focal * x) / depth,
      this.height / 2 - (this.focal * y) / depth,
      1 / depth,
    ]);
  }

  /** Returns the sRGB colour of a side: Lambert's law, as the materials of three.js have it. */
  shade(color: Triple, normal: Triple): Triple {
    const { ambient, hemisphere, lamp } = LIGHTS;
    // The hemisphere light of three.js has its sky along y.
    const share = 0.5 * normal[1] + 0.5;
    const direct = lamp.intensity * Math.max(0, dot(normal, this.lamp));
    const part = (at: 0 | 1 | 2) => {
      const around = hemisphere.intensity * mix(GROUND[at], SKY[at], share);
      return encode((color[at] * (ambient + around + direct)) / Math.PI);
    };
    return [part(0), part(1), part(2)];
  }
}

const SKY = linear(rgb(LIGHTS.hemisphere.sky));
const GROUND = linear(rgb(LIGHTS.hemisphere.ground));

/** Cuts off what is nearer than a distance (Sutherland and Hodgman, 1974). */
function clipNear(corners: readonly Triple[], near: number): readonly Triple[] {
  if (corners.every(([, , depth]) => depth >= near)) return corners;
  return corners.flatMap((corner, index) => {
    const before = corners.at(index - 1) as Triple;
    const kept = corner[2] >= near ? [corner] : [];
    if (corner[2] >= near === before[2] >= near) return kept;
    const share = (near - before[2]) / (corner[2] - before[2]);
    return [[mix(before[0], corner[0], share), mix(before[1], corner[1], share), near] as Triple, ...kept];
  });
}

function dot(one: Triple, other: Triple): number {
  return one[0] * other[0] + one[1] * other[1] + one[2] * other[2];
}

function cross(one: Triple, other: Triple): Triple {
  return [
    one[1] * other[2] - one[2] * other[1],
    one[2] * other[0] - one[0] * other[2],
    one[0] * other[1] - one[1] * other[0],
  ];
}

function scaled([x, y, z]: Triple, factor: number): Triple {
  return [factor * x, factor * y, factor * z];
}

function moved(from: Triple, by: Triple, factor: number): Triple {
  return [from[0] + factor * by[0], from[1] + factor * by[1], from[2] + factor * by[2]];
}

function mix(from: number, to: number, share: number): number {
  return from + share * (to - from);
}
