// The lines of the plots: of the whole recording as lowest and highest values, and once all frames are unpacked, every value.

import type { Data, PlotLine } from "./data";
import { type Store, lower, messageOf, physical, raw } from "./frames";
import { unpack } from "./packed";

/** What is silent for longer breaks the line, in microseconds. */
const BREAK = 500_000;
/** So many values of one level are one of the next. */
const FOLD = 4;

/** A level: the lowest and the highest of so many values each. */
interface Level {
  size: number;
  lowest: Float32Array;
  highest: Float32Array;
}

/** Every value of a line, and the lowest and highest of ever more of them. */
class Detail {
  private readonly levels: Level[];

  constructor(readonly times: Float64Array, readonly values: Float32Array) {
    let last: Level = { size: 1, lowest: values, highest: values };
    this.levels = [last];
    while (last.lowest.length > FOLD * FOLD) {
      last = folded(last);
      this.levels.push(last);
    }
  }

  /** The level to look at where a column has so many values: of it, each column has a few. */
  level(each: number): Level {
    return this.levels.findLast((one) => one.size * FOLD <= each) ?? this.levels[0]!;
  }
}

function folded({ size, lowest, highest }: Level): Level {
  const length = Math.ceil(lowest.length / FOLD);
  const next = { size: size * FOLD, lowest: new Float32Array(length), highest: new Float32Array(length) };
  for (let i = 0; i < length; i++) {
    const end = Math.min((i + 1) * FOLD, lowest.length);
    let low = Infinity;
    let high = -Infinity;
    for (let j = i * FOLD; j < end; j++) {
      if (lowest[j]! < low) low = lowest[j]!;
      if (highest[j]! > high) high = highest[j]!;
    }
    next.lowest[i] = low;
    next.highest[i] = high;
  }
  return next;
}

/** The lowest and the highest value from a place to before another; no value in it is left out, and at the edges a few may be of beside. */
function extremes({ size, lowest, highest }: Level, from: number, to: number): [number, number] {
  let low = Infinity;
  let high = -Infinity;
  const end = Math.ceil(to / size);
  for (let i = Math.floor(from / size); i < end; i++) {
    if (lowest[i]! < low) low = lowest[i]!;
    if (highest[i]! > high) high = highest[i]!;
  }
  return [low, high];
}

/** A line of a plot. */
export class Series {
  private detail: Detail | undefined;
  private overview: { width: number; lowest: Float32Array; highest: Float32Array } | undefined;

  constructor(private readonly data: Data, readonly line: PlotLine) {}

  /** The picture of the whole is there. */
  knows(width: number, lowest: Float32Array, highest: Float32Array): void {
    this.overview = { width, lowest, highest };
  }

  /** Every value, once the frames are there. */
  private exact(store: Store): Detail | undefined {
    if (!store.loaded) return undefined;
    return (this.detail ??= this.made(store));
  }

  private made(store: Store): Detail {
    if (this.line.of === "answer") return new Detail(store.answers.times, store.answers.values);
    const frames = store.of.get(this.line.id!);
    if (!frames) return new Detail(new Float64Array(0), new Float32Array(0));
    const { times, lengths, data } = frames;
    if (this.line.of === "period") {
      const values = new Float32Array(Math.max(times.length - 1, 0));
      for (let i = 0; i < values.length; i++) values[i] = (times[i + 1]! - times[i]!) / 1000;
      return new Detail(times.subarray(1), values);
    }
    const signal = messageOf(this.data, this.line.id!)?.signals.find((one) => one.name === this.line.signal);
    if (!signal) return new Detail(new Float64Array(0), new Float32Array(0));
    const values = new Float32Array(times.length);
    const kept = new Float64Array(times.length);
    let count = 0;
    for (let i = 0; i < times.length; i++) {
      const value = raw(signal, data, i * 8, lengths[i]!);
      if (value === undefined) continue;
      kept[count] = times[i]!;
      values[count++] = physical(signal, value);
    }
    return new Detail(count === times.length ? times : kept.subarray(0, count), values.subarray(0, count));
  }

  /** Whether it ever has a value. */
  isEmpty(): boolean {
    return this.overview !== undefined && this.overview.lowest.every(Number.isNaN);
  }

  /** The last value up to a time, unless that is long ago. */
  at(store: Store, t: number): number | undefined {
    const detail = this.exact(store);
    if (!detail) {
      const value = this.overview?.highest[Math.floor(t / this.overview.width)];
      return value === undefined || Number.isNaN(value) ? undefined : value;
    }
    const place = lower(detail.times, t + 1) - 1;
    if (place < 0 || t - detail.times[place]! > BREAK) return undefined;
    return detail.values[place];
  }

  /** How many values are from a time to another; infinite as long as only the picture of the whole is there. */
  count(store: Store, from: number, to: number): number {
    const detail = this.exact(store);
    return detail ? lower(detail.times, to) - lower(detail.times, from) : Infinity;
  }

  /** Each value from a time to another, with one before and one behind; a break where it is silent for long. */
  points(store: Store, from: number, to: number): [number, number | null][] {
    const detail = this.exact(store);
    if (!detail) return [];
    const begin = Math.max(lower(detail.times, from) - 1, 0);
    const end = Math.min(lower(detail.times, to) + 1, detail.times.length);
    const points: [number, number | null][] = [];
    for (let i = begin; i < end; i++) {
      const t = detail.times[i]!;
      const before = points.at(-1)?.[0];
      if (before !== undefined && t - before > BREAK) points.push([before + 1, null]);
      points.push([t, detail.values[i]!]);
    }
    return points;
  }

  /** The lowest and the highest value in each of so many columns: two places each. */
  columns(store: Store, from: number, to: number, columns: number): (number | null | undefined)[] {
    const values = new Array<number | null | undefined>(columns * 2);
    const width = (to - from) / columns;
    const detail = this.exact(store);
    let last = -Infinity;
    const put = (column: number, low: number, high: number) => {
      values[column * 2] = low;
      values[column * 2 + 1] = high;
    };
    if (detail) {
      let place = lower(detail.times, from);
      const end = lower(detail.times, to);
      const level = detail.level((end - place) / columns);
      for (let column = 0; column < columns; column++) {
        const until = from + (column + 1) * width;
        const next = lower(detail.times, until, place, end);
        if (next > place) {
          put(column, ...extremes(level, place, next));
          last = until;
        } else if (until - last > BREAK) put(column, NaN, NaN);
        place = next;
      }
    } else if (this.overview) {
      const { width: bucket, lowest, highest } = this.overview;
      for (let column = 0; column < columns; column++) {
        const place = Math.floor((from + (column + 0.5) * width) / bucket);
        const low = lowest[place];
        if (low !== undefined && !Number.isNaN(low)) put(column, low, highest[place]!);
        else put(column, NaN, NaN);
      }
    }
    return values.map((value) => (value !== undefined && Number.isNaN(value) ? null : value));
  }
}

/** Every line of every plot, in their order, each with its picture of the whole. */
export async function allSeries(data: Data): Promise<Series[]> {
  const series = data.plots.flatMap((plot) => plot.lines.map((line) => new Series(data, line)));
  const { buckets, width, packed } = data.overview;
  const floats = new Float32Array((await unpack(packed)).buffer);
  series.forEach((one, place) => {
    const begin = place * 2 * buckets;
    one.knows(width, floats.subarray(begin, begin + buckets), floats.subarray(begin + buckets, begin + 2 * buckets));
  });
  return series;
}
