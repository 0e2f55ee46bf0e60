/** What grounding again has changed, and why. */

import type { RegroundReply } from "../api/types";
import { classLabel } from "../state/model";
import type { Store } from "../state/store";
import { Dialog } from "./Dialog";

export function ChangesDialog({ store, changes }: { store: Store; changes: RegroundReply["changes"] }) {
  const { model } = store;
  const close = () => {
    store.changes.value = null;
  };
  return (
    <Dialog title={`${changes.length} ${changes.length === 1 ? "suggestion" : "suggestions"} changed`} onClose={close}>
      {changes.length === 0 && <p class="empty">The decisions so far teach nothing new about the open objects.</p>}
      <ul class="changes">
        {changes.map(({ object, before, after, reason }) => (
          <li key={object}>
            <button
              type="button"
              class="link"
              onClick={() => {
                close();
                store.select([object]);
              }}
            >
              {model.shortNames[object]}
            </button>
            <span>
              {before < 0 ? "no class" : classLabel(model, before)} <span class="arrow">→</span>{" "}
              <strong>{after < 0 ? "no class" : classLabel(model, after)}</strong>
            </span>
            <span class="muted">{reason}</span>
          </li>
        ))}
      </ul>
    </Dialog>
  );
}
