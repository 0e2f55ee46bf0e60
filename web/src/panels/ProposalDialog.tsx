/** Proposes a subclass that the ontology lacks; the objects get its superclass. */

import { useMemo, useState } from "preact/hooks";
import { offeredClasses } from "../state/concepts";
import { classLabel } from "../state/model";
import { proposedLabel } from "../state/proposals";
import type { Store } from "../state/store";
import { ClassPicker, useClassChoice } from "./ClassPicker";
import { Dialog } from "./Dialog";

const MAX_LABEL = 100;

export function ProposalDialog({ store }: { store: Store }) {
  const { model } = store;
  const [label, setLabel] = useState(() => proposedLabel(store));
  const [comment, setComment] = useState("");
  const targets = store.targets.value;
  const offered = offeredClasses(store);
  const choice = useClassChoice(
    model,
    useMemo(() => offered, [offered.join()]),
  );
  const close = () => {
    store.isProposalOpen.value = false;
  };
  const isReady = label.trim() !== "" && choice.chosen >= 0;
  return (
    <Dialog title={`A class for ${targets.length} ${targets.length === 1 ? "object" : "objects"}`} onClose={close}>
      <form
        class="proposal picking"
        onSubmit={(event) => {
          event.preventDefault();
          if (!isReady) return;
          close();
          void store.decide(targets, "choose", choice.chosen, { proposal: label.trim(), comment: comment.trim() });
        }}
      >
        <div class="fields">
          <label>
            Label of the class
            <input
              type="text"
              maxLength={MAX_LABEL}
              autofocus
              value={label}
              onFocus={(event) => event.currentTarget.select()}
              onInput={(event) => setLabel(event.currentTarget.value)}
            />
          </label>
          <label>
            Comment
            <input
              type="text"
              maxLength={2000}
              value={comment}
              onInput={(event) => setComment(event.currentTarget.value)}
            />
          </label>
        </div>
        <span class="muted">Superclass, which the objects get</span>
        <ClassPicker model={model} choice={choice} label="Superclass" isFocused={false} />
        <button type="submit" class="primary" disabled={!isReady}>
          Propose {label.trim() || "a class"} below {choice.chosen < 0 ? "…" : classLabel(model, choice.chosen)}{" "}
          <kbd>Enter</kbd>
        </button>
      </form>
    </Dialog>
  );
}
