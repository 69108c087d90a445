// Figure 2 while a car moves: the state that it is in, the arrow that was taken, and what holds of each guard. Which arrows there are and
// what they ask for comes from the machine that drives.

import { SIGNS, h } from "../../../report/page/src/dom";
import { type Picture, drawn } from "../../../report/page/src/figure";

export interface FigureData {
  picture: Picture;
  arrows: Arrow[];
}

interface Arrow {
  from: string;
  to: string;
  section: string;
  terms: { section: string; conditions: { atom: string; value: boolean; text: string }[] }[];
}

/** What is known of a condition. */
export type Truth = "true" | "false" | "unknown";

export interface Figure {
  element: HTMLElement;
  /** The state, and what is known of the conditions. */
  now(state: string | null, truth: (atom: string) => Truth): void;
  /** An arrow was taken. */
  taken(from: string, to: string): void;
}

const WORDS: Record<Truth, [string, string]> = {
  true: [SIGNS.good, "holds: "], false: [SIGNS.bad, "does not hold: "], unknown: [SIGNS.unknown, "not known: "],
};

export function figure(data: FigureData): Figure {
  const guard = h("div", { class: "guard", id: "guard", "aria-live": "off" });
  let chosen: Arrow | undefined;
  let current: string | null = null;
  let holds: (atom: string) => Truth = () => "unknown";
  let told = "";
  const looks = data.arrows.map((arrow) => {
    const text = arrow.terms.map((term) => term.conditions.map((one) => one.text).join(" and ")).join("; or ");
    return { from: arrow.from, to: arrow.to, label: arrow.section, name: `${arrow.from} to ${arrow.to}, section ${arrow.section}`, title: `${arrow.from} → ${arrow.to} (${arrow.section}): ${text}` };
  });
  const { picture, mark, boxes, choose } = drawn(data.picture, looks, "Figure 2: the states, and the arrows between them", (which) => {
    const one = data.arrows[which];
    chosen = chosen === one ? undefined : one;
    choose(chosen && which);
    tell();
  });
  const marks = new Map<string, boolean>();
  /** What is so already is left as it is. */
  const set = (place: number, name: string, on: boolean) => {
    const key = `${place} ${name}`;
    if (marks.get(key) === on) return;
    marks.set(key, on);
    mark(place, name, on);
  };
  const tell = () => {
    const of = data.arrows.filter((arrow) => (chosen ? arrow === chosen : arrow.from === current));
    const key = `${chosen ? data.arrows.indexOf(chosen) : current} ${of.map((arrow) => arrow.terms.map((term) => term.conditions.map(({ atom, value }) => fits(holds(atom), value)))).join()}`;
    if (key === told) return;
    told = key;
    const title = chosen ? `${chosen.from} → ${chosen.to}` : current ? `From ${current}` : "No power";
    guard.replaceChildren(h("h3", {}, title, chosen ? " " : "", chosen && h("button", { type: "button", click: () => {
      chosen = undefined;
      choose(undefined);
      tell();
    } }, "all from the state that it is in")), ...of.map((arrow) => words(arrow, holds)));
  };
  return {
    element: h("div", { class: "figure" }, picture, guard),
    now(state, truth) {
      if (state !== current) {
        current = state;
        for (const [name, element] of boxes) element.classList.toggle("current", name === state);
      }
      holds = truth;
      data.arrows.forEach((arrow, place) => {
        const from = arrow.from === state;
        set(place, "from-here", from);
        set(place, "open", from && arrow.terms.some((term) => term.conditions.every(({ atom, value }) => fits(holds(atom), value) === "true")));
      });
      tell();
    },
    taken(from, to) {
      const taken = data.arrows.findIndex((arrow) => arrow.from === from && arrow.to === to);
      if (taken >= 0) data.arrows.forEach((_, place) => mark(place, "taken", place === taken));
    },
  };
}

/** Whether a condition is as the guard asks for it. */
function fits(truth: Truth, value: boolean): Truth {
  return truth === "unknown" ? "unknown" : truth === String(value) ? "true" : "false";
}

/** An arrow with each alternative of its guard, and which of its conditions hold now. */
function words(arrow: Arrow, holds: (atom: string) => Truth): HTMLElement {
  const terms = arrow.terms.map((term) => h("ul", { class: "plain" }, ...term.conditions.map(({ atom, value, text }) => {
    const truth = fits(holds(atom), value);
    const [sign, word] = WORDS[truth];
    return h("li", { class: truth }, h("span", { "aria-hidden": "true" }, sign), h("span", { class: "hidden" }, word), ` ${text}`);
  })));
  const joined = terms.flatMap((term, place) => (place === 0 ? [term] : [h("p", { class: "or" }, "or"), term]));
  return h("details", { open: true }, h("summary", {}, `→ ${arrow.to} (${arrow.section})`), ...joined);
}
