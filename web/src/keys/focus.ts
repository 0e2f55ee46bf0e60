/** The focus after the mouse: a control that was clicked gives it back, so that the next key belongs to the review. */

/** Controls that take Enter, Space or arrows while they have the focus; text fields and lists are none. */
const CONTROLS = "button, a, summary, input[type=checkbox], input[type=range]";
/** What has keys of its own until it is closed. */
const ENCLOSURES = "dialog, .popover";

/** Follows the mouse and the keyboard; returns what stops it. */
export function giveFocusBack(): () => void {
  // A click has no pointer of its own if a key or a label makes it.
  let isByPointer = false;
  const onPointer = () => {
    isByPointer = true;
  };
  const onKey = () => {
    isByPointer = false;
  };
  const onClick = () => {
    const focused = document.activeElement;
    if (!isByPointer || !(focused instanceof HTMLElement)) return;
    if (focused.matches(CONTROLS) && focused.closest(ENCLOSURES) === null) focused.blur();
  };
  addEventListener("pointerdown", onPointer, true);
  addEventListener("keydown", onKey, true);
  addEventListener("click", onClick);
  return () => {
    removeEventListener("pointerdown", onPointer, true);
    removeEventListener("keydown", onKey, true);
    removeEventListener("click", onClick);
  };
}
