// An AI Computer that was examined: what failed with expected and seen, the requirements, the scenarios.

import { SIGNS, counted, h, number, table } from "../dom";
import type { Message } from "../data";
import { raw, shown } from "../frames";
import type { ExamData, ExamFinding } from "./data";
import { type Kind, copied, filtered, opening, page, plain, rows, sentences, terms } from "./parts";

export function exam(data: ExamData): HTMLElement[] {
  const { notes, unused } = data.json;
  const told = [...notes, ...unused.map((id) => `${id} is accepted, and does not fail: take it out of the file`)];
  return page(data,
    told.length > 0 && h("ul", { class: "plain", id: "notes" }, ...told.map((note) => h("li", {}, `${SIGNS.care} ${note}`))),
    findings(data), requirements(data), scenarios(data));
}

const COUNTS: Kind[] = [["counts", `${SIGNS.bad} counts`, true], ["accepted", `${SIGNS.care} accepted`, true]];

function findings(data: ExamData): HTMLElement {
  const items = data.json.findings.map((one, place) => {
    const kind = one.accepted ? "accepted" : "counts";
    const text = [one.scenario, one.seen, one.expected, one.rule, one.section, ...one.requirements].join(" ");
    return opening(`finding-${place}`, kind, text, one.scenario, [
      h("span", { class: "when" }, `${one.t.toFixed(3)} s`), one.requirements.join(", ") || one.rule,
      h("span", {}, h("span", { class: "sign", title: one.accepted ? "accepted" : "counts" }, one.accepted ? SIGNS.care : SIGNS.bad), one.seen), one.expected],
      () => finding(data, one));
  });
  return filtered("findings", "Findings", "findings", COUNTS, items,
    items.length > 0 ? rows("Findings", ["Scenario", "When", "Against", "Seen", "Expected"], items) : h("p", {}, "None."));
}

function finding(data: ExamData, one: ExamFinding): HTMLElement {
  const frames = one.frames.map(({ t, by, frame }) => [h("span", { class: "when" }, `${t.toFixed(3)} s`), by, ...said(data.messages, frame)]);
  return h("div", {},
    terms(["Seen", one.seen], ["Expected", one.expected], ["Section", `${one.section}, rule ${one.rule}`],
      ["Against", one.requirements.length > 0 && sentences(data, one.requirements)],
      ["The operator had", one.operator.map(({ t, did }) => `${t.toFixed(3)} s ${did}`).join("; ")],
      ["The car", one.car]),
    one.trace ? copied("Where it failed, in its own words", one.trace) : null,
    frames.length > 0 && table(`The last frames of ${one.scenario} at ${one.t.toFixed(3)} s, by message`, ["When", "By", "Frame", "What it says"], frames),
    one.shortest ? copied("The shortest scenario that shows it, for --scenario", one.shortest) : null);
}

/** The name of a frame that candump writes so, and its signals; what is zero tells nothing. */
function said(messages: Message[], frame: string): (string | HTMLElement)[] {
  const [id, hex] = frame.split("#");
  const bytes = Uint8Array.from(hex?.match(/../g) ?? [], (byte) => Number.parseInt(byte, 16));
  const message = messages.find((message) => message.id === Number.parseInt(id ?? "", 16));
  const values = (message?.signals ?? []).flatMap((signal) => {
    const value = raw(signal, bytes, 0, bytes.length);
    return value === undefined || value === 0 ? [] : [`${signal.name}: ${shown(signal, value)}`];
  });
  return [h("span", {}, message?.name ?? "", " ", h("code", {}, frame)), values.join(", ")];
}

const OUTCOMES: Kind[] = [
  ["fail", `${SIGNS.bad} failed`, true], ["not exercised", `${SIGNS.unknown} not exercised`, true], ["pass", `${SIGNS.good} passed`, true],
];

function requirements(data: ExamData): HTMLElement {
  const { json } = data;
  const items = json.requirements.map((one) => {
    const name = OUTCOMES.find(([kind]) => kind === one.outcome)?.[1] ?? one.outcome;
    const broken = [...new Set(one.findings.map((place) => json.findings[place]?.scenario ?? ""))];
    const because = one.why ?? (one.accepted !== null ? `accepted: ${one.accepted}` : broken.join(", "));
    return plain(one.outcome, [one.id, one.about, one.section, one.outcome, because].join(" "), [
      h("strong", {}, one.id), one.section, h("span", { class: `word ${one.outcome === "fail" ? "past" : ""}` }, name), one.about, because]);
  });
  return filtered("requirements", "Requirements", "requirements", OUTCOMES, items,
    rows("Requirements", ["Requirement", "Section", "Result", "What it asks for", "Broken in, or why"], items));
}

const RUNS: Kind[] = [["wrong", `${SIGNS.bad} with findings`, true], ["stuck", `${SIGNS.unknown} came to no end`, true], ["right", `${SIGNS.good} nothing wrong`, true]];

function scenarios(data: ExamData): HTMLElement {
  const { json } = data;
  const items = json.scenarios.map((one) => {
    const kind = one.findings > 0 ? "wrong" : one.stuck !== null ? "stuck" : "right";
    const against = [...new Set(json.findings.filter((finding) => finding.scenario === one.name).flatMap((finding) => finding.requirements))];
    const sign = kind === "wrong" ? SIGNS.bad : kind === "stuck" ? SIGNS.unknown : SIGNS.good;
    const came = one.stuck !== null ? `waited in vain for ${one.stuck}` : one.findings > 0 ? counted(one.findings, "finding") : "nothing wrong";
    return plain(kind, [one.name, one.about, came, ...against, ...one.exercised].join(" "), [
      h("strong", {}, one.name), one.about, `${number(one.duration, 1)} s`, String(one.frames), `${sign} ${came}`, against.join(", "),
      one.exercised.length > 0 ? h("details", {}, h("summary", {}, counted(one.exercised.length, "requirement")), one.exercised.join(", ")) : ""]);
  });
  return filtered("scenarios", "Scenarios", "scenarios", RUNS, items,
    rows("Scenarios", ["Scenario", "What it is about", "Time", "Frames", "What came of it", "Against", "Exercised"], items));
}
