/** Short names: without the beginning that most names of a scene share, which tells them apart no better. */

const MIN_SHARE = 0.6;
const MIN_LENGTH = 6;

/** Returns the longest beginning, up to a separator, that most names share; empty if there is none worth leaving out. */
function sharedBeginning(names: readonly string[]): string {
  const counts = new Map<string, number>();
  for (const name of names) {
    for (const { index } of name.matchAll(/[_\-. ]/g)) {
      const beginning = name.slice(0, index + 1);
      counts.set(beginning, (counts.get(beginning) ?? 0) + 1);
    }
  }
  let longest = "";
  for (const [beginning, count] of counts) {
    if (count >= MIN_SHARE * names.length && beginning.length > longest.length) longest = beginning;
  }
  return names.length > 2 && longest.length >= MIN_LENGTH ? longest : "";
}

/** Returns the names, where they begin like most others with an ellipsis instead. */
export function shortNames(names: readonly string[]): string[] {
  const beginning = sharedBeginning(names);
  return names.map((name) =>
    beginning !== "" && name.startsWith(beginning) && name.length > beginning.length
      ? `…${name.slice(beginning.length)}`
      : name,
  );
}
