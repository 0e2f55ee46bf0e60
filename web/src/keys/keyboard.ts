/** Handles keys wherever they are pressed, except in text fields. */

import type { Store } from "../state/store";
import { dialogs, findBinding, keyName, type ViewCommands } from "./bindings";

const TEXT_INPUTS = new Set(["text", "search", "password", "email", "number"]);

function isTextField(target: EventTarget | null): boolean {
  if (target instanceof HTMLInputElement) return TEXT_INPUTS.has(target.type);
  return target instanceof HTMLTextAreaElement || target instanceof HTMLSelectElement;
}

/**
 * Returns whether a key belongs to the focused control: Enter and Space on a button, arrows on a slider and in a list,
 * which prevents the default of the other keys that it takes.
 */
function isOfControl(target: EventTarget | null, key: string): boolean {
  if (target instanceof HTMLElement && target.matches("button, a, summary")) return key === "Enter" || key === "Space";
  if (target instanceof HTMLInputElement && target.type === "range") return key.startsWith("Arrow");
  if (target instanceof HTMLInputElement) return key === "Space";
  return target instanceof HTMLElement && target.closest("[data-own-keys]") !== null && key.startsWith("Arrow");
}

export function handleKey(event: KeyboardEvent, store: Store, view: ViewCommands): void {
  const key = keyName(event);
  if (event.defaultPrevented || event.isComposing) return;
  const isModal = dialogs(store).some((dialog) => dialog.value) || store.changes.value !== null;
  if (key !== "Escape" && (isModal || isTextField(event.target) || isOfControl(event.target, key))) return;
  if (key === "Escape" && isTextField(event.target)) (event.target as HTMLElement).blur();
  const binding = findBinding(key);
  if (binding === undefined) return;
  event.preventDefault();
  binding.run(store, view, key);
}
