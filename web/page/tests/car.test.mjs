// The virtual car, driven by clicking.

import assert from "node:assert/strict";
import { after, test } from "node:test";

import { begin, browser, ready } from "./web.mjs";

after(() => browser.close());

async function car(options) {
  const opened = await begin(undefined, options);
  const { tab } = opened;
  await tab.getByRole("button", { name: "Virtual car" }).click();
  await tab.selectOption("#car-speed", "5");
  const lamp = tab.locator("#lamp strong");
  const state = (name) => tab.waitForFunction((name) => document.querySelector("#lamp strong")?.textContent === name, name, { timeout: 30_000 });
  const click = (key) => tab.locator(`[data-switch="${key}"]`).click();
  const set = (key, position) => tab.selectOption(`[data-switch="${key}"]`, position);
  const toReady = async () => {
    await set("ami", "TRACK_DRIVE");
    await set("ebs", "ARMED");
    await click("tsms");
    await click("asms");
    await state("AS_READY");
  };
  /** "Go", once all else is there. */
  const go = async () => {
    await tab.waitForFunction(() => document.querySelectorAll("#missing li").length === 1 && document.querySelector('#missing [data-action="go on"]'), undefined, { timeout: 30_000 });
    await tab.locator('#missing [data-action="go on"]').click();
    await state("AS_DRIVING");
  };
  return { ...opened, lamp, state, click, set, toReady, go };
}

test("a mission from AS_OFF to AS_FINISHED and back, by clicking; the judge finds nothing, live and afterwards", async () => {
  const { tab, wrong, close, state, click, toReady, go } = await car();
  await state("AS_OFF");
  assert.equal(await tab.locator("#missing p").textContent(), "AS_READY (3.1) still needs:");
  await toReady();
  await tab.waitForFunction(() => document.querySelector('[data-arrow="AS_OFF-AS_READY"]').classList.contains("taken"));
  assert.equal(await tab.locator(".figure2 .current").textContent(), "AS_READYyellow, continuous");
  assert.match(await tab.locator("#guard h3").textContent(), /^From AS_READY/);
  await go();
  assert.match(await tab.locator("#lamp").textContent(), /light: yellow, flashing/);
  assert.match(await tab.locator('[data-id="1312"] .says').textContent(), /AS_STATE: AS_DRIVING/);
  await state("AS_FINISHED");
  await click("asms");
  await state("AS_OFF");
  const happened = await tab.locator("#happened .change").allTextContents();
  assert.deepEqual(happened.map((text) => /(\S+ → \S+) /.exec(text)[1]).reverse(), ["AS_OFF → AS_READY", "AS_READY → AS_DRIVING", "AS_DRIVING → AS_FINISHED", "AS_FINISHED → AS_OFF"]);
  assert.ok(happened.every((text) => text.endsWith("✓ justified")), happened.join("\n"));
  assert.match(await tab.locator("#live-verdict").textContent(), /^✓ no violation so far/);
  await tab.locator("#judge-drive").click();
  await ready(tab);
  assert.match(await tab.title(), /: conforms$/);
  assert.match(await tab.locator("h1").textContent(), /^virtual car, edition 3\.0$/);
  assert.deepEqual(wrong, []);
  await close();
});

test("an emergency brake: the remote E-stop, then the EBS timer, then a power cycle, as the page says what is missing", async () => {
  const { tab, wrong, close, state, click, toReady, go } = await car();
  await toReady();
  await go();
  await click("remote_estop");
  await state("EMERGENCY_BRAKE");
  assert.match(await tab.locator("#lamp").textContent(), /light: blue, flashing/);
  assert.match(await tab.locator(".guard").textContent(), /EBS timer|timer/i);
  await click("remote_estop");
  await tab.locator('#missing [data-action="asms off"]').click();
  await state("AS_OFF");
  await tab.locator('#missing [data-action="power cycle"]').click();
  await state("no power");
  await state("AS_OFF");
  assert.equal(await tab.locator('#missing [data-action="power cycle"]').count(), 0);
  assert.match(await tab.locator("#live-verdict").textContent(), /^✓ no violation so far/);
  assert.deepEqual(wrong, []);
  await close();
});

test("a mistake of the AI Computer is a violation at once", async () => {
  const { tab, wrong, close, state, toReady, go } = await car();
  await toReady();
  await go();
  await tab.waitForTimeout(400);
  await tab.locator('[data-slip="says-finished"]').click();
  await state("EMERGENCY_BRAKE");
  await tab.waitForFunction(() => document.querySelector("#live-verdict").textContent.startsWith("✗ violates"));
  const violations = await tab.locator("#happened li.violation").allTextContents();
  assert.ok(violations.some((text) => /violation by AI .*FINISHED/.test(text)), violations.join("\n"));
  assert.equal(await tab.locator('[data-slip="says-finished"]').getAttribute("aria-pressed"), "true");
  assert.deepEqual(wrong, []);
  await close();
});

test("a scenario plays by itself, time can stand still, and each edition has its Figure 2", async () => {
  const { tab, wrong, close, state } = await car();
  await tab.selectOption("#car-edition", "2026");
  await tab.selectOption("#car-scenario", "mission");
  await state("AS_READY");
  await tab.getByRole("button", { name: "Pause" }).click();
  await tab.waitForTimeout(100);
  const moves = await tab.locator(".moves").textContent();
  await tab.waitForTimeout(300);
  assert.equal(await tab.locator(".moves").textContent(), moves);
  await tab.getByRole("button", { name: "Pause" }).click();
  await state("AS_FINISHED");
  const arrows = await tab.locator("[data-arrow]").count();
  assert.ok(arrows >= 9, String(arrows));
  await tab.locator('[data-arrow="AS_READY-AS_DRIVING"]').press("Enter");
  assert.match(await tab.locator("#guard").textContent(), /AS_READY → AS_DRIVING.*"Go" signal/s);
  assert.deepEqual(wrong, []);
  await close();
});
