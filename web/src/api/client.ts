/** Requests to the studio's server. */

import { isSlow, Lane, MAX_SLOW } from "./lane";
import type { ApiError } from "./types";

/** A request that failed: the server's message, and its status (0 if there was no answer). */
export class ApiFailure extends Error {
  constructor(
    message: string,
    readonly status: number,
  ) {
    super(message);
  }
}

export interface Client {
  get<T>(path: string): Promise<T>;
  post<T>(path: string, body: unknown): Promise<T>;
  blob(path: string): Promise<Blob>;
  stream(path: string, signal: AbortSignal): Promise<ReadableStream<Uint8Array>>;
}

type Fetch = typeof fetch;

/** Returns a client that sends the access key with each request. */
export function createClient(key: string, send: Fetch = fetch.bind(globalThis)): Client {
  const slow = new Lane(MAX_SLOW);
  const request = (path: string, init?: RequestInit): Promise<Response> =>
    isSlow(path) ? slow.run(() => ask(path, init)) : ask(path, init);
  const ask = async (path: string, init: RequestInit = {}): Promise<Response> => {
    const headers = new Headers(init.headers);
    headers.set("Authorization", `Bearer ${key}`);
    let response: Response;
    try {
      response = await send(`api/${path}`, { ...init, headers, cache: "no-store" });
    } catch (error) {
      if (error instanceof DOMException && error.name === "AbortError") throw error;
      throw new ApiFailure("the server does not answer; is usd2kg studio still running?", 0);
    }
    if (!response.ok) throw new ApiFailure(await errorText(response), response.status);
    return response;
  };
  return {
    get: async <T>(path: string) => (await (await request(path)).json()) as T,
    post: async <T>(path: string, body: unknown) => {
      const init = { method: "POST", body: JSON.stringify(body), headers: { "Content-Type": "application/json" } };
      return (await (await request(path, init)).json()) as T;
    },
    blob: async (path) => (await request(path)).blob(),
    stream: async (path, signal) => {
      const { body } = await request(path, { signal });
      if (body === null) throw new ApiFailure("the stream of changes is empty", 0);
      return body;
    },
  };
}

async function errorText(response: Response): Promise<string> {
  const text = await response.text();
  try {
    const { error } = JSON.parse(text) as ApiError;
    if (typeof error === "string") return error;
  } catch {
    // Not JSON: a proxy or the server's guard.
  }
  return text.trim() || `the server answers ${response.status}`;
}

const STORED = "usd2kg-key";

/** Returns the access key in the fragment of the address; null without one. */
export function keyOfAddress(location: Pick<Location, "hash">): string | null {
  return new URLSearchParams(location.hash.replace(/^#/, "")).get("token") || null;
}

/**
 * Returns the access key: from the fragment of the address, which is then removed so that it is not shared by accident,
 * or as this tab remembers it; null if it is unknown.
 */
export function readKey(
  location: Pick<Location, "hash" | "pathname" | "search">,
  store: Pick<Storage, "getItem" | "setItem">,
  replace: (url: string) => void,
): string | null {
  const given = keyOfAddress(location);
  if (given !== null) {
    store.setItem(STORED, given);
    replace(location.pathname + location.search);
    return given;
  }
  return store.getItem(STORED);
}

/** Remembers a key that the user typed, for this tab. */
export function storeKey(key: string, store: Pick<Storage, "setItem" | "removeItem">): void {
  if (key === "") store.removeItem(STORED);
  else store.setItem(STORED, key);
}
