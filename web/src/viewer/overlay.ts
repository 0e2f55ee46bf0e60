/** Labels over the picture: plain text elements that follow points of the scene. */

import { type Camera, Vector3 } from "three";

export interface OverlayLabel {
  at: Vector3;
  text: string;
  kind: "object" | "relation";
}

/** Where a label is: its middle and its width in pixels. */
export interface Place {
  x: number;
  y: number;
  width: number;
}

const LETTER_WIDTH = 6;
const PADDING = 5;
const HEIGHT = 16;

export function overlaps(one: Place, other: Place): boolean {
  return Math.abs(one.x - other.x) < (one.width + other.width) / 2 && Math.abs(one.y - other.y) < HEIGHT;
}

export class LabelOverlay {
  private labels: OverlayLabel[] = [];
  private readonly elements: HTMLElement[] = [];

  constructor(private readonly host: HTMLElement) {}

  show(labels: OverlayLabel[]): void {
    this.labels = labels;
    while (this.elements.length < labels.length) {
      const element = document.createElement("div");
      this.host.append(element);
      this.elements.push(element);
    }
    this.elements.forEach((element, index) => {
      const label = labels[index];
      element.hidden = label === undefined;
      if (label !== undefined) {
        element.className = `label label-${label.kind}`;
        element.textContent = label.text;
      }
    });
  }

  /** Moves the labels to where the camera sees their points; one that would cover an earlier one is hidden. */
  place(camera: Camera, width: number, height: number): void {
    const point = new Vector3();
    const taken: Place[] = [];
    this.labels.forEach((label, index) => {
      const element = this.elements[index] as HTMLElement;
      point.copy(label.at).project(camera);
      const isBehind = point.z > 1 || Math.abs(point.x) > 1.05 || Math.abs(point.y) > 1.05;
      const x = ((point.x + 1) / 2) * width;
      const y = ((1 - point.y) / 2) * height;
      const place = { x, y, width: LETTER_WIDTH * label.text.length + 2 * PADDING };
      const isShown = !isBehind && !taken.some((other) => overlaps(place, other));
      element.style.visibility = isShown ? "visible" : "hidden";
      if (isShown) taken.push(place);
      element.style.transform = `translate(-50%, -50%) translate(${x.toFixed(1)}px, ${y.toFixed(1)}px)`;
    });
  }
}
