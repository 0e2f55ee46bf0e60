/** The first picture: the boxes of the scene in the place of the view, until WebGL has drawn its first frame. */

import type { SceneData } from "../api/types";
import { drawBoxes } from "./boxPicture";

/** As the view; more pixels are not seen. */
export const MAX_PIXEL_RATIO = 2;
const LATEST_MS = 200;

export class FirstPicture {
  private readonly canvas = document.createElement("canvas");
  /** The columns and rows of the page, still empty. */
  private readonly page = document.createElement("div");

  constructor(private readonly data: SceneData) {
    this.canvas.className = "first-picture";
    this.canvas.setAttribute("aria-hidden", "true");
    this.page.className = "app first-page";
    const view = document.createElement("div");
    view.className = "viewer";
    view.append(this.canvas);
    this.page.append(view);
  }

  /** Shows it where the view will be; resolves when the browser has painted it. */
  async show(): Promise<void> {
    document.body.append(this.page);
    this.draw();
    await painted();
  }

  /** Moves it into the view, which may have another size. */
  moveTo(host: HTMLElement): void {
    host.append(this.canvas);
    this.page.remove();
    this.draw();
  }

  remove(): void {
    this.canvas.remove();
    this.page.remove();
  }

  private draw(): void {
    const { clientWidth, clientHeight } = this.canvas;
    const ratio = Math.min(devicePixelRatio, MAX_PIXEL_RATIO);
    const [width, height] = [Math.floor(clientWidth * ratio), Math.floor(clientHeight * ratio)];
    if (width === 0 || height === 0 || (this.canvas.width === width && this.canvas.height === height)) return;
    Object.assign(this.canvas, { width, height });
    const pixels = new ImageData(drawBoxes(this.data, width, height), width, height);
    this.canvas.getContext("2d")?.putImageData(pixels, 0, 0);
  }
}

/** Resolves after the next frame; a page in the background has none. */
function painted(): Promise<void> {
  return new Promise((resolve) => {
    requestAnimationFrame(() => setTimeout(resolve, 0));
    setTimeout(resolve, LATEST_MS);
  });
}
