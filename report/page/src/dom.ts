// Elements. Whatever is shown is text, never markup: nothing here reads HTML.

type Child = Node | string | null | undefined | false;
type Attributes = Record<string, string | number | boolean | null | undefined | ((event: Event) => void)>;

/** An element with attributes and children. A function is a listener. */
export function h<K extends keyof HTMLElementTagNameMap>(
  name: K,
  attributes: Attributes = {},
  ...children: Child[]
): HTMLElementTagNameMap[K] {
  const element = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) {
    if (typeof value === "function") element.addEventListener(key, value);
    else if (value === true) element.setAttribute(key, "");
    else if (value !== false && value !== null && value !== undefined) element.setAttribute(key, String(value));
  }
  for (const child of children) if (child) element.append(child);
  return element;
}

/** A section with a heading that links to it. */
export function section(id: string, title: string, ...children: Child[]): HTMLElement {
  return h("section", { id, "aria-labelledby": `${id}-title` }, h("h2", { id: `${id}-title` }, title), ...children);
}

/** A table with a head. */
export function table(caption: string, head: string[], rows: Child[][]): HTMLElement {
  const cell = (content: Child) => h("td", {}, content);
  return h("div", { class: "scroll", tabindex: 0, role: "region", "aria-label": `${caption}, a table` },
    h("table", {},
      h("caption", { class: "hidden" }, caption),
      h("thead", {}, h("tr", {}, ...head.map((title) => h("th", { scope: "col" }, title)))),
      h("tbody", {}, ...rows.map((row) => h("tr", {}, ...row.map(cell))))));
}

/** Microseconds as seconds with three decimals. */
export function seconds(us: number): string {
  return (Math.round(us / 1000) / 1000).toFixed(3);
}

/** A number with as many decimals as mean something. */
export function number(value: number, decimals = 2): string {
  return String(Number(value.toFixed(decimals)));
}

/** A number and its noun. */
export function counted(count: number, noun: string): string {
  return `${count.toLocaleString("en")} ${noun}${count === 1 ? "" : "s"}`;
}

const MOODS = { good: "good", care: "worth a look", bad: "not as it should be", unknown: "not known" } as const;

/** The sign of a mood, with its meaning. */
export function sign(mood: keyof typeof MOODS): HTMLElement {
  return h("span", { class: "sign", title: MOODS[mood] },
    h("span", { "aria-hidden": "true" }, SIGNS[mood]), h("span", { class: "hidden" }, `${MOODS[mood]}: `));
}

/** What stands before a word, so that color is not all that tells. */
export const SIGNS = { good: "✓", care: "!", bad: "✗", unknown: "?", violation: "▲", warning: "◆", note: "●" } as const;
