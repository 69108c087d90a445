// The pictures of docs/report.md and docs/outcomes.md, small enough for a repository.

import { mkdirSync } from "node:fs";
import { join } from "node:path";

import { browser, driven, open, page, recording } from "./tests/browser.mjs";
import { costs, mutant, outcome, stack } from "./tests/programs.mjs";

let docs = new URL("../../docs/report", import.meta.url).pathname;

async function shot(name, file, options, act = async () => {}) {
  const { tab, close } = await open(file, options);
  await act(tab);
  await tab.waitForTimeout(300);
  await tab.screenshot({ path: join(docs, `${name}.png`) });
  await close();
}

const at = (id) => (tab) => tab.evaluate((id) => document.getElementById(id).scrollIntoView(), id);
const violates = page(recording("finished-while-moving"));
const small = { viewport: { width: 1110, height: 700 } };

await shot("verdict", violates, { viewport: { width: 1000, height: 560 } });
await shot("questions", page(driven("remote-estop", "2026")), { viewport: { width: 1000, height: 640 } }, at("questions"));
await shot("timeline", violates, small, async (tab) => {
  await tab.locator(".answer button").nth(5).click();
  await tab.waitForTimeout(200);
  await at("timeline")(tab);
});
await shot("finding", violates, { viewport: { width: 1120, height: 640 } }, async (tab) => {
  await tab.locator("tr.violation button").first().click();
  await at("findings")(tab);
});
await shot("dark", page(driven("remote-estop", "2026")), { viewport: { width: 1110, height: 640 }, colorScheme: "dark" }, async (tab) => {
  await tab.locator(".answer button").first().click();
  await tab.waitForTimeout(200);
  await at("timeline")(tab);
});
await shot("phone", violates, { viewport: { width: 390, height: 760 }, isMobile: true, hasTouch: true });

// The ten questions with their answers, of both recordings and of each scenario.
for (const [name, log] of [
  ["mission-3.0", recording("mission")], ["finished-while-moving", recording("finished-while-moving")],
  ...["mission", "go-too-early", "go-lost", "remote-estop", "power-cycle"].map((scenario) => [scenario, driven(scenario, "2026")]),
]) {
  const { tab, close } = await open(page(log), { viewport: { width: 900, height: 640 } });
  await tab.locator("#questions").screenshot({ path: join(docs, `questions-${name}.png`) });
  await close();
}

// Those of docs/outcomes.md.
docs = new URL("../../docs/outcomes", import.meta.url).pathname;
mkdirSync(docs, { recursive: true });
const vcu = outcome("conform", ["--runs", "50"], [mutant, "--mutation", "3.6: dropped", "--mutation", "3.3: leads to AS_OFF", "--mutation", "ready dwell +1"]).page;
await shot("conform", vcu, { viewport: { width: 1000, height: 640 } });
await shot("figure", vcu, { viewport: { width: 1000, height: 480 } }, at("figure2"));
await shot("exam", outcome("exam", ["--stdio"], [stack, "looks-at-one-wheel"]).page, { viewport: { width: 1000, height: 760 } }, (tab) => tab.locator("#findings .open").first().click());
await shot("readings", costs().page, { viewport: { width: 1000, height: 640 } });
await shot("phone", vcu, { viewport: { width: 390, height: 760 }, isMobile: true, hasTouch: true, colorScheme: "dark" });
await browser.close();
