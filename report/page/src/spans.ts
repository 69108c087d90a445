// What the lanes show: for each a row of spans, with a word and a look.

import type { Arrow, Data, Stay, Tone } from "./data";
import { SIGNS } from "./dom";

export type Look = Tone | "yellow" | "yellow-flashing" | "blue" | "blue-flashing" | "dark" | "true" | "false" | "gap";

export interface Span {
  from: number;
  to: number;
  word: string;
  look: Look;
}

export interface Row {
  id: string;
  title: string;
  of: string;
  spans: Span[];
}

const us = (seconds: number) => Math.round(seconds * 1e6);

/** All rows, from the states down. */
export function rows(data: Data): Row[] {
  const states: Row = { id: "states", title: "AS state", of: "as the judge saw it", spans: [] };
  for (const stay of data.check.stays) {
    states.spans.push({ from: us(stay.since), to: us(stay.until), word: stay.state, look: light(data, stay.state) });
  }
  return [states, ...arrows(data), ...data.lanes.map((lane) => ({ ...lane, spans: spans(data, lane) })), recording(data)];
}

/** The look of a state is its light. */
function light(data: Data, state: string): Look {
  const shown = data.lights.find(([name]) => name === state)?.[1] ?? "";
  const [hue, how] = shown.split(", ");
  if (hue === "yellow" || hue === "blue") return how === "flashing" ? `${hue}-flashing` : hue;
  return "dark";
}

/** An arrow of Figure 2 is a row: what blocked it, while the car was where it begins. */
function arrows(data: Data): Row[] {
  const all = new Map<string, Row>();
  for (const stay of data.check.stays) {
    for (const arrow of stay.arrows) {
      const title = `${stay.state} → ${arrow.to}`;
      const row = all.get(title) ?? { id: `arrow-${all.size}`, title, of: `section ${arrow.section}`, spans: [] };
      all.set(title, row);
      row.spans.push(...blocked(stay, arrow));
    }
  }
  return [...all.values()];
}

function blocked(stay: Stay, arrow: Arrow): Span[] {
  const found: Span[] = [];
  let at = us(stay.since);
  for (const time of arrow.blocked) {
    const [from, to] = [us(time.since), us(time.until)];
    if (from > at) found.push(open(at, from, arrow));
    const failed = time.failed.length;
    const word = failed > 0
      ? `${SIGNS.bad} ${time.failed.map((one) => one.needs).join(", ")}`
      : `${SIGNS.unknown} ${time.unknown.map((one) => one.needs).join(", ")}`;
    found.push({ from, to, word, look: failed > 0 ? "false" : "unknown" });
    at = to;
  }
  if (us(stay.until) > at) found.push(open(at, us(stay.until), arrow));
  return found;
}

/** Nothing blocked it; where not all times are listed, nobody says. */
function open(from: number, to: number, arrow: Arrow): Span {
  if (arrow.not_listed > 0) return { from, to, word: `${SIGNS.unknown} not listed`, look: "several" };
  return { from, to, word: `${SIGNS.good} open`, look: "true" };
}

function spans(data: Data, lane: Data["lanes"][number]): Span[] {
  const found: Span[] = [];
  lane.spans.forEach(([from, place], index) => {
    const to = lane.spans[index + 1]?.[0] ?? data.end;
    const [word, look] = lane.words[place] ?? ["not known", "unknown"];
    found.push({ from, to, word, look });
  });
  return found;
}

function recording(data: Data): Row {
  const found: Span[] = data.gaps.map(([from, to]) => ({ from, to, word: "no frame", look: "gap" }));
  for (const [at, count] of data.drops) found.push({ from: at, to: at, word: `${count} frames lost`, look: "bad" });
  found.sort((a, b) => a.from - b.from);
  return { id: "gaps", title: "Gaps of the recording", of: data.interface ?? "all interfaces", spans: found };
}

/** The span of a row at a time. */
export function spanAt(row: Row, t: number): Span | undefined {
  let from = 0;
  let to = row.spans.length;
  while (from < to) {
    const middle = (from + to) >>> 1;
    if (row.spans[middle]!.from <= t) from = middle + 1;
    else to = middle;
  }
  const span = row.spans[from - 1];
  return span && (t < span.to || (t === span.to && from === row.spans.length)) ? span : undefined;
}
