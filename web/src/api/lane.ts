/** Limits how many requests of a kind wait for the server at once. */

/**
 * Requests that wait until a graph is built, a query is answered or meshes are read. A browser keeps 6 connections to a
 * server: one for the stream of changes and two for pictures, so that two of these leave one for decisions.
 */
const SLOW: ReadonlySet<string> = new Set([
  "ask",
  "comparison",
  "examples",
  "export",
  "geometry",
  "reground",
  "relations",
  "sparql",
]);
export const MAX_SLOW = 2;

/** Returns whether a request may take seconds. */
export function isSlow(path: string): boolean {
  return SLOW.has(path.split(/[/?]/, 1)[0] ?? "");
}

/** Runs at most some tasks at a time, the others in the order in which they came. */
export class Lane {
  private readonly waiting: (() => void)[] = [];
  private running = 0;

  constructor(private readonly width: number) {}

  async run<T>(task: () => Promise<T>): Promise<T> {
    if (this.running >= this.width) await new Promise<void>((resolve) => this.waiting.push(resolve));
    else this.running++;
    try {
      return await task();
    } finally {
      // The place of a finished task goes to the next one.
      const next = this.waiting.shift();
      if (next === undefined) this.running--;
      else next();
    }
  }
}
