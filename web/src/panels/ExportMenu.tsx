/** Downloads of what follows from the decisions. */

import { useState } from "preact/hooks";
import type { Store } from "../state/store";
import { Popover } from "./Popover";

const EXPORTS: { name: string; label: string }[] = [
  { name: "graph.ttl", label: "Knowledge graph (Turtle)" },
  { name: "labels.usda", label: "Labels (USD layer)" },
  { name: "mapping.sssom.tsv", label: "Mapping (SSSOM)" },
  { name: "decisions.sssom.tsv", label: "Decisions (SSSOM journal)" },
  { name: "lessons.sssom.tsv", label: "What decisions teach (alignment)" },
  { name: "proposals.ttl", label: "Proposed classes (OWL)" },
  { name: "objects.csv", label: "Objects (CSV)" },
  { name: "grounding.json", label: "Grounding (JSON)" },
];

export function ExportMenu({ store }: { store: Store }) {
  const [isBusy, setBusy] = useState(false);
  const { limits } = store.model.data;
  const download = async (name: string) => {
    setBusy(true);
    try {
      const url = URL.createObjectURL(await store.client.blob(`export/${name}`));
      const link = document.createElement("a");
      link.href = url;
      link.download = `${store.model.data.title.replace(/\.[^.]*$/, "")}.${name}`;
      link.click();
      setTimeout(() => URL.revokeObjectURL(url), 10000);
    } catch (error) {
      store.report(error);
    }
    setBusy(false);
  };
  return (
    <Popover label={isBusy ? "Exporting…" : "Export"}>
      {EXPORTS.map(({ name, label }) => (
        <button
          key={name}
          type="button"
          disabled={isBusy || (name === "labels.usda" && limits.labels !== undefined)}
          title={name === "labels.usda" ? (limits.labels ?? "") : ""}
          onClick={() => void download(name)}
        >
          {label}
        </button>
      ))}
    </Popover>
  );
}
