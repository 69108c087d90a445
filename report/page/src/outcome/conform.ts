// A program held against the state machine of the document: deviations first, then Figure 2, what is not explained, failures, requirements.

import { SIGNS, counted, h, section, table } from "../dom";
import type { ConformData, Deviation, Failure } from "./data";
import { ownFigure } from "./own";
import { type Kind, copied, filtered, opening, page, plain, rows, sentences, terms } from "./parts";
import { stepTable, suiteTable } from "./steps";

export function conform(data: ConformData): HTMLElement[] {
  const { json, picture } = data;
  const found = json.diagnosis;
  return page(data,
    found && deviations(data, found.deviations),
    found && picture && ownFigure(picture, found.figure),
    unexplained(data),
    failures(data, "failures", "Failures", json.failures, json.more_failures > 0 ? `And ${json.more_failures} more.` : ""),
    json.observations.length > 0 && failures(data, "observations", "Otherwise than decided here",
      json.observations, "Where the document is silent; no failure but with --strict."),
    requirements(data),
    readings(data));
}

function deviations(data: ConformData, all: Deviation[]): HTMLElement {
  const state = (one: Deviation) => (one.accepted !== null ? "accepted" : one.observed ? "observed" : "counts");
  const moods = { counts: ["bad", SIGNS.bad], accepted: ["care", `${SIGNS.care} accepted:`], observed: ["care", `${SIGNS.care} no failure:`] } as const;
  const cards = all.map((one, place) => {
    const [mood, sign] = moods[state(one)];
    return h("li", { class: `card deviation ${mood}`, id: `deviation-${place}` },
      h("h3", {}, h("span", { class: "sign" }, sign), ` ${one.text}`),
      terms(["Its name", h("code", {}, one.id)],
        ["Accepted", one.accepted],
        ["No failure", one.observed && "the document is silent, and this is only decided here"],
        ["Against", one.requirements.length > 0 && sentences(data, one.requirements)],
        ["Beside", one.example && one.example.beside.length > 0 && one.example.beside.join(", ")]),
      one.example && h("h4", {}, "The shortest scenario that shows it"),
      one.example && suiteTable(one.id, one.example.test, one.example.differences.join(", ")),
      one.example && copied("As a test for --suite", one.example.test));
  });
  const none = data.json.diagnosis!.cut ? "The search ended before anything could be named."
    : data.json.diagnosis!.unexplained > 0 ? "Nothing that can be named explains what it does." : "None.";
  return section("deviations", "Deviations",
    h("p", { class: "quiet" }, `What it does otherwise than the document, each by itself, found in ${counted(data.json.diagnosis!.experiments, "experiment")}.`),
    all.length > 0 ? h("ol", { class: "cards deviations" }, ...cards) : h("p", {}, none));
}

function unexplained(data: ConformData): HTMLElement | null {
  const { diagnosis, not_shown, not_told, notes } = data.json;
  const list: [string, string][] = [];
  if (diagnosis && diagnosis.unexplained > 0) list.push(["Not explained", `${diagnosis.unexplained} of ${counted(diagnosis.experiments, "experiment")}`]);
  if (diagnosis && diagnosis.left_out.length > 0) list.push(["Left out", `${diagnosis.left_out.join(", ")}: nothing that can be named explains what is shown there`]);
  if (diagnosis?.cut) list.push(["Cut short", "the search for deviations ended before all was tried: there may be more; raise --diagnosis-limit"]);
  for (const id of diagnosis?.unused ?? []) list.push(["Accepted for nothing", `${id} is not there any more: take it out of the file`]);
  if (not_shown.length > 0) list.push(["Outputs that it does not show", not_shown.join(", ")]);
  if (not_told.length > 0) list.push(["Tests that were not run", not_told.join(", ")]);
  for (const note of notes) list.push(["Note", note]);
  return list.length > 0 ? section("unexplained", "What is not known", terms(...list)) : null;
}

function failures(data: ConformData, id: string, title: string, all: Failure[], more: string): HTMLElement {
  if (all.length === 0) return section(id, title, h("p", {}, "None."));
  const items = all.map((one, place) => {
    const text = [one.name, one.about, one.why ?? "", ...one.requirements, ...one.also].join(" ");
    return opening(`${id}-${place}`, "", text, one.name, [
      one.why ?? "its answers were right when it was asked again", one.requirements.join(", ")], () => failure(data, one));
  });
  return filtered(id, title, id, [], items, rows(title, ["Test", "What is wrong", "Requirements"], items),
    more ? h("p", { class: "quiet" }, more) : null);
}

function failure(data: ConformData, one: Failure): HTMLElement {
  const keys = one.differences.map((difference) => difference.key);
  const row = one.row && `${one.row.from} → ${one.row.to} (${one.row.section}): ${one.row.guard.join(" and ")}`;
  return h("div", {},
    terms(["The test", one.about],
      ["Wrong in the end", one.differences.map(({ key, found, expected }) => `${key} is ${found}, expected ${expected}`).join("; ")],
      ["The row of Figure 2", row],
      ["Against", one.requirements.length > 0 && sentences(data, one.requirements)],
      ["Fail likewise", one.also.join(", ")],
      ["Right under", one.explained_by.join(", ")]),
    stepTable(one.name, one.steps, keys.length > 0 ? keys : ["as_state"]));
}

const OUTCOMES: Kind[] = [
  ["fail", `${SIGNS.bad} failed`, true], ["differs", `${SIGNS.care} differs`, true],
  ["not checked", `${SIGNS.unknown} not checked`, false], ["pass", `${SIGNS.good} passed`, false],
];

function requirements(data: ConformData): HTMLElement {
  const items = data.json.requirements.map((one) => {
    const name = OUTCOMES.find(([kind]) => kind === one.outcome)?.[1] ?? one.outcome;
    const tests = one.checked === one.tests ? String(one.tests) : `${one.checked} of ${one.tests}`;
    const sentence = data.requirements[one.id] ?? "";
    return plain(one.outcome, [one.id, sentence, one.outcome, ...one.failed].join(" "), [
      h("strong", {}, one.id), h("span", { class: `word ${one.outcome === "fail" ? "past" : ""}` }, name), tests, sentence, one.failed.join(", ")]);
  });
  const silent = data.json.about_the_vcu - data.json.requirements.length;
  return filtered("requirements", "Requirements", "requirements", OUTCOMES, items,
    rows("Requirements", ["Requirement", "Result", "Tests", "What it says", "Broken by"], items),
    silent > 0 && h("p", { class: "quiet" }, `${silent} more about the VCU are in no test, for no output shows them.`));
}

function readings(data: ConformData): HTMLElement {
  const text = (reading: string, choice: string) => data.readings[`${reading}=${choice}`] ?? choice;
  const list = data.json.follows.map((one) => {
    const says = one.mixes.length > 0
      ? `${SIGNS.bad} mixes: ${one.mixes.map((side) => `${text(one.reading, side.choice)} (${side.tests.join(", ")})`).join("; ")}`
      : one.possible.length === 1 ? text(one.reading, one.possible[0]!) : one.possible.length === 0 ? `${SIGNS.unknown} undecided` : `${SIGNS.unknown} undecided: ${one.possible.map((choice) => text(one.reading, choice)).join(" or ")}`;
    return [h("span", {}, h("code", {}, one.reading), ` ${data.readings[one.reading] ?? ""}`), says];
  });
  return section("readings", "Readings that it follows",
    h("p", { class: "quiet" }, "The document leaves these questions open; any answer conforms."),
    list.length > 0 ? table("Readings", ["Question", "Its answer"], list) : h("p", {}, "None is shown."));
}
