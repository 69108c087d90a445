// The page that judges in a browser.
//
//   start --a log--> opened: the report, by the edition and readings that are chosen
//     |  --several-> list: a verdict each --a click--> opened
//     +-- car: the virtual car, judged live --its log--> opened
//     +-- live: a bus that `adsdv watch --web` streams --its log--> opened

import { h } from "../../../report/page/src/dom";
import { refused } from "./busy";
import { car } from "./car";
import { Engine, type Source } from "./engine";
import { list } from "./list";
import { hasLive, live } from "./live";
import { opened } from "./opened";
import { start } from "./start";
import { keepOffline } from "./offline";

const page = document.getElementById("page")!;
let view = new AbortController();

/** Shows another view in place of the one before. */
function to(title: string, make: (signal: AbortSignal) => HTMLElement[]): void {
  view.abort();
  view = new AbortController();
  delete document.documentElement.dataset["ready"];
  document.title = `adsdv: ${title}`;
  const back = page.firstElementChild!;
  page.replaceChildren(back, ...make(view.signal));
  scrollTo(0, 0);
}

function begin(engine: Engine): void {
  let several: Source[] = [];
  const showStart = () => to("judge a log", () => start(engine, open));
  const showList = () => to("logs", (signal) => list(engine, several, showOne, signal));
  const showOne = (source: Source) => {
    to(source.name, (signal) => opened(engine, source, signal));
    mark(logs);
  };
  const showCar = () => to("the virtual car", (signal) => car(engine, showOne, signal));
  const showLive = () => to("a live bus", (signal) => live(engine, showOne, signal));
  const open = (sources: Source[]) => {
    several = sources.length > 1 ? sources : [];
    all.hidden = several.length === 0;
    if (several.length > 0) {
      showList();
      mark(all);
    } else showOne(sources[0]!);
  };
  const tab = (text: string, show: () => void) => {
    const button: HTMLButtonElement = h("button", { type: "button", click: () => {
      show();
      mark(button);
    } }, text);
    return button;
  };
  const logs = tab("Judge a log", showStart);
  const all = tab("The list", showList);
  const drive = tab("Virtual car", showCar);
  const watched = hasLive() ? [tab("Live bus", showLive)] : [];
  const mark = (current: HTMLButtonElement) => {
    for (const one of [...watched, logs, all, drive]) {
      if (one === current) one.setAttribute("aria-current", "page");
      else one.removeAttribute("aria-current");
    }
  };
  all.hidden = true;
  page.replaceChildren(h("nav", { "aria-label": "adsdv", class: "tabs" }, h("strong", {}, "adsdv"), ...watched, logs, all, drive));
  if (watched[0]) {
    showLive();
    mark(watched[0]);
  } else {
    showStart();
    mark(logs);
  }
  // What misses the place to drop is not to replace the page.
  for (const event of ["dragover", "drop"]) addEventListener(event, (one) => one.preventDefault());
  document.documentElement.dataset["begun"] = "yes";
}

page.append(h("p", { role: "status" }, "Loading the judge …"));
Engine.begin().then(begin).catch((error: unknown) => {
  page.replaceChildren(refused(error), h("p", {}, "This page is for Chromium 110, Firefox 115, Safari 16.4 and later."));
});
keepOffline();
