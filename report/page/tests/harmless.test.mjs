// What stands in a log, in its name and in rules is text on the page, and nothing of it runs.

import assert from "node:assert/strict";
import { after, test } from "node:test";

import { browser, open, page, texts, written } from "./browser.mjs";

after(() => browser.close());

const SCRIPT = "</script><script>window.ran=1;alert(1)</script>";
const IMAGE = "<img/src=x/onerror=window.ran=1>";

test("a log, a name and rules that look like scripts are shown as they are", async () => {
  const name = "<img src=x onerror=window.ran=1>.log";
  const lines = [];
  for (let cycle = 0; cycle < 200; cycle++) {
    const time = (1 + cycle / 100).toFixed(6);
    lines.push(`(${time}) ${IMAGE} 520#0${cycle % 2}00010000000000`, `(${time}) ${IMAGE} 510#0${cycle % 2}00000000000000`);
  }
  lines.splice(50, 0, SCRIPT, `(1.2) ${SCRIPT} 7FF#00`);
  const log = written(name, `${lines.join("\n")}\n`);
  const rules = written("team.rules", `calm: never AS_STATE is AS_OFF "${SCRIPT}"\n`);
  const { tab, wrong, close } = await open(page(log, "--rules", rules, "--interface", IMAGE));
  assert.equal(await tab.evaluate(() => window.ran), undefined);
  assert.equal(await tab.locator("img, iframe, object, embed").count(), 0);
  assert.equal(await tab.locator("script").count(), 2);
  assert.ok((await tab.locator("h1").textContent()).endsWith(name));
  assert.ok((await tab.title()).includes(name));
  assert.ok((await tab.locator("header").textContent()).includes(IMAGE));
  assert.ok((await texts(tab, "#rules p")).includes(SCRIPT));
  assert.deepEqual(wrong, []);
  await close();
});

test("a script that gets onto the page all the same does not run, and nothing can be sent", async () => {
  const { tab, wrong, close } = await open(page(written("small.log", "(1.0) can0 520#0000010000000000\n")));
  await tab.evaluate(() => {
    const script = document.createElement("script");
    script.textContent = "window.ran = 1";
    document.body.append(script);
    const image = document.createElement("img");
    image.setAttribute("onerror", "window.ran = 1");
    image.src = "x.png";
    document.body.append(image);
  });
  const sent = await tab.evaluate(() => fetch("https://example.invalid/").then(() => "sent", () => "refused"));
  await tab.waitForTimeout(100);
  assert.equal(sent, "refused");
  assert.equal(await tab.evaluate(() => window.ran), undefined);
  assert.ok(wrong.length > 0 && wrong.every((one) => /Content Security Policy|x\.png$/.test(one)), wrong.join("\n"));
  await close();
});
