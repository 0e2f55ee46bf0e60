/** A dialog that finds a class, and chooses it for the objects under review. */

import type { ClassIndex } from "../api/types";
import type { Store } from "../state/store";
import { ClassPicker, useClassChoice } from "./ClassPicker";
import { Dialog } from "./Dialog";

const NOTHING: readonly ClassIndex[] = [];

export function ClassSearch({ store }: { store: Store }) {
  const { model } = store;
  const choice = useClassChoice(model, NOTHING);
  const targets = store.targets.value;
  const close = () => {
    store.isClassSearchOpen.value = false;
  };
  const choose = (index: ClassIndex) => {
    if (index < 0) return;
    close();
    void store.decide(targets, "choose", index);
  };
  return (
    <Dialog title={`Class of ${targets.length} ${targets.length === 1 ? "object" : "objects"}`} onClose={close}>
      <form
        class="picking"
        onSubmit={(event) => {
          event.preventDefault();
          choose(choice.chosen);
        }}
      >
        <ClassPicker model={model} choice={choice} label="Search a class" isFocused onPick={choose} />
      </form>
    </Dialog>
  );
}
