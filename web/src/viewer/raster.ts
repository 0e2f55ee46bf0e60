/** Fills polygons pixel by pixel. */

import type { Triple } from "./look";

/** RGBA, row by row from the top; transparent where there is nothing. */
export type Pixels = Uint8ClampedArray<ArrayBuffer>;

/** In pixels, from the left and from the top, then the inverse of the distance. */
export type Corner = readonly [number, number, number];

/** Square pixels; less is a side that is seen edge-on. */
const MIN_AREA = 1e-9;

/** A picture in which what is nearer hides what is behind it. */
export class Raster {
  private readonly pixels: Pixels;
  private readonly depth: Float32Array;

  constructor(
    private readonly width: number,
    private readonly height: number,
  ) {
    this.pixels = new Uint8ClampedArray(4 * width * height);
    this.depth = new Float32Array(width * height);
  }

  /** Fills a convex polygon where nothing nearer is, if its corners are counter-clockwise on the screen. */
  fill(corners: readonly Corner[], color: Triple, opacity: number): void {
    const first = corners[0];
    if (first === undefined) return;
    // The plane of the inverse distances, which are linear in the picture; by Newell's sum over the edges.
    let [slopeX, slopeY, area] = [0, 0, 0];
    corners.forEach((to, index) => {
      const from = corners.at(index - 1) as Corner;
      slopeX += (from[1] - to[1]) * (from[2] + to[2]);
      slopeY += (from[2] - to[2]) * (from[0] + to[0]);
      area += (from[0] - to[0]) * (from[1] + to[1]);
    });
    if (area > -MIN_AREA) return;
    const step = -slopeX / area;
    const [top, bottom] = rowsOf(corners, this.height);
    for (let row = top; row <= bottom; row++) {
      const [from, to] = spanOf(corners, row + 0.5);
      const left = Math.max(0, Math.ceil(from - 0.5));
      const right = Math.min(this.width - 1, Math.ceil(to - 0.5) - 1);
      const inverse = first[2] + step * (left + 0.5 - first[0]) - (slopeY / area) * (row + 0.5 - first[1]);
      this.fillRow(row * this.width + left, right - left + 1, inverse, step, color, opacity);
    }
  }

  private fillRow(start: number, count: number, first: number, step: number, color: Triple, opacity: number): void {
    const { depth, pixels } = this;
    const [red, green, blue] = color;
    for (let at = start, inverse = first; at < start + count; at++, inverse += step) {
      if (inverse < (depth[at] as number)) continue;
      if (opacity < 1) {
        this.blend(4 * at, color, opacity);
        continue;
      }
      depth[at] = inverse;
      pixels[4 * at] = red;
      pixels[4 * at + 1] = green;
      pixels[4 * at + 2] = blue;
      pixels[4 * at + 3] = 255;
    }
  }

  /** Colours are multiplied by the opacity until `finish`. */
  private blend(at: number, [red, green, blue]: Triple, opacity: number): void {
    const { pixels } = this;
    const rest = 1 - opacity;
    pixels[at] = opacity * red + rest * (pixels[at] as number);
    pixels[at + 1] = opacity * green + rest * (pixels[at + 1] as number);
    pixels[at + 2] = opacity * blue + rest * (pixels[at + 2] as number);
    pixels[at + 3] = opacity * 255 + rest * (pixels[at + 3] as number);
  }

  /** Returns the picture; nothing can be added any more. */
  finish(): Pixels {
    const { pixels } = this;
    for (let at = 0; at < pixels.length; at += 4) {
      const alpha = pixels[at + 3] as number;
      if (alpha === 0 || alpha === 255) continue;
      for (let part = at; part < at + 3; part++) pixels[part] = (255 * (pixels[part] as number)) / alpha;
    }
    return pixels;
  }
}

/** Returns the first and the last row whose middle is in a polygon. */
function rowsOf(corners: readonly Corner[], height: number): [number, number] {
  let [least, most] = [Number.POSITIVE_INFINITY, Number.NEGATIVE_INFINITY];
  for (const [, y] of corners) {
    least = Math.min(least, y);
    most = Math.max(most, y);
  }
  return [Math.max(0, Math.ceil(least - 0.5)), Math.min(height - 1, Math.ceil(most - 0.5) - 1)];
}

/** Returns from where to where a row lies in a convex polygon. */
function spanOf(corners: readonly Corner[], row: number): [number, number] {
  let [least, most] = [Number.POSITIVE_INFINITY, Number.NEGATIVE_INFINITY];
  let from = corners[corners.length - 1] as Corner;
  for (const to of corners) {
    if (from[1] <= row !== to[1] <= row) {
      const x = from[0] + ((row - from[1]) / (to[1] - from[1])) * (to[0] - from[0]);
      least = Math.min(least, x);
      most = Math.max(most, x);
    }
    from = to;
  }
  return [least, most];
}
