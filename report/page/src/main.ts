// The page of a judged recording. It takes one object of data, which stands in the page itself, and needs nothing else.

import type { Data } from "./data";
import { h } from "./dom";
import { show } from "./report";

const page = document.getElementById("page")!;
try {
  const data = JSON.parse(document.getElementById("data")?.textContent ?? "") as Data;
  const last = `Made by adsdv ${data.version}. This file holds the whole recording of the interface that was judged, and asks for nothing else.`;
  show(data, page, last, new AbortController().signal).catch(failed);
} catch (error) {
  failed(error);
}

function failed(error: unknown): void {
  page.append(h("p", { class: "verdict bad", role: "alert" },
    `This report cannot be shown: ${error instanceof Error ? error.message : String(error)}. It is for Chromium 110, Firefox 115, Safari 16.4 and later.`));
}
