// The plots: uPlot draws them, each with its lines and their values under the cursor beside it.

import uPlot from "uplot";

import { NUMBERS, RIGHT } from "./axis";
import type { Data, Plot } from "./data";
import { h, number } from "./dom";
import type { Store } from "./frames";
import type { Series } from "./series";
import { LINES, color } from "./theme";
import type { View } from "./view";

const HEIGHT = 130;
const DASHES = { request: [7, 4], actual: [], limit: [2, 3] };
const ROLES = { request: "asked for", actual: "measured", limit: "limit" };

/** A plot among the others. */
export class PlotView {
  readonly element: HTMLElement;
  private readonly frame: HTMLElement;
  private readonly values: HTMLOutputElement[];
  private readonly hidden = new Set<number>();
  private chart: uPlot | undefined;
  private seen = false;
  private stale = true;

  constructor(
    readonly plot: Plot,
    private readonly series: Series[],
    private readonly store: Store,
    private readonly view: View,
  ) {
    this.frame = h("div", { class: "plot-frame", role: "img", "aria-label": `${plot.title}; the values at the cursor stand beside it` });
    this.values = series.map(() => h("output", {}));
    const limits = plot.limits.map((limit) => `${limit.text}: ${number(limit.value)} ${plot.unit}`).join("; ");
    this.element = h("div", { class: "plot", id: `plot-${plot.id}` },
      h("div", { class: "legend" },
        h("h3", {}, `${plot.title}${plot.unit && `, ${plot.unit}`}`),
        limits && h("p", { class: "limits" }, limits),
        ...series.map((one, place) => this.legend(one, place))),
      this.frame);
    const near = new IntersectionObserver(([entry]) => {
      this.seen = entry?.isIntersecting ?? true;
      if (this.seen && this.stale) this.draw();
    }, { rootMargin: "100px" });
    near.observe(this.frame);
    new ResizeObserver(() => this.resize()).observe(this.frame);
    view.on((changed) => {
      if (changed === "range") this.refresh();
      this.said();
    });
  }

  /** The name of a line with its look and its value; a click hides and shows it. */
  private legend(one: Series, place: number): HTMLElement {
    const swatch = document.createElementNS("http://www.w3.org/2000/svg", "svg");
    swatch.setAttribute("viewBox", "0 0 24 8");
    swatch.setAttribute("aria-hidden", "true");
    const line = document.createElementNS("http://www.w3.org/2000/svg", "line");
    for (const [key, value] of [["x1", "0"], ["x2", "24"], ["y1", "4"], ["y2", "4"], ["stroke-width", "2.5"]] as const) {
      line.setAttribute(key, value);
    }
    line.setAttribute("stroke", `var(--${LINES[place % LINES.length]})`);
    line.setAttribute("stroke-dasharray", DASHES[one.line.role].join(" "));
    swatch.append(line);
    const empty = one.isEmpty();
    const button = h("button", {
      type: "button",
      class: "line",
      "aria-pressed": "true",
      title: `${ROLES[one.line.role]}; click to hide or show`,
      click: () => {
        const hide = !this.hidden.has(place);
        if (hide) this.hidden.add(place);
        else this.hidden.delete(place);
        button.setAttribute("aria-pressed", String(!hide));
        this.refresh();
      },
    }, swatch, h("span", { class: "label" }, `${one.line.label}${empty ? ": not recorded" : ""}`), this.values[place]);
    return button;
  }

  /** Colors or the room have changed. */
  restyle(now: boolean): void {
    this.chart?.destroy();
    this.chart = undefined;
    this.stale = true;
    if (now || this.seen) this.draw();
  }

  private refresh(): void {
    this.stale = true;
    if (this.seen) this.draw();
  }

  private resize(): void {
    const width = this.frame.clientWidth;
    if (this.chart && width > 0 && width !== this.chart.width) this.chart.setSize({ width, height: HEIGHT });
    this.refresh();
  }

  /** The values at the cursor. */
  private said(): void {
    const t = this.view.cursor;
    this.series.forEach((one, place) => {
      const value = t === null ? undefined : one.at(this.store, t);
      const text = value === undefined ? "" : number(value);
      const output = this.values[place]!;
      if (output.textContent !== text) output.textContent = text;
    });
  }

  private draw(): void {
    const width = this.frame.clientWidth;
    if (width === 0) return;
    this.stale = false;
    this.chart ??= new uPlot(this.options(width), [[0]], this.frame);
    this.chart.setData(this.points(width - NUMBERS - RIGHT));
  }

  private options(width: number): uPlot.Options {
    const [ink, grid] = [color("quiet"), color("grid")];
    const axis = { stroke: ink, grid: { stroke: grid, width: 1 }, ticks: { stroke: grid, width: 1, size: 4 }, gap: 3, font: "11px system-ui, sans-serif" };
    return {
      width,
      height: HEIGHT,
      padding: [8, RIGHT, 0, 0],
      legend: { show: false },
      cursor: { show: false },
      scales: {
        x: { time: false, range: () => [this.view.from / 1e6, this.view.to / 1e6] },
        y: { range: (_, low, high) => rounded(low, high) },
      },
      axes: [
        { ...axis, size: 24, values: (_, splits) => splits.map((value) => number(value, 6)) },
        { ...axis, size: NUMBERS, values: (_, splits) => splits.map((value) => number(value, 4)) },
      ],
      series: [
        {},
        ...this.series.map((one, place): uPlot.Series => ({
          label: one.line.label,
          stroke: color(LINES[place % LINES.length]!),
          width: one.line.role === "actual" ? 1.75 : 1.5,
          dash: DASHES[one.line.role],
        })),
      ],
      hooks: { draw: [(chart) => this.limits(chart)] },
    };
  }

  /** The limits that lie in what is shown. */
  private limits(chart: uPlot): void {
    const { min, max } = chart.scales["y"]!;
    const { ctx, bbox } = chart;
    for (const { value } of this.plot.limits) {
      if (min === undefined || max === undefined || value < min || value > max) continue;
      const y = Math.round(chart.valToPos(value, "y", true)) + 0.5;
      ctx.save();
      ctx.strokeStyle = color("bad");
      ctx.setLineDash([2, 4]);
      ctx.lineWidth = devicePixelRatio || 1;
      ctx.beginPath();
      ctx.moveTo(bbox.left, y);
      ctx.lineTo(bbox.left + bbox.width, y);
      ctx.stroke();
      ctx.restore();
    }
  }

  /** Dashes show what is asked for; in what goes up and down in each column they would not be seen, and take long to draw. */
  private dashed(place: number, dashed: boolean): void {
    const drawn = this.chart?.series[place + 1];
    if (drawn) drawn.dash = dashed ? DASHES[this.series[place]!.line.role] : [];
  }

  /** What is drawn: each value where there are few, else the lowest and the highest of each column. */
  private points(pixels: number): uPlot.AlignedData {
    const { from, to } = this.view;
    const columns = Math.max(Math.floor(pixels / (this.view.moving ? 5 : 2)), 10);
    const shown = this.series.map((one, place) => (this.hidden.has(place) ? undefined : one));
    const none: (number | null | undefined)[] = [];
    if (shown.every((one) => !one || one.count(this.store, from, to) <= columns * 4)) {
      const lines = shown.map((one) => (one ? one.points(this.store, from, to) : []));
      const times = Float64Array.from(new Set(lines.flatMap((line) => line.map(([t]) => t)))).sort();
      shown.forEach((_, place) => this.dashed(place, true));
      const place = new Map(Array.from(times, (t, index) => [t, index]));
      const values = lines.map((line) => {
        const row = new Array<number | null | undefined>(times.length);
        for (const [t, value] of line) row[place.get(t)!] = value;
        return row;
      });
      return [Array.from(times, (t) => t / 1e6), ...values] as uPlot.AlignedData;
    }
    const width = (to - from) / columns;
    const times = Array.from({ length: columns * 2 }, (_, i) => (from + (i / 2 + 0.25) * width) / 1e6);
    const values = shown.map((one) => (one ? one.columns(this.store, from, to, columns) : none));
    values.forEach((row, place) => this.dashed(place, !this.view.moving && !restless(row)));
    return [times, ...values] as uPlot.AlignedData;
  }
}

/** Whether most columns have more than one value. */
function restless(row: (number | null | undefined)[]): boolean {
  let wide = 0;
  for (let i = 0; i < row.length; i += 2) if (row[i] !== row[i + 1]) wide++;
  return wide * 6 > row.length;
}

/** A range with room above and below; of what never changes, one around it. */
function rounded(low: number | null, high: number | null): [number, number] {
  if (low === null || high === null || !Number.isFinite(low) || !Number.isFinite(high)) return [0, 1];
  const room = (high - low) * 0.08 || Math.max(Math.abs(high) * 0.1, 1);
  return [low - room, high + room];
}

/** Every plot of which something was recorded or could have been. */
export function plots(data: Data, series: Series[], store: Store, view: View): PlotView[] {
  let place = 0;
  return data.plots.map((plot) => {
    const own = series.slice(place, (place += plot.lines.length));
    return new PlotView(plot, own, store, view);
  });
}
