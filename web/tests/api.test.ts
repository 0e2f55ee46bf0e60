import { describe, expect, it, vi } from "vitest";
import { ApiFailure, createClient, readKey } from "../src/api/client";
import { EventParser, listen } from "../src/api/events";
import { Lane } from "../src/api/lane";
import type { ChangeEvent } from "../src/api/types";

function answering(status: number, body: string, seen: Request[] = []): typeof fetch {
  return async (input, init) => {
    seen.push(new Request(new URL(String(input), "http://x/"), init));
    return new Response(body, { status });
  };
}

describe("client", () => {
  it("sends the key and the body", async () => {
    const seen: Request[] = [];
    const client = createClient("secret", answering(200, '{"a": 1}', seen));
    expect(await client.post("undo", { reviewer: "Ann" })).toEqual({ a: 1 });
    expect(seen[0]?.url).toBe("http://x/api/undo");
    expect(seen[0]?.headers.get("authorization")).toBe("Bearer secret");
    expect(seen[0]?.headers.get("content-type")).toBe("application/json");
    expect(await seen[0]?.json()).toEqual({ reviewer: "Ann" });
  });

  it("reports the server's message and status", async () => {
    const client = createClient("k", answering(422, '{"error": "no such class"}'));
    await expect(client.get("scene")).rejects.toEqual(new ApiFailure("no such class", 422));
    const guarded = createClient("k", answering(403, "this host name is not served\n"));
    await expect(guarded.get("scene")).rejects.toThrow("this host name is not served");
  });

  it("tells a server that is gone from one that refuses", async () => {
    const client = createClient("k", () => Promise.reject(new TypeError("fetch failed")));
    await expect(client.get("scene")).rejects.toMatchObject({ status: 0 });
  });
});

describe("access key", () => {
  const storage = () => {
    const kept = new Map<string, string>();
    return {
      getItem: (name: string) => kept.get(name) ?? null,
      setItem: (n: string, v: string) => void kept.set(n, v),
    };
  };

  it("is taken from the address, which is cleaned", () => {
    const store = storage();
    const urls: string[] = [];
    const location = { hash: "#token=a%2Bb", pathname: "/", search: "?x" };
    expect(readKey(location, store, (url) => urls.push(url))).toBe("a+b");
    expect(urls).toEqual(["/?x"]);
    expect(readKey({ ...location, hash: "" }, store, () => undefined)).toBe("a+b");
  });

  it("is unknown without either", () => {
    expect(readKey({ hash: "", pathname: "/", search: "" }, storage(), () => undefined)).toBeNull();
  });
});

describe("event stream", () => {
  it("is parsed whatever its pieces are", () => {
    const text = 'event: change\nid: 3\ndata: {"version": 3}\n\n: alive\n\nevent: change\ndata: a\ndata: b\n\n';
    for (const size of [1, 2, 7, 1000]) {
      const parser = new EventParser();
      const events = [];
      for (let at = 0; at < text.length; at += size) events.push(...parser.push(text.slice(at, at + size)));
      expect(events).toEqual([
        { name: "change", data: '{"version": 3}' },
        { name: "change", data: "a\nb" },
      ]);
    }
  });

  it("reconnects with the last version", async () => {
    const asked: string[] = [];
    const control = new AbortController();
    const send: typeof fetch = async (input) => {
      asked.push(String(input));
      if (asked.length === 2) control.abort();
      return new Response(`event: change\ndata: {"version": ${asked.length}}\n\n`);
    };
    let version = 0;
    const handlers = {
      onOutputs: () => undefined,
      onSuggestions: () => undefined,
      onChange: (change: ChangeEvent) => {
        version = change.version;
      },
      onLink: () => undefined,
      onDenied: () => undefined,
    };
    await listen(createClient("k", send), () => version, handlers, control.signal);
    expect(asked).toEqual(["api/events?since=0", "api/events?since=1"]);
  });

  it("stops when the key is no longer taken", async () => {
    const links: boolean[] = [];
    const denied = vi.fn();
    const send: typeof fetch = async () => new Response('{"error": "wrong key"}', { status: 401 });
    const handlers = {
      onChange: () => undefined,
      onOutputs: () => undefined,
      onSuggestions: () => undefined,
      onLink: (is: boolean) => void links.push(is),
      onDenied: denied,
    };
    await listen(createClient("k", send), () => 0, handlers, new AbortController().signal);
    expect(denied).toHaveBeenCalledOnce();
    expect(links).toEqual([]);
  });
});

describe("slow requests", () => {
  it("leave a connection for decisions", async () => {
    const sent: string[] = [];
    const answers: (() => void)[] = [];
    const client = createClient("key", (url) => {
      sent.push(String(url));
      return new Promise((resolve) => answers.push(() => resolve(new Response("{}"))));
    });
    const asked = ["ask", "sparql", "reground"].map((path) => client.post(path, {}));
    asked.push(client.get("relations?kind=on"));
    void client.post("decisions", {});
    await vi.waitFor(() => expect(sent).toEqual(["api/ask", "api/sparql", "api/decisions"]));
    answers[1]?.();
    await asked[1];
    await vi.waitFor(() => expect(sent.slice(3)).toEqual(["api/reground"]));
    answers[0]?.();
    answers[3]?.();
    await vi.waitFor(() => expect(sent.slice(4)).toEqual(["api/relations?kind=on"]));
    answers[4]?.();
    await Promise.all(asked);
  });

  it("give their place to the next one when they fail", async () => {
    const lane = new Lane(1);
    const failed = lane.run(() => Promise.reject(new Error("no")));
    const next = lane.run(async () => 7);
    await expect(failed).rejects.toThrow("no");
    expect([await next, await lane.run(async () => 8)]).toEqual([7, 8]);
  });
});
