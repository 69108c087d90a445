// While a log is judged: how far it is, and a way to stop it; and what is said where there is no answer.

import { h } from "../../../report/page/src/dom";
import { Refused, broken } from "./module";

/** A bar that fills, with a button that stops. */
export function busy(what: string, stop: () => void): { element: HTMLElement; progress(share: number): void } {
  const bar = h("progress", { max: 1, "aria-label": what });
  const element = h("div", { class: "busy", role: "status" }, h("span", {}, `${what} `), bar, " ",
    h("button", { type: "button", click: stop }, "Cancel"));
  return { element, progress: (share) => (bar.value = Math.min(share, 1)) };
}

/** Why there is no answer, and what to do. */
export function refused(error: unknown): HTMLElement {
  const { what, why, hint } = error instanceof Refused ? error.refusal : broken(error);
  return h("div", { class: "verdict bad", role: "alert" },
    h("h2", {}, h("span", { class: "sign" }, "✗"), `${what}: ${why}`),
    h("p", {}, h("strong", {}, "What to do: "), hint));
}
