// Builds the page into one file that needs no other: node build.mjs MODULE.wasm PAGE.html
// Beside it goes sw.js, which keeps the page in a browser where it comes from a site.

import { copyFile, mkdir, readFile, writeFile } from "node:fs/promises";
import { dirname, join } from "node:path";
import { deflateRawSync } from "node:zlib";

import { bundled, filled, hash } from "../../report/page/bundle.mjs";

const folder = new URL(".", import.meta.url).pathname;
const [wasm, target] = process.argv.slice(2);
if (!wasm || !target) {
  console.error("node build.mjs MODULE.wasm PAGE.html");
  process.exit(2);
}

const script = await bundled(folder, "src/main.ts", { format: "iife" });
const worker = await bundled(folder, "src/worker.ts", { format: "iife" });
const style = await bundled(folder, "src/page.css", {});
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
const page = await filled(`${folder}src/page.html`, { policy, style, script, worker, module });
await mkdir(dirname(target), { recursive: true });
await writeFile(target, page);
await copyFile(`${folder}src/sw.js`, join(dirname(target), "sw.js"));
console.log(`${target}: ${page.length} bytes, of which the judge ${module.length} (${bytes.length} unpacked)`);
