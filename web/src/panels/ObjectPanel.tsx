/** The page of one object: class, evidence for each candidate, measures, relations, history, statements. */

import type { ComponentChildren } from "preact";
import type { HistoryEntry, ObjectPage, RelationRecord } from "../api/types";
import { isAuditing } from "../state/audit";
import { focusOf, pageOf } from "../state/candidates";
import { openConcept } from "../state/concepts";
import { classLabel, conceptLabel } from "../state/model";
import type { Store } from "../state/store";
import { relationText } from "../viewer/annotations";
import { Candidates } from "./Candidates";
import { StateBadge } from "./StateBadge";
import { Thumbnail } from "./Thumbnail";

export function ObjectPanel({ store }: { store: Store }) {
  const page = pageOf(store).value;
  const state = store.states.value[focusOf(store)];
  if (page === null || state === undefined || page.object !== state.object) {
    return (
      <aside class="object-panel" aria-label="Object">
        <p class="empty">Select an object in the picture, a tree or a table.</p>
      </aside>
    );
  }
  const { model } = store;
  const targets = store.targets.value;
  return (
    <aside class="object-panel" aria-label="Object">
      <header>
        <Thumbnail object={page.object} label={`Picture of ${page.name}`} />
        <div>
          <h2 title={page.path}>{page.name}</h2>
          <p class="class-line">{state.class < 0 ? "no class" : classLabel(model, state.class)}</p>
          {state.proposal !== "" && (
            <p class="muted">
              proposed below it: <strong>{state.proposal}</strong>
            </p>
          )}
          <StateBadge state={state.state} />
          {state.confidence !== null && !isAuditing(store) && (
            <p class="muted">confidence {state.confidence.toFixed(2)}</p>
          )}
        </div>
      </header>
      {state.is_conflict && <p class="conflict">Reviewers disagree. A decision now settles it.</p>}
      <Section title="Why">
        <p>{page.explanation}</p>
        {page.evidence.length > 0 && <p class="evidence">Evidence: {page.evidence.join(", ")}</p>}
        {page.concept !== null && (
          <p class="concept">
            Concept <strong>{page.concept.label}</strong>
            {page.concept.confidence !== null && !isAuditing(store) && ` (${page.concept.confidence.toFixed(2)})`}
            <span class="path"> ‹ {page.concept.hypernyms.slice(0, 5).join(" ‹ ")}</span>{" "}
            <button type="button" onClick={() => openConcept(store)}>
              Every {page.concept.label} is… <kbd>E</kbd>
            </button>
          </p>
        )}
      </Section>
      {page.second !== null && (
        <Section title={`Second grounder (${page.second.grounder})`}>
          <p class={page.second.is_disputed ? "disputed" : ""}>
            <strong>{classLabel(model, page.second.class)}</strong>
            {page.second.confidence !== null && !isAuditing(store) && ` (${page.second.confidence.toFixed(2)})`}
            {page.second.is_disputed && ": disagrees"}
          </p>
          <p class="muted">{page.second.explanation}</p>
        </Section>
      )}
      <Section title="Candidates">
        <Candidates store={store} targets={targets.includes(page.object) ? targets : [page.object]} />
      </Section>
      <Section title={`Relations (${page.relations.length})`}>
        <RelationList store={store} page={page} />
      </Section>
      <Section title="Measures and names">
        <Facts page={page} />
      </Section>
      {page.history.length > 0 && (
        <Section title="History">
          <History store={store} entries={page.history} />
        </Section>
      )}
      {page.turtle !== "" && (
        <details>
          <summary>Statements (Turtle)</summary>
          <pre>{page.turtle}</pre>
        </details>
      )}
    </aside>
  );
}

function Section({ title, children }: { title: string; children: ComponentChildren }) {
  return (
    <section>
      <h3>{title}</h3>
      {children}
    </section>
  );
}

const MAX_RELATIONS = 60;

function RelationList({ store, page }: { store: Store; page: ObjectPage }) {
  const { shortNames: name } = store.model;
  if (page.relations.length === 0) return <p class="empty">none</p>;
  const text = (relation: RelationRecord): [string, number, string] => {
    const isTarget = relation.target === page.object;
    const other = isTarget ? relation.anchor : relation.target;
    const label = other < 0 ? (relation.anchor_path.split("/").at(-1) ?? "") : (name[other] ?? "");
    return [isTarget ? relationText(relation) : `⟵ ${relationText(relation)}`, other, label];
  };
  return (
    <ul class="relations">
      {page.relations.slice(0, MAX_RELATIONS).map((relation) => {
        const [kind, other, label] = text(relation);
        return (
          <li key={`${relation.kind} ${relation.target} ${relation.anchor_path}`} title={relation.rule}>
            <span class="kind">{kind}</span>
            {other < 0 ? (
              <span>{label}</span>
            ) : (
              <button type="button" class="link" onClick={() => store.select([other])}>
                {label}
              </button>
            )}
          </li>
        );
      })}
    </ul>
  );
}

function Facts({ page }: { page: ObjectPage }) {
  const metres = (values: readonly number[]) => values.map((value) => value.toFixed(3)).join(" × ");
  const facts: [string, string][] = [
    ["Path", page.path],
    ["Size", page.size === null ? "" : `${metres(page.size)} m`],
    ["Position", page.position === null ? "" : `${page.position.map((value) => value.toFixed(3)).join(", ")} m`],
    ["Mass", page.mass_kg === null ? "" : `${page.mass_kg} kg`],
    ["Asset", page.assets.join(", ")],
    ["Materials", page.materials.join(", ")],
    ["Parts", page.parts.slice(0, 20).join(", ")],
    ["Labels", page.labels.map((label) => `${label.taxonomy}: ${label.value}`).join(", ")],
    ["Documentation", page.documentation],
    ["Type", [page.type_name, page.kind].filter(Boolean).join(", ")],
    ["Object because", page.selected_by],
  ];
  return (
    <dl class="facts">
      {facts
        .filter(([, value]) => value !== "")
        .map(([label, value]) => (
          <div key={label}>
            <dt>{label}</dt>
            <dd>{value}</dd>
          </div>
        ))}
    </dl>
  );
}

const VERDICTS: Record<HistoryEntry["verdict"], string> = {
  open: "open again",
  class: "",
  "no-class": "no class fits",
  unsure: "unsure",
};

function History({ store, entries }: { store: Store; entries: HistoryEntry[] }) {
  return (
    <ol class="history">
      {entries.map((entry) => (
        <li key={entry.event}>
          <strong>{entry.verdict === "class" ? classLabel(store.model, entry.class) : VERDICTS[entry.verdict]}</strong>{" "}
          {entry.proposal !== "" && `(proposed below it: ${entry.proposal}) `}
          {entry.concept >= 0 && `(every ${conceptLabel(store.model, entry.concept)}) `}
          {entry.action !== "decide" && `(${entry.action}) `}by {entry.reviewer},{" "}
          {new Date(entry.time).toLocaleString()}
          {entry.comment !== "" && <q>{entry.comment}</q>}
        </li>
      ))}
    </ol>
  );
}
