// Builds the page into one file without data, dist/page.html; with --check, tells whether that file is what a fresh build makes.

import { readFile, mkdir, writeFile } from "node:fs/promises";
import { bundled, filled, hash } from "./bundle.mjs";

const folder = new URL(".", import.meta.url).pathname;
const target = `${folder}dist/page.html`;

const script = await bundled(folder, "src/main.ts", { format: "iife" });
const style = await bundled(folder, "src/page.css", {});
const policy = [
  "default-src 'none'",
  `script-src ${hash(script)}`,
  `style-src ${hash(style)}`,
  "base-uri 'none'",
  "form-action 'none'",
].join("; ");

const page = await filled(`${folder}src/page.html`, { policy, style, script });

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
