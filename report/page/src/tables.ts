// The rest of the report: the states in words, margins, answers to the handshake, what was exercised, rules of the user's own.

import type { Data } from "./data";
import { SIGNS, counted, h, number, section, table } from "./dom";
import { requirements } from "./findings";
import type { View } from "./view";

const HELD = { true: SIGNS.good, false: SIGNS.bad, unknown: SIGNS.unknown };

const JUSTIFIED: Record<string, string> = {
  true: `${SIGNS.good} justified`, false: `${SIGNS.bad} violation`, unknown: `${SIGNS.unknown} not certain`,
};

function jump(view: View, t: number): HTMLElement {
  return h("button", { type: "button", click: () => {
    view.jump(t * 1e6);
    document.getElementById("timeline")?.scrollIntoView();
  } }, `${t.toFixed(3)} s`);
}

export function states(data: Data, view: View): HTMLElement {
  const rows = data.check.transitions.map((one, place) => {
    const { decided = [], or = [] } = data.transitions[place] ?? {};
    return [
      jump(view, one.t),
      `${one.from} → ${one.to}`,
      one.section,
      JUSTIFIED[one.justified] ?? one.justified,
      h("ul", { class: "plain" },
        ...decided.map(({ text, held }) => h("li", { class: held }, `${HELD[held]} ${text}`)),
        ...or.map((text) => h("li", {}, `or ${text}, which the VCU reports alike`))),
    ];
  });
  const lasted = data.check.stays.map((stay) => [jump(view, stay.since), stay.state, `${(stay.until - stay.since).toFixed(3)} s`, stay.left_to ?? "the end"]);
  const vain = data.check.go_presses.map((press) => h("li", {}, jump(view, press.t), ` "Go" in vain: ${press.why}`));
  return section("states-table", "States in words",
    rows.length > 0 ? table("Transitions", ["When", "Transition", "Section", "Justified", "What decided"], rows) : h("p", {}, "No change of AS_STATE was seen."),
    table("States", ["Since", "State", "Lasted", "Left to"], lasted),
    vain.length > 0 && h("ul", {}, ...vain));
}

export function margins(data: Data, view: View): HTMLElement {
  const rows = data.check.margins.map((margin) => {
    const share = `${number(margin.left * 100, 0)} %`;
    return [
      jump(view, margin.t),
      margin.what + (margin.message ? ` ${margin.message}` : ""),
      margin.party,
      margin.section,
      `${number(margin.value)} ${margin.unit}`,
      `${number(margin.limit)} ${margin.unit} (${margin.basis})`,
      margin.basis === "cycle" ? "" : h("span", { class: margin.left < 0 ? "past" : "" }, `${margin.left < 0 ? `${SIGNS.bad} ` : ""}${share}`),
    ];
  });
  return section("margins", "Margins",
    h("p", { class: "quiet" }, "How close the run came to its limits, the closest first."),
    rows.length > 0 ? table("Margins", ["When", "What", "Who", "Section", "Worst", "Limit", "Left"], rows) : h("p", {}, "Nothing was measured."));
}

export function handshake(data: Data): HTMLElement {
  const times = data.check.handshake_response_ms;
  if (!times) return section("answers", "Answers to the handshake", h("p", {}, "No answers seen."));
  const ms = (value: number) => `${number(value, 3)} ms`;
  return section("answers", "Answers to the handshake",
    table("Answers of the AI Computer", ["Answers", "Fastest", "Median", "99 % within", "Slowest"],
      [[String(times.count), ms(times.min), ms(times.median), ms(times.p99), ms(times.max)]]));
}

export function exercised(data: Data): HTMLElement {
  const { exercised: all, required = [] } = data.check;
  const standings = ["violated", "held", "not certain", "not exercised"];
  const signs: Record<string, string> = { violated: SIGNS.bad, held: SIGNS.good, "not certain": SIGNS.unknown, "not exercised": "–" };
  const groups = standings.map((standing) => {
    const ids = all.requirements.filter((one) => one.told === standing).map((one) => one.id);
    return h("details", { open: standing === "violated" && ids.length > 0 },
      h("summary", {}, `${signs[standing]} ${counted(ids.length, "requirement")} ${standing}`),
      ids.length > 0 && requirements(data, ids));
  });
  const seen = data.check.exercised.states;
  const missing = data.lights.map(([state]) => state).filter((state) => !seen.includes(state));
  const sides = `${all.ai ? SIGNS.good : SIGNS.bad} AI Computer, ${all.vcu ? SIGNS.good : SIGNS.bad} VCU`;
  return section("exercised", "Exercised",
    h("p", {}, `Heard: ${sides}. States seen: ${seen.join(", ") || "none"}. Not seen: ${missing.join(", ") || "none"}.`),
    required.length > 0 && h("ul", {}, ...required.map((one) => h("li", {}, `${one.met ? SIGNS.good : SIGNS.bad} ${one.what}: required, ${one.met ? "there" : "missing"}`))),
    ...groups);
}

export function rules(data: Data, view: View): HTMLElement | null {
  const all = data.check.rules;
  if (!all) return null;
  const rows = all.map((rule) => [
    rule.name,
    h("div", {}, h("code", {}, rule.rule), rule.note && h("p", { class: "quiet" }, rule.note)),
    `${rule.verdict === "holds" ? SIGNS.good : rule.verdict === "broken" ? SIGNS.bad : SIGNS.unknown} ${rule.verdict}`,
    `${rule.held} / ${rule.broken} / ${rule.undecided}`,
    h("ul", { class: "plain" }, ...rule.breaches.map((breach) => h("li", {}, jump(view, breach.t), ` ${breach.seen}`)), rule.why && h("li", {}, rule.why)),
  ]);
  return section("rules", "Rules of your own", table("Rules", ["Rule", "Says", "Verdict", "Held / broken / undecided", "Where"], rows));
}
