/** Figures of the run: what was read, with which ontology and settings. */

import type { Store } from "../state/store";

export function RunFigures({ store }: { store: Store }) {
  return (
    <dl class="facts columns">
      {store.model.data.figures.map(({ label, value }) => (
        <div key={label}>
          <dt>{label}</dt>
          <dd>{value}</dd>
        </div>
      ))}
    </dl>
  );
}
