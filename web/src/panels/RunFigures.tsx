/** Figures of the run: what was read, with which ontology and settings, and how far the reviewers agree. */

import { classLabel } from "../state/model";
import { listProposals } from "../state/proposals";
import type { Store } from "../state/store";

export function RunFigures({ store }: { store: Store }) {
  const agreement = (store.queue.value?.agreement ?? []).map(({ reviewers, objects, same, kappa }) => ({
    label: `Agreement of ${reviewers.join(" and ")}`,
    value: `${same} of ${objects}${kappa === null ? "" : `, Cohen's κ ${kappa.toFixed(2)}`}`,
  }));
  const proposals = listProposals(store.states.value).map(({ label, parent, objects }) => ({
    label: `Proposed class “${label}”`,
    value: `below ${classLabel(store.model, parent)}, ${objects} ${objects === 1 ? "object" : "objects"}`,
  }));
  return (
    <dl class="facts columns">
      {[...agreement, ...proposals, ...store.model.data.figures].map(({ label, value }) => (
        <div key={label}>
          <dt>{label}</dt>
          <dd>{value}</dd>
        </div>
      ))}
    </dl>
  );
}
