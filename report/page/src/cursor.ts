// What counts at the cursor: the state, why each of its arrows is not taken, and what every lane says.

import type { Arrow, Condition, Data, Stay } from "./data";
import { SIGNS, h, seconds } from "./dom";
import { type Row, spanAt } from "./spans";
import type { View } from "./view";

/** Beside the timeline: it follows the cursor. */
export function panel(data: Data, rows: Row[], view: View): HTMLElement {
  const time = h("h3", {}, "No cursor");
  const why = h("div", {});
  const says = h("div", {});
  const element = h("section", { class: "panel", "aria-labelledby": "why-title" },
    h("h2", { id: "why-title" }, "Why not?"), time, why, h("h3", {}, "At the cursor"), says);
  let shown: string | null = null;
  const show = () => {
    const t = view.cursor;
    if (t === null) {
      why.replaceChildren(h("p", { class: "quiet" }, "Point at the timeline, or press → in it: here stands what the car waited for at that moment."));
      return;
    }
    time.textContent = `${seconds(t)} s`;
    const stay = stayAt(data, t);
    const lanes = rows.filter((row) => !row.id.startsWith("arrow")).map((row) => [row, spanAt(row, t)] as const);
    // What says the same is not written again.
    const key = JSON.stringify([stay?.since, stay && arrowsAt(stay, t).map(([, time]) => time?.since), lanes.map(([, span]) => span?.from)]);
    if (key === shown) return;
    shown = key;
    why.replaceChildren(stay ? whyNot(stay, t) : h("p", {}, "No frame shows the state of the car here."));
    const list = lanes.filter(([, span]) => span).flatMap(([row, span]) => [h("dt", { title: row.of }, row.title), h("dd", {}, span!.word)]);
    says.replaceChildren(h("dl", { class: "lanes-said" }, ...list));
  };
  view.on(show);
  show();
  return element;
}

/** The state that lasts at a time. */
export function stayAt(data: Data, t: number): Stay | undefined {
  return data.check.stays.findLast((stay) => stay.since * 1e6 <= t + 1 && t <= stay.until * 1e6 + 1);
}

function arrowsAt(stay: Stay, t: number): [Arrow, Arrow["blocked"][number] | undefined][] {
  return stay.arrows.map((arrow) => [arrow, arrow.blocked.find((time) => time.since * 1e6 <= t + 1 && t < time.until * 1e6)]);
}

function whyNot(stay: Stay, t: number): HTMLElement {
  const left = stay.left_to ? `, left to ${stay.left_to}` : "";
  return h("div", {},
    h("p", {}, h("strong", {}, stay.state), ` since ${stay.since.toFixed(3)} s, until ${stay.until.toFixed(3)} s${left}`),
    ...arrowsAt(stay, t).map(([arrow, time]) => h("div", { class: "arrow" },
      h("h4", {}, `→ ${arrow.to} `, h("span", { class: "quiet" }, arrow.section)),
      time
        ? h("ul", {}, ...time.failed.map((one) => condition(one, "false")), ...time.unknown.map((one) => condition(one, "unknown")),
          time.holding.length > 0 && h("li", { class: "true" }, `${SIGNS.good} ${time.holding.length} ${time.holding.length === 1 ? "other holds" : "others hold"}`))
        : h("p", { class: arrow.not_listed > 0 ? "quiet" : "true" }, arrow.not_listed > 0 ? "? not listed" : `${SIGNS.good} nothing is known to block it`))));
}

function condition(one: Condition, how: "false" | "unknown"): HTMLElement {
  const by = one.message ? `${one.whose}, ${one.message}` : one.whose;
  const seen = how === "false" && one.seen ? `: ${one.seen}` : one.seen ? `: ${one.seen}, not certain` : ": not known";
  return h("li", { class: how }, `${how === "false" ? SIGNS.bad : SIGNS.unknown} needs ${one.needs}${seen} `, h("span", { class: "quiet" }, `(${by})`));
}
