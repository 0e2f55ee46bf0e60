/** Problems of the stage; a click selects the object concerned. */

import type { Store } from "../state/store";

export function Diagnostics({ store }: { store: Store }) {
  const { diagnostics, objects, is_graph: isGraph } = store.model.data;
  if (diagnostics.length === 0 && isGraph)
    return <p class="empty">A graph does not state the problems of its stage.</p>;
  if (diagnostics.length === 0) return <p class="empty">The stage has no problems that the reader found.</p>;
  return (
    <ul class="diagnostics">
      {diagnostics.map(({ code, message, path }) => {
        const object = path === null ? -1 : objects.path.indexOf(path);
        return (
          <li key={`${code} ${path} ${message}`}>
            <code>{code}</code>
            {path !== null &&
              (object < 0 ? (
                <span class="path">{path}</span>
              ) : (
                <button type="button" class="link" onClick={() => store.select([object])}>
                  {path}
                </button>
              ))}
            <span>{message}</span>
          </li>
        );
      })}
    </ul>
  );
}
