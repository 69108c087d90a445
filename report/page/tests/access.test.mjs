// axe finds nothing against it: in light and in dark, on a wide screen and on a phone, with a finding open.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { after, test } from "node:test";

import { browser, driven, open, page, recording, written } from "./browser.mjs";

after(() => browser.close());

const axe = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");
const files = {
  "a recording that violates": page(recording("finished-while-moving")),
  "a run of 2026": page(driven("go-too-early", "2026")),
  "a log that tells nothing": page(written("nothing.log", "(1.0) can0 7FF#00\n")),
};

for (const [name, file] of Object.entries(files)) {
  for (const colorScheme of ["light", "dark"]) {
    for (const width of [1400, 390]) {
      test(`${name}, ${colorScheme}, ${width} wide`, async () => {
        const { tab, close } = await open(file, { colorScheme, viewport: { width, height: 900 } });
        const first = tab.locator(".findings tbody tr:not([hidden]) button").first();
        if (await first.count()) await first.click();
        await tab.locator("#exercised summary").last().click();
        await tab.evaluate(() => scrollTo(0, document.body.scrollHeight));
        await tab.waitForTimeout(100);
        await tab.evaluate(axe);
        const { violations } = await tab.evaluate(() => globalThis.axe.run());
        assert.deepEqual(violations.map((one) => `${one.id}: ${one.help}: ${one.nodes.slice(0, 3).map((node) => node.html.slice(0, 160)).join(" | ")}`), []);
        await close();
      });
    }
  }
}
