// Builds the page into one file that needs no other: node build.mjs MODULE.wasm PAGE.html
// Beside it goes sw.js, which keeps the page in a browser where it comes from a site.

import { createHash } from "node:crypto";
import { copyFile, mkdir, readFile, writeFile } from "node:fs/promises";
import { createRequire } from "node:module";
import { dirname, join } from "node:path";
import { deflateRawSync } from "node:zlib";

// The tools are those of the page of a report.
const { build } = createRequire(new URL("../../report/page/package.json", import.meta.url))("esbuild");

const folder = new URL(".", import.meta.url).pathname;
const [wasm, target] = process.argv.slice(2);
if (!wasm || !target) {
  console.error("node build.mjs MODULE.wasm PAGE.html");
  process.exit(2);
}

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
const worker = await bundled("src/worker.ts", { format: "iife" });
const style = await bundled("src/page.css", {});
if (/<\/(script|style)/i.test(script + worker + style)) throw new Error("what is built would end its own element");

const hash = (text) => `'sha256-${createHash("sha256").update(text).digest("base64")}'`;
const policy = [
  "default-src 'none'",
  `script-src ${hash(script)} 'wasm-unsafe-eval'`,
  // The worker is made of what stands in the page; the other one keeps the page.
  "worker-src blob: 'self'",
  `style-src ${hash(style)}`,
  "base-uri 'none'",
  "form-action 'none'",
].join("; ");

const bytes = await readFile(wasm);
const module = deflateRawSync(bytes, { level: 9 }).toString("base64");
const parts = { policy, style, script, worker, module };
const frame = await readFile(`${folder}src/page.html`, "utf8");
const page = frame.replace(/\{\{(\w+)\}\}/g, (_, name) => parts[name]);
await mkdir(dirname(target), { recursive: true });
await writeFile(target, page);
await copyFile(`${folder}src/sw.js`, join(dirname(target), "sw.js"));
console.log(`${target}: ${page.length} bytes, of which the judge ${module.length} (${bytes.length} unpacked)`);
