// What the pages of outcomes have in common: the top, lists that filter, requirements with their sentences.

import { h, section, sign } from "../dom";
import type { Data } from "./data";

type Part = HTMLElement | null | undefined | false;

/** The whole page. */
export function page(data: Data, ...sections: Part[]): HTMLElement[] {
  document.title = `${data.title}: ${data.verdict}`;
  return [
    h("header", {}, h("h1", {}, data.title), ...data.about.map((line) => h("p", { class: "about" }, line))),
    h("main", {},
      h("section", { id: "verdict", "aria-labelledby": "verdict-title" },
        h("div", { class: `verdict ${data.mood}` },
          h("h2", { id: "verdict-title" }, sign(data.mood), data.verdict),
          h("p", {}, h("strong", {}, "Next: "), data.next))),
      ...sections.filter((one) => one instanceof HTMLElement)),
    h("footer", {}, `Made by adsdv ${data.version}. This file holds all that --json prints, and asks for nothing else.`),
  ];
}

/** Requirements with their sentences. */
export function sentences(data: Data, ids: string[]): HTMLElement {
  return h("ul", { class: "requirements" }, ...ids.map((id) => h("li", {}, h("strong", {}, id), ` ${data.requirements[id] ?? ""}`)));
}

/** A list of terms; what has nothing to say is left out. */
export function terms(...list: [string, string | HTMLElement | null | undefined | false][]): HTMLElement {
  return h("dl", {}, ...list.flatMap(([term, what]) => (what ? [h("dt", {}, term), h("dd", {}, what)] : [])));
}

/** Text that is there to be copied. */
export function copied(title: string, text: string): HTMLElement {
  return h("details", { class: "copied" }, h("summary", {}, title), h("pre", { tabindex: 0, "aria-label": title }, text));
}

/** Something that a list shows or not. */
export interface Item {
  /** All that goes with it. */
  elements: HTMLElement[];
  /** What it is found by. */
  text: string;
  kind: string;
  show?: (fits: boolean) => void;
}

/** Kinds of items: a name with its sign, and whether they are shown at first. */
export type Kind = [kind: string, title: string, shown: boolean];

/** A section with what filters its items, by words and by kinds. */
export function filtered(id: string, title: string, noun: string, kinds: Kind[], items: Item[], list: HTMLElement, ...before: Part[]): HTMLElement {
  const text = h("input", { type: "search", id: `${id}-filter`, autocomplete: "off", input: () => filter() });
  const there = kinds.filter(([kind]) => items.some((item) => item.kind === kind));
  const all = !there.some(([, , shown]) => shown);
  const boxes = there.map(([kind, name, shown]) => {
    const box = h("input", { type: "checkbox", "data-kind": kind, checked: shown || all, change: () => filter() });
    return { kind, box, label: h("label", {}, box, ` ${name} (${items.filter((item) => item.kind === kind).length})`) };
  });
  const status = h("p", { role: "status", class: "quiet" });
  const filter = () => {
    const words = text.value.toLowerCase().split(/\s+/).filter(Boolean);
    let left = 0;
    for (const item of items) {
      const of = item.text.toLowerCase();
      const fits = words.every((word) => of.includes(word)) && (boxes.find(({ kind }) => kind === item.kind)?.box.checked ?? true);
      if (item.show) item.show(fits);
      else for (const element of item.elements) element.hidden = !fits;
      if (fits) left++;
    }
    status.textContent = `${left} of ${items.length} ${noun} shown`;
  };
  filter();
  return section(id, title, ...before,
    items.length > 1 && h("form", { class: "filters", submit: (event) => event.preventDefault() },
      h("label", { for: text.id }, "Filter"), text, ...(boxes.length > 1 ? boxes.map(({ label }) => label) : [])),
    items.length > 1 && status, list);
}

/** A table whose rows are items; a row with `detail` opens. */
export function rows(caption: string, head: string[], items: Item[]): HTMLElement {
  return h("div", { class: "scroll", tabindex: 0, role: "region", "aria-label": `${caption}, a table` },
    h("table", {}, h("caption", { class: "hidden" }, caption),
      h("thead", {}, h("tr", {}, ...head.map((title) => h("th", { scope: "col" }, title)))),
      h("tbody", {}, ...items.flatMap((item) => item.elements))));
}

/** A row that opens with what is behind it. */
export function opening(id: string, kind: string, text: string, label: string, cells: (string | HTMLElement)[], detail: () => HTMLElement): Item {
  const inside = h("td", { colspan: cells.length + 1 });
  const below = h("tr", { id: `${id}-detail`, class: "detail", hidden: true }, inside);
  const button: HTMLButtonElement = h("button", { type: "button", class: "open", "aria-expanded": "false", "aria-controls": below.id, click: () => {
    const open = button.getAttribute("aria-expanded") !== "true";
    if (open && inside.childElementCount === 0) inside.append(h("div", { class: "opened" }, detail()));
    below.hidden = !open;
    button.setAttribute("aria-expanded", String(open));
  } }, label);
  const line = h("tr", { id, class: kind }, h("td", {}, button), ...cells.map((cell) => h("td", {}, cell)));
  return {
    elements: [line, below],
    text,
    kind,
    show(fits) {
      line.hidden = !fits;
      below.hidden = !fits || button.getAttribute("aria-expanded") !== "true";
    },
  };
}

/** A row that is all there is. */
export function plain(kind: string, text: string, cells: (string | HTMLElement)[]): Item {
  return { elements: [h("tr", { class: kind }, ...cells.map((cell) => h("td", {}, cell)))], text, kind };
}
