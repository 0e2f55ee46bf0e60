/** The line at the bottom: whether decisions are saved, who decides, how much is left. */

import { useState } from "preact/hooks";
import { durationText, groupCount } from "../state/review";
import type { Saving } from "../state/serverState";
import type { Store } from "../state/store";

const SAVING: Record<Saving, string> = {
  saved: "Saved",
  saving: "Saving…",
  failed: "Not saved",
  offline: "Offline: the server does not answer",
};

export function StatusBar({ store }: { store: Store }) {
  const { model } = store;
  const seconds = store.queue.value?.seconds_left ?? null;
  const decided = store.decided.value;
  const share = model.count === 0 ? 1 : decided / model.count;
  const { folder, problem } = store.server.outputs.value;
  const groups = store.openGroups.value.length;
  const saving = store.server.saving.value;
  return (
    <footer class="status-bar">
      <span class={`saving is-${saving}`} role="status">
        {SAVING[saving]}
      </span>
      <span
        class={problem === "" ? "folder" : "folder problem"}
        title={problem || "Graph, mapping and labels follow the decisions"}
      >
        {problem === "" ? folder : `Files not up to date: ${problem}`}
      </span>
      <span class="progress" role="progressbar" aria-valuenow={Math.round(100 * share)} aria-label="Decided">
        <span style={{ width: `${100 * share}%` }} />
      </span>
      <span>
        {decided} of {model.count} decided
        {groups > 0 && ` · ${groupCount(groups)} open`}
        {seconds !== null && ` · about ${durationText(seconds)} left`}
      </span>
      <Reviewer store={store} />
    </footer>
  );
}

function Reviewer({ store }: { store: Store }) {
  const [name, setName] = useState<string | null>(null);
  const save = () => {
    if (name !== null) store.setReviewer(name);
    setName(null);
  };
  return (
    <label class="reviewer" title="Your name or ORCID iD, as your decisions state it">
      Reviewer
      <input
        type="text"
        maxLength={200}
        value={name ?? store.reviewer.value}
        onInput={(event) => setName(event.currentTarget.value)}
        onBlur={save}
        onKeyDown={(event) => {
          if (event.key === "Enter") event.currentTarget.blur();
        }}
      />
    </label>
  );
}
