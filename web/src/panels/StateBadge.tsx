/** The state of an object's class as icon, colour and text. */

import type { ReviewState } from "../api/types";
import { STATE_LABELS } from "../state/colors";

/** Shapes differ, so that states can be told apart without colours. */
const ICONS: Record<ReviewState, string> = {
  suggested: "M8 3a5 5 0 1 0 0 10A5 5 0 0 0 8 3zm0 1.6a3.4 3.4 0 1 1 0 6.8 3.4 3.4 0 0 1 0-6.8z",
  confirmed: "M6.5 11.6 2.9 8l1.2-1.2 2.4 2.4 5.4-5.4L13.1 5z",
  corrected: "M3 11.2V13h1.8l6.3-6.3-1.8-1.8zM12.8 5 11 3.2l-1 1L11.8 6z",
  unsure:
    "M7.2 11.4h1.6V13H7.2zM8 3a3 3 0 0 0-3 3h1.6a1.4 1.4 0 1 1 2.2 1.2c-1 .7-1.6 1.2-1.6 2.8h1.6c0-1 .4-1.2 1-1.7A3 3 0 0 0 8 3z",
  "no-class":
    "M8 3a5 5 0 1 0 0 10A5 5 0 0 0 8 3zM4.7 8c0-.7.2-1.3.6-1.9l4.6 4.6A3.3 3.3 0 0 1 4.7 8zm1.4-2.7A3.3 3.3 0 0 1 10.7 9.9z",
  refused: "M5.5 2.5h5l3 3v5l-3 3h-5l-3-3v-5zM5 7.2v1.6h6V7.2z",
  unreadable:
    "M3 4h10v1.5H3zm0 3.2h6v1.5H3zm0 3.3h4V12H3zm7.3-1.8 1.1-1.1 1.3 1.3 1.3-1.3 1 1.1L13.8 10l1.3 1.3-1 1-1.4-1.2-1.3 1.3-1.1-1.1 1.3-1.3z",
  failed: "M8 2.5 14 13H2zM7.3 6.5v3h1.4v-3zm0 4v1.3h1.4v-1.3z",
};

export function StateIcon({ state }: { state: ReviewState }) {
  return (
    <svg class={`state-icon state-${state}`} viewBox="0 0 16 16" role="img" aria-label={STATE_LABELS[state]}>
      <path d={ICONS[state]} fill-rule="evenodd" />
    </svg>
  );
}

export function StateBadge({ state }: { state: ReviewState }) {
  return (
    <span class={`badge state-${state}`}>
      <StateIcon state={state} />
      {STATE_LABELS[state]}
    </span>
  );
}
