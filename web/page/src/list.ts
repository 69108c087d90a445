// Several logs: a verdict each, and a click opens one.

import { SIGNS, counted, h } from "../../../report/page/src/dom";
import { refused } from "./busy";
import { AS_USUAL, type Engine, type Judged, type Source } from "./engine";
import { Refused } from "./module";

const VERDICTS: Record<string, string> = {
  conforms: `${SIGNS.good} conforms`, violates: `${SIGNS.bad} violates`,
};

/** A list that judges by itself, until the signal ends it. */
export function list(engine: Engine, sources: Source[], open: (source: Source) => void, signal: AbortSignal): HTMLElement[] {
  const status = h("p", { role: "status", class: "about", id: "list-status" });
  const stop = new AbortController();
  signal.addEventListener("abort", () => stop.abort(), { once: true });
  const cancel = h("button", { type: "button", click: () => stop.abort() }, "Cancel");
  const rows = sources.map((source) => row(source, () => open(source)));
  const tally = { conforms: 0, violates: 0, other: 0, none: 0 };
  const say = (end: string) => {
    const done = tally.conforms + tally.violates + tally.other + tally.none;
    const parts = [`${SIGNS.bad} violates: ${tally.violates}`, `${SIGNS.good} conforms: ${tally.conforms}`];
    if (tally.other > 0) parts.push(`${SIGNS.unknown} neither: ${tally.other}`);
    if (tally.none > 0) parts.push(`${SIGNS.unknown} no answer: ${tally.none}`);
    status.textContent = `${done} of ${counted(sources.length, "file")}${end}. ${parts.join(", ")}`;
  };
  let next = 0;
  const work = async () => {
    for (let place = next++; place < sources.length && !stop.signal.aborted; place = next++) {
      try {
        const judged = await engine.judge(sources[place]!, AS_USUAL, true, stop.signal, () => {});
        rows[place]!.judged(judged);
        if (judged.verdict === "conforms" || judged.verdict === "violates") tally[judged.verdict]++;
        else tally.other++;
      } catch (error) {
        if (stop.signal.aborted) return;
        rows[place]!.refused(error);
        tally.none++;
      }
      say(" judged");
    }
  };
  say(" judged");
  const workers = Math.max(1, Math.min(4, (navigator.hardwareConcurrency || 2) - 1, sources.length));
  void Promise.all(Array.from({ length: workers }, work)).then(() => {
    cancel.hidden = true;
    say(stop.signal.aborted ? " judged, then cancelled" : " judged");
    if (!stop.signal.aborted) document.documentElement.dataset["ready"] = "yes";
  });
  const head = ["Log", "Verdict", "Violations", "Warnings", "Edition", "Format", "Length"].map((title) => h("th", { scope: "col" }, title));
  return [
    h("header", {}, h("h1", {}, counted(sources.length, "file")), status, cancel),
    h("main", {}, h("div", { class: "scroll", tabindex: 0, role: "region", "aria-label": "Logs, a table" },
      h("table", { class: "logs" }, h("caption", { class: "hidden" }, "Logs with their verdicts"),
        h("thead", {}, h("tr", {}, ...head)), h("tbody", {}, ...rows.map((one) => one.element))))),
  ];
}

interface Row {
  element: HTMLElement;
  judged(judged: Judged): void;
  refused(error: unknown): void;
}

function row(source: Source, open: () => void): Row {
  const element = h("tr", {}, h("td", {}, h("button", { type: "button", class: "open", click: open }, source.name)), h("td", { colspan: 6, class: "quiet" }, "…"));
  const fill = (...cells: HTMLElement[]) => element.replaceChildren(element.firstElementChild!, ...cells);
  return {
    element,
    judged({ verdict, violations, warnings, edition, format, duration_s, failure }) {
      element.className = verdict;
      const text = VERDICTS[verdict] ?? `${SIGNS.unknown} ${verdict}`;
      fill(h("td", { class: "word" }, failure ? `${text} (as far as it can be read)` : text), ...[violations, warnings].map((count) => h("td", {}, String(count))),
        h("td", {}, edition), h("td", {}, format), h("td", {}, `${duration_s.toFixed(3)} s`));
    },
    refused(error) {
      element.className = "none";
      const why = error instanceof Refused ? `${error.refusal.why}; ${error.refusal.hint}` : refused(error).textContent;
      fill(h("td", { colspan: 6 }, `${SIGNS.unknown} no answer: ${why}`));
    },
  };
}
