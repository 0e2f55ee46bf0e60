/** The name under which this browser decides. */

const STORED = "usd2kg-reviewer";

/** Returns the name that the user has typed; null if there is none, so that the server's suggestion holds. */
export function storedReviewer(storage: Pick<Storage, "getItem">): string | null {
  return storage.getItem(STORED);
}

export function storeReviewer(name: string, storage: Pick<Storage, "setItem">): void {
  storage.setItem(STORED, name);
}
