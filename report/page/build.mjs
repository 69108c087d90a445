// Builds the page into one file without data, dist/page.html; with --check, tells whether that file is what a fresh build makes.

import { createHash } from "node:crypto";
import { readFile, mkdir, writeFile } from "node:fs/promises";
import { build } from "esbuild";

const folder = new URL(".", import.meta.url).pathname;
const target = `${folder}dist/page.html`;

/** What esbuild makes of a file and of all that it imports. */
async function bundled(entry, more) {
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
  return made.outputFiles[0].text.trim();
}

const script = await bundled("src/main.ts", { format: "iife" });
const style = await bundled("src/page.css", {});
if (/<\/(script|style)/i.test(script + style)) throw new Error("what is built would end its own element");

const hash = (text) => `'sha256-${createHash("sha256").update(text).digest("base64")}'`;
const policy = [
  "default-src 'none'",
  `script-src ${hash(script)}`,
  `style-src ${hash(style)}`,
  "base-uri 'none'",
  "form-action 'none'",
].join("; ");

const parts = { policy, style, script };
const frame = await readFile(`${folder}src/page.html`, "utf8");
const page = frame.replace(/\{\{(\w+)\}\}/g, (_, name) => parts[name]);

if (process.argv.includes("--check")) {
  const there = await readFile(target, "utf8").catch(() => "");
  if (there !== page) {
    console.error("report/page/dist/page.html is not what a fresh build makes; run: npm run build");
    process.exit(1);
  }
} else {
  await mkdir(`${folder}dist`, { recursive: true });
  await writeFile(target, page);
  console.log(`dist/page.html: ${page.length} bytes`);
}
