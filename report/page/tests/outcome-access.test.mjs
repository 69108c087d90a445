// axe finds nothing against the pages of outcomes, in light and in dark, wide and on a phone, with all open; nothing of a name runs; all is printed.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { after, test } from "node:test";

import { browser, open, written } from "./browser.mjs";
import { costs, mutant, named, outcome, stack } from "./programs.mjs";

after(() => browser.close());

const axe = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");
const pages = {
  conform: outcome("conform", ["--runs", "20"], [mutant, "--mutation", "3.6: dropped"]).page,
  exam: outcome("exam", ["--stdio", "--only", "mission", "--only", "ready"], [stack, "never-selects"]).page,
  readings: costs().page,
};

for (const [name, page] of Object.entries(pages)) {
  for (const colorScheme of ["light", "dark"]) {
    for (const width of [1400, 390]) {
      test(`${name}, ${colorScheme}, ${width} wide`, async () => {
        const { tab, close } = await open(page, { colorScheme, viewport: { width, height: 900 } });
        await tab.evaluate(() => {
          document.querySelectorAll("button.open").forEach((one, place) => place < 3 && one.click());
          document.querySelectorAll("details").forEach((one, place) => (one.open = place < 3));
        });
        const over = await tab.evaluate(() => document.documentElement.scrollWidth - document.documentElement.clientWidth);
        assert.ok(over <= 0, `${over} pixels do not fit`);
        await tab.evaluate(axe);
        const { violations } = await tab.evaluate(() => globalThis.axe.run());
        assert.deepEqual(violations.map((one) => `${one.id}: ${one.help}: ${one.nodes.slice(0, 3).map((node) => node.html.slice(0, 160)).join(" | ")}`), []);
        await close();
      });
    }
  }
  test(`${name} is printed with what was closed`, async () => {
    const { tab, close } = await open(page);
    await tab.evaluate(() => dispatchEvent(new Event("beforeprint")));
    assert.equal(await tab.locator("details:not([open])").count(), 0);
    assert.ok((await tab.pdf()).length > 10_000);
    await close();
  });
}

const HOSTILE = "<img src=x onerror=window.ran=1>";
const SCRIPT = "</script><script>window.ran=1</script>";

test("names of programs, of files and reasons that look like scripts are shown as they are", async () => {
  const accept = written("accept.txt", `ready-off:missing  ${SCRIPT}\n`);
  const vcu = outcome("conform", ["--runs", "5", "--accept", accept], [named(mutant, HOSTILE), "--mutation", "3.6: dropped"]);
  const scenario = written(`${HOSTILE}.txt`, readFileSync(new URL("../../../can/scenarios/mission.txt", import.meta.url), "utf8"));
  const ai = outcome("exam", ["--stdio", "--scenario", scenario, "--shrink", "0"], [named(stack, `${HOSTILE}2`), "never-selects"]);
  for (const [{ page, json }, texts] of [[vcu, [HOSTILE, SCRIPT]], [ai, [HOSTILE]]]) {
    const { tab, wrong, close } = await open(page);
    assert.ok(JSON.stringify(json).includes("window.ran=1"));
    await tab.evaluate(() => document.querySelectorAll("button.open").forEach((one) => one.click()));
    await tab.waitForTimeout(100);
    assert.equal(await tab.evaluate(() => window.ran), undefined);
    assert.equal(await tab.locator("img, iframe, object, embed").count(), 0);
    assert.equal(await tab.locator("script").count(), 2);
    const text = await tab.locator("body").textContent();
    for (const one of texts) assert.ok(text.includes(one), one);
    assert.ok((await tab.title()).includes(HOSTILE));
    assert.deepEqual(wrong, []);
    await close();
  }
});

test("a script that gets onto the page all the same does not run, and nothing can be sent", async () => {
  const { tab, close } = await open(pages.conform);
  await tab.evaluate(() => {
    const script = document.createElement("script");
    script.textContent = "window.ran = 1";
    document.body.append(script);
  });
  assert.equal(await tab.evaluate(() => fetch("https://example.invalid/").then(() => "sent", () => "refused")), "refused");
  assert.equal(await tab.evaluate(() => window.ran), undefined);
  await close();
});
