import { describe, expect, it } from "vitest";
import type { Box } from "../src/api/types";
import { boundsOf } from "../src/viewer/bounds";

const cube = (x: number, y: number, z: number): Box => [x - 0.5, y - 0.5, z - 0.5, x + 0.5, y + 0.5, z + 0.5];

describe("bounds", () => {
  const columns = {
    box: [cube(0, 0, 0), cube(4, 3, 0), null, cube(1, 1, 343_582)],
    is_outlier: [false, false, false, true],
  };

  it("leave out outliers and objects without geometry", () => {
    expect(boundsOf(columns)).toEqual([-0.5, -0.5, -0.5, 4.5, 3.5, 0.5]);
  });

  it("show an outlier that is looked at alone", () => {
    expect(boundsOf(columns, [3])).toEqual(columns.box[3]);
  });

  it("are unknown without objects", () => {
    expect(boundsOf(columns, [])).toBeNull();
    expect(boundsOf(columns, [2])).toBeNull();
  });
});
