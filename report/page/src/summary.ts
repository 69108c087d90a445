// The top of the page: what was judged, the verdict, what to do next, what matters most, and the questions that a team has.

import type { Data } from "./data";
import { counted, h, seconds, section, sign } from "./dom";

export interface Go {
  /** Looks at a moment, in a lane or plot. */
  look(at: number | null, show: string): void;
  /** Opens a finding. */
  open(finding: number): void;
}

export function head(data: Data): HTMLElement {
  const { check } = data;
  const by = check.recognised;
  const evidence = by?.evidence.slice(0, 2).join("; ");
  const edition = `edition ${check.edition}${evidence ? `, recognised: ${evidence}` : ""}`;
  const bus = data.interface === null ? "" : `, interface ${data.interface}`;
  return h("header", {},
    h("h1", {}, data.name),
    h("p", { class: "about" },
      `${counted(check.frames, "frame")} in ${check.duration_s.toFixed(3)} s${bus}; ${edition}`),
    ...data.settings.map((line) => h("p", { class: "about" }, line)));
}

export function verdict(data: Data, go: Go): HTMLElement {
  const { summary } = data;
  const matters = summary.matters.map((matter) => h("li", { class: `card ${matter.mood}` },
    h("h3", {}, sign(matter.mood), matter.title),
    h("p", {}, matter.text),
    matter.at !== null && h("button", {
      type: "button",
      click: () => (matter.finding === undefined ? go.look(matter.at, "states") : go.open(matter.finding)),
    }, `Show ${seconds(matter.at)} s`)));
  return h("section", { id: "verdict", "aria-labelledby": "verdict-title" },
    h("div", { class: `verdict ${summary.mood}` },
      h("h2", { id: "verdict-title" }, sign(summary.mood), summary.verdict),
      h("p", {}, h("strong", {}, "Next: "), summary.next)),
    matters.length > 0 && h("h2", { class: "small" }, "What matters most"),
    matters.length > 0 && h("ul", { class: "cards" }, ...matters));
}

export function questions(data: Data, go: Go): HTMLElement {
  const rows = data.questions.map((one) => h("div", { class: `answer ${one.mood}` },
    h("dt", {}, sign(one.mood), one.question),
    h("dd", {}, h("span", {}, one.answer), " ",
      h("button", { type: "button", "aria-label": `Show: ${one.question}`, click: () => go.look(one.at, one.show) },
        one.at === null ? "Show" : `Show ${seconds(one.at)} s`))));
  return section("questions", "Questions after a run", h("dl", { class: "questions" }, ...rows));
}
