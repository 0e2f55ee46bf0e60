/** The candidate classes of the object in focus, with their keys. */

import type { CandidateEvidence, ObjectIndex } from "../api/types";
import { isAuditing } from "../state/audit";
import { candidatesOf, evidenceText } from "../state/candidates";
import type { Store } from "../state/store";

export function Candidates({ store, targets }: { store: Store; targets: readonly ObjectIndex[] }) {
  const candidates = candidatesOf(store);
  if (candidates === undefined) return <p class="empty">…</p>;
  if (candidates.length === 0) return <p class="empty">The grounder named no class. Search one with /</p>;
  return (
    <ol class="candidates">
      {candidates.map(({ class: index, share, taxonomy, evidence }, number) => {
        const cls = store.model.data.classes[index];
        return (
          <li key={index}>
            <button
              type="button"
              disabled={targets.length === 0}
              title={cls?.definition ?? ""}
              onClick={() => void store.decide(targets, "choose", index)}
            >
              <kbd>{number + 1}</kbd>
              <span class="name">{cls?.label}</span>
              {share !== null && !isAuditing(store) && (
                <span class="share" style={{ "--share": `${Math.round(100 * share)}%` }}>
                  {Math.round(100 * share)} %
                </span>
              )}
              <span class="path">{taxonomy.slice(1).join(" ‹ ")}</span>
            </button>
            {evidence.length > 0 && <Evidence evidence={evidence} label={cls?.label ?? ""} />}
          </li>
        );
      })}
    </ol>
  );
}

/** What speaks for a candidate and against it, source by source; opened, with its sentences. */
function Evidence({ evidence, label }: { evidence: readonly CandidateEvidence[]; label: string }) {
  return (
    <details class="candidate-evidence">
      <summary aria-label={`Evidence for ${label}`}>{evidence.map(evidenceText).join(" · ")}</summary>
      <ul>
        {evidence.map((each) => (
          <li key={each.group}>
            <strong>{evidenceText(each)}</strong> {each.explanation}
          </li>
        ))}
      </ul>
    </details>
  );
}
