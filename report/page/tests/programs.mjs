// Programs with mistakes, what adsdv says of them, and the pages that it makes of that.

import { copyFileSync, mkdirSync, readFileSync } from "node:fs";
import { join } from "node:path";

import { folder, root, run, template } from "./browser.mjs";

const examples = process.env.EXAMPLES ?? join(root, "target/debug/examples");
/** A VCU, by what it does otherwise. */
export const mutant = join(examples, "mutant");
/** An AI Computer, by its mistake. */
export const stack = join(examples, "ai_mutant");

/** A page of a command, and what it prints for a program. */
export function outcome(command, options, program) {
  const page = join(folder, `${Math.random().toString(36).slice(2)}.html`);
  const json = JSON.parse(run(command, ...options, "--json", "--html", page, "--", ...program));
  return { page, json };
}

/** The page of costs of readings: exploring them takes minutes, so that they are read from a file of `adsdv verify --readings --json`. */
export function costs() {
  const json = [JSON.parse(readFileSync(new URL("costs-3.0.json", import.meta.url), "utf8"))];
  const page = template("outcome", {
    kind: "readings", version: "0", title: "adsdv verify --readings: what each reading costs", about: ["edition 3.0"], mood: "good",
    verdict: "Every exploration was complete.", next: "Agree on the answers.", requirements: {}, readings: {}, picture: null, json,
  });
  return { page, json };
}

/** A program under another name. */
export function named(program, name) {
  const bin = join(folder, "bin");
  mkdirSync(bin, { recursive: true });
  copyFileSync(program, join(bin, name));
  return join(bin, name);
}
