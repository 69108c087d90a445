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
  /** Whether an arrow, by its place, has a class. */
  mark(which: number, name: string, on: boolean): void;
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
  const arrows = picture.lines.map((line, which) => arrow(line, looks[which]!, () => chosen(which)));
  const boxes = new Map(picture.states.map((state) => [state.name, box(state, picture.box)]));
  const order = picture.lines.map((line, which) => ({ line, which })).sort((a, b) => b.line.length - a.line.length);
  const [width, height] = picture.size;
  const element = svg("svg", { viewBox: `0 0 ${width} ${height}`, class: "figure2", role: "group", "aria-label": label },
    svg("defs", {}, ...HEADS.map((kind) => svg("marker", { id: `head${kind}`, class: `head${kind}`, viewBox: "0 0 10 10", refX: 9, refY: 5, markerWidth: 7, markerHeight: 7, orient: "auto-start-reverse" }, svg("path", { d: "M0 0 L10 5 L0 10 z" })))),
    // All lines lie below, the longest first, so that none goes through the label of another.
    ...order.map(({ which }) => arrows[which]!.line), ...arrows.map(({ label }) => label), ...boxes.values());
  const holder = document.createElement("div");
  holder.className = "picture";
  holder.append(element);
  return {
    picture: holder,
    mark(which, name, on) {
      const { line, label } = arrows[which]!;
      for (const part of [line, label]) {
        part.classList.remove(name);
        // Begins anew, where it was there.
        if (on) void part.getBoundingClientRect();
        part.classList.toggle(name, on);
      }
    },
    boxes,
    choose: (which) => arrows.forEach(({ label }, place) => label.setAttribute("aria-pressed", String(place === which))),
  };
}

function box({ name, light, x, y }: Picture["states"][number], [width, height]: [number, number]): SVGGElement {
  return svg("g", { class: `state ${lightClass(light)}` },
    svg("rect", { x: x - width / 2, y: y - height / 2, width, height, rx: 9 }),
    svg("text", { x, y: y - 3 }, name),
    svg("text", { x, y: y + 15, class: "small" }, light === "off" ? "dark" : light));
}

/** An arrow: its line, and what can be clicked, which has its label. */
function arrow({ path, label: [x, y] }: Picture["lines"][number], look: Look, chosen: () => void): { line: SVGGElement; label: SVGGElement } {
  const width = Math.max(34, look.label.length * 7 + 12);
  const kind = `arrow ${look.class ?? ""}`.trim();
  const label = svg("g", { class: kind, tabindex: 0, role: "button", "aria-pressed": "false", "aria-label": look.name, "data-arrow": `${look.from}-${look.to}` },
    svg("title", {}, look.title),
    svg("path", { d: path, class: "wide" }),
    svg("rect", { x: x - width / 2, y: y - 10, width, height: 20, rx: 5 }),
    svg("text", { x, y: y + 4 }, look.label));
  label.addEventListener("click", chosen);
  label.addEventListener("keydown", (event) => {
    if (event.key !== "Enter" && event.key !== " ") return;
    event.preventDefault();
    chosen();
  });
  return { line: svg("g", { class: kind, "data-line": `${look.from}-${look.to}` }, svg("path", { d: path, class: "line" })), label };
}
