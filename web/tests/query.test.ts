import { describe, expect, it } from "vitest";
import { fetchAbout, fetchCsv, QueryFailure, runQuery, type Term } from "../src/query/protocol";
import { describeQuery, isNumber, shortenIri, webAddress } from "../src/query/terms";

const PREFIXES = { u2k: "https://w3id.org/usd2kg#", w3id: "https://w3id.org/", lab: "https://my.lab/k/" };

function replying(text: string, init: ResponseInit = {}) {
  const requests: { url: string; init: RequestInit | undefined }[] = [];
  const send = (async (url: string, sent?: RequestInit) => {
    requests.push({ url, init: sent });
    return new Response(text, init);
  }) as typeof fetch;
  return { send, requests };
}

const json = (value: unknown, headers = {}) =>
  replying(JSON.stringify(value), { headers: { "Content-Type": "application/sparql-results+json", ...headers } });

describe("the protocol", () => {
  it("reads a table, with unbound variables", async () => {
    const label: Term = { type: "literal", value: "Tasse", "xml:lang": "de" };
    const { send, requests } = json(
      { head: { vars: ["o", "label"] }, results: { bindings: [{ label }, {}] } },
      { "X-SPARQL-MaxRows": "2" },
    );
    const answer = await runQuery("SELECT *", "https://my.lab/a", new AbortController().signal, send);
    expect(answer.result).toEqual({
      kind: "table",
      table: {
        variables: ["o", "label"],
        rows: [
          [undefined, label],
          [undefined, undefined],
        ],
      },
    });
    expect(answer.cutAt).toBe(2);
    expect(String(requests[0]?.init?.body)).toBe("query=SELECT+*&default-graph-uri=https%3A%2F%2Fmy.lab%2Fa");
  });

  it("reads yes and no, and RDF as text", async () => {
    const { signal } = new AbortController();
    const truth = await runQuery("ASK {}", "", signal, json({ head: {}, boolean: false }).send);
    expect(truth).toMatchObject({ result: { kind: "truth", truth: false }, cutAt: null });
    const turtle = replying("<a> <b> <c> .", { headers: { "Content-Type": "text/turtle" } });
    const text = await runQuery("CONSTRUCT {}", "", signal, turtle.send);
    expect(text.result).toEqual({ kind: "text", text: "<a> <b> <c> ." });
    expect(String(turtle.requests[0]?.init?.body)).toBe("query=CONSTRUCT+%7B%7D");
  });

  it("passes on what the server says of an error", async () => {
    const refusing = replying("line 1: expected a variable\n", { status: 400 });
    await expect(fetchCsv("SELECT", "", refusing.send)).rejects.toThrow(
      new QueryFailure("line 1: expected a variable"),
    );
    const dead = (async () => {
      throw new TypeError("failed to fetch");
    }) as typeof fetch;
    await expect(fetchAbout(dead)).rejects.toThrow("Is usd2kg serve still running?");
  });

  it("does not call a stopped query an error of the server", async () => {
    const stopped = (async () => {
      throw new DOMException("stopped", "AbortError");
    }) as typeof fetch;
    await expect(runQuery("ASK {}", "", new AbortController().signal, stopped)).rejects.toThrow(DOMException);
  });
});

describe("terms", () => {
  it("takes the longest prefix that leaves a local name", () => {
    expect(shortenIri("https://w3id.org/usd2kg#on", PREFIXES)).toBe("u2k:on");
    expect(shortenIri("https://my.lab/k/Kitchen.Cup_1", PREFIXES)).toBe("lab:Kitchen.Cup_1");
    expect(shortenIri("https://my.lab/k/a/b", PREFIXES)).toBe("https://my.lab/k/a/b");
    expect(shortenIri("https://my.lab/k/", PREFIXES)).toBe("https://my.lab/k/");
  });

  it("asks what the graph states about an IRI", () => {
    expect(describeQuery("urn:a")).toContain("<urn:a> ?property ?value");
  });

  it("opens only web addresses", () => {
    expect(webAddress("https://my.lab/a")).toBe("https://my.lab/a");
    expect(webAddress("javascript:alert(1)")).toBeNull();
  });

  it("knows numbers by their datatype", () => {
    expect(isNumber({ type: "literal", value: "3", datatype: "http://www.w3.org/2001/XMLSchema#decimal" })).toBe(true);
    expect(isNumber({ type: "literal", value: "3" })).toBe(false);
    expect(isNumber(undefined)).toBe(false);
  });
});
