/** The SPARQL 1.1 Protocol, and results in JSON (https://www.w3.org/TR/sparql12-results-json/). */

export type Term =
  | { type: "uri"; value: string }
  | { type: "bnode"; value: string }
  | { type: "literal"; value: string; datatype?: string; "xml:lang"?: string }
  | { type: "triple"; value: { subject: Term; predicate: Term; object: Term } };

export interface ResultTable {
  variables: string[];
  /** One term for each variable; undefined where it is unbound. */
  rows: (Term | undefined)[][];
}

export type Result =
  | { kind: "table"; table: ResultTable }
  | { kind: "truth"; truth: boolean }
  | { kind: "text"; text: string };

export interface Answer {
  result: Result;
  /** Rows after which the server cut the answer; null if it is complete. */
  cutAt: number | null;
  seconds: number;
}

/** What the server says of itself at /about. */
export interface About {
  title: string;
  graphs: string[];
  prefixes: Record<string, string>;
  examples: { title: string; query: string }[];
}

interface ResultJson {
  head: { vars?: string[] };
  boolean?: boolean;
  results?: { bindings: Record<string, Term>[] };
}

const RESULT_TYPES = "application/sparql-results+json, text/turtle;q=0.9, text/plain;q=0.1";

export class QueryFailure extends Error {}

/** Runs a query on one graph, or on all if `graph` is empty. */
export async function runQuery(
  query: string,
  graph: string,
  signal: AbortSignal,
  send: typeof fetch = fetch,
): Promise<Answer> {
  const start = performance.now();
  const response = await post(query, graph, RESULT_TYPES, signal, send);
  const text = await response.text();
  const cutAt = response.headers.get("X-SPARQL-MaxRows");
  return {
    result: parseResult(response.headers.get("Content-Type") ?? "", text),
    cutAt: cutAt === null ? null : Number(cutAt),
    seconds: (performance.now() - start) / 1000,
  };
}

/** Returns the answer to a query as CSV. */
export async function fetchCsv(query: string, graph: string, send: typeof fetch = fetch): Promise<Blob> {
  return (await post(query, graph, "text/csv", null, send)).blob();
}

export async function fetchAbout(send: typeof fetch = fetch): Promise<About> {
  return (await (await answered(send("about"))).json()) as About;
}

function post(
  query: string,
  graph: string,
  accept: string,
  signal: AbortSignal | null,
  send: typeof fetch,
): Promise<Response> {
  const body = new URLSearchParams({ query });
  if (graph !== "") body.append("default-graph-uri", graph);
  return answered(send("sparql", { method: "POST", body, headers: { Accept: accept }, signal }));
}

async function answered(sent: Promise<Response>): Promise<Response> {
  let response: Response;
  try {
    response = await sent;
  } catch (error) {
    if (error instanceof DOMException && error.name === "AbortError") throw error;
    throw new QueryFailure("The server cannot be reached. Is usd2kg serve still running?");
  }
  if (!response.ok) throw new QueryFailure((await response.text()).trim());
  return response;
}

function parseResult(mediaType: string, text: string): Result {
  if (!mediaType.includes("sparql-results+json")) return { kind: "text", text };
  const { head, boolean, results } = JSON.parse(text) as ResultJson;
  if (boolean !== undefined) return { kind: "truth", truth: boolean };
  const variables = head.vars ?? [];
  const rows = (results?.bindings ?? []).map((binding) => variables.map((name) => binding[name]));
  return { kind: "table", table: { variables, rows } };
}
