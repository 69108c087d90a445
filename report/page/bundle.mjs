// What the builds of pages share: a script or a style of all that it imports, its hash for a content security policy, and a page of parts.

import { createHash } from "node:crypto";
import { readFile } from "node:fs/promises";
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
    target: ["chrome110", "firefox115", "safari16.4"],
    ...more,
  });
  const text = made.outputFiles[0].text.trim();
  if (/<\/(script|style)/i.test(text)) throw new Error(`what is built of ${entry} would end its own element`);
  return text;
}

/** A source of a content security policy: this text and no other. */
export const hash = (text) => `'sha256-${createHash("sha256").update(text).digest("base64")}'`;

/** A frame with its parts in the places that have their names. */
export async function filled(frame, parts) {
  return (await readFile(frame, "utf8")).replace(/\{\{(\w+)\}\}/g, (_, name) => parts[name]);
}
