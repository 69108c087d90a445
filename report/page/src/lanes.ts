// The timeline: a canvas with a ruler, the marks of the findings, and a lane for each row.

import { RIGHT, gutter, left, x } from "./axis";
import type { Data, Severity } from "./data";
import { SIGNS, h, seconds } from "./dom";
import type { Look, Row, Span } from "./spans";
import { color, stripes } from "./theme";
import type { View } from "./view";

const RULER = 22;
const MARKS = 26;
const LANE = 18;
const BETWEEN = 3;
/** A name above its lane, where there is no room beside it. */
const NAME = 14;
const FONT = "11px system-ui, sans-serif";
const FONT_BOLD = "600 11px system-ui, sans-serif";

export interface Lanes {
  element: HTMLElement;
  /** Colors or the room have changed. */
  restyle(): void;
  /** The finding whose mark is there. */
  findingAt(place: number, height: number): number | undefined;
}

/** How a span is filled, and what is written in it. */
type Fills = Record<Look, [CanvasPattern | string, string]>;

function fills(context: CanvasRenderingContext2D): Fills {
  const [ink, paper, quiet] = [color("ink"), color("paper"), color("quiet")];
  const [yellow, blue] = [color("yellow"), color("blue")];
  return {
    dark: [color("dark-light"), color("on-dark-light")],
    yellow: [yellow, color("on-yellow")],
    "yellow-flashing": [stripes(context, yellow, "#fff3b0", 9), color("on-yellow")],
    blue: [blue, color("on-blue")],
    "blue-flashing": [stripes(context, blue, "#12307a", 9), color("on-blue")],
    off: [color("faint"), quiet],
    on: [color("on"), color("on-on")],
    bad: [color("bad"), color("on-bad")],
    unknown: [stripes(context, paper, color("edge"), 7), ink],
    several: [stripes(context, color("faint"), color("edge"), 4), ink],
    true: [color("true"), color("on-true")],
    false: [color("false"), color("on-false")],
    gap: [stripes(context, paper, color("bad"), 5), ink],
  };
}

/** What stripes are where there is no room for them. */
const PLAIN: Partial<Record<Look, string>> = {
  "yellow-flashing": "yellow", "blue-flashing": "blue", unknown: "edge", several: "edge", gap: "bad",
};

/** A step of the ruler that leaves room for its numbers. */
function step(width: number, pixels: number): number {
  const least = (width / Math.max(pixels, 1)) * 80;
  let unit = 1;
  while (unit * 10 < least) unit *= 10;
  return [1, 2, 5, 10].map((one) => one * unit).find((one) => one >= least) ?? unit * 10;
}

export function lanes(data: Data, view: View, all: Row[]): Lanes {
  const canvas = h("canvas", { "aria-hidden": "true" });
  const element = h("div", { class: "lanes" }, canvas);
  const findings = data.check.findings.map((finding, place) => ({ ...finding, place, at: finding.t * 1e6 }));
  const marks: { place: number; x: number; wide: number }[] = [];
  let looks: Fills | undefined;

  const draw = () => {
    const context = canvas.getContext("2d");
    if (!context) return;
    const width = element.clientWidth;
    const above = gutter() === 0;
    const lane = LANE + (above ? NAME : 0) + BETWEEN;
    const height = RULER + MARKS + all.length * lane;
    const scale = devicePixelRatio || 1;
    if (canvas.width !== Math.round(width * scale) || canvas.height !== Math.round(height * scale)) {
      canvas.width = Math.round(width * scale);
      canvas.height = Math.round(height * scale);
      canvas.style.height = `${height}px`;
    }
    context.setTransform(scale, 0, 0, scale, 0, 0);
    context.clearRect(0, 0, width, height);
    context.font = FONT;
    context.textBaseline = "middle";
    const begin = left();
    const end = width - RIGHT;
    ruler(context, width, height, begin, end);
    name(context, "Findings", 0, above ? RULER + 2 : RULER + MARKS / 2, above);
    drawMarks(context, width, end);
    looks ??= fills(context);
    all.forEach((row, index) => {
      const top = RULER + MARKS + index * lane;
      name(context, row.title, 0, above ? top + NAME / 2 : top + LANE / 2, above);
      drawRow(context, row, looks!, above ? top + NAME : top, width, begin, end);
    });
  };

  const name = (context: CanvasRenderingContext2D, text: string, at: number, middle: number, above: boolean) => {
    context.fillStyle = color("ink");
    context.textAlign = "left";
    context.font = FONT;
    context.fillText(fitted(context, text, (above ? 300 : left()) - 8), at + 2, middle);
  };

  const ruler = (context: CanvasRenderingContext2D, width: number, height: number, begin: number, end: number) => {
    const by = step(view.to - view.from, end - begin);
    context.strokeStyle = color("grid");
    context.fillStyle = color("quiet");
    context.textAlign = "center";
    context.lineWidth = 1;
    const decimals = by >= 1e6 ? 0 : by >= 1e5 ? 1 : by >= 1e4 ? 2 : by >= 1e3 ? 3 : 6;
    for (let t = Math.ceil(view.from / by) * by; t <= view.to; t += by) {
      const at = Math.round(x(view, t, width)) + 0.5;
      context.beginPath();
      context.moveTo(at, RULER - 4);
      context.lineTo(at, height);
      context.stroke();
      context.fillText(`${(t / 1e6).toFixed(decimals)} s`, Math.min(at, end - 14), RULER / 2 - 1);
    }
  };

  const drawMarks = (context: CanvasRenderingContext2D, width: number, end: number) => {
    marks.length = 0;
    const order: Severity[] = ["note", "warning", "violation"];
    const sorted = findings.toSorted((a, b) => order.indexOf(a.severity) - order.indexOf(b.severity));
    let free = -Infinity;
    let drawn: [Severity | undefined, number] = [undefined, -Infinity];
    const labels: [string, number, Severity][] = [];
    context.font = FONT_BOLD;
    context.textAlign = "center";
    for (const finding of sorted) {
      if (finding.at < view.from || finding.at > view.to) continue;
      const at = x(view, finding.at, width);
      marks.push({ place: finding.place, x: at, wide: 9 });
      // Of marks on one place one is drawn.
      if (drawn[0] === finding.severity && at - drawn[1] < 2) continue;
      drawn = [finding.severity, at];
      context.fillStyle = color(`mark-${finding.severity}`);
      context.fillText(SIGNS[finding.severity], at, RULER + MARKS / 2 + (gutter() === 0 ? 5 : 0));
      if (finding.severity !== "note") labels.push([`${finding.party} ${finding.section}`, at, finding.severity]);
    }
    context.textAlign = "left";
    context.font = FONT;
    for (const [text, at, severity] of labels.toSorted((a, b) => a[1] - b[1])) {
      const wide = context.measureText(text).width;
      const begins = Math.max(at + 8, free);
      if (begins > at + 60 || begins + wide > end) continue;
      context.fillStyle = color(`mark-${severity}`);
      context.fillText(text, begins, RULER + MARKS / 2 + (gutter() === 0 ? 5 : 0));
      free = begins + wide + 12;
    }
  };

  const drawRow = (
    context: CanvasRenderingContext2D, row: Row, looks: Fills, top: number, width: number, begin: number, end: number,
  ) => {
    context.font = row.id === "states" ? FONT_BOLD : FONT;
    context.textAlign = "left";
    // What is narrower than a pixel is drawn once a pixel.
    let drawn = -Infinity;
    for (const span of visible(row.spans, view)) {
      const from = Math.max(x(view, span.from, width), begin);
      const to = Math.min(x(view, span.to, width), end);
      if (to < drawn + 0.5) continue;
      const wide = Math.max(to - from, 1.5);
      const [fill, text] = looks[span.look];
      const plain = wide < 5 ? PLAIN[span.look] : undefined;
      context.fillStyle = plain ? color(plain) : fill;
      context.fillRect(from, top, wide, LANE);
      if (wide > 3 && (span.look === "unknown" || span.look === "true" || span.look === "false" || span.look === "several")) {
        context.strokeStyle = color("edge");
        context.strokeRect(from + 0.5, top + 0.5, Math.max(wide - 1, 0.5), LANE - 1);
      }
      drawn = to;
      if (wide < 14) continue;
      const shown = fitted(context, span.word, wide - 6);
      if (span.look !== "dark" && typeof fill !== "string") halo(context, shown, from + 4, top + LANE / 2, span.look);
      context.fillStyle = text;
      context.fillText(shown, from + 4, top + LANE / 2);
    }
  };

  /** Text on stripes stands on a plain ground. */
  const halo = (context: CanvasRenderingContext2D, text: string, at: number, middle: number, look: Look) => {
    context.fillStyle = look === "yellow-flashing" ? color("yellow") : look === "blue-flashing" ? color("blue") : color("paper");
    context.fillRect(at - 2, middle - 7, context.measureText(text).width + 4, 14);
  };

  view.on((changed) => changed === "range" && draw());
  new ResizeObserver(() => view.redraw()).observe(element);
  return {
    element,
    restyle() {
      looks = undefined;
      draw();
    },
    findingAt(place, height) {
      if (height < RULER || height > RULER + MARKS) return undefined;
      return marks.findLast((mark) => Math.abs(mark.x - place) <= mark.wide)?.place;
    },
  };
}

function visible(spans: Span[], view: View): Span[] {
  return spans.filter((span) => span.to >= view.from && span.from <= view.to);
}

const fits = new Map<string, string>();

/** As much of a text as fits. */
function fitted(context: CanvasRenderingContext2D, text: string, width: number): string {
  // Whole pixels are enough, and many spans say the same.
  const key = `${context.font} ${Math.floor(width)} ${text}`;
  let found = fits.get(key);
  if (found === undefined) {
    if (fits.size > 20_000) fits.clear();
    found = cut(context, text, Math.floor(width));
    fits.set(key, found);
  }
  return found;
}

function cut(context: CanvasRenderingContext2D, text: string, width: number): string {
  if (context.measureText(text).width <= width) return text;
  let from = 0;
  let to = text.length;
  while (from < to) {
    const middle = (from + to + 1) >>> 1;
    if (context.measureText(`${text.slice(0, middle)}…`).width <= width) from = middle;
    else to = middle - 1;
  }
  return from === 0 ? (text.length > 0 ? text.slice(0, 1) : "") : `${text.slice(0, from)}…`;
}

/** The rows and the cursor in words, for who does not see them. */
export function said(all: Row[], t: number, at: (row: Row, t: number) => Span | undefined): string {
  const state = all[0] && at(all[0], t)?.word;
  return `${seconds(t)} s${state ? `, ${state}` : ""}`;
}
