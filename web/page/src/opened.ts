// One log: its report, by the edition and the readings that are chosen above it.

import { h } from "../../../report/page/src/dom";
import { show } from "../../../report/page/src/report";
import { busy, refused } from "./busy";
import { AS_USUAL, type Engine, type How, type Judged, type Source } from "./engine";

/** How a log comes out, in a few words. */
function outcome(judged: Judged): string {
  const count = (number: number, noun: string) => `${number} ${noun}${number === 1 ? "" : "s"}`;
  return `edition ${judged.edition}: ${judged.verdict}, ${count(judged.violations, "violation")}, ${count(judged.warnings, "warning")}`;
}

/** A log with its report, until the signal ends it. */
export function opened(engine: Engine, source: Source, signal: AbortSignal): HTMLElement[] {
  const report = h("div", { id: "report" });
  const state = h("div", { id: "state" });
  const before = h("p", { role: "status", class: "about", id: "before" });
  let how: How = AS_USUAL;
  let last: Judged | undefined;
  let now = new AbortController();
  signal.addEventListener("abort", () => now.abort(), { once: true });

  /** As a page of its own, as long as there is no report. */
  const say = (...said: HTMLElement[]) => {
    if (report.childElementCount > 0) state.replaceChildren(...said);
    else state.replaceChildren(h("main", {}, h("h1", {}, source.name), ...said));
  };
  const judge = async () => {
    now.abort();
    const mine = (now = new AbortController());
    delete document.documentElement.dataset["ready"];
    const bar = busy(`Judging ${source.name}`, () => mine.abort());
    say(bar.element);
    try {
      const judged = await engine.judge(source, how, false, mine.signal, bar.progress);
      if (last) before.textContent = `Before, by ${outcome(last)}. Now, by ${outcome(judged)}.`;
      last = judged;
      choice.judgedBy(judged.edition);
      state.replaceChildren();
      if (judged.failure) state.append(refusedPart(judged.failure));
      report.replaceChildren();
      await show(judged.data!, report, `Judged in this browser by adsdv ${engine.about.version}. Nothing of the log has left it.`, mine.signal);
    } catch (error) {
      if (mine !== now) return;
      if (mine.signal.aborted) say(h("p", { role: "status" }, "Cancelled. ", h("button", { type: "button", click: () => void judge() }, "Judge it after all")));
      else {
        report.replaceChildren();
        say(refused(error));
      }
    }
  };
  const choice = choose(engine, (chosen) => {
    how = chosen;
    void judge();
  });
  void judge();
  return [h("section", { class: "settings", "aria-label": "How it is judged" }, choice.element, before), state, report];
}

function refusedPart(failure: { why: string; hint: string }): HTMLElement {
  return h("p", { class: "verdict care", role: "alert" }, `Not all of it could be read: ${failure.why}. What follows is about the rest. ${failure.hint}.`);
}

/** The edition, and the readings that it leaves open. */
function choose(engine: Engine, chosen: (how: How) => void): { element: HTMLElement; judgedBy(edition: string): void } {
  const { editions } = engine.about;
  let by = editions[0]!.edition;
  const pins = new Map<string, string>();
  const tell = () => {
    const open = readingsOf().map((one) => one.id);
    const readings = [...pins].filter(([id]) => open.includes(id)).map(([id, choice]) => `${id}=${choice}`);
    chosen({ edition: edition.value || null, readings });
  };
  const readingsOf = () => editions.find((one) => one.edition === (edition.value || by))?.readings ?? [];
  const edition = h("select", { id: "edition", change: () => {
    fill();
    tell();
  } },
    h("option", { value: "" }, "the one that the log tells"),
    ...editions.map((one) => h("option", { value: one.edition }, `${one.edition}: ${one.document}`)));
  const list = h("div", { class: "readings" });
  const title = h("summary", {});
  const fill = () => {
    const all = readingsOf();
    const pinned = all.filter(({ id }) => pins.has(id)).length;
    title.textContent = `Readings of the document: ${pinned === 0 ? `all that are possible of ${all.length} open questions` : `${pinned} pinned`}`;
    list.replaceChildren(...all.map((reading) => {
      const select = h("select", { id: `reading-${reading.id}`, change: () => {
        if (select.value) pins.set(reading.id, select.value);
        else pins.delete(reading.id);
        fill();
        document.getElementById(`reading-${reading.id}`)?.focus();
        tell();
      } },
        h("option", { value: "" }, "whichever is possible"),
        ...reading.choices.map(({ id, text }) => h("option", { value: id, selected: pins.get(reading.id) === id }, text)));
      return h("label", {}, h("span", {}, `${reading.question} (${reading.section})`), select);
    }));
  };
  fill();
  return {
    element: h("div", {}, h("label", {}, "Edition ", edition), h("details", {}, title, list)),
    judgedBy(version) {
      if (version === by) return;
      by = version;
      fill();
    },
  };
}
