// Builds the pages into one file each without data, in dist/; with --check, tells whether those files are what a fresh build makes.

import { readFile, mkdir, writeFile } from "node:fs/promises";
import { bundled, filled, hash } from "./bundle.mjs";

const folder = new URL(".", import.meta.url).pathname;
/** Of each page its script and its style. */
const PAGES = {
  page: ["src/main.ts", "src/page.css"],
  outcome: ["src/outcome/main.ts", "src/outcome/page.css"],
};

for (const [name, [main, css]] of Object.entries(PAGES)) {
  const target = `${folder}dist/${name}.html`;
  const script = await bundled(folder, main, { format: "iife" });
  const style = await bundled(folder, css, {});
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
      console.error(`report/page/dist/${name}.html is not what a fresh build makes; run: npm run build`);
      process.exitCode = 1;
    }
  } else {
    await mkdir(`${folder}dist`, { recursive: true });
    await writeFile(target, page);
    console.log(`dist/${name}.html: ${page.length} bytes`);
  }
}
