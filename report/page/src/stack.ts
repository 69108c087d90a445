// The lanes and plots as one: a pointer anywhere in them moves the cursor, drags out a stretch or pans, and keys do as well.

import { RIGHT, left, time, x } from "./axis";
import type { Data } from "./data";
import { h, seconds } from "./dom";
import type { Lanes } from "./lanes";
import type { View } from "./view";

/** A drag that is shorter is a click. */
const CLICK = 5;

export function stack(
  data: Data, view: View, lanes: Lanes, plots: HTMLElement[], say: (t: number) => string, open: (finding: number) => void,
): HTMLElement {
  const line = h("div", { class: "cursor", hidden: true });
  const chosen = h("div", { class: "chosen", hidden: true });
  // Who does not see the lanes hears the time and the state.
  const slider = lanes.element;
  for (const [name, value] of Object.entries({
    tabindex: "0",
    role: "slider",
    "aria-label": "Time under the cursor",
    "aria-describedby": "keys",
    "aria-valuemin": "0",
    "aria-valuemax": seconds(data.end),
    "aria-valuenow": "0",
    "aria-valuetext": "no cursor",
  })) slider.setAttribute(name, value);
  const all = h("div", { class: "stack" }, slider, ...plots, chosen, line);

  view.on(() => {
    const t = view.cursor;
    const inside = t !== null && t >= view.from && t <= view.to;
    line.hidden = !inside;
    if (t === null) return;
    line.style.transform = `translateX(${x(view, t, all.clientWidth)}px)`;
    slider.setAttribute("aria-valuenow", seconds(t));
    slider.setAttribute("aria-valuetext", say(t));
  });

  const place = (event: PointerEvent | WheelEvent) => event.clientX - all.getBoundingClientRect().left;
  const inside = (event: PointerEvent | WheelEvent) => place(event) >= left() && place(event) <= all.clientWidth - RIGHT;
  const at = (where: number) => time(view, where, all.clientWidth);

  pointers(all, view, { place, inside, at }, chosen, (event) => {
    const top = event.clientY - lanes.element.getBoundingClientRect().top;
    const finding = lanes.findingAt(place(event), top);
    if (finding !== undefined) open(finding);
  });
  all.addEventListener("wheel", (event) => {
    if (event.ctrlKey || event.metaKey) {
      event.preventDefault();
      view.zoom(1.002 ** event.deltaY, at(place(event)));
    } else if (event.shiftKey || Math.abs(event.deltaX) > Math.abs(event.deltaY)) {
      event.preventDefault();
      view.pan((event.deltaX || event.deltaY) / all.clientWidth);
    }
  }, { passive: false });
  all.addEventListener("dblclick", () => view.show(0, view.end));
  return all;
}

interface Places {
  place(event: PointerEvent): number;
  inside(event: PointerEvent): boolean;
  at(place: number): number;
}

/** A mouse drags out what to look at, and pans with Shift; one finger pans, two zoom. */
function pointers(all: HTMLElement, view: View, places: Places, chosen: HTMLElement, click: (event: PointerEvent) => void): void {
  const down = new Map<number, PointerEvent>();
  let begun: PointerEvent | undefined;
  const choose = (from: number, to: number) => {
    chosen.hidden = false;
    chosen.style.left = `${Math.min(from, to)}px`;
    chosen.style.width = `${Math.abs(to - from)}px`;
  };
  all.addEventListener("pointerdown", (event) => {
    if (!places.inside(event) || event.button !== 0 || (event.target as Element).closest("button")) return;
    down.set(event.pointerId, event);
    begun = down.size === 1 ? event : undefined;
    if (event.pointerType === "mouse") all.setPointerCapture(event.pointerId);
  });
  all.addEventListener("pointermove", (event) => {
    const before = down.get(event.pointerId);
    if (!before) {
      if (event.pointerType === "mouse" && places.inside(event)) view.at(places.at(places.place(event)));
      return;
    }
    const [now, then] = [places.place(event), places.place(before)];
    if (down.size === 2) {
      const other = [...down.values()].find((one) => one.pointerId !== event.pointerId)!;
      const fixed = places.place(other);
      const factor = Math.abs(then - fixed) / Math.max(Math.abs(now - fixed), 10);
      if (Number.isFinite(factor) && factor > 0) view.zoom(factor, places.at(fixed));
    } else if (event.pointerType !== "mouse" || event.shiftKey) {
      view.show(view.from + places.at(then) - places.at(now), view.to + places.at(then) - places.at(now));
    } else if (begun) {
      view.at(places.at(now));
      choose(places.place(begun), now);
      return;
    }
    down.set(event.pointerId, event);
  });
  const up = (event: PointerEvent) => {
    chosen.hidden = true;
    const was = down.delete(event.pointerId);
    const first = begun;
    begun = undefined;
    if (!was || !first || event.type === "pointercancel") return;
    const [from, to] = [places.place(first), places.place(event)];
    if (Math.abs(from - to) < CLICK) {
      view.at(places.at(to));
      click(event);
    } else if (event.pointerType === "mouse" && !event.shiftKey) {
      view.show(places.at(Math.min(from, to)), places.at(Math.max(from, to)));
    }
  };
  all.addEventListener("pointerup", up);
  all.addEventListener("pointercancel", up);
}
