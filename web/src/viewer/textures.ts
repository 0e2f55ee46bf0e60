/** Images of textures, fetched once each. */

import { ClampToEdgeWrapping, MirroredRepeatWrapping, RepeatWrapping, SRGBColorSpace, Texture } from "three";
import type { Client } from "../api/client";
import type { TextureUse } from "../api/types";

const ANISOTROPY = 4;

/** Returns the texture; null if the server has no image for it. */
export async function fetchTexture(client: Client, use: TextureUse): Promise<Texture | null> {
  const blob = await client.blob(`geometry/textures/${use.texture}`);
  if (blob.size === 0) return null;
  const texture = new Texture(await createImageBitmap(blob));
  // As in glTF, the origin of texture coordinates is the upper left corner.
  texture.flipY = false;
  texture.colorSpace = SRGBColorSpace;
  texture.anisotropy = ANISOTROPY;
  [texture.wrapS, texture.wrapT] = [wrapping(use.wrap[0]), wrapping(use.wrap[1])];
  texture.needsUpdate = true;
  return texture;
}

function wrapping(mode: string) {
  if (mode === "mirror") return MirroredRepeatWrapping;
  return mode === "clamp" ? ClampToEdgeWrapping : RepeatWrapping;
}
