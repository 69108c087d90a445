// A live bus: `adsdv watch --web` streams its frames, and the judge of this page hears them. States, what the car waits for, Figure 2,
// findings as they come, the frames; and, in the end or at any time, the report of all that was heard.

import type { Arrow, Finding, Message, Stay } from "../../../report/page/src/data";
import { SIGNS, counted, h, section } from "../../../report/page/src/dom";
import { lightClass } from "../../../report/page/src/figure";
import { frames } from "./bus";
import { refused } from "./busy";
import type { Engine, Source } from "./engine";
import { type FigureData, type Truth, figure } from "./figure";
import { happenings } from "./happened";

interface Heard {
  t: number | null;
  interface: string | null;
  frames: number;
  broken: number;
  verdict: string;
  begun: { edition: string; figure: FigureData; messages: Message[] } | null;
  state: string | null;
  in_state: number;
  known: [string, Truth][];
  stay: Stay | null;
  messages: [number, number, string, number][];
  transitions: { t: number; from: string; to: string; section: string; justified: string }[];
  findings: Finding[];
}

/** So many characters of lines are kept for the report: an hour at full load is more, and then the log of `watch --log` has it. */
const KEPT = 400_000_000;

/** Whether this page comes with a bus. */
export function hasLive(): boolean {
  return document.querySelector<HTMLMetaElement>('meta[name="adsdv-live"]')?.content === "yes";
}

export function live(engine: Engine, open: (source: Source) => void, signal: AbortSignal): HTMLElement[] {
  const title = h("h1", {}, "A live bus");
  const link = h("p", { role: "status", id: "link", class: "link" });
  const body = h("div", {});
  const lost = h("p", { class: "past", id: "lost", role: "status" });
  let kept: string[] = [];
  let size = 0;
  let run = "";
  let shown: ReturnType<typeof bus> | undefined;
  let missed = 0;
  let lines = 0;

  const all = () => new Blob(kept, { type: "text/plain" });
  const judge = h("button", { type: "button", class: "primary", id: "judge-live", disabled: true, click: () => {
    const blob = all();
    open({ name: title.textContent!, bytes: () => Promise.resolve(blob) });
  } }, "Open the report so far");
  const save = h("button", { type: "button", disabled: true, id: "save-live", click: () => {
    const url = URL.createObjectURL(all());
    h("a", { href: url, download: "live.log" }).click();
    setTimeout(() => URL.revokeObjectURL(url), 10_000);
  } }, "Save its log");

  const say = (mood: "good" | "care" | "bad", text: string) => {
    link.className = `link ${mood}`;
    link.replaceChildren(h("span", { class: "sign", "aria-hidden": "true" }, SIGNS[mood]), text);
  };
  const fail = (error: unknown) => {
    stream.close();
    body.replaceChildren(refused(error));
  };
  const begin = (edition: string, readings: string[]) => {
    kept = [];
    size = lines = missed = 0;
    lost.textContent = "";
    engine.ask({ do: "listen", edition: edition || null, readings });
    shown = bus();
    body.replaceChildren(...shown.elements);
  };
  const tell = (heard: Heard) => {
    shown?.show(heard);
    document.documentElement.dataset["heard"] = String(heard.frames);
  };

  say("care", "Connecting …");
  const stream = new EventSource("live");
  signal.addEventListener("abort", () => stream.close(), { once: true });
  stream.addEventListener("begin", ({ data }: MessageEvent<string>) => {
    const [id, name, edition, ...readings] = data.split("\n");
    title.textContent = name || "A live bus";
    if (id !== run) {
      const again = run !== "";
      run = id!;
      begin(edition ?? "", readings);
      if (again) lost.textContent = "The program was started anew: what stands here is of the new run.";
    }
    say("good", "Connected: the frames come as the bus has them.");
    document.documentElement.dataset["ready"] = "yes";
  });
  stream.addEventListener("missed", ({ data }: MessageEvent<string>) => {
    missed += Number(data);
    lost.textContent = `${SIGNS.bad} ${counted(Number(data), "frame")} came before this page could read them, and are not kept any more: the judge starts anew behind them.`;
  });
  stream.onmessage = ({ data }: MessageEvent<string>) => {
    try {
      lines += 1;
      if (size < KEPT) {
        kept.push(`${data}\n`);
        size += data.length + 1;
        if (size >= KEPT) lost.textContent = `${SIGNS.care} The report and the log of this page end here, for they hold no more; what comes is judged all the same.`;
      }
      judge.disabled = save.disabled = false;
      tell(engine.ask<Heard>({ do: "hear", lines: `${data}\n`, lost: missed }));
      missed = 0;
    } catch (error) {
      fail(error);
    }
  };
  stream.addEventListener("end", ({ data }: MessageEvent<string>) => {
    stream.close();
    say("care", `The stream has ended: ${data}.`);
    document.documentElement.dataset["ended"] = "yes";
    try {
      tell(engine.ask<Heard>({ do: "heard-all" }));
    } catch (error) {
      fail(error);
    }
  });
  stream.onerror = () => {
    if (stream.readyState === EventSource.CLOSED) say("bad", "The connection to adsdv cannot be had: is it still running? Load this page again.");
    else say("bad", "The connection to adsdv is broken; connecting again. Frames that come meanwhile are kept by it.");
  };

  return [
    h("header", {}, title, link, lost),
    h("main", {}, h("div", { class: "settings", role: "group", "aria-label": "The run" }, judge, save), body),
  ];
}

/** How a bus looks, from its first frame on. */
function bus(): { elements: HTMLElement[]; show(heard: Heard): void } {
  const lamp = h("div", { class: "lamp dark", id: "lamp" }, h("strong", {}, "…"), h("span", {}, "no frame yet"));
  const heardState = h("p", { class: "hidden", role: "status" });
  const facts = h("p", { class: "moves", id: "facts" });
  const waits = h("div", { id: "waits" });
  const { verdict, list, add } = happenings();
  const place = h("div", {}, h("p", { class: "quiet" }, "Which edition the bus speaks is recognised within a second or ten of its first frame."));
  const onBus = h("div", {});
  let drawn: ReturnType<typeof figure> | undefined;
  let table: ReturnType<typeof frames> | undefined;
  let lights = new Map<string, string>();
  let state: string | null | undefined;
  let edition = "";
  let blocked = "";
  const early: Heard["messages"] = [];
  const show = (heard: Heard) => {
    if (heard.begun) {
      edition = heard.begun.edition;
      drawn = figure(heard.begun.figure);
      table = frames(heard.begun.messages);
      lights = new Map(heard.begun.figure.picture.states.map(({ name, light }) => [name, light]));
      place.replaceChildren(h("p", { class: "quiet" }, `As edition ${edition} has it. Of an arrow from the state that it is in: ✓ what holds, ✗ what does not, ? what the bus does not tell.`), drawn.element);
      onBus.replaceChildren(table.element);
      table.add(early.splice(0), 0);
      state = undefined;
    }
    if (!table) early.push(...heard.messages);
    else table.add(heard.messages, heard.t ?? 0);
    for (const { from, to } of heard.transitions) drawn?.taken(from, to);
    if (heard.state !== state && (heard.t !== null || state === undefined)) {
      state = heard.state;
      const light = state === null ? "" : lights.get(state) ?? "off";
      lamp.className = `lamp ${state === null ? "dark" : lightClass(light)}`;
      lamp.replaceChildren(h("strong", {}, state ?? "not known"), h("span", {}, state === null ? "no frame of the VCU shows it" : `light: ${light}`));
      heardState.textContent = state === null ? "the state is not known" : `${state}, light ${light}`;
    }
    const known = new Map(heard.known);
    drawn?.now(heard.state, (atom) => known.get(atom) ?? "unknown");
    facts.textContent = [heard.t === null ? "the edition is being recognised" : `${heard.t.toFixed(1)} s, in this state for ${heard.in_state.toFixed(1)} s`,
      counted(heard.frames, "frame"), heard.interface && `interface ${heard.interface}`, edition && `edition ${edition}`,
      heard.broken > 0 && `${counted(heard.broken, "line")} cannot be read`].filter(Boolean).join("; ");
    const now = JSON.stringify(heard.stay?.arrows.map(({ to, blocked }) => [to, blocked.at(-1)]) ?? null);
    if (now !== blocked) {
      blocked = now;
      waits.replaceChildren(...waitsFor(heard.stay));
    }
    add(heard.transitions, heard.findings);
  };
  return {
    elements: [
      h("div", { class: "cockpit" },
        h("section", { "aria-label": "State" }, lamp, heardState, facts),
        section("waits-for", "What the car waits for", waits)),
      h("div", { class: "two" }, section("judged", "Judged live", verdict, list), section("bus", "On the bus", onBus)),
      section("figure2", "Figure 2", place),
    ],
    show,
  };
}

/** What blocks each arrow from the state that it is in. */
function waitsFor(stay: Stay | null): HTMLElement[] {
  if (!stay) return [h("p", { class: "quiet" }, "No frame shows the state of the car.")];
  return stay.arrows.map((arrow: Arrow) => {
    const now = arrow.blocked.at(-1);
    const is = now && now.until > 1e9 ? now : undefined;
    const needs = (one: { needs: string; seen: string | null; whose: string; message: string | null }, sign: string, kind: string) =>
      h("li", { class: kind }, `${sign} needs ${one.needs}${one.seen ? `: ${one.seen}` : kind === "unknown" ? ": not known" : ""} `,
        h("span", { class: "quiet" }, `(${one.message ? `${one.whose}, ${one.message}` : one.whose})`));
    return h("div", { class: "waits" },
      h("h3", {}, `→ ${arrow.to} `, h("span", { class: "quiet" }, arrow.section)),
      is ? h("ul", { class: "plain" }, ...is.failed.map((one) => needs(one, SIGNS.bad, "false")), ...is.unknown.map((one) => needs(one, SIGNS.unknown, "unknown")))
        : h("p", { class: "true" }, `${SIGNS.good} nothing is known to block it`));
  });
}
