// A scenario of a VCU, step by step: what is given, what is expected, and what was shown.

import { SIGNS, h } from "../dom";
import type { Step, Value } from "./data";

/** Steps that are alike are one line. */
interface Stretch {
  first: number;
  last: number;
  ms: number;
  changes: string;
  expected: string;
  actual: string;
  wrong: boolean;
}

const shown = (value: Value | undefined) => (value === undefined || value === null ? "–" : String(value));

/** What an input is that no step names, seen from what it was. */
function usual(before: Value | undefined): string {
  return typeof before === "boolean" ? "false" : typeof before === "number" ? "0" : "at its default";
}

/** What changed in the inputs; what is not named any more is at its default. */
function changes(before: Record<string, Value>, now: Record<string, Value>): string {
  const keys = [...new Set([...Object.keys(before), ...Object.keys(now)])];
  const other = keys.filter((key) => shown(before[key]) !== shown(now[key]));
  return other.map((key) => `${key} ${key in now ? shown(now[key]) : usual(before[key])}`).join(", ");
}

/** The outputs that are said, the state first; of those that are wrong all. */
function outputs(step: Step, which: "expected" | "actual", wrong: string[]): string {
  const keys = ["as_state", ...wrong.filter((key) => key !== "as_state")];
  const said = keys.filter((key) => key in step[which]);
  return said.map((key) => (key === "as_state" ? shown(step[which][key]) : `${key} ${shown(step[which][key])}`)).join(", ") || "–";
}

/** A failure's steps as a table. */
export function stepTable(name: string, steps: Step[], keys: string[]): HTMLElement {
  const lines: Stretch[] = [];
  let ms = 0;
  steps.forEach((step, place) => {
    ms += step.dt_ms;
    const changed = changes(steps[place - 1]?.inputs ?? {}, step.inputs);
    const wrong = keys.filter((key) => key in step.expected && key in step.actual && shown(step.expected[key]) !== shown(step.actual[key]));
    const line = { first: place + 1, last: place + 1, ms, changes: changed, expected: outputs(step, "expected", keys), actual: outputs(step, "actual", keys), wrong: wrong.length > 0 };
    const before = lines.at(-1);
    if (before && changed === "" && before.expected === line.expected && before.actual === line.actual) {
      before.last = line.last;
      before.ms = ms;
    } else lines.push(line);
  });
  return table(name, ["Step", "Time", "Inputs that changed", "Expected", "Shown"], lines.map((one) => [
    one.first === one.last ? String(one.first) : `${one.first}–${one.last}`, when(one.ms), one.changes, one.expected,
    one.wrong ? h("strong", { class: "past" }, `${SIGNS.bad} ${one.actual}`) : one.actual]));
}

/** The steps of a line of a suite, and what is shown after the last of them. */
export function suiteTable(name: string, line: string, end: string): HTMLElement | undefined {
  let test: { steps?: { dt_ms?: number; times?: number; inputs?: Record<string, Value> }[] };
  try {
    test = JSON.parse(line) as typeof test;
  } catch {
    return undefined;
  }
  let ms = 0;
  let count = 0;
  let before: Record<string, Value> = {};
  const lines = (test.steps ?? []).map((step) => {
    const times = step.times ?? 1;
    const [first, last] = [count + 1, count + times];
    count = last;
    ms += (step.dt_ms ?? 0) * times;
    const inputs = step.inputs ?? {};
    const changed = changes(before, inputs);
    before = inputs;
    return [first === last ? String(first) : `${first}–${last}`, when(ms), changed, ""] as (string | HTMLElement)[];
  });
  lines.at(-1)?.splice(3, 1, h("strong", { class: "past" }, `${SIGNS.bad} ${end}`));
  return table(name, ["Step", "Time", "Inputs that changed", "Shown"], lines);
}

const when = (ms: number) => h("span", { class: "when" }, `${ms} ms`);

function table(name: string, head: string[], lines: (string | HTMLElement)[][]): HTMLElement {
  return h("div", { class: "scroll frames", tabindex: 0, role: "region", "aria-label": `Steps of ${name}, a table` },
    h("table", {}, h("thead", {}, h("tr", {}, ...head.map((title) => h("th", { scope: "col" }, title)))),
      h("tbody", {}, ...lines.map((cells) => h("tr", {}, ...cells.map((cell) => h("td", {}, cell)))))));
}
