// The keyboard: in the timeline arrows move the cursor, and everywhere a few letters do.

import { h } from "./dom";
import type { View } from "./view";

export const HELP: [string, string][] = [
  ["← →", "move the cursor; with Shift further"],
  ["+ −", "zoom in and out around the cursor"],
  ["< >", "earlier, later"],
  ["0", "the whole recording"],
  ["n p", "the next finding, the one before"],
  ["/", "filter the findings"],
];

/** What the keys do, for who looks and for who listens. */
export function help(): HTMLElement {
  return h("p", { id: "keys", class: "quiet keys" },
    ...HELP.flatMap(([keys, what]) => [h("kbd", {}, keys), ` ${what}; `]),
    "drag a stretch to look at it, double-click for all of it, Ctrl and the wheel zoom, Shift and drag pan");
}

export interface Acts {
  finding(step: 1 | -1): void;
}

export function keys(view: View, timeline: HTMLElement, signal: AbortSignal, acts: Acts): void {
  const move = (share: number) => {
    const from = view.cursor ?? view.from;
    view.at(from + (view.to - view.from) * share);
  };
  const inTimeline: Record<string, (shift: boolean) => void> = {
    ArrowLeft: (shift) => move(shift ? -0.05 : -0.002),
    ArrowRight: (shift) => move(shift ? 0.05 : 0.002),
    PageUp: () => view.pan(-0.8),
    PageDown: () => view.pan(0.8),
    Home: () => view.at(0),
    End: () => view.at(view.end),
  };
  const anywhere: Record<string, () => void> = {
    "+": () => view.zoom(0.5),
    "=": () => view.zoom(0.5),
    "-": () => view.zoom(2),
    "−": () => view.zoom(2),
    "<": () => view.pan(-0.25),
    ">": () => view.pan(0.25),
    "0": () => view.show(0, view.end),
    n: () => acts.finding(1),
    p: () => acts.finding(-1),
    "/": () => {
      const filter = document.getElementById("filter");
      filter?.scrollIntoView({ block: "center" });
      filter?.focus();
    },
  };
  addEventListener("keydown", (event) => {
    const target = event.target as HTMLElement;
    if (event.ctrlKey || event.metaKey || event.altKey || target.matches("input, select, textarea")) return;
    const act = (target === timeline ? inTimeline[event.key] : undefined) ?? anywhere[event.key];
    if (!act) return;
    event.preventDefault();
    act(event.shiftKey);
  }, { signal });
}
