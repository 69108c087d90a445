// The beginning: drop or choose a log or a folder, or try an example.

import { h, section } from "../../../report/page/src/dom";
import type { Engine, Source } from "./engine";
import { ofDrop, ofList } from "./files";

export function start(engine: Engine, open: (sources: Source[]) => void): HTMLElement[] {
  const { about } = engine;
  const said = h("p", { role: "status", class: "quiet", id: "said" });
  const take = (sources: Source[]) => {
    if (sources.length > 0) open(sources);
    else said.textContent = "There is no file in it.";
  };
  const chosen = (event: Event) => {
    const input = event.target as HTMLInputElement;
    take(ofList(input.files ?? []));
  };
  const file = h("input", { type: "file", id: "file", class: "hidden", multiple: true, tabindex: -1, "aria-label": "Logs", change: chosen });
  const folder = h("input", { type: "file", id: "folder", class: "hidden", webkitdirectory: true, tabindex: -1, "aria-label": "A folder of logs", change: chosen });
  const drop = h("div", {
    class: "drop",
    id: "drop",
    dragover: (event) => {
      event.preventDefault();
      drop.classList.add("over");
    },
    dragleave: () => drop.classList.remove("over"),
    drop: (event) => {
      event.preventDefault();
      drop.classList.remove("over");
      const { dataTransfer } = event as DragEvent;
      if (dataTransfer) void ofDrop(dataTransfer).then(take, (error: unknown) => (said.textContent = `It cannot be opened: ${String(error)}`));
    },
  },
    h("p", { class: "big" }, "Drop a log here, or a folder of logs"),
    h("p", {},
      h("button", { type: "button", class: "primary", click: () => file.click() }, "Choose logs"), " ",
      h("button", { type: "button", click: () => folder.click() }, "Choose a folder"), file, folder),
    h("p", { class: "quiet" }, `${about.formats.join(", ")}; also with gzip or Zstandard. It is judged here, in this browser: nothing is sent anywhere.`),
    said);
  const examples = about.examples.map(({ id, title, edition }) => h("li", {},
    h("button", { type: "button", "data-example": id, click: () => open([engine.example(id, title)]) }, title), ` edition ${edition}`));
  return [
    h("header", {},
      h("h1", {}, "What does your log say?"),
      h("p", { class: "about" }, "Judges recordings of the ADS-DV's CAN bus against the interface specification: the verdict, what to fix first, and each frame that shows it.")),
    h("main", {}, drop, section("examples", "Or try one", h("ul", { class: "examples" }, ...examples))),
    h("footer", {}, `adsdv ${about.version}. This page is one file that works without a network; save it to have it at the track.`),
  ];
}
