/** Starts the page of `usd2kg serve`. */

import { render } from "preact";
import { fetchAbout } from "./protocol";
import { QueryPage } from "./QueryPage";

const host = document.getElementById("app") as HTMLElement;

fetchAbout().then(
  (about) => {
    document.title = `${about.title}: query the graph`;
    render(<QueryPage about={about} />, host);
  },
  (error: unknown) => render(<p class="fatal">{error instanceof Error ? error.message : String(error)}</p>, host),
);
