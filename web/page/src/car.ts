// The virtual car: switches to click, the state with its light, what is missing, Figure 2, the frames, and the judge beside it.

import type { Finding, Message } from "../../../report/page/src/data";
import { SIGNS, h, section } from "../../../report/page/src/dom";
import { refused } from "./busy";
import type { Engine, Source, Switch } from "./engine";
import { lightClass } from "../../../report/page/src/figure";
import { type FigureData, figure } from "./figure";
import { frames } from "./bus";
import { happenings } from "./happened";

interface Begun {
  edition: string;
  figure: FigureData;
  messages: Message[];
}

/** How the car stands, and what has happened since it was last asked. */
export interface Run {
  t: number;
  state: string | null;
  in_state: number;
  go_signal: boolean;
  faults: string[];
  shutdown_cause: string;
  speed_mps: number;
  distance_m: number;
  steer_deg: number;
  switches: [string, string][];
  slips: string[];
  missing: { to: string; section: string; conditions: [string, string | null][]; then: [string, string | null] | null } | null;
  holds: string[];
  next: string | null;
  frames: [number, number, string][];
  kept: number;
  full: boolean;
  did: [number, string][];
  transitions: { t: number; from: string; to: string; section: string; justified: string }[];
  findings: Finding[];
}

/** So much is asked for at once, in milliseconds; what was not looked at for longer is left out. */
const MOST = 250;

const PARTS: [Switch["part"], string][] = [["", "The car"], ["sdc", "Opens the shutdown circuit"], ["reports", "Is reported to the VCU"]];

export function car(engine: Engine, open: (source: Source) => void, signal: AbortSignal): HTMLElement[] {
  const { about } = engine;
  const body = h("div", { class: "car" });
  const edition = h("select", { id: "car-edition", change: () => begin() }, ...about.editions.map((one) => h("option", { value: one.edition }, one.edition)));
  const scenario = h("select", { id: "car-scenario", change: () => begin() },
    h("option", { value: "" }, "nobody: you do"), ...about.scenarios.map((name) => h("option", { value: name }, `the scenario ${name}`)));
  const speed = h("select", { id: "car-speed" }, ...["1", "2", "5"].map((times) => h("option", { value: times }, `${times} ×`)));
  const pause = h("button", { type: "button", "aria-pressed": "false", click: () => pause.setAttribute("aria-pressed", String(pause.getAttribute("aria-pressed") !== "true")) }, "Pause");
  let tick: ((ms: number) => void) | undefined;

  const log = () => engine.log({ do: "drive-log" });
  const judge = h("button", { type: "button", class: "primary", id: "judge-drive", click: () => {
    const blob = log();
    open({ name: `virtual car, edition ${edition.value}`, bytes: () => Promise.resolve(blob) });
  } }, "Judge the whole drive");
  const save = h("button", { type: "button", click: () => {
    const url = URL.createObjectURL(log());
    h("a", { href: url, download: "virtual-car.log" }).click();
    setTimeout(() => URL.revokeObjectURL(url), 10_000);
  } }, "Save its log");

  const begin = () => {
    try {
      const begun = engine.ask<Begun>({ do: "begin", edition: edition.value, scenario: scenario.value || null });
      const shown = drive(engine, begun);
      body.replaceChildren(...shown.elements);
      tick = shown.tick;
    } catch (error) {
      tick = undefined;
      body.replaceChildren(refused(error));
    }
  };
  begin();
  document.documentElement.dataset["ready"] = "yes";

  let before = performance.now();
  let left = 0;
  const frame = (now: number) => {
    if (signal.aborted) return;
    requestAnimationFrame(frame);
    const passed = Math.min(now - before, MOST) * Number(speed.value);
    before = now;
    if (pause.getAttribute("aria-pressed") === "true") return;
    left += passed;
    const ms = Math.floor(left);
    left -= ms;
    if (ms > 0 && tick) {
      try {
        tick(ms);
      } catch (error) {
        tick = undefined;
        body.replaceChildren(refused(error));
      }
    }
  };
  requestAnimationFrame(frame);

  return [
    h("header", {}, h("h1", {}, "The virtual car"),
      h("p", { class: "about" }, "The VCU of the specification, an AI Computer that keeps to it, and a simple vehicle, on a bus in this page, judged while they drive. Switch on what is missing, and press \"Go\".")),
    h("main", {},
      h("div", { class: "settings", role: "group", "aria-label": "The drive" },
        h("label", {}, "Edition ", edition), h("label", {}, "Who operates ", scenario), h("label", {}, "Time ", speed), pause,
        h("button", { type: "button", click: begin }, "Begin anew"), judge, save),
      body),
  ];
}

/** A car that has begun; `tick` lets so many milliseconds pass. */
function drive(engine: Engine, begun: Begun): { elements: HTMLElement[]; tick: (ms: number) => void } {
  const { about } = engine;
  const act = (action: string) => void engine.ask({ do: "act", action });
  const drawn = figure(begun.figure);
  const bus = frames(begun.messages);
  const lights = new Map(begun.figure.picture.states.map(({ name, light }) => [name, light]));

  const lamp = h("div", { class: "lamp", id: "lamp" });
  const moves = h("p", { class: "moves" });
  const faults = h("p", { class: "faults" });
  const next = h("div", { id: "missing" });
  const heard = h("p", { class: "hidden", role: "status" });
  const panel = new Map<string, (position: string) => void>();
  const groups = PARTS.map(([part, title]) => h("fieldset", {}, h("legend", {}, title),
    ...about.switches.filter((one) => one.part === part).map((one) => {
      const made = control(one, act);
      panel.set(one.key, made.set);
      return made.element;
    }),
    part === "" && h("button", { type: "button", class: "switch", title: about.power_cycle[1], "data-switch": "power", click: () => act(about.power_cycle[0]) }, about.power_cycle[0])));
  const slips = about.slips.map(([id, text]) => {
    const button: HTMLButtonElement = h("button", { type: "button", class: "switch cause", "aria-pressed": "false", "data-slip": id,
      click: () => void engine.ask({ do: "slip", slip: id, on: button.getAttribute("aria-pressed") !== "true" }) }, text);
    return { id, button };
  });
  groups.push(h("fieldset", {}, h("legend", {}, "The AI Computer makes a mistake"), ...slips.map((one) => one.button)));

  const happened = happenings();
  const full = h("p", { class: "full", id: "full", role: "status" });

  let state: string | null | undefined;
  let missing = "";
  const tick = (ms: number) => {
    const run = engine.ask<Run>({ do: "run", ms });
    if (run.state !== state) {
      if (state && run.state) drawn.taken(state, run.state);
      state = run.state;
      const light = state === null ? "off" : lights.get(state)!;
      lamp.className = `lamp ${state === null ? "dark" : lightClass(light)}`;
      lamp.replaceChildren(h("strong", {}, state ?? "no power"), h("span", {}, state === null ? "" : `light: ${light}`));
      heard.textContent = `${state ?? "no power"}, light ${light}`;
    }
    const holds = new Set(run.holds);
    drawn.now(run.state, (atom) => (holds.has(atom) ? "true" : "false"));
    moves.textContent = `${run.t.toFixed(1)} s; in this state for ${run.in_state.toFixed(1)} s; ${run.speed_mps.toFixed(1)} m/s, ${run.distance_m.toFixed(1)} m, steering ${run.steer_deg.toFixed(1)}°; GO_SIGNAL ${run.go_signal ? "on" : "off"}${run.next ? `; next: ${run.next}` : ""}`;
    const bad = run.faults.length > 0 ? `${SIGNS.bad} ${run.faults.join(", ")}` : `${SIGNS.good} no fault`;
    faults.textContent = run.shutdown_cause === "NO SHUTDOWN" ? bad : `${bad}; SHUTDOWN_CAUSE ${run.shutdown_cause}`;
    faults.classList.toggle("bad", run.faults.length > 0);
    for (const [key, position] of run.switches) panel.get(key)?.(position);
    for (const { id, button } of slips) button.setAttribute("aria-pressed", String(run.slips.includes(id)));
    const waits = JSON.stringify(run.missing);
    if (waits !== missing) {
      missing = waits;
      fill(next, run.missing, act);
    }
    bus.add(run.frames, run.t);
    for (const [t, what] of run.did) happened.did(t, what);
    happened.add(run.transitions, run.findings);
    if (run.full && full.textContent === "") {
      full.textContent = `${SIGNS.care} The log of this drive ends here: it holds ${run.kept.toLocaleString("en")} frames and no more. The car drives on and is judged, but what comes is in no report and no saved log. Begin anew for another log.`;
    }
  };
  tick(10);

  const elements = [
    h("div", { class: "cockpit" },
      h("section", { "aria-label": "State" }, lamp, heard, moves, faults, next),
      h("section", { "aria-label": "Switches", class: "switches" }, ...groups)),
    section("figure2", "Figure 2", h("p", { class: "quiet" }, `As edition ${begun.edition} has it. An arrow shows its guard; what holds is marked while the car moves.`), drawn.element),
    h("div", { class: "two" },
      section("judged", "Judged live", happened.verdict, full, happened.list),
      section("bus", "On the bus", bus.element)),
  ];
  return { elements, tick };
}

/** A switch: a button where it is on or off, else a list of its positions. */
function control(one: Switch, act: (action: string) => void): { element: HTMLElement; set: (position: string) => void } {
  const flag = one.positions.length === 2 && one.positions.includes("on");
  if (flag) {
    const button: HTMLButtonElement = h("button", { type: "button", class: `switch${one.part === "" ? "" : " cause"}`, title: one.about, "data-switch": one.key, "aria-pressed": "false",
      click: () => act(`${one.key} ${button.getAttribute("aria-pressed") === "true" ? "off" : "on"}`) }, one.key);
    return { element: button, set: (position) => button.setAttribute("aria-pressed", String(position === "on")) };
  }
  const select = h("select", { "data-switch": one.key, title: one.about, change: () => act(`${one.key} ${select.value}`) }, ...one.positions.map((position) => h("option", { value: position }, position)));
  return {
    element: h("label", { class: "position" }, `${one.key} `, select),
    set(position) {
      if (select.value !== position && document.activeElement !== select) select.value = position;
    },
  };
}

/** What is missing for the next arrow, each with a button that does it where there is one. */
function fill(element: HTMLElement, missing: Run["missing"], act: (action: string) => void): void {
  const focused = element.contains(document.activeElement) ? (document.activeElement as HTMLElement).dataset["action"] : undefined;
  if (!missing) {
    element.replaceChildren(h("p", { class: "good" }, `${SIGNS.good} nothing is missing`));
    return;
  }
  const one = ([text, action]: [string, string | null]) => h("li", {}, text, " ", action && h("button", { type: "button", "data-action": action, click: () => act(action) }, action));
  element.replaceChildren(h("p", {}, h("strong", {}, `${missing.to} (${missing.section}) still needs:`)),
    h("ul", {}, ...missing.conditions.map(one), missing.then && one(missing.then)));
  if (focused) element.querySelector<HTMLElement>(`[data-action="${CSS.escape(focused)}"]`)?.focus();
}
