// The frames as they go by: the last of each message, decoded.

import type { Message } from "../../../report/page/src/data";
import { h } from "../../../report/page/src/dom";
import { idText, raw, shown } from "../../../report/page/src/frames";

/** So often what stands there is written anew, in seconds of the car's time: nobody reads faster. */
const OFTEN = 0.1;

export function frames(messages: Message[]): { element: HTMLElement; add(frames: [number, number, string, number?][], t: number): void } {
  const rows = new Map<number, { last: string; count: number; cells: HTMLElement[] }>();
  const body = h("tbody", {});
  let written = -1;
  const row = (id: number) => {
    let known = rows.get(id);
    if (!known) {
      const message = messages.find((one) => one.id === id);
      const cells = [h("td", { class: "when" }), h("td", { class: "says" })];
      const line = h("tr", { "data-id": id }, h("td", { class: "name" }, `${message?.name ?? ""} ${idText(id)}`), h("td", {}, message?.from ?? "?"), ...cells);
      known = { last: "", count: 0, cells };
      rows.set(id, known);
      const after = [...body.children].find((one) => Number((one as HTMLElement).dataset["id"]) > id);
      body.insertBefore(line, after ?? null);
    }
    return known;
  };
  return {
    element: h("div", { class: "scroll frames", tabindex: 0, role: "region", "aria-label": "Frames, a table" },
      h("table", {}, h("caption", { class: "hidden" }, "The last frame of each message"),
        h("thead", {}, h("tr", {}, ...["Frame", "From", "Count", "What it says"].map((title) => h("th", { scope: "col" }, title)))), body)),
    add(some, t) {
      for (const [, id, hex, count = 1] of some) {
        const one = row(id);
        one.count += count;
        one.last = hex;
      }
      if (t >= written && t - written < OFTEN) return;
      written = t;
      for (const [id, { last, count, cells }] of rows) {
        const data = Uint8Array.from(last.match(/../g) ?? [], (byte) => Number.parseInt(byte, 16));
        const said = (messages.find((one) => one.id === id)?.signals ?? []).flatMap((signal) => {
          const value = raw(signal, data, 0, data.length);
          return value === undefined || value === 0 ? [] : [`${signal.name}: ${shown(signal, value)}`];
        });
        cells[0]!.textContent = String(count);
        cells[1]!.replaceChildren(said.join(", "), h("code", {}, last.replace(/..(?=.)/g, "$& ")));
      }
    },
  };
}
