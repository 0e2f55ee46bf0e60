/** Starts the page: asks for the scene, and shows its boxes while the rest of the page is loading. */

import { readKey } from "./api/client";
import { type Opening, openScene } from "./api/opening";
import { FirstPicture } from "./viewer/firstPicture";

/** A scene that is being opened, and its first picture; null if the scene cannot be had, which `scene` reports. */
export interface Start extends Opening {
  picture: Promise<FirstPicture | null>;
}

function open(key: string): Start {
  const opening = openScene(key, localStorage);
  return { ...opening, picture: opening.scene.then(showPicture, () => null) };
}

async function showPicture(scene: Awaited<Opening["scene"]>): Promise<FirstPicture> {
  const picture = new FirstPicture(scene);
  await picture.show();
  return picture;
}

const key = readKey(location, sessionStorage, (url) => history.replaceState(null, "", url));
const first = key === null ? null : open(key);
const { run } = await import("./main");
run(first, open);
