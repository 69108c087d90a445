// What the readings of the document cost: a ranking, and of each property that fails the shortest run that shows it.

import { SIGNS, h, section, table } from "../dom";
import type { Answer, Costs, Property, ReadingsData, StoryLine } from "./data";
import { type Item, filtered, page } from "./parts";

export function readings(data: ReadingsData): HTMLElement[] {
  return page(data, ...data.json.flatMap((one) => edition(one)));
}

const said = (answers: Answer[]) => (answers.length === 0 ? "the default answers" : answers.map(({ id, text }) => `${id} (${text})`).join(" and "));

function edition(one: Costs): HTMLElement[] {
  const id = `edition-${one.edition.replace(/\W/g, "-")}`;
  const ranking = one.ranking.map(({ answers, harm, fails }, place) => [
    String(place + 1), list(answers.map(({ id, text }) => [id, text])), answers.map((answer) => answer.instead_of).join(" and "), harm, list(fails.map((name) => [name, ""]))]);
  const free = one.free.map(({ id, text, instead_of }) => ["–", list([[id, text]]), instead_of, `${SIGNS.good} fails nothing`, ""]);
  const same = one.same.length > 0 ? `Edition ${one.same.join(" and ")} has the same state machine and the same questions. ` : "";
  return [
    section(id, `Edition ${one.edition}`,
      h("p", {}, `${same}${one.combinations.toLocaleString("en")} combinations of answers, ${one.steps.toLocaleString("en")} steps; ${one.complete ? `${SIGNS.good} every exploration complete` : `${SIGNS.bad} an exploration was not complete, and nothing below is certain`}.`),
      h("h3", {}, "The answers, ranked by what they can cost"),
      table(`Answers of edition ${one.edition}`, ["Rank", "Answer", "Instead of", "What it can cost", "Properties that fail"], [...ranking, ...free])),
    properties(id, one),
    others(id, one),
  ];
}

function list(lines: [string, string][]): HTMLElement {
  return h("ul", { class: "plain" }, ...lines.map(([id, text]) => h("li", {}, h("code", {}, id), text && ` ${text}`)));
}

/** Each property that fails, under each answer that fails it. */
function properties(id: string, one: Costs): HTMLElement {
  const open = one.costs.map((cost) => item(cost, `Fails under ${said(cost.answers)}${cost.undone_by.length > 0 ? `, but not with ${cost.undone_by.join(" and ")}` : ""}: ${cost.harm}.`, cost.run, "any AI Computer"));
  const closed = one.closed.map((cost) => item(cost, `Fails under ${said(cost.answers)}, though the AI Computer follows the document.`, cost.run, "an AI Computer that follows the document"));
  const items = [...open, ...closed];
  return filtered(`${id}-costs`, `The properties that fail in edition ${one.edition}`, "failures",
    [["any AI Computer", "with any AI Computer", true], ["an AI Computer that follows the document", "with one that follows the document", true]], items,
    items.length > 0 ? h("div", { class: "costs" }, ...items.flatMap(({ elements }) => elements)) : h("p", {}, "None."));
}

function item(property: Property, how: string, run: StoryLine[], kind: string): Item {
  const element = h("details", { class: "cost" },
    h("summary", {}, h("code", {}, property.name), ` ${how}`),
    h("p", {}, `${property.statement} (${property.requirements.join(", ")}).`),
    run.length > 0 && h("p", { class: "quiet" }, "The shortest run that shows it:"),
    run.length > 0 && h("ol", { class: "run" }, ...run.map(({ ms, text }) => h("li", {}, h("span", { class: "when" }, `${(ms / 1000).toFixed(3)} s`), ` ${text}`))));
  return { elements: [element], text: [property.name, property.statement, how, ...property.requirements].join(" "), kind };
}

function others(id: string, one: Costs): HTMLElement {
  const names = (all: Property[], more: (place: number) => string) => h("ul", {}, ...all.map((property, place) => h("li", {}, h("code", {}, property.name), ` ${property.statement} (${property.requirements.join(", ")})${more(place)}`)));
  return section(`${id}-others`, `What else of edition ${one.edition}`,
    one.unreachable.length > 0 && h("h3", {}, "What cannot happen any more"),
    one.unreachable.length > 0 && h("ul", {}, ...one.unreachable.map((goal) => h("li", {}, `${goal.statement} `, h("code", {}, goal.name), `: not under ${said(goal.answers)}`))),
    h("details", {}, h("summary", {}, `${one.holding.length} properties hold under every combination`), names(one.holding, () => "")));
}
