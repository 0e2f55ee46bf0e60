/** Server-sent events over fetch, since EventSource cannot send the access key. */

import { ApiFailure, type Client } from "./client";
import type { ChangeEvent, Outputs, SuggestionsEvent } from "./types";

/** One event of a stream. */
export interface StreamEvent {
  name: string;
  data: string;
}

/** Parses a stream of events piece by piece; see the HTML standard, section 9.2.6. */
export class EventParser {
  private rest = "";

  /** Returns the events that are complete with this piece. */
  push(piece: string): StreamEvent[] {
    this.rest += piece;
    const blocks = this.rest.split(/\r?\n\r?\n/);
    this.rest = blocks.pop() ?? "";
    return blocks.map(parseBlock).filter((event) => event.data !== "");
  }
}

function parseBlock(block: string): StreamEvent {
  const event: StreamEvent = { name: "message", data: "" };
  const data: string[] = [];
  for (const line of block.split(/\r?\n/)) {
    const [field = "", value = ""] = line.split(/: ?(.*)/s);
    if (field === "event") event.name = value;
    if (field === "data") data.push(value);
  }
  event.data = data.join("\n");
  return event;
}

const RETRY_MS = [500, 1000, 2000, 5000];

export interface StreamHandlers {
  onChange(change: ChangeEvent): void;
  /** Called when the files have been written. */
  onOutputs(outputs: Outputs): void;
  /** Called when somebody has grounded the open objects again. */
  onSuggestions(event: SuggestionsEvent): void;
  /** Called when the connection is made or lost. */
  onLink(isConnected: boolean): void;
  /** Called when the server no longer takes the access key, as after a restart; no more is tried. */
  onDenied(): void;
}

/** Listens to changes, from the version after `version()`, until aborted or denied; a lost connection is made again. */
export async function listen(
  client: Client,
  version: () => number,
  handlers: StreamHandlers,
  signal: AbortSignal,
): Promise<void> {
  for (let failures = 0; !signal.aborted; failures++) {
    try {
      const reader = (await client.stream(`events?since=${version()}`, signal)).getReader();
      const parser = new EventParser();
      const decoder = new TextDecoder();
      handlers.onLink(true);
      failures = 0;
      for (;;) {
        const { done, value } = await reader.read();
        if (done) break;
        for (const event of parser.push(decoder.decode(value, { stream: true }))) {
          if (event.name === "change") handlers.onChange(JSON.parse(event.data) as ChangeEvent);
          if (event.name === "outputs") handlers.onOutputs(JSON.parse(event.data) as Outputs);
          if (event.name === "suggestions") handlers.onSuggestions(JSON.parse(event.data) as SuggestionsEvent);
        }
      }
    } catch (error) {
      if (signal.aborted) return;
      if (error instanceof ApiFailure && error.status === 401) {
        handlers.onDenied();
        return;
      }
    }
    handlers.onLink(false);
    await new Promise((resolve) => setTimeout(resolve, RETRY_MS[Math.min(failures, RETRY_MS.length - 1)]));
  }
}
