// What stands in a log and in its name is text, and nothing of it runs; and nothing can be sent.

import assert from "node:assert/strict";
import { after, test } from "node:test";

import { begin, browser, drop, ready } from "./web.mjs";

after(() => browser.close());

const SCRIPT = "</script><script>window.ran=1;alert(1)</script>";
const IMAGE = "<img/src=x/onerror=window.ran=1>";
const NAME = "<img src=x onerror=window.ran=1>.log";

function hostile() {
  const lines = [];
  for (let cycle = 0; cycle < 200; cycle++) {
    const time = (1 + cycle / 100).toFixed(6);
    lines.push(`(${time}) ${IMAGE} 520#0${cycle % 2}00010000000000`, `(${time}) ${IMAGE} 510#0${cycle % 2}00000000000000`);
  }
  lines.splice(50, 0, SCRIPT, `(1.2) ${SCRIPT} 7FF#00`);
  return `${lines.join("\n")}\n`;
}

test("a log and a name that look like scripts are shown as they are", async () => {
  const { tab, wrong, close } = await begin();
  await drop(tab, [[NAME, hostile()]]);
  await ready(tab);
  assert.equal(await tab.locator("h1").textContent(), NAME);
  assert.ok((await tab.locator("header").textContent()).includes(IMAGE));
  await tab.getByRole("button", { name: "Judge a log" }).click();
  await drop(tab, [[NAME, hostile()], [`2${NAME}`, SCRIPT]]);
  await ready(tab);
  assert.ok((await tab.locator(".logs").textContent()).includes(NAME));
  assert.ok((await tab.locator(".logs").textContent()).includes(SCRIPT.slice(0, 20)));
  assert.equal(await tab.evaluate(() => window.ran), undefined);
  assert.equal(await tab.locator("img, iframe, object, embed").count(), 0);
  assert.equal(await tab.locator("script").count(), 3);
  assert.deepEqual(wrong, []);
  await close();
});

test("a script that gets onto the page all the same does not run, and nothing can be sent", async () => {
  const { tab, wrong, close } = await begin();
  await tab.evaluate(() => {
    const script = document.createElement("script");
    script.textContent = "window.ran = 1";
    document.body.append(script);
  });
  const sent = await tab.evaluate(() => fetch("https://example.invalid/").then(() => "sent", () => "refused"));
  const evaluated = await tab.evaluate(() => {
    const script = document.createElement("script");
    script.src = "data:text/javascript,window.ran=1";
    document.body.append(script);
    return new Promise((done) => (script.onerror = () => done("refused")));
  });
  assert.deepEqual([sent, evaluated, await tab.evaluate(() => window.ran)], ["refused", "refused", undefined]);
  assert.ok(wrong.length > 0 && wrong.every((one) => /Content Security Policy/.test(one)), wrong.join("\n"));
  await close();
});
