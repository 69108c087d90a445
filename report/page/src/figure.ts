// Figure 2 as a picture: its states with their lights, and arrows that can be chosen. Where they are drawn is data, made by
// spec/src/export/places.rs.

export interface Picture {
  size: [number, number];
  box: [number, number];
  states: { name: string; light: string; x: number; y: number }[];
  lines: { path: string; label: [number, number]; length: number }[];
}

/** What stands at an arrow. */
export interface Look {
  from: string;
  to: string;
  /** In a few letters. */
  label: string;
  /** For who cannot see it. */
  name: string;
  /** Where the pointer rests on it. */
  title: string;
  class?: string;
}

export interface Drawn {
  picture: HTMLElement;
  /** In their order. */
  arrows: SVGGElement[];
  boxes: Map<string, SVGGElement>;
  /** Marks an arrow as chosen, and no other. */
  choose(which: number | undefined): void;
}

const SVG = "http://www.w3.org/2000/svg";
const HEADS = ["", "-open", "-taken", "-bad"];

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

/** Draws it; a click on an arrow tells which. */
export function drawn(picture: Picture, looks: Look[], label: string, chosen: (which: number) => void): Drawn {
  const arrows = picture.lines.map((line, which) => arrow(line, which, looks[which]!, () => chosen(which)));
  const boxes = new Map(picture.states.map((state) => [state.name, box(state, picture.box)]));
  const order = picture.lines.map((line, which) => ({ line, which })).sort((a, b) => b.line.length - a.line.length);
  const [width, height] = picture.size;
  const element = svg("svg", { viewBox: `0 0 ${width} ${height}`, class: "figure2", role: "group", "aria-label": label },
    svg("defs", {}, ...HEADS.map((kind) => svg("marker", { id: `head${kind}`, class: `head${kind}`, viewBox: "0 0 10 10", refX: 9, refY: 5, markerWidth: 7, markerHeight: 7, orient: "auto-start-reverse" }, svg("path", { d: "M0 0 L10 5 L0 10 z" })))),
    // The longest lie below, and all labels once more above all lines, so that no line goes through that of another.
    ...order.map(({ which }) => arrows[which]!),
    ...arrows.map((_, which) => svg("use", { href: `#label-${which}`, class: "above", "aria-hidden": "true" })), ...boxes.values());
  const holder = document.createElement("div");
  holder.className = "picture";
  holder.append(element);
  return {
    picture: holder,
    arrows,
    boxes,
    choose: (which) => arrows.forEach((one, place) => one.setAttribute("aria-pressed", String(place === which))),
  };
}

function box({ name, light, x, y }: Picture["states"][number], [width, height]: [number, number]): SVGGElement {
  return svg("g", { class: `state ${lightClass(light)}` },
    svg("rect", { x: x - width / 2, y: y - height / 2, width, height, rx: 9 }),
    svg("text", { x, y: y - 3 }, name),
    svg("text", { x, y: y + 15, class: "small" }, light === "off" ? "dark" : light));
}

function arrow({ path, label: [x, y] }: Picture["lines"][number], which: number, look: Look, chosen: () => void): SVGGElement {
  const width = Math.max(34, look.label.length * 7 + 12);
  const element = svg("g", { class: `arrow ${look.class ?? ""}`.trim(), tabindex: 0, role: "button", "aria-pressed": "false", "aria-label": look.name, "data-arrow": `${look.from}-${look.to}` },
    svg("title", {}, look.title),
    svg("path", { d: path, class: "wide" }), svg("path", { d: path, class: "line" }),
    svg("g", { id: `label-${which}` },
      svg("rect", { x: x - width / 2, y: y - 10, width, height: 20, rx: 5 }),
      svg("text", { x, y: y + 4 }, look.label)));
  element.addEventListener("click", chosen);
  element.addEventListener("keydown", (event) => {
    if (event.key !== "Enter" && event.key !== " ") return;
    event.preventDefault();
    chosen();
  });
  return element;
}
