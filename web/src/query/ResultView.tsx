/** A result: a table whose IRIs lead to what the graph states about them, yes or no, or RDF as text. */

import type { Result, ResultTable, Term } from "./protocol";
import { describeQuery, isNumber, shortenIri, webAddress } from "./terms";

export const MAX_ROWS = 2000;

interface Props {
  result: Result;
  prefixes: Readonly<Record<string, string>>;
}

export function ResultView({ result, prefixes }: Props) {
  if (result.kind === "table") return <Table table={result.table} prefixes={prefixes} />;
  return <pre>{result.kind === "text" ? result.text : result.truth ? "yes (true)" : "no (false)"}</pre>;
}

function Table({ table, prefixes }: { table: ResultTable; prefixes: Props["prefixes"] }) {
  const numeric = table.variables.map((_, column) => isNumber(table.rows[0]?.[column]));
  return (
    <table>
      <thead>
        <tr>
          {table.variables.map((name, column) => (
            <th key={name} scope="col" class={numeric[column] ? "number" : ""}>
              {name}
            </th>
          ))}
        </tr>
      </thead>
      <tbody>
        {table.rows.slice(0, MAX_ROWS).map((row, index) => (
          <tr key={String(index)}>
            {row.map((term, column) => (
              <td key={table.variables[column]} class={isNumber(term) ? "number" : ""}>
                {term !== undefined && <TermView term={term} prefixes={prefixes} />}
              </td>
            ))}
          </tr>
        ))}
      </tbody>
    </table>
  );
}

function TermView({ term, prefixes }: { term: Term; prefixes: Props["prefixes"] }) {
  if (term.type === "uri") {
    const address = webAddress(term.value);
    return (
      <>
        <a href={`#${encodeURIComponent(describeQuery(term.value))}`} title={term.value}>
          {shortenIri(term.value, prefixes)}
        </a>
        {address !== null && (
          <a class="out" href={address} target="_blank" rel="noopener noreferrer nofollow" title={`Open ${address}`}>
            ↗
          </a>
        )}
      </>
    );
  }
  if (term.type === "triple") {
    const { subject, predicate, object } = term.value;
    return (
      <>
        {[subject, predicate, object].map((part, index) => (
          <span key={String(index)} class="part">
            <TermView term={part} prefixes={prefixes} />
          </span>
        ))}
      </>
    );
  }
  if (term.type === "bnode") return <>{`_:${term.value}`}</>;
  const language = term["xml:lang"];
  return (
    <>
      {term.value}
      {language !== undefined && <small> @{language}</small>}
    </>
  );
}
