// axe finds nothing against it: each view, in light and in dark, on a wide screen and on a phone; and a keyboard is enough.

import assert from "node:assert/strict";
import { after, test } from "node:test";

import { axe, begin, browser, choose, ready, recording, written } from "./web.mjs";

after(() => browser.close());

const views = {
  "the beginning": async () => {},
  "a list": async (tab) => {
    await choose(tab, recording("mission"), recording("finished-while-moving"), written("none.txt", "x\n"));
    await ready(tab);
  },
  "a report": async (tab) => {
    await choose(tab, recording("finished-while-moving"));
    await ready(tab);
    await tab.locator(".settings summary").click();
  },
  "what is no log": async (tab) => {
    await choose(tab, written("none.txt", "x\n"));
    await tab.getByRole("alert").waitFor();
  },
  "the car": async (tab) => {
    await tab.getByRole("button", { name: "Virtual car" }).click();
    for (const key of ["tsms", "asms", "remote_estop"]) await tab.locator(`[data-switch="${key}"]`).click();
    await tab.locator('[data-slip="asks-for-torque"]').click();
    await tab.waitForTimeout(500);
  },
};

for (const [name, go] of Object.entries(views)) {
  test(`${name}: in light and dark, wide and narrow`, async () => {
    for (const colorScheme of ["light", "dark"]) {
      for (const width of [1400, 390]) {
        const { tab, wrong, close } = await begin(undefined, { colorScheme, viewport: { width, height: 900 } });
        await go(tab);
        await tab.evaluate(axe);
        const { violations } = await tab.evaluate(() => globalThis.axe.run());
        assert.deepEqual(violations.map((one) => `${one.id}: ${one.help}: ${one.nodes.slice(0, 3).map((node) => node.html.slice(0, 160)).join(" | ")}`), [], `${colorScheme}, ${width} wide`);
        const [inner, all] = await tab.evaluate(() => [document.documentElement.clientWidth, document.documentElement.scrollWidth]);
        assert.ok(all <= inner, `${name} is ${all} wide on a screen of ${inner}`);
        assert.deepEqual(wrong, []);
        await close();
      }
    }
  });
}

test("with a keyboard alone an example is opened and the car is switched on", async () => {
  const { tab, close } = await begin();
  const focus = async (test) => {
    for (let step = 0; step < 80; step++) {
      await tab.keyboard.press("Tab");
      if (await tab.evaluate(test)) return;
    }
    assert.fail("it cannot be reached");
  };
  await focus(() => document.activeElement.dataset.example === "finished");
  await tab.keyboard.press("Enter");
  await ready(tab);
  assert.match(await tab.title(), /violates$/);
  await tab.keyboard.press("n");
  await tab.waitForFunction(() => document.querySelector(".detail:not([hidden])"));
  await tab.getByRole("button", { name: "Virtual car" }).focus();
  await tab.keyboard.press("Enter");
  await focus(() => document.activeElement.dataset.action === "asms on");
  await tab.keyboard.press("Enter");
  await tab.waitForFunction(() => document.querySelector('[data-switch="asms"]').getAttribute("aria-pressed") === "true");
  await close();
});
