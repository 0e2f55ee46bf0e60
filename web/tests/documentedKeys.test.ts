import { describe, expect, it } from "vitest";
import guide from "../../docs/studio.md?raw";
import { BINDINGS, findBinding } from "../src/keys/bindings";

/** Keys in the first column of the guide's table, with ranges and arrows spelled out. */
function documented(): string[] {
  const lines = guide.split("\n");
  const table = lines.slice(lines.indexOf("| key | |"), lines.findIndex((line) => line.endsWith("| all keys |")) + 1);
  return table.flatMap((line) => {
    const cell = line.split("|")[1] ?? "";
    const keys = [...cell.matchAll(/`([^`]+)`/g)].map((match) => match[1] as string);
    return cell.includes("arrows") ? [...keys, "ArrowDown", "ArrowUp", "ArrowRight", "ArrowLeft"] : keys;
  });
}

describe("the guide", () => {
  it("names keys that exist", () => {
    expect(documented().length).toBeGreaterThan(15);
    expect(documented().filter((key) => findBinding(key) === undefined)).toEqual([]);
  });

  it("names all keys of the review", () => {
    const known = new Set(documented());
    const missing = BINDINGS.filter(({ section }) => section === "Review" || section === "Queue").filter(
      ({ keys }) => !keys.some((key) => known.has(key)),
    );
    expect(missing.map(({ help }) => help)).toEqual([]);
  });
});
