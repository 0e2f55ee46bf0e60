/** Loads the meshes of a scene, file by file. */

import type { Client } from "../api/client";
import type { GeometryManifest } from "../api/types";
import type { Viewer } from "./viewer";

/** Adds all files to the picture, the largest objects first; the next file is made while one is added. */
export async function loadGeometry(
  client: Client,
  viewer: Viewer,
  onProgress: (done: number, count: number) => void,
): Promise<void> {
  const { chunks } = await client.get<GeometryManifest>("geometry");
  const fetchFile = async (index: number) => (await client.blob(`geometry/${index}.glb`)).arrayBuffer();
  let next = chunks.length > 0 ? fetchFile(0) : null;
  for (let index = 0; next !== null; index++) {
    onProgress(index, chunks.length);
    const data: ArrayBuffer = await next;
    next = index + 1 < chunks.length ? fetchFile(index + 1) : null;
    // The error of a request that is never awaited is no error of the page.
    next?.catch(() => {});
    await viewer.addFile(data);
  }
  onProgress(chunks.length, chunks.length);
}
