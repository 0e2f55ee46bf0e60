/** SPARQL queries on the current graph. */

import { useEffect, useState } from "preact/hooks";
import type { ExampleQuery, SparqlReply } from "../api/types";
import type { Store } from "../state/store";
import { AnswerTable } from "./AnswerTable";
import { showAnswer } from "./Ask";

export function Sparql({ store }: { store: Store }) {
  const [examples, setExamples] = useState<ExampleQuery[]>([]);
  const [query, setQuery] = useState("");
  const [reply, setReply] = useState<SparqlReply | null>(null);
  const [problem, setProblem] = useState("");
  const [isBusy, setBusy] = useState(false);
  useEffect(() => {
    store.client.get<ExampleQuery[]>("examples").then(
      (found) => {
        setExamples(found);
        setQuery((before) => before || (found[0]?.query ?? ""));
      },
      (error: unknown) => store.report(error),
    );
  }, [store]);
  const run = async () => {
    setBusy(true);
    setProblem("");
    try {
      const found = await store.client.post<SparqlReply>("sparql", { query });
      setReply(found);
      showAnswer(store, found.objects);
    } catch (error) {
      setReply(null);
      setProblem(error instanceof Error ? error.message : String(error));
    }
    setBusy(false);
  };
  return (
    <div class="sparql">
      <form
        onSubmit={(event) => {
          event.preventDefault();
          void run();
        }}
      >
        <select
          aria-label="Examples"
          value=""
          onChange={(event) => {
            const chosen = examples[Number(event.currentTarget.value)];
            if (chosen !== undefined) setQuery(chosen.query);
            event.currentTarget.value = "";
          }}
        >
          <option value="">Examples of this scene</option>
          {examples.map(({ title }, index) => (
            <option key={title} value={index}>
              {title}
            </option>
          ))}
        </select>
        <textarea
          aria-label="SPARQL query"
          spellcheck={false}
          value={query}
          onInput={(event) => setQuery(event.currentTarget.value)}
          onKeyDown={(event) => {
            if (event.key === "Enter" && (event.ctrlKey || event.metaKey)) {
              event.preventDefault();
              void run();
            }
          }}
        />
        <button type="submit" class="primary" disabled={isBusy}>
          {isBusy ? "Running…" : "Run"} <kbd>Ctrl+Enter</kbd>
        </button>
      </form>
      <div class="result">
        {problem !== "" && <pre role="alert">{problem}</pre>}
        {reply !== null && (
          <>
            <p>
              {reply.rows.length} {reply.rows.length === 1 ? "row" : "rows"} in {reply.milliseconds} ms
              {reply.hints.map((hint) => (
                <span key={hint} class="hint">
                  {hint}
                </span>
              ))}
            </p>
            <AnswerTable store={store} {...reply} />
          </>
        )}
      </div>
    </div>
  );
}
