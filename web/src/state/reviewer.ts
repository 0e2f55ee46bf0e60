/** The name under which this tab decides. */

const STORED = "usd2kg-reviewer";

export interface NameStorage {
  /** Outlives a reload of this tab; other tabs have their own. */
  tab: Pick<Storage, "getItem" | "setItem">;
  /** Shared by all tabs: the name with which a new one begins. */
  browser: Pick<Storage, "getItem" | "setItem">;
}

/** Returns the name of this tab, or the last one that was typed in any; null if there is none. */
export function storedReviewer({ tab, browser }: NameStorage): string | null {
  return tab.getItem(STORED) ?? browser.getItem(STORED);
}

/** Keeps the name of this tab, whatever is typed in others. */
export function keepReviewer(name: string, { tab }: NameStorage): void {
  tab.setItem(STORED, name);
}

/** Keeps a name that the user has typed, for new tabs too. */
export function storeReviewer(name: string, storage: NameStorage): void {
  keepReviewer(name, storage);
  storage.browser.setItem(STORED, name);
}
