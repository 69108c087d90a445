// What docs/web.md says of sizes and speed: node measure.mjs MODULE.wasm

import { spawnSync } from "node:child_process";
import { readFileSync, statSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { deflateRawSync } from "node:zlib";

import { begin, browser, choose, folder, fresh, moduleOf, ready, recording, root } from "./tests/web.mjs";

const [, , wasm] = process.argv;
const mb = (bytes) => `${(bytes / 1e6).toFixed(2)} MB`;
console.log(`module: ${mb(statSync(wasm).size)}, compressed ${mb(deflateRawSync(readFileSync(wasm), { level: 9 }).length)}; page: ${mb(statSync(fresh).size)}`);

// A million frames, as one log: the same run again and again.
const times = 60;
const log = join(folder, "long.log");
writeFileSync(log, readFileSync(join(root, recording("mission"))).toString().repeat(times));
const bytes = readFileSync(log);
const judge = moduleOf(fresh);
const best = (run) => Math.min(...Array.from({ length: 5 }, () => {
  const begun = performance.now();
  run();
  return performance.now() - begun;
}));
let frames = 0;
const here = best(() => ({ frames } = JSON.parse(judge({ do: "judge", name: "long", brief: true }, bytes).answer)));
const whole = best(() => judge({ do: "judge", name: "long" }, bytes));
const beside = best(() => {
  const { status } = spawnSync(process.env.ADSDV, ["check", "--json", log], { maxBuffer: 1 << 30 });
  if (status === null || status > 1) throw new Error("adsdv check");
});
const rate = (ms) => `${(frames / ms / 1000).toFixed(1)} M frames/s`;
console.log(`${frames} frames: judged in V8 at ${rate(here)}, with the report at ${rate(whole)}; adsdv check --json at ${rate(beside)}, which starts for it`);

const { tab, close } = await begin();
const begun = performance.now();
await choose(tab, log);
await ready(tab);
console.log(`in Chromium, from the choice of the file to the last of its report: ${((performance.now() - begun) / 1000).toFixed(1)} s`);
await close();
await browser.close();
