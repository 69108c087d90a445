// Every frame, message by message, and what its bits say.

import type { Data, Message, Signal } from "./data";
import { number } from "./dom";
import { Reader, unpack } from "./packed";

/** The frames of one message, in order of time. */
export interface Frames {
  times: Float64Array;
  lengths: Uint8Array;
  /** Eight bytes a frame. */
  data: Uint8Array;
}

/** A frame among those of its message. */
export interface Frame {
  id: number;
  t: number;
  place: number;
}

const BYTES = 8;

/** All frames of the recording, and the answers to the handshake. */
export class Store {
  readonly of = new Map<number, Frames>();
  answers = { times: new Float64Array(0), values: new Float32Array(0) };
  loaded = false;

  constructor(private readonly data: Data) {}

  /** Unpacks all pieces, without holding up what is on the screen. */
  async load(): Promise<void> {
    const parts = new Map<number, Frames[]>();
    const times: Float64Array[] = [];
    const took: Float64Array[] = [];
    for (const chunk of this.data.chunks) {
      const reader = new Reader(await unpack(chunk.packed));
      const messages = reader.number();
      for (let i = 0; i < messages; i++) {
        const id = reader.number();
        const count = reader.number();
        const frames = {
          times: reader.times(count, chunk.from),
          lengths: new Uint8Array(count),
          data: new Uint8Array(count * BYTES),
        };
        reader.differences(count, frames.lengths, 0, 1);
        const longest = reader.number();
        for (let byte = 0; byte < longest; byte++) reader.differences(count, frames.data, byte, BYTES);
        parts.set(id, [...(parts.get(id) ?? []), frames]);
      }
      const answers = reader.number();
      times.push(reader.times(answers, chunk.from));
      took.push(Float64Array.from({ length: answers }, () => reader.signed() / 1000));
      await new Promise((later) => setTimeout(later));
    }
    for (const [id, list] of parts) this.of.set(id, joined(list));
    this.answers = { times: concat(times), values: Float32Array.from(concat(took)) };
    this.loaded = true;
  }

  /** The frames from a time to another, in order. */
  between(from: number, to: number): Frame[] {
    const found: Frame[] = [];
    for (const [id, frames] of this.of) {
      for (let place = lower(frames.times, from); place < frames.times.length; place++) {
        const t = frames.times[place]!;
        if (t > to) break;
        found.push({ id, t, place });
      }
    }
    return found.sort((a, b) => a.t - b.t || a.id - b.id);
  }

  /** The bytes of a frame. */
  bytes(frame: Frame): Uint8Array {
    const frames = this.of.get(frame.id)!;
    const begin = frame.place * BYTES;
    return frames.data.subarray(begin, begin + frames.lengths[frame.place]!);
  }
}

function joined(list: Frames[]): Frames {
  if (list.length === 1) return list[0]!;
  return {
    times: concat(list.map((one) => one.times)),
    lengths: bytes(list.map((one) => one.lengths)),
    data: bytes(list.map((one) => one.data)),
  };
}

function concat(list: Float64Array[]): Float64Array<ArrayBuffer> {
  const all = new Float64Array(list.reduce((sum, one) => sum + one.length, 0));
  let place = 0;
  for (const one of list) {
    all.set(one, place);
    place += one.length;
  }
  return all;
}

function bytes(list: Uint8Array[]): Uint8Array {
  const all = new Uint8Array(list.reduce((sum, one) => sum + one.length, 0));
  let place = 0;
  for (const one of list) {
    all.set(one, place);
    place += one.length;
  }
  return all;
}

/** The place of the first time that is not before `t`, among those from a place to before another. */
export function lower(times: Float64Array, t: number, from = 0, to = times.length): number {
  while (from < to) {
    const middle = (from + to) >>> 1;
    if (times[middle]! < t) from = middle + 1;
    else to = middle;
  }
  return from;
}

/** The raw bits of a signal, as the number that they are; none where the data is too short. */
export function raw(signal: Signal, data: Uint8Array, begin: number, length: number): number | undefined {
  const { start, width } = signal;
  if (start + width > length * 8) return undefined;
  let value = 0;
  let scale = 1;
  let bit = start;
  let left = width;
  while (left > 0) {
    const shift = bit & 7;
    const take = Math.min(8 - shift, left);
    value += ((data[begin + (bit >> 3)]! >> shift) & ((1 << take) - 1)) * scale;
    scale *= 2 ** take;
    bit += take;
    left -= take;
  }
  if (signal.coding === "i" && value >= 2 ** (width - 1)) value -= 2 ** width;
  if (signal.coding === "f") {
    const view = new DataView(new ArrayBuffer(4));
    view.setUint32(0, value >>> 0);
    value = view.getFloat32(0);
  }
  return value;
}

/** In the signal's unit. */
export function physical(signal: Signal, raw: number): number {
  return (raw * signal.num) / signal.den + signal.offset;
}

/** For a person: the name of the value, or the number with its unit. */
export function shown(signal: Signal, raw: number): string {
  const name = signal.values.find(([value]) => value === raw)?.[1];
  if (name !== undefined) return name;
  return `${number(physical(signal, raw), 4)}${signal.unit && ` ${signal.unit}`}`;
}

/** The message of an identifier. */
export function messageOf(data: Data, id: number): Message | undefined {
  return data.messages.find((message) => message.id === id);
}

/** An identifier as everywhere: 520h. */
export function idText(id: number): string {
  return `${id.toString(16).toUpperCase().padStart(3, "0")}h`;
}
