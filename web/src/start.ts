/** Starts the page: asks for the scene, and shows its boxes while the rest of the page is loading. */

import { keyOfAddress, readKey } from "./api/client";
import { type Opening, openScene } from "./api/opening";
import { FirstPicture } from "./viewer/firstPicture";

/** A scene that is being opened, and its first picture; null if the scene cannot be had, which `scene` reports. */
export interface Start extends Opening {
  picture: Promise<FirstPicture | null>;
}

function open(key: string): Start {
  const opening = openScene(key, { tab: sessionStorage, browser: localStorage });
  return { ...opening, picture: opening.scene.then(showPicture, () => null) };
}

async function showPicture(scene: Awaited<Opening["scene"]>): Promise<FirstPicture> {
  const picture = new FirstPicture(scene);
  await picture.show();
  return picture;
}

const findKey = () => readKey(location, sessionStorage, (url) => history.replaceState(null, "", url));
// The address of a studio that was started again differs in the fragment alone, so that the browser loads nothing.
addEventListener("hashchange", () => {
  if (keyOfAddress(location) === null) return;
  findKey();
  location.reload();
});
const key = findKey();
const first = key === null ? null : open(key);
const { run } = await import("./main");
run(first, open);
