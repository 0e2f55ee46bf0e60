/** Labels over the picture: plain text elements that follow points of the scene. */

import { type Camera, Vector3 } from "three";

export interface OverlayLabel {
  at: Vector3;
  text: string;
  kind: "object" | "relation" | "hover";
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

  /** Moves the labels to where the camera sees their points. */
  place(camera: Camera, width: number, height: number): void {
    const point = new Vector3();
    this.labels.forEach((label, index) => {
      const element = this.elements[index] as HTMLElement;
      point.copy(label.at).project(camera);
      const isBehind = point.z > 1 || Math.abs(point.x) > 1.05 || Math.abs(point.y) > 1.05;
      element.style.visibility = isBehind ? "hidden" : "visible";
      const x = ((point.x + 1) / 2) * width;
      const y = ((1 - point.y) / 2) * height;
      element.style.transform = `translate(-50%, -50%) translate(${x.toFixed(1)}px, ${y.toFixed(1)}px)`;
    });
  }
}
