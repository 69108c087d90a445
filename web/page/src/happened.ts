// What the judge says while frames come: the verdict so far, and each transition and finding, the latest first.

import type { Finding } from "../../../report/page/src/data";
import { SIGNS, h } from "../../../report/page/src/dom";

interface Change {
  t: number;
  from: string;
  to: string;
  section: string;
  justified: string;
}

/** So many are shown. */
const MOST = 200;

const JUSTIFIED: Record<string, string> = { true: `${SIGNS.good} justified`, false: `${SIGNS.bad} violation`, unknown: `${SIGNS.unknown} not certain` };

const time = (t: number) => h("span", { class: "when" }, `${t.toFixed(3)} s`);

export function happenings(): {
  verdict: HTMLElement;
  list: HTMLElement;
  did(t: number, what: string): void;
  add(transitions: Change[], findings: Finding[]): void;
} {
  const verdict = h("p", { id: "live-verdict", role: "status" });
  const list = h("ol", { class: "happened", id: "happened", tabindex: 0, "aria-label": "What happened, the latest first" });
  const counts = { violation: 0, warning: 0, note: 0 };
  const tell = (element: HTMLElement) => {
    list.prepend(element);
    while (list.childElementCount > MOST) list.lastElementChild?.remove();
  };
  return {
    verdict,
    list,
    did: (t, what) => tell(h("li", {}, time(t), ` operator: ${what}`)),
    add(transitions, findings) {
      for (const one of transitions) tell(h("li", { class: one.justified === "false" ? "violation" : "change" }, time(one.t), ` ${one.from} → ${one.to} (${one.section}) ${JUSTIFIED[one.justified] ?? one.justified}`));
      for (const one of findings) {
        counts[one.severity]++;
        tell(h("li", { class: one.severity }, time(one.t), h("strong", {}, ` ${SIGNS[one.severity]} ${one.severity}`), ` by ${one.party} (${one.section}): ${one.message}`));
      }
      const judged = counts.violation > 0 ? `${SIGNS.bad} violates the document: ${counts.violation} violation${counts.violation === 1 ? "" : "s"}, ${counts.warning} warnings` : `${SIGNS.good} no violation so far, ${counts.warning} warnings`;
      if (verdict.textContent !== judged) verdict.textContent = judged;
      verdict.classList.toggle("bad", counts.violation > 0);
    },
  };
}
