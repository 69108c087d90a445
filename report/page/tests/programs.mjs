// Programs with mistakes, what adsdv says of them, and the pages that it makes of that.

import { copyFileSync, mkdirSync, readFileSync } from "node:fs";
import { join, relative } from "node:path";

import { folder, root, run, template } from "./browser.mjs";

/** Seen from the root, so that no page has a path of this machine. */
const examples = relative(root, process.env.EXAMPLES ?? join(root, "target/debug/examples"));
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

/** The page of costs of readings: exploring them takes minutes, so that its data is that of `adsdv verify --readings --edition 3.0 --html`. */
export function costs() {
  const data = JSON.parse(readFileSync(new URL("costs-3.0.json", import.meta.url), "utf8"));
  return { page: template("outcome", data), json: data.json };
}

/** A program under another name. */
export function named(program, name) {
  const bin = join(folder, "bin");
  mkdirSync(bin, { recursive: true });
  copyFileSync(join(root, program), join(bin, name));
  return join(bin, name);
}
