// A judged recording, shown: in the page that holds it, and in the page that judges.
//
//   data --> summary, questions, findings, tables: sentences and tables
//     |
//     +----> spans --> lanes --\
//     +----> series --> plots --> stack <--> view (stretch and cursor) --> cursor: "why not" and what each lane says
//     +----> frames: every frame, unpacked after the first picture, for all that is looked at closely

import { panel } from "./cursor";
import type { Data } from "./data";
import { h, section } from "./dom";
import { findings } from "./findings";
import { Store } from "./frames";
import { help, keys } from "./keys";
import { lanes, said } from "./lanes";
import { plots } from "./plots";
import { allSeries } from "./series";
import { rows, spanAt } from "./spans";
import { stack } from "./stack";
import { type Go, head, questions, verdict } from "./summary";
import { exercised, handshake, margins, rules, states } from "./tables";
import { forget } from "./theme";
import { View } from "./view";

/** Shows a judged recording in an element, until the signal ends it; the last line says what the page is. */
export async function show(data: Data, page: HTMLElement, last: string, signal: AbortSignal): Promise<void> {
  document.title = `${data.name}: ${data.check.verdict}`;
  const view = new View(data.end);
  const store = new Store(data);
  const all = rows(data);
  const list = findings(data, store, view);
  const go: Go = {
    open: (place) => list.open(place),
    look(at, show) {
      if (at !== null) view.jump(at, 1_000_000);
      else view.show(0, view.end);
      const place = show === "findings" ? "findings" : document.getElementById(`plot-${show}`) ? `plot-${show}` : "timeline";
      document.getElementById(place)?.scrollIntoView({ block: place.startsWith("plot") ? "center" : "start" });
    },
  };
  const series = await allSeries(data);
  const charts = plots(data, series, store, view);
  const timeline = lanes(data, view, all);
  const stacked = stack(data, view, timeline, charts.map((chart) => chart.element),
    (t) => said(all, t, spanAt), (place) => list.open(place));
  const bar = h("div", { class: "bar" },
    ...([["−", "Zoom out", () => view.zoom(2)], ["+", "Zoom in", () => view.zoom(0.5)], ["‹", "Earlier", () => view.pan(-0.25)],
      ["›", "Later", () => view.pan(0.25)], ["All", "The whole recording", () => view.show(0, view.end)]] as const)
      .map(([sign, name, click]) => h("button", { type: "button", "aria-label": name, title: name, click }, sign)),
    h("span", { role: "status", class: "quiet", id: "loading" }, "unpacking every frame …"));
  if (signal.aborted) return;
  page.append(
    h("a", { class: "skip", href: "#findings" }, "To the findings"),
    head(data),
    h("main", {},
      verdict(data, go),
      questions(data, go),
      section("timeline", "Timeline", bar, h("div", { class: "look" }, stacked, panel(data, all, view)), help()),
      list.element,
      states(data, view),
      margins(data, view),
      handshake(data),
      exercised(data),
      rules(data, view)),
    h("footer", {}, last));
  keys(view, timeline.element, signal, {
    finding(step) {
      const next = list.beside(view.cursor ?? (step > 0 ? -1 : data.end + 2), step);
      if (next !== undefined) list.open(next);
    },
  });
  // What is printed is drawn, whether or not somebody has seen it.
  let printing = false;
  const restyle = () => {
    forget();
    timeline.restyle();
    charts.forEach((chart) => chart.restyle(printing));
    view.redraw();
  };
  for (const media of ["(prefers-color-scheme: dark)", "(max-width: 760px)"]) matchMedia(media).addEventListener("change", restyle, { signal });
  for (const event of ["beforeprint", "afterprint"]) {
    addEventListener(event, () => {
      printing = event === "beforeprint";
      restyle();
    }, { signal });
  }
  view.redraw();
  await new Promise((drawn) => requestAnimationFrame(() => setTimeout(drawn)));
  performance.mark("adsdv-first-picture");
  await store.load();
  if (signal.aborted) return;
  performance.mark("adsdv-every-frame");
  document.getElementById("loading")!.textContent = "";
  document.documentElement.dataset["ready"] = "yes";
  view.redraw();
}
