// Figure 2 as a program does it: the document's, with what differs marked by a sign, a line of its own and words.

import { SIGNS, h, section } from "../dom";
import { type Picture, drawn } from "../figure";
import type { OwnArrow } from "./data";

type Mark = "usual" | "differs" | "added" | "missing" | "not-shown";

const MARKS: Record<Mark, { sign: string; word: string; legend: string }> = {
  usual: { sign: "", word: "as in the document", legend: "as in the document: a thin line" },
  differs: { sign: "≠", word: "differs", legend: "≠ differs: a thick line" },
  added: { sign: "+", word: "not in the document", legend: "+ not in the document: a thick line of long dashes" },
  missing: { sign: SIGNS.bad, word: "missing", legend: `${SIGNS.bad} missing: a dashed line` },
  "not-shown": { sign: SIGNS.unknown, word: "not shown", legend: `${SIGNS.unknown} nothing is known of it: a dotted line` },
};

export function mark(arrow: OwnArrow): Mark {
  if (arrow.missing) return "missing";
  if (arrow.section === null) return "added";
  if (arrow.otherwise.length > 0) return "differs";
  return arrow.not_shown ? "not-shown" : "usual";
}

export function ownFigure(picture: Picture, arrows: OwnArrow[]): HTMLElement {
  const panel = h("div", { class: "guard", id: "guard" });
  const differing = arrows.filter((arrow) => !["usual", "not-shown"].includes(mark(arrow)));
  let chosen: OwnArrow | undefined;
  const looks = arrows.map((arrow) => {
    const { sign, word } = MARKS[mark(arrow)];
    const section = arrow.section === null ? "" : `, section ${arrow.section}`;
    return {
      from: arrow.from,
      to: arrow.to,
      label: [sign, arrow.section ?? "new"].filter(Boolean).join(" "),
      name: `${arrow.from} to ${arrow.to}${section}: ${word}`,
      title: [`${arrow.from} → ${arrow.to}${section}: ${word}`, ...arrow.otherwise].join("; "),
      class: mark(arrow),
    };
  });
  const show = () => panel.replaceChildren(...(chosen ? [chosen] : differing).map(words),
    ...(chosen || differing.length > 0 ? [] : [h("p", {}, `${SIGNS.good} Every arrow is as in the document.`)]),
    ...(chosen ? [h("button", { type: "button", click: () => {
      chosen = undefined;
      figure.choose(undefined);
      show();
    } }, "all that differ")] : []));
  const figure = drawn(picture, looks, "Figure 2 as the program does it", (which) => {
    chosen = chosen === arrows[which] ? undefined : arrows[which];
    figure.choose(chosen && which);
    show();
  });
  show();
  const marks = [...new Set(arrows.map(mark))];
  return section("figure2", "Figure 2 as the program does it",
    h("p", { class: "quiet" }, "A click on an arrow, or Enter, shows its guard."),
    h("div", { class: "figure" },
      h("div", {}, figure.picture, h("ul", { class: "legend", "aria-label": "Legend" }, ...marks.map((one) => h("li", { "data-mark": one }, MARKS[one].legend)))),
      panel));
}

function words(arrow: OwnArrow): HTMLElement {
  const { sign, word } = MARKS[mark(arrow)];
  return h("div", { class: "own" },
    h("h3", {}, `${sign ? `${sign} ` : ""}${arrow.from} → ${arrow.to}${arrow.section ? ` (${arrow.section})` : ""}`),
    h("p", { class: mark(arrow) === "usual" ? "quiet" : "past" }, word),
    ...arrow.otherwise.map((text) => h("p", {}, text)),
    arrow.guard.length > 0 && !arrow.missing && h("p", { class: "quiet" }, "Its guard:"),
    !arrow.missing && h("ul", { class: "guards" }, ...arrow.guard.map((text, place) => h("li", {}, `${place > 0 ? "or " : ""}${text}`))));
}
