// The findings: a table that filters; each opens with what was expected, what could excuse it, its requirements and its frames.

import type { Data, Finding, Severity } from "./data";
import { SIGNS, h, section, seconds } from "./dom";
import { around } from "./around";
import type { Store } from "./frames";
import type { View } from "./view";

export interface Findings {
  element: HTMLElement;
  /** Opens a finding, and goes there. */
  open(place: number): void;
  /** The next or the one before, seen from a time. */
  beside(t: number, step: 1 | -1): number | undefined;
}

const SEVERITIES: Severity[] = ["violation", "warning", "note"];

export function findings(data: Data, store: Store, view: View): Findings {
  const all = data.check.findings;
  const count = (severity: Severity) => all.filter((one) => one.severity === severity).length;
  const rows = all.map((finding, place) => row(data, store, view, finding, place));
  const text = h("input", { type: "search", id: "filter", placeholder: "handshake, 520h, 3.7 …", autocomplete: "off", input: () => filter() });
  const boxes = SEVERITIES.map((severity) => h("input", {
    type: "checkbox",
    checked: severity !== "note" || all.every((one) => one.severity === "note"),
    change: () => filter(),
  }));
  const parties = [...new Set(all.map((one) => one.party))].sort();
  const party = h("select", { change: () => filter() },
    h("option", { value: "" }, "anybody"), ...parties.map((name) => h("option", { value: name }, name)));
  const shown = h("p", { role: "status", class: "quiet" });

  const filter = () => {
    const words = text.value.toLowerCase().split(/\s+/).filter(Boolean);
    let left = 0;
    all.forEach((finding, place) => {
      const of = [finding.t.toFixed(3), finding.severity, finding.party, finding.section, finding.rule, finding.message,
        ...finding.requirements, ...finding.evidence.map((one) => one.id)].join(" ").toLowerCase();
      const fits = words.every((word) => of.includes(word))
        && boxes[SEVERITIES.indexOf(finding.severity)]!.checked
        && (party.value === "" || party.value === finding.party);
      rows[place]!.show(fits);
      if (fits) left++;
    });
    shown.textContent = `${left} of ${all.length} findings shown`;
  };
  filter();

  const head = ["When", "What", "Who", "Section", "Rule", "Seen"].map((title) => h("th", { scope: "col" }, title));
  const element = section("findings", "Findings",
    h("form", { class: "filters", submit: (event) => event.preventDefault() },
      h("label", { for: "filter" }, "Filter"), text,
      ...SEVERITIES.map((severity, place) => h("label", {}, boxes[place], ` ${SIGNS[severity]} ${severity}s (${count(severity)})`)),
      h("label", {}, "by ", party)),
    shown,
    h("div", { class: "scroll", tabindex: 0, role: "region", "aria-label": "Findings, a table" },
      h("table", { class: "findings" },
        h("caption", { class: "hidden" }, "Findings in order of time"),
        h("thead", {}, h("tr", {}, ...head)),
        h("tbody", {}, ...rows.flatMap((one) => one.elements)))));

  return {
    element,
    open(place) {
      const one = rows[place];
      if (!one) return;
      const { severity, party: of } = all[place]!;
      if (one.elements[0].hidden) {
        text.value = "";
        boxes[SEVERITIES.indexOf(severity)]!.checked = true;
        if (party.value !== of) party.value = "";
        filter();
      }
      one.open();
    },
    beside(t, step) {
      const list = all.map((one, place) => ({ at: one.t * 1e6, place })).filter(({ place }) => !rows[place]!.elements[0].hidden);
      const found = step > 0 ? list.find(({ at }) => at > t + 1) : list.findLast(({ at }) => at < t - 1);
      return found?.place;
    },
  };
}

interface Row {
  elements: [HTMLElement, HTMLElement];
  show(fits: boolean): void;
  open(): void;
}

function row(data: Data, store: Store, view: View, finding: Finding, place: number): Row {
  const at = finding.t * 1e6;
  const detail = h("td", { colspan: 6 });
  const below = h("tr", { id: `finding-${place}-detail`, class: "detail", hidden: true }, detail);
  const fill = () => {
    if (detail.childElementCount === 0) detail.append(details(data, store, finding));
  };
  const set = (open: boolean) => {
    if (open) fill();
    below.hidden = !open || line.hidden;
    button.setAttribute("aria-expanded", String(open));
  };
  const button = h("button", {
    type: "button",
    class: "open",
    "aria-expanded": "false",
    "aria-controls": below.id,
    click: () => {
      const open = button.getAttribute("aria-expanded") !== "true";
      set(open);
      if (open) view.jump(at);
    },
  }, `${seconds(at)} s`);
  const line = h("tr", { id: `finding-${place}`, class: finding.severity },
    h("td", {}, button),
    h("td", { class: "severity" }, `${SIGNS[finding.severity]} ${finding.severity}`),
    h("td", {}, finding.party),
    h("td", {}, finding.section),
    h("td", {}, finding.rule),
    h("td", { class: "message" }, finding.message));
  return {
    elements: [line, below],
    show(fits) {
      line.hidden = !fits;
      below.hidden = !fits || button.getAttribute("aria-expanded") !== "true";
    },
    open() {
      set(true);
      view.jump(at);
      line.scrollIntoView({ block: "center", behavior: "auto" });
      button.focus({ preventScroll: true });
    },
  };
}

function details(data: Data, store: Store, finding: Finding): HTMLElement {
  const parts: [string, string | null][] = [
    ["Seen", finding.seen],
    ["Expected", finding.expected],
    ["It would be none if", finding.unless],
  ];
  const list = parts.filter(([, text]) => text).flatMap(([title, text]) => [h("dt", {}, title), h("dd", {}, text)]);
  if (finding.requirements.length > 0) {
    list.push(h("dt", {}, "Requirements"), h("dd", {}, requirements(data, finding.requirements)));
  }
  return h("div", { class: "opened" }, h("dl", {}, ...list), around(data, store, finding.t * 1e6, finding.evidence));
}

/** Requirements with their sentences. */
export function requirements(data: Data, ids: string[]): HTMLElement {
  const one = (id: string) => h("li", {}, h("strong", {}, id), ` ${data.requirements[id] ?? ""}`);
  return h("ul", { class: "requirements" }, ...ids.map(one));
}
