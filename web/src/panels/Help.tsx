/** The keys, made from the table of bindings. */

import { BINDINGS, type Binding } from "../keys/bindings";
import type { Store } from "../state/store";
import { Dialog } from "./Dialog";

const SECTIONS: Binding["section"][] = ["Review", "Queue", "View", "Page"];

export function Help({ store }: { store: Store }) {
  return (
    <Dialog title="Keys" onClose={() => (store.isHelpOpen.value = false)}>
      <div class="help">
        {SECTIONS.map((section) => (
          <section key={section}>
            <h3>{section}</h3>
            <dl>
              {BINDINGS.filter((binding) => binding.section === section).map((binding) => (
                <div key={binding.help}>
                  <dt>
                    {shownKeys(binding.keys).map((key) => (
                      <kbd key={key}>{key}</kbd>
                    ))}
                  </dt>
                  <dd>{binding.help}</dd>
                </div>
              ))}
            </dl>
          </section>
        ))}
      </div>
    </Dialog>
  );
}

function shownKeys(keys: string[]): string[] {
  if (keys.length === 9) return ["1 … 9"];
  const isEachArrow = keys.length === 4 && keys.every((key) => key.includes("+Arrow"));
  return isEachArrow
    ? [(keys[0] ?? "").replace(/Arrow\w+/, "arrows")]
    : keys.map((key) => key.replace("Arrow", "").replace("Escape", "Esc"));
}
