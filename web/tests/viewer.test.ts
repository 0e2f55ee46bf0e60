import { signal } from "@preact/signals";
import { BufferAttribute, Matrix4, PlaneGeometry, Ray, Raycaster, Vector3 } from "three";
import { describe, expect, it } from "vitest";
import { ApiFailure, type Client } from "../src/api/client";
import { missingPicture, ThumbnailCache } from "../src/panels/Thumbnail";
import { BoxBatch, boxMatrix } from "../src/viewer/boxes";
import { type Appearance, MeshBatches } from "../src/viewer/meshes";
import { makeScene } from "./scene";

const PLAIN: Appearance = { isVisible: true, color: null, opacity: 1 };

describe("clicks on boxes", () => {
  // Two boxes one behind the other along y; the first is 2 m high, the second 1 m.
  const boxes = new BoxBatch(
    [
      [-1, 1, 0, 1, 2, 2],
      [-1, 3, 0, 1, 4, 1],
    ],
    [null, null],
  );
  const pick = (appearances: Appearance[], z: number, top = 1000) => {
    boxes.paint(
      (object) => appearances[object] ?? PLAIN,
      () => false,
    );
    boxes.group.updateMatrixWorld(true);
    return boxes.pick(new Raycaster(new Vector3(0, 0, z), new Vector3(0, 1, 0)), top)?.object ?? null;
  };

  it("mean the nearest", () => {
    expect(pick([PLAIN, PLAIN], 0.5)).toBe(0);
  });

  it("go through ghosts and what is hidden to what is solid", () => {
    expect(pick([{ ...PLAIN, opacity: 0.1 }, PLAIN], 0.5)).toBe(1);
    expect(pick([{ ...PLAIN, isVisible: false }, PLAIN], 0.5)).toBe(1);
  });

  it("mean a ghost if there is nothing else", () => {
    expect(pick([{ ...PLAIN, opacity: 0.1 }, PLAIN], 1.5)).toBe(0);
  });

  it("miss what is cut away", () => {
    expect(pick([PLAIN, PLAIN], 1.5, 1.2)).toBeNull();
  });
});

describe("the meshes of one object", () => {
  /** Walls of one object at y = 2 and y = 4, of one geometry, and another object at y = 3. */
  const meshes = new MeshBatches();
  const wall = new PlaneGeometry(10, 10).rotateX(Math.PI / 2);
  const other = new PlaneGeometry(10, 10).rotateX(Math.PI / 2);
  for (const geometry of [wall, other]) {
    const count = geometry.attributes["position"]?.count ?? 0;
    geometry.setAttribute("color", new BufferAttribute(new Float32Array(4 * count).fill(1), 4));
  }
  const part = (geometry: PlaneGeometry, y: number, object: number) => ({
    geometry,
    texture: null,
    matrix: new Matrix4().makeTranslation(0, y, 0),
    object,
  });
  meshes.add([part(other, 3, 1), part(wall, 2, 0), part(wall, 4, 0)]);
  const along = (y: number) => new Ray(new Vector3(0, y, 0), new Vector3(0, 1, 0));

  it("are met only before the distance, and whether they are visible or not", () => {
    expect(meshes.meets(0, along(0), 2.5)).toBe(true);
    expect(meshes.meets(0, along(0), 1.5)).toBe(false);
    expect(meshes.meets(0, along(2.5), 1)).toBe(false);
    expect(meshes.meets(0, along(2.5), 2)).toBe(true);
    expect(meshes.meets(1, along(2.5), 1)).toBe(true);
    expect(meshes.meets(2, along(0), 10)).toBe(false);
    meshes.paint(() => ({ ...PLAIN, isVisible: false }), true);
    expect(meshes.meets(0, along(0), 2.5)).toBe(true);
  });
});

describe("thumbnails", () => {
  const cacheOf = (failures: ApiFailure[]) => {
    let requests = 0;
    const blob = async () => {
      requests++;
      const failure = failures.shift();
      if (failure !== undefined) throw failure;
      return new Blob(["png"]);
    };
    return {
      cache: new ThumbnailCache({ blob } as unknown as Client, (object) => (object === 9 ? "box only" : ""), signal(0)),
      count: () => requests,
    };
  };

  it("are asked for once", async () => {
    const { cache, count } = cacheOf([]);
    const [one, two] = await Promise.all([cache.get(1), cache.get(1)]);
    expect([one, count()]).toEqual([two, 1]);
  });

  it("are not asked for where there is nothing to render", async () => {
    const { cache, count } = cacheOf([]);
    expect([await cache.get(9), count()]).toEqual([{ problem: "box only" }, 0]);
    const data = makeScene();
    data.objects.box[1] = null;
    expect([0, 1].map((object) => missingPicture(data, object))).toEqual(["", "no geometry"]);
    expect(missingPicture({ ...data, limits: { meshes: "no stage" } }, 0)).toBe("box only");
  });

  it("tell an object without geometry from a failed request, which is tried again", async () => {
    const { cache, count } = cacheOf([new ApiFailure("no visible geometry", 422), new ApiFailure("gone", 0)]);
    expect(await cache.get(1)).toEqual({ problem: "no geometry" });
    expect(await cache.get(1)).toEqual({ problem: "no geometry" });
    expect(await cache.get(2)).toEqual({ problem: "not loaded" });
    expect(await cache.get(2)).toHaveProperty("url");
    expect(count()).toBe(3);
  });
});

describe("boxes without meshes", () => {
  it("stand along the object's own axes", () => {
    // A board of 2 × 0.2 × 0.1 m, turned by 90° about z: its long side lies along y.
    const half = Math.SQRT1_2;
    const matrix = boxMatrix([-0.1, -1, 0, 0.1, 1, 0.1], [0, 0, half, half, 2, 0.2, 0.1]);
    const corner = new Vector3(0.5, 0.5, 0.5).applyMatrix4(matrix);
    expect(corner.toArray().map((value) => Math.round(1000 * value) / 1000)).toEqual([-0.1, 1, 0.1]);
  });
});
