/** The table of an answer; a click on a row selects its object. */

import type { ObjectIndex } from "../api/types";
import type { Store } from "../state/store";

interface Props {
  store: Store;
  columns: readonly string[];
  rows: readonly (readonly (string | number | boolean | null)[])[];
  objects: readonly ObjectIndex[];
  is_cut: boolean;
}

const MAX_ROWS = 500;

export function AnswerTable({ store, columns, rows, objects, is_cut }: Props) {
  if (rows.length === 0) return null;
  const selected = new Set(store.selection.value);
  return (
    <div class="answer-table">
      <table>
        <thead>
          <tr>
            {columns.map((column) => (
              <th key={column} scope="col">
                {column}
              </th>
            ))}
          </tr>
        </thead>
        <tbody>
          {rows.slice(0, MAX_ROWS).map((row, index) => {
            const object = objects[index] ?? -1;
            const key = `${index} ${row[0]}`;
            return (
              <tr key={key} aria-selected={selected.has(object)} onClick={() => object >= 0 && store.select([object])}>
                {row.map((cell, column) => (
                  <td key={columns[column]}>
                    {column === 0 && object >= 0 ? (
                      <button type="button" class="link" onClick={() => store.select([object])}>
                        {cellText(cell)}
                      </button>
                    ) : (
                      cellText(cell)
                    )}
                  </td>
                ))}
              </tr>
            );
          })}
        </tbody>
      </table>
      {(is_cut || rows.length > MAX_ROWS) && <p>The first {Math.min(rows.length, MAX_ROWS)} rows are shown.</p>}
    </div>
  );
}

function cellText(cell: string | number | boolean | null): string {
  if (cell === null) return "";
  if (typeof cell !== "number") return String(cell);
  return Number.isInteger(cell) ? String(cell) : String(Number(cell.toPrecision(4)));
}
