/** The page: shows the scene, asks for the access key, listens to changes. */

import { render } from "preact";
import { ApiFailure, storeKey } from "./api/client";
import { listen } from "./api/events";
import type { ChangeEvent, Outputs, SuggestionsEvent } from "./api/types";
import { App } from "./panels/App";
import { KeyForm } from "./panels/KeyForm";
import type { Start } from "./start";
import { startWithComparison } from "./state/comparison";
import { Store } from "./state/store";

const host = document.getElementById("app") as HTMLElement;

type Open = (key: string) => Start;

/** Runs the page; asks for the key if no scene is being opened. */
export function run(start: Start | null, open: Open): void {
  if (start === null) askForKey("", open);
  else void show(start, open);
}

async function show({ client, scene, states, picture }: Start, open: Open): Promise<void> {
  host.replaceChildren();
  try {
    const firstPicture = await picture;
    const store = new Store(client, await scene, await states, { tab: sessionStorage, browser: localStorage });
    document.title = `${store.model.data.title} · usd2kg studio`;
    startWithComparison(store);
    render(<App store={store} firstPicture={firstPicture} />, host);
    void store.loadQueue();
    const handlers = {
      onChange: (change: ChangeEvent) => store.server.receive(change),
      onOutputs: (outputs: Outputs) => store.server.receiveOutputs(outputs),
      onSuggestions: (event: SuggestionsEvent) => store.server.receiveSuggestions(event),
      onLink: (isConnected: boolean) => store.server.setConnected(isConnected),
      onDenied: () => askForKey("The studio was restarted with another key.", open),
    };
    void listen(client, () => store.server.version.value, handlers, new AbortController().signal);
  } catch (error) {
    (await picture)?.remove();
    if (error instanceof ApiFailure && error.status === 401) askForKey("This key is wrong.", open);
    else render(<p class="fatal">{error instanceof Error ? error.message : String(error)}</p>, host);
  }
}

function askForKey(problem: string, open: Open): void {
  storeKey("", sessionStorage);
  const submit = (key: string) => {
    storeKey(key, sessionStorage);
    render(null, host);
    run(open(key), open);
  };
  render(<KeyForm problem={problem} onSubmit={submit} />, host);
}
