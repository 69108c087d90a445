// What the builds of pages share: a script or a style of all that it imports, its hash for a content security policy, and a page of parts.

import { createHash } from "node:crypto";
import { readFile } from "node:fs/promises";
import { basename } from "node:path";
import { build } from "esbuild";

/** What esbuild makes of a file and of all that it imports. */
export async function bundled(folder, entry, more) {
  const made = await build({
    absWorkingDir: folder,
    entryPoints: [entry],
    bundle: true,
    minify: !process.env.PLAIN,
    write: false,
    charset: "utf8",
    legalComments: "inline",
    metafile: true,
    target: ["chrome110", "firefox115", "safari16.4"],
    ...more,
  });
  const text = (await notices(folder, made.metafile)) + made.outputFiles[0].text.trim();
  if (/<\/(script|style)/i.test(text)) throw new Error(`what is built of ${entry} would end its own element`);
  return text;
}

/** The licences of the packages that are in a script, which want to go with each copy; a package's style comes with its script. */
async function notices(folder, { inputs }) {
  const packages = Object.keys(inputs).flatMap((path) => /^.*node_modules\/(?:@[^/]+\/)?[^/]+\/(?!.*\.css$)/.exec(path)?.[0] ?? []);
  const texts = [...new Set(packages)].map(async (path) => `/*! ${basename(path)}\n${(await readFile(`${folder}${path}LICENSE`, "utf8")).trim()} */\n`);
  return (await Promise.all(texts)).join("");
}

/** A source of a content security policy: this text and no other. */
export const hash = (text) => `'sha256-${createHash("sha256").update(text).digest("base64")}'`;

/** A frame with its parts in the places that have their names. */
export async function filled(frame, parts) {
  return (await readFile(frame, "utf8")).replace(/\{\{(\w+)\}\}/g, (_, name) => parts[name]);
}
