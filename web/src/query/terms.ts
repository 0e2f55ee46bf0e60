/** RDF terms as text. */

import type { Term } from "./protocol";

const NUMBER = /#(integer|int|long|decimal|double|float|nonNegativeInteger)$/;

/** Returns an IRI with the longest prefix that leaves a local name; the IRI itself if there is none. */
export function shortenIri(iri: string, prefixes: Readonly<Record<string, string>>): string {
  const fitting = Object.entries(prefixes).filter(
    ([, base]) => iri.startsWith(base) && /^[^/#]+$/.test(iri.slice(base.length)),
  );
  const best = fitting.sort(([, one], [, other]) => other.length - one.length)[0];
  return best === undefined ? iri : `${best[0]}:${iri.slice(best[1].length)}`;
}

/** Returns a query for everything that the graph states about an IRI. */
export function describeQuery(iri: string): string {
  return `SELECT ?property ?value WHERE {\n  <${iri}> ?property ?value .\n} ORDER BY ?property ?value`;
}

export function isNumber(term: Term | undefined): boolean {
  return term?.type === "literal" && NUMBER.test(term.datatype ?? "");
}

/** Returns the address of a page about an IRI; null for schemes that a browser does not open as one. */
export function webAddress(iri: string): string | null {
  return /^https?:\/\//i.test(iri) ? iri : null;
}
