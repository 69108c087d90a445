// Figure 2: its states with their lights, and its arrows, whose guards say at any time what holds. Which arrows there are and what they ask
// for comes from the machine that drives; only where they are drawn is of this file.

import { SIGNS, h } from "../../../report/page/src/dom";

export interface FigureData {
  states: { name: string; light: string }[];
  arrows: Arrow[];
}

interface Arrow {
  from: string;
  to: string;
  section: string;
  terms: { section: string; conditions: { atom: string; value: boolean; text: string }[] }[];
}

export interface Figure {
  element: HTMLElement;
  /** The state, and the conditions that hold. */
  now(state: string | null, holds: Set<string>): void;
  /** An arrow was taken. */
  taken(from: string, to: string): void;
}

/** Where the document draws the states: the middle of each box. */
const PLACES: Record<string, [number, number]> = {
  AS_OFF: [400, 50], AS_READY: [400, 190], AS_DRIVING: [400, 330], EMERGENCY_BRAKE: [120, 260], AS_FINISHED: [680, 260],
};
const BOX = { width: 170, height: 52 };
const SVG = "http://www.w3.org/2000/svg";

function svg<K extends keyof SVGElementTagNameMap>(name: K, attributes: Record<string, string | number>, ...children: (Node | string)[]): SVGElementTagNameMap[K] {
  const element = document.createElementNS(SVG, name);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, String(value));
  element.append(...children);
  return element;
}

/** The class of a light: yellow or blue, and whether it flashes. */
export function lightClass(light: string): string {
  return `light-${light.split(",")[0]}${light.includes("flashing") ? " flashing" : ""}`;
}

export function figure(data: FigureData): Figure {
  const guard = h("div", { class: "guard", id: "guard", "aria-live": "off" });
  const arrows = data.arrows.map((arrow) => draw(arrow, data.arrows, () => choose(arrow)));
  const boxes = new Map(data.states.map(({ name, light }) => [name, box(name, light)]));
  let chosen: Arrow | undefined;
  let current: string | null = null;
  let held = new Set<string>();
  let drawn = "";
  const tell = () => {
    const of = data.arrows.filter((arrow) => (chosen ? arrow === chosen : arrow.from === current));
    const key = `${chosen ? data.arrows.indexOf(chosen) : current} ${[...held].join(" ")}`;
    if (key === drawn) return;
    drawn = key;
    const title = chosen ? `${chosen.from} → ${chosen.to}` : current ? `From ${current}` : "No power";
    guard.replaceChildren(h("h3", {}, title, chosen ? " " : "", chosen && h("button", { type: "button", click: () => choose(undefined) }, "all from the state that it is in")),
      ...of.map((arrow) => words(arrow, held)));
  };
  const choose = (arrow: Arrow | undefined) => {
    chosen = chosen === arrow ? undefined : arrow;
    arrows.forEach((one, place) => one.element.setAttribute("aria-pressed", String(data.arrows[place] === chosen)));
    tell();
  };
  const picture = svg("svg", { viewBox: "0 0 800 382", class: "figure2", role: "group", "aria-label": "Figure 2: the states, and the arrows between them" },
    svg("defs", {}, ...["", "-open", "-taken"].map((kind) => svg("marker", { id: `head${kind}`, class: `head${kind}`, viewBox: "0 0 10 10", refX: 9, refY: 5, markerWidth: 7, markerHeight: 7, orient: "auto-start-reverse" }, svg("path", { d: "M0 0 L10 5 L0 10 z" })))),
    // The longest lie below, so that no line goes through the number of another.
    ...[...arrows].sort((a, b) => b.length - a.length).map((one) => one.element), ...boxes.values());
  return {
    element: h("div", { class: "figure" }, h("div", { class: "picture" }, picture as unknown as HTMLElement), guard),
    now(state, holds) {
      if (state !== current) {
        current = state;
        for (const [name, element] of boxes) element.classList.toggle("current", name === state);
      }
      held = holds;
      data.arrows.forEach((arrow, place) => {
        const from = arrow.from === state;
        arrows[place]!.element.classList.toggle("from-here", from);
        arrows[place]!.element.classList.toggle("open", from && arrow.terms.some((term) => term.conditions.every(({ atom, value }) => holds.has(atom) === value)));
      });
      tell();
    },
    taken(from, to) {
      const place = data.arrows.findIndex((arrow) => arrow.from === from && arrow.to === to);
      const element = arrows[place]?.element;
      if (!element) return;
      arrows.forEach((one) => one.element.classList.remove("taken"));
      // Begins anew, where it was just taken.
      void element.getBoundingClientRect();
      element.classList.add("taken");
    },
  };
}

function box(name: string, light: string): SVGGElement {
  const [x, y] = PLACES[name] ?? [0, 0];
  return svg("g", { class: `state ${lightClass(light)}` },
    svg("rect", { x: x - BOX.width / 2, y: y - BOX.height / 2, width: BOX.width, height: BOX.height, rx: 9 }),
    svg("text", { x, y: y - 3 }, name),
    svg("text", { x, y: y + 15, class: "small" }, light === "off" ? "dark" : light));
}

/** A point on the edge of a box, on the way from its middle to another point. */
function edge([x, y]: [number, number], [toX, toY]: [number, number]): [number, number] {
  const [dx, dy] = [toX - x, toY - y];
  const share = Math.min(BOX.width / 2 / Math.max(Math.abs(dx), 0.01), BOX.height / 2 / Math.max(Math.abs(dy), 0.01));
  return [x + dx * Math.min(share, 1), y + dy * Math.min(share, 1)];
}

function draw(arrow: Arrow, all: Arrow[], choose: () => void): { element: SVGGElement; length: number } {
  const from = PLACES[arrow.from] ?? [0, 0];
  const to = PLACES[arrow.to] ?? [0, 0];
  const alike = all.filter((one) => one.from === arrow.from && one.to === arrow.to);
  const back = all.some((one) => one.from === arrow.to && one.to === arrow.from);
  const [dx, dy] = [to[0] - from[0], to[1] - from[1]];
  const length = Math.hypot(dx, dy) || 1;
  // What would lie on the line of another, or go through a box, is bent to its side.
  const through = Object.entries(PLACES).some(([name, [x, y]]) => {
    if (name === arrow.from || name === arrow.to) return false;
    const along = ((x - from[0]) * dx + (y - from[1]) * dy) / length;
    const beside = Math.abs((x - from[0]) * dy - (y - from[1]) * dx) / length;
    return along > 0 && along < length && beside < BOX.height / 2;
  });
  const bend = (back ? 22 : 0) + (through ? 130 : 0) + alike.indexOf(arrow) * 24;
  const middle: [number, number] = [(from[0] + to[0]) / 2 - (dy / length) * bend * 1.6, (from[1] + to[1]) / 2 + (dx / length) * bend * 1.6];
  const [a, b] = [edge(from, middle), edge(to, middle)];
  const path = `M${a[0]} ${a[1]} Q${middle[0]} ${middle[1]} ${b[0]} ${b[1]}`;
  // Where a long arrow crosses others its number would stand on theirs.
  const share = length > 400 ? 0.28 : 0.5;
  const at = (place: 0 | 1) => (1 - share) ** 2 * a[place] + 2 * share * (1 - share) * middle[place] + share ** 2 * b[place];
  const label: [number, number] = [at(0), at(1)];
  const text = arrow.terms.map((term) => term.conditions.map((one) => one.text).join(" and ")).join("; or ");
  const element = svg("g", { class: "arrow", tabindex: 0, role: "button", "aria-pressed": "false", "aria-label": `${arrow.from} to ${arrow.to}, section ${arrow.section}`, "data-arrow": `${arrow.from}-${arrow.to}` },
    svg("title", {}, `${arrow.from} → ${arrow.to} (${arrow.section}): ${text}`),
    svg("path", { d: path, class: "wide" }), svg("path", { d: path, class: "line" }),
    svg("rect", { x: label[0] - 17, y: label[1] - 10, width: 34, height: 20, rx: 5 }),
    svg("text", { x: label[0], y: label[1] + 4 }, arrow.section));
  element.addEventListener("click", choose);
  element.addEventListener("keydown", (event) => {
    if (event.key !== "Enter" && event.key !== " ") return;
    event.preventDefault();
    choose();
  });
  return { element, length };
}

/** An arrow with each alternative of its guard, and which of its conditions hold now. */
function words(arrow: Arrow, holds: Set<string>): HTMLElement {
  const terms = arrow.terms.map((term) => h("ul", { class: "plain" }, ...term.conditions.map(({ atom, value, text }) => {
    const fits = holds.has(atom) === value;
    return h("li", { class: fits ? "true" : "false" }, h("span", { "aria-hidden": "true" }, fits ? SIGNS.good : SIGNS.bad),
      h("span", { class: "hidden" }, fits ? "holds: " : "does not hold: "), ` ${text}`);
  })));
  const joined = terms.flatMap((term, place) => (place === 0 ? [term] : [h("p", { class: "or" }, "or"), term]));
  return h("details", { open: true }, h("summary", {}, `→ ${arrow.to} (${arrow.section})`), ...joined);
}
