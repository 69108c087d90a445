// The frames around a moment, decoded: those of the evidence, and what changed.

import type { Data, Message } from "./data";
import { h } from "./dom";
import { type Frame, type Store, idText, messageOf, raw, shown } from "./frames";

/** So long before and after, in microseconds. */
const NEAR = 30_000;
/** So many frames are a table that can be read. */
const MOST = 400;

export function around(data: Data, store: Store, t: number, evidence: { t: number; id: string }[] = []): HTMLElement {
  const element = h("div", { class: "frames" });
  const all = h("input", { type: "checkbox", change: () => fill() });
  const body = h("div", {});
  const fill = () => body.replaceChildren(frames(data, store, t, evidence, all.checked));
  element.append(
    h("h3", {}, `Frames from ${NEAR / 1000} ms before to ${NEAR / 1000} ms after`),
    h("label", {}, all, " all frames, and not only those that say something new"), body);
  const wait = () => {
    if (store.loaded) return fill();
    body.textContent = "The frames are being unpacked …";
    setTimeout(wait, 50);
  };
  wait();
  return element;
}

function frames(data: Data, store: Store, t: number, evidence: { t: number; id: string }[], all: boolean): HTMLElement {
  const isEvidence = (frame: Frame) => evidence.some((one) => one.id === idText(frame.id) && Math.abs(one.t * 1e6 - frame.t) < 1.5);
  const times = evidence.map((one) => one.t * 1e6).filter((at) => Math.abs(at - t) < NEAR * 10);
  const found = store.between(Math.min(t, ...times) - NEAR, Math.max(t, ...times) + NEAR);
  const said = found.map((frame) => ({ frame, changes: changes(data, store, frame) }));
  const restless = alternating(said);
  const rows: HTMLElement[] = [];
  let same = 0;
  for (const { frame, changes } of said) {
    const named = isEvidence(frame);
    const isNew = changes.some(({ signal }) => !restless.has(`${frame.id} ${signal}`));
    if (all || named || isNew) {
      if (rows.length < MOST) rows.push(row(data, store, t, frame, changes, named));
    } else same++;
  }
  const more = same > 0 ? `${same} further frames say nothing new.` : "";
  if (rows.length === 0) return h("p", { class: "quiet" }, more || "No frame came in this time.");
  const head = ["", "When", "Frame", "From", "What it says"].map((title) => h("th", { scope: "col" }, title || h("span", { class: "hidden" }, "Evidence")));
  return h("div", {},
    h("table", {}, h("thead", {}, h("tr", {}, ...head)), h("tbody", {}, ...rows)),
    more && h("p", { class: "quiet" }, more));
}

/** A signal that says something else than in the frame before. */
interface Change {
  signal: string;
  text: string;
}

/** Signals that change in most of their frames, as the handshake and counters do: that they change is nothing new. */
function alternating(said: { frame: Frame; changes: Change[] }[]): Set<string> {
  const counts = new Map<string, number>();
  const frames = new Map<number, number>();
  for (const { frame, changes } of said) {
    frames.set(frame.id, (frames.get(frame.id) ?? 0) + 1);
    for (const { signal } of changes) {
      const key = `${frame.id} ${signal}`;
      counts.set(key, (counts.get(key) ?? 0) + 1);
    }
  }
  const often = [...counts].filter(([key, count]) => count > 2 && count * 2 > frames.get(Number.parseInt(key))!);
  return new Set(often.map(([key]) => key));
}

function row(data: Data, store: Store, t: number, frame: Frame, changes: Change[], named: boolean): HTMLElement {
  const message = messageOf(data, frame.id);
  const bytes = store.bytes(frame);
  const hex = Array.from(bytes, (byte) => byte.toString(16).toUpperCase().padStart(2, "0")).join(" ");
  const says = h("td", {});
  if (message) {
    says.append(...changes.map(({ text }) => h("div", {}, h("strong", {}, text))));
    // What is zero all the time tells nothing.
    const rest = values(message, bytes).filter(({ name, zero }) => !zero && !changes.some(({ signal }) => signal === name));
    says.append(h("div", { class: "quiet" }, rest.map(({ name, text }) => `${name}: ${text}`).join(", ")));
  }
  says.append(h("code", {}, `${idText(frame.id)} # ${hex}`));
  const offset = (frame.t - t) / 1000;
  return h("tr", { class: named ? "evidence" : "" },
    h("td", { title: named ? "a frame that shows it" : "" }, named ? "▶" : "", named && h("span", { class: "hidden" }, "evidence")),
    h("td", { class: "when" }, `${(frame.t / 1e6).toFixed(6)} s`, h("br"), `${offset >= 0 ? "+" : "−"}${Math.abs(offset).toFixed(1)} ms`),
    h("td", { class: "name" }, message ? `${message.name} ${idText(frame.id)}` : idText(frame.id)),
    h("td", {}, message?.from ?? "?"), says);
}

/** The signals of a frame with their values. */
function values(message: Message, bytes: Uint8Array): { name: string; text: string; zero: boolean }[] {
  const list = [];
  for (const signal of message.signals) {
    const value = raw(signal, bytes, 0, bytes.length);
    if (value !== undefined) list.push({ name: signal.name, text: shown(signal, value), zero: value === 0 });
  }
  return list;
}

/** What a frame says otherwise than the one before of its message; all of a first one is new. */
function changes(data: Data, store: Store, frame: Frame): Change[] {
  const message = messageOf(data, frame.id);
  if (!message) return [{ signal: "", text: "no message of this edition" }];
  const now = values(message, store.bytes(frame));
  if (frame.place === 0) return now.map(({ name, text }) => ({ signal: name, text: `${name}: ${text}` }));
  const before = new Map(values(message, store.bytes({ ...frame, place: frame.place - 1 })).map(({ name, text }) => [name, text]));
  const other = now.filter(({ name, text }) => before.get(name) !== text);
  return other.map(({ name, text }) => ({ signal: name, text: `${name}: ${before.get(name) ?? "none"} → ${text}` }));
}
