/** Loads the meshes of a scene, file by file. */

import type { Client } from "../api/client";
import type { GeometryManifest, TextureUse } from "../api/types";
import { fetchTexture } from "./textures";
import type { Viewer } from "./viewer";

/** Adds all files to the picture, the largest objects first; the next file is made while one is added. */
export async function loadGeometry(
  client: Client,
  viewer: Viewer,
  onProgress: (done: number, count: number) => void,
): Promise<void> {
  const { chunks } = await client.get<GeometryManifest>("geometry");
  const fetchFile = async (index: number) => (await client.blob(`geometry/${index}.glb`)).arrayBuffer();
  const textures = new Map<number, TextureUse>();
  let next = chunks.length > 0 ? fetchFile(0) : null;
  for (let index = 0; next !== null; index++) {
    onProgress(index, chunks.length);
    const data: ArrayBuffer = await next;
    next = index + 1 < chunks.length ? fetchFile(index + 1) : null;
    // The error of a request that is never awaited is not an error of the page.
    next?.catch(() => {});
    for (const use of await viewer.addFile(data)) textures.set(use.texture, use);
  }
  onProgress(chunks.length, chunks.length);
  // Colours are shown until the images arrive.
  for (const use of textures.values()) {
    const texture = await fetchTexture(client, use);
    if (texture !== null) viewer.addTexture(use.texture, texture);
  }
}
