/** Figures of the run: what was read, with which ontology and settings, and how far the reviewers agree. */

import type { Store } from "../state/store";

export function RunFigures({ store }: { store: Store }) {
  const agreement = (store.queue.value?.agreement ?? []).map(({ reviewers, objects, same, kappa }) => ({
    label: `Agreement of ${reviewers.join(" and ")}`,
    value: `${same} of ${objects}${kappa === null ? "" : `, Cohen's κ ${kappa.toFixed(2)}`}`,
  }));
  return (
    <dl class="facts columns">
      {[...agreement, ...store.model.data.figures].map(({ label, value }) => (
        <div key={label}>
          <dt>{label}</dt>
          <dd>{value}</dd>
        </div>
      ))}
    </dl>
  );
}
