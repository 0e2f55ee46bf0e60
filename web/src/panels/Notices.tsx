/** Short messages about what has happened. */

import type { Store } from "../state/store";

export function Notices({ store }: { store: Store }) {
  return (
    <div class="notices" role="status" aria-live="polite">
      {store.notices.value.map((notice) => (
        <div key={notice.id} class={`notice ${notice.kind}`}>
          <span>{notice.text}</span>
          <button type="button" class="quiet" aria-label="Dismiss" onClick={() => store.dismiss(notice.id)}>
            ×
          </button>
        </div>
      ))}
    </div>
  );
}
