// Where a time stands on the screen: the same in every lane and plot.

import { color } from "./theme";
import type { View } from "./view";

/** Room at the right edge. */
export const RIGHT = 14;
/** Room for the numbers of a plot. */
export const NUMBERS = 48;

/** The left edge of what is drawn, in the coordinates of the stack: behind the names and the numbers. */
export function left(): number {
  return gutter() + NUMBERS;
}

/** Room for names beside what is drawn; none on a narrow screen, where they stand above. */
export function gutter(): number {
  return Number.parseFloat(color("gutter")) || 0;
}

/** The horizontal place of a time. */
export function x(view: View, t: number, width: number): number {
  const begin = left();
  return begin + ((t - view.from) / (view.to - view.from)) * (width - begin - RIGHT);
}

/** The time at a horizontal place. */
export function time(view: View, place: number, width: number): number {
  const begin = left();
  return view.from + ((place - begin) / (width - begin - RIGHT)) * (view.to - view.from);
}
