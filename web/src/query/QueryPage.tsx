/** The page of `usd2kg serve`: queries in SPARQL, with examples of the served graphs. */

import { useEffect, useRef, useState } from "preact/hooks";
import { type About, type Answer, fetchCsv, runQuery } from "./protocol";
import { MAX_ROWS, ResultView } from "./ResultView";

interface Asked {
  query: string;
  graph: string;
}

export function QueryPage({ about }: { about: About }) {
  const [query, setQuery] = useState(() => queryOfAddress() ?? about.examples[0]?.query ?? "");
  const [graph, setGraph] = useState("");
  const [asked, setAsked] = useState<Asked | null>(null);
  const [answer, setAnswer] = useState<Answer | null>(null);
  const [problem, setProblem] = useState("");
  const [status, setStatus] = useState("");
  const running = useRef<AbortController | null>(null);

  const run = async (next: Asked) => {
    if (next.query.trim() === "") return;
    running.current?.abort();
    const controller = new AbortController();
    running.current = controller;
    setAsked(next);
    setAnswer(null);
    setProblem("");
    setStatus("Running…");
    history.replaceState(null, "", `#${encodeURIComponent(next.query)}`);
    try {
      const found = await runQuery(next.query, next.graph, controller.signal);
      if (running.current !== controller) return;
      setAnswer(found);
      setStatus(statusText(found));
    } catch (error) {
      if (running.current !== controller) return;
      const isStopped = error instanceof DOMException && error.name === "AbortError";
      setStatus(isStopped ? "Stopped." : "");
      if (!isStopped) setProblem(error instanceof Error ? error.message : String(error));
    }
    running.current = null;
  };
  const runNow = (text: string) => {
    setQuery(text);
    void run({ query: text, graph });
  };
  const save = async () => {
    if (asked === null) return;
    try {
      saveFile(await fetchCsv(asked.query, asked.graph), "answer.csv");
    } catch (error) {
      setProblem(error instanceof Error ? error.message : String(error));
    }
  };

  useEffect(() => {
    // A query in the address may be somebody else's: it runs only once the user has seen it.
    if (queryOfAddress() === null) void run({ query, graph });
    else setStatus("Check the query, then run it.");
  }, []);
  useEffect(() => {
    const follow = () => {
      const next = queryOfAddress();
      if (next === null || next === asked?.query) return;
      runNow(next);
      scrollTo(0, 0);
    };
    addEventListener("hashchange", follow);
    return () => removeEventListener("hashchange", follow);
  }, [asked, graph]);

  const isRunning = status === "Running…";
  return (
    <>
      <header>
        <h1>{about.title}</h1>
        <span>
          read-only · SPARQL 1.1 at <code>/sparql</code>
        </span>
      </header>
      <main>
        <form
          aria-label="Query"
          onSubmit={(event) => {
            event.preventDefault();
            void run({ query, graph });
          }}
        >
          <div class="choices">
            <label class="wide">
              Example questions
              <select
                value=""
                onChange={({ currentTarget }) => {
                  const chosen = about.examples[Number(currentTarget.value)];
                  if (currentTarget.value !== "" && chosen !== undefined) runNow(chosen.query);
                  currentTarget.value = "";
                }}
              >
                <option value="">Choose one…</option>
                {about.examples.map(({ title }, index) => (
                  <option key={title} value={index}>
                    {title}
                  </option>
                ))}
              </select>
            </label>
            {about.graphs.length > 1 && (
              <label>
                Scene
                <select
                  value={graph}
                  onChange={({ currentTarget }) => {
                    setGraph(currentTarget.value);
                    void run({ query, graph: currentTarget.value });
                  }}
                >
                  <option value="">all scenes</option>
                  {about.graphs.map((iri) => (
                    <option key={iri} value={iri}>
                      {iri}
                    </option>
                  ))}
                </select>
              </label>
            )}
          </div>
          <textarea
            aria-label="SPARQL query"
            spellcheck={false}
            value={query}
            onInput={({ currentTarget }) => setQuery(currentTarget.value)}
            onKeyDown={(event) => {
              if (event.key !== "Enter" || !(event.ctrlKey || event.metaKey)) return;
              event.preventDefault();
              void run({ query, graph });
            }}
          />
          <div class="actions">
            <button type="submit" class="primary" disabled={isRunning}>
              Run <kbd>Ctrl+Enter</kbd>
            </button>
            {isRunning && (
              <button type="button" onClick={() => running.current?.abort()}>
                Stop
              </button>
            )}
            <p role="status">{status}</p>
            {answer?.result.kind === "table" && (
              <button type="button" onClick={() => void save()}>
                Save as CSV
              </button>
            )}
          </div>
        </form>
        {problem !== "" && (
          <pre class="problem" role="alert">
            {problem}
          </pre>
        )}
        {answer !== null && (
          <section aria-label="Results">
            {noteText(answer) !== "" && <p class="note">{noteText(answer)}</p>}
            <div class="scroll">
              <ResultView result={answer.result} prefixes={about.prefixes} />
            </div>
          </section>
        )}
      </main>
    </>
  );
}

/** Returns the query that the address holds; null without one. */
function queryOfAddress(): string | null {
  if (location.hash.length < 2) return null;
  try {
    return decodeURIComponent(location.hash.slice(1));
  } catch {
    return null;
  }
}

function statusText({ result, seconds }: Answer): string {
  const time = `${seconds.toFixed(2)} s`;
  return result.kind === "table" ? `${countText(result.table.rows.length)} in ${time}` : time;
}

function noteText({ result, cutAt }: Answer): string {
  const notes: string[] = [];
  if (cutAt !== null) notes.push(`The answer is cut: the server returns at most ${countText(cutAt)}.`);
  if (result.kind === "table" && result.table.rows.length > MAX_ROWS)
    notes.push(`Only the first ${countText(MAX_ROWS)} are shown; the CSV has all of them.`);
  return notes.join(" ");
}

function countText(rows: number): string {
  return `${rows.toLocaleString("en")} ${rows === 1 ? "row" : "rows"}`;
}

function saveFile(content: Blob, name: string): void {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(content);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 1000);
}
