/** Starts the page: reads the access key, loads the scene, listens to changes. */

import { render } from "preact";
import { ApiFailure, createClient, readKey, storeKey } from "./api/client";
import { listen } from "./api/events";
import { requestScene } from "./api/opening";
import type { ChangeEvent, SuggestionsEvent } from "./api/types";
import { App } from "./panels/App";
import { KeyForm } from "./panels/KeyForm";
import { startWithComparison } from "./state/comparison";
import { Store } from "./state/store";

const host = document.getElementById("app") as HTMLElement;

async function start(): Promise<void> {
  const key = readKey(location, sessionStorage, (url) => history.replaceState(null, "", url));
  if (key === null) {
    askForKey("");
    return;
  }
  const client = createClient(key);
  host.replaceChildren();
  try {
    const [data, states] = await requestScene(client, localStorage);
    const store = new Store(client, data, states, localStorage);
    document.title = `${data.title} · usd2kg studio`;
    startWithComparison(store);
    render(<App store={store} />, host);
    void store.loadQueue();
    const handlers = {
      onChange: (change: ChangeEvent) => store.receive(change),
      onSuggestions: (event: SuggestionsEvent) => store.receiveSuggestions(event),
      onLink: (isConnected: boolean) => {
        if (!isConnected) store.saving.value = "offline";
        else if (store.saving.value === "offline") void store.reload();
      },
      onDenied: () => askForKey("The studio was restarted with another key."),
    };
    void listen(client, () => store.version.value, handlers, new AbortController().signal);
  } catch (error) {
    if (error instanceof ApiFailure && error.status === 401) askForKey("This key is wrong.");
    else render(<p class="fatal">{error instanceof Error ? error.message : String(error)}</p>, host);
  }
}

function askForKey(problem: string): void {
  storeKey("", sessionStorage);
  const submit = (key: string) => {
    storeKey(key, sessionStorage);
    render(null, host);
    void start();
  };
  render(<KeyForm problem={problem} onSubmit={submit} />, host);
}

void start();
