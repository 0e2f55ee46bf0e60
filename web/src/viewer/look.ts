/** How the start of the view looks, in plain numbers: the first picture is drawn before three.js is there. */

import type { Box } from "../api/types";
import type { Rgb } from "../state/colors";

export type Triple = readonly [number, number, number];

/** Vertical, in degrees. */
export const FIELD_OF_VIEW = 45;
/** From the scene to the camera at the start; a unit vector. */
export const START_DIRECTION: Triple = unit([-0.62, -0.62, 0.75]);
/** The far plane is this many times as far as what is looked at, the near plane as much nearer. */
export const DEPTH = 200;
/** Opacity of what is shown as a ghost. */
export const GHOST_OPACITY = 0.12;
/** Flatter boxes could not be seen from the side; metres. */
export const MIN_SIDE = 0.002;
/** Linear RGB of boxes without a colour. */
export const NO_COLOR: Triple = [0.5, 0.5, 0.5];
export const LIGHTS = {
  ambient: 0.55,
  hemisphere: { sky: "#ffffff", ground: "#8d8578", intensity: 1.1 },
  /** From the camera, and a little higher; metres. */
  lamp: { intensity: 1.6, above: 3 },
} as const;

export function unit([x, y, z]: Triple): Triple {
  const length = Math.hypot(x, y, z) || 1;
  return [x / length, y / length, z / length];
}

export function middleOf([x0, y0, z0, x1, y1, z1]: Box): Triple {
  return [(x0 + x1) / 2, (y0 + y1) / 2, (z0 + z1) / 2];
}

/** Returns the radius of the sphere around a box that the view shows; metres. */
export function radiusOf([x0, y0, z0, x1, y1, z1]: Box): number {
  return Math.max(Math.hypot(x1 - x0, y1 - y0, z1 - z0) / 2, 0.05);
}

/** Returns how far from its centre a perspective camera sees a whole sphere. */
export function distanceTo(radius: number, aspect: number): number {
  const half = (FIELD_OF_VIEW / 2) * (Math.PI / 180);
  return radius / Math.sin(Math.min(half, Math.atan(Math.tan(half) * aspect)));
}

/** Returns linear RGB of sRGB. */
export function linear([red, green, blue]: Rgb): [number, number, number] {
  const decode = (value: number) => (value <= 0.04045 ? value / 12.92 : ((value + 0.055) / 1.055) ** 2.4);
  return [decode(red), decode(green), decode(blue)];
}

/** Returns sRGB of one linear component, from 0 to 255. */
export function encode(value: number): number {
  const held = Math.min(Math.max(value, 0), 1);
  return Math.round(255 * (held <= 0.0031308 ? 12.92 * held : 1.055 * held ** (1 / 2.4) - 0.055));
}
