import { describe, expect, it } from "vitest";
import type { Box, SceneData } from "../src/api/types";
import { drawBoxes } from "../src/viewer/boxPicture";
import { Raster } from "../src/viewer/raster";
import { makeScene } from "./scene";

const SIZE = 64;
const RED: [number, number, number] = [1, 0, 0];
const BLUE: [number, number, number] = [0, 0, 1];

function sceneOf(boxes: Box[], colors: [number, number, number][], given: Partial<SceneData> = {}): SceneData {
  const data = makeScene();
  const each = <T>(value: T) => boxes.map(() => value);
  const objects = {
    ...data.objects,
    box: boxes,
    color: colors,
    turned: each(null),
    parent: each(-1),
    shell: each("" as const),
    mount: each(-1),
    is_outlier: each(false),
  };
  return { ...data, objects, ...given };
}

const middleOf = (pixels: Uint8ClampedArray) => {
  const at = 4 * (SIZE * (SIZE / 2) + SIZE / 2);
  return [...pixels.subarray(at, at + 4)];
};
const share = (pixels: Uint8ClampedArray) => pixels.filter((value, at) => at % 4 === 3 && value > 0).length / SIZE ** 2;

describe("the picture of boxes", () => {
  const cube: Box = [-1, -1, -1, 1, 1, 1];

  it("shows what is nearer to the camera, whatever the order", () => {
    // The camera looks from -x, -y and above.
    const near: Box = [-1.5, -1.5, 1.2, -1.1, -1.1, 1.6];
    for (const order of [
      [cube, near],
      [near, cube],
    ]) {
      const colors = order.map((box) => (box === cube ? RED : BLUE));
      const pixels = drawBoxes(sceneOf(order as Box[], colors), SIZE, SIZE);
      const blue = pixels.filter((value, at) => at % 4 === 2 && value > 100).length;
      expect(blue).toBeGreaterThan(10);
      expect(share(pixels)).toBeGreaterThan(0.2);
    }
  });

  it("is lit from above the camera: the top is brighter than the sides", () => {
    const pixels = drawBoxes(sceneOf([cube], [RED]), SIZE, SIZE);
    const rows = Array.from({ length: SIZE }, (_, row) => pixels[4 * (SIZE * row + SIZE / 2)] as number);
    const shown = rows.filter((value) => value > 0);
    expect(shown[2]).toBeGreaterThan((shown.at(-3) as number) + 10);
    expect(middleOf(pixels)[3]).toBe(255);
  });

  it("is transparent where there is nothing, and everywhere without boxes", () => {
    const pixels = drawBoxes(sceneOf([cube], [RED]), SIZE, SIZE);
    expect([...pixels.subarray(0, 4)]).toEqual([0, 0, 0, 0]);
    expect(share(drawBoxes(sceneOf([], []), SIZE, SIZE))).toBe(0);
  });

  it("leaves out ceilings and near walls", () => {
    const data = sceneOf([cube, [-4, -4, 2, 4, 4, 2.2]], [RED, BLUE]);
    data.objects.shell[1] = "ceiling";
    expect(middleOf(drawBoxes(data, SIZE, SIZE))[2]).toBe(0);
  });

  it("lets boxes without meshes that hold others be seen through", () => {
    const data = sceneOf([cube, [-0.2, -0.2, -0.2, 0.2, 0.2, 0.2]], [RED, BLUE], { limits: { meshes: "a graph" } });
    data.objects.parent[1] = 0;
    const middle = middleOf(drawBoxes(data, SIZE, SIZE));
    expect(middle[2]).toBeGreaterThan(60);
    expect(middle[0]).toBeGreaterThan(0);
    const ghost = drawBoxes(data, SIZE, SIZE).filter((value, at) => at % 4 === 3 && value > 0 && value < 255);
    expect(ghost.length).toBeGreaterThan(100);
  });

  it("has the box of a turned object along its own axes", () => {
    const data = sceneOf([[-1, -1, -0.1, 1, 1, 0.1]], [RED]);
    const straight = share(drawBoxes(data, SIZE, SIZE));
    const half = Math.SQRT1_2;
    data.objects.turned[0] = [0, 0, half, half, 2, 0.1, 0.1];
    expect(share(drawBoxes(data, SIZE, SIZE))).toBeLessThan(straight / 3);
  });

  it("cuts off what is behind the camera", () => {
    // A ground that reaches behind the camera, as an outlier does.
    const data = sceneOf([cube, [-500, -500, -1.2, 500, 500, -1.1]], [RED, BLUE]);
    data.objects.is_outlier[1] = true;
    const pixels = drawBoxes(data, SIZE, SIZE);
    expect(share(pixels)).toBeGreaterThan(0.9);
    expect([...pixels.subarray(pixels.length - 4)].map(Number)[2]).toBeGreaterThan(60);
  });
});

describe("a raster", () => {
  it("fills the pixels whose middles are in a polygon, seen from its front", () => {
    const raster = new Raster(4, 4);
    // Counter-clockwise on the screen: down the left side, then to the right.
    raster.fill(
      [
        [1, 1, 1],
        [1, 3, 1],
        [3, 3, 1],
        [3, 1, 1],
      ],
      [9, 8, 7],
      1,
    );
    raster.fill(
      [
        [0, 0, 2],
        [4, 0, 2],
        [4, 4, 2],
        [0, 4, 2],
      ],
      [1, 1, 1],
      1,
    );
    const pixels = raster.finish();
    const filled = [...Array(16).keys()].filter((at) => pixels[4 * at + 3] === 255);
    expect(filled).toEqual([5, 6, 9, 10]);
    expect([...pixels.subarray(20, 24)]).toEqual([9, 8, 7, 255]);
  });
});
