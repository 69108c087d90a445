// The timeline and the plots, with a mouse, with fingers and with keys.

import assert from "node:assert/strict";
import { after, test } from "node:test";

import { area, browser, data, json, open, page, range, recording, texts, timeAt } from "./browser.mjs";

after(() => browser.close());

const log = recording("finished-while-moving");
const file = page(log);
const check = json(log);
const finding = check.findings.find((one) => one.rule === "finished-while-moving");

/** Whether two times are the same but for a few pixels of a stretch. */
const near = (a, b, stretch) => assert.ok(Math.abs(a - b) < stretch / 100, `${a} is not about ${b}`);

/** How many pixels of a plot have a color. */
const ink = (tab, id) => tab.locator(`#plot-${id} canvas`).evaluate((canvas) => {
  const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
  let colored = 0;
  for (let i = 0; i < data.length; i += 4) {
    if (data[i + 3] > 100 && Math.max(data[i], data[i + 1], data[i + 2]) - Math.min(data[i], data[i + 1], data[i + 2]) > 60) colored++;
  }
  return colored;
});

test("a mouse drags out a stretch, and a double click shows all", async () => {
  const { tab, wrong, close } = await open(file);
  await tab.evaluate(() => document.getElementById("timeline").scrollIntoView());
  const [from, to] = await range(tab);
  near(from, 0, check.duration_s);
  near(to, check.duration_s, check.duration_s);
  const { left, right, top } = await area(tab);
  const at = (share) => left + (right - left) * share;
  await tab.mouse.move(at(0.4), top + 80);
  await tab.mouse.down();
  await tab.mouse.move(at(0.6), top + 80, { steps: 5 });
  await tab.mouse.up();
  const [begin, end] = await range(tab);
  near(begin, check.duration_s * 0.4, check.duration_s);
  near(end, check.duration_s * 0.6, check.duration_s);
  await tab.mouse.dblclick(at(0.5), top + 80);
  const [again] = await range(tab);
  near(again, 0, check.duration_s);
  assert.deepEqual(wrong, []);
  await close();
});

test("Ctrl and the wheel zoom around the mouse, and Shift and a drag pan", async () => {
  const { tab, close } = await open(file);
  await tab.evaluate(() => document.getElementById("timeline").scrollIntoView());
  const { left, right, top } = await area(tab);
  const middle = (left + right) / 2;
  const before = await timeAt(tab, middle, top + 80);
  await tab.keyboard.down("Control");
  await tab.mouse.wheel(0, -700);
  await tab.keyboard.up("Control");
  const [from, to] = await range(tab);
  assert.ok(to - from < check.duration_s / 3, `${from} to ${to}`);
  near(await timeAt(tab, middle, top + 80), before, to - from);
  await tab.keyboard.down("Shift");
  await tab.mouse.down();
  await tab.mouse.move(middle + 200, top + 80, { steps: 4 });
  await tab.mouse.up();
  await tab.keyboard.up("Shift");
  const [panned] = await range(tab);
  near(panned, from - ((to - from) * 200) / (right - left), to - from);
  await close();
});

test("one cursor for all: the state, the lanes, each line's value and why not", async () => {
  const { tab, close } = await open(file);
  const says = data(file);
  await tab.evaluate(() => document.getElementById("timeline").scrollIntoView());
  const { left, right, top } = await area(tab);
  for (const share of [0.2, 0.4, 0.75]) {
    const t = await timeAt(tab, left + (right - left) * share, top + 80);
    const stay = check.stays.find((one) => one.since <= t && t < one.until);
    const panel = await tab.locator(".panel").textContent();
    assert.ok(panel.includes(`${stay.state} since ${stay.since.toFixed(3)} s`), panel);
    assert.match(await tab.locator(".lanes").getAttribute("aria-valuetext"), new RegExp(`^${t.toFixed(3)} s, ${stay.state}$`));
    for (const arrow of stay.arrows) {
      assert.ok(panel.includes(`→ ${arrow.to} ${arrow.section}`), panel);
      const blocked = arrow.blocked.find((one) => one.since <= t && t < one.until);
      for (const one of blocked?.failed ?? []) assert.ok(panel.includes(`✗ needs ${one.needs}: ${one.seen}`), panel);
      for (const one of blocked?.unknown ?? []) assert.ok(panel.includes(`? needs ${one.needs}`), panel);
    }
    for (const lane of says.lanes) {
      const [, place] = lane.spans.findLast(([from]) => from <= t * 1e6) ?? [];
      if (place === undefined) continue;
      const at = await tab.locator(".lanes-said dt", { hasText: new RegExp(`^${lane.title.replace(/[()]/g, "\\$&")}$`) }).first().locator("xpath=following-sibling::dd[1]").textContent();
      assert.equal(at, place < 0 ? "not known" : lane.words[place][0], lane.title);
    }
    const speed = await tab.locator("#plot-wheels output").first().textContent();
    assert.match(speed, /^\d+(\.\d+)?$/);
  }
  await close();
});

test("every plot is drawn, and a click on a line's name hides it", async () => {
  const { tab, close } = await open(file);
  for (const { id } of data(file).plots) {
    await tab.locator(`#plot-${id}`).scrollIntoViewIfNeeded();
    await tab.waitForTimeout(80);
    assert.ok((await ink(tab, id)) > 200, id);
  }
  const line = tab.locator("#plot-handshake button.line");
  await line.click();
  await tab.waitForTimeout(80);
  assert.equal(await line.getAttribute("aria-pressed"), "false");
  assert.ok((await ink(tab, "handshake")) < 50);
  await close();
});

test("keys move the cursor, zoom, and go from finding to finding", async () => {
  const { tab, close } = await open(file);
  const stack = tab.locator(".lanes");
  const now = async () => {
    await tab.waitForTimeout(60);
    return Number(await stack.getAttribute("aria-valuenow"));
  };
  await stack.focus();
  await stack.press("End");
  near(await now(), check.duration_s, 1);
  await stack.press("Home");
  assert.equal(await now(), 0);
  await stack.press("Shift+ArrowRight");
  const first = await now();
  near(first, check.duration_s * 0.05, check.duration_s);
  await stack.press("+");
  await stack.press("+");
  await stack.press("Shift+ArrowRight");
  near((await now()) - first, check.duration_s * 0.0125, check.duration_s);
  await stack.press("0");
  await stack.press("Home");
  await stack.press("n");
  assert.equal(await tab.locator(".detail:not([hidden])").count(), 1);
  near(await now(), finding.t, 0.1);
  await tab.keyboard.press("n");
  assert.equal(await tab.locator(".detail:not([hidden])").count(), 2);
  await tab.keyboard.press("p");
  near(await now(), finding.t, 0.1);
  await tab.keyboard.press("/");
  assert.equal(await tab.evaluate(() => document.activeElement.id), "filter");
  await tab.keyboard.type("n+0");
  assert.equal(await tab.locator("#filter").inputValue(), "n+0", "letters in a field are letters");
  await close();
});

test("findings are filtered by words, severity and party, and open with all that is known", async () => {
  const { tab, close } = await open(file);
  const shown = () => texts(tab, ".findings tbody tr:not(.detail):not([hidden]) td:nth-child(5)");
  const serious = check.findings.filter((one) => one.severity !== "note");
  assert.deepEqual(await shown(), serious.map((one) => one.rule));
  await tab.getByLabel(/notes/).check();
  assert.deepEqual(await shown(), check.findings.map((one) => one.rule));
  await tab.locator("#filter").fill("vcu 524h");
  assert.deepEqual(await shown(), ["start-value"]);
  assert.equal(await tab.locator("#findings [role=status]").textContent(), `1 of ${check.findings.length} findings shown`);
  await tab.locator("#filter").fill("");
  await tab.locator("#findings select").selectOption("AI");
  assert.deepEqual(await shown(), check.findings.filter((one) => one.party === "AI").map((one) => one.rule));
  await tab.locator("tr.violation:not([hidden]) button").click();
  const detail = await tab.locator(".detail:not([hidden])").textContent();
  for (const text of [finding.seen, finding.expected, finding.unless]) assert.ok(detail.includes(text), text);
  for (const id of finding.requirements) assert.ok(detail.includes(`${id} ${data(file).requirements[id]}`), id);
  assert.ok(detail.includes("MISSION_STATUS: RUNNING → FINISHED"), detail);
  await close();
});

test("a mark in the timeline opens its finding, even one that the filter hides", async () => {
  const { tab, close } = await open(file);
  await tab.locator("#filter").fill("nothing has this");
  await tab.evaluate(() => document.getElementById("timeline").scrollIntoView());
  const { left, right, top } = await area(tab);
  await tab.mouse.click(left + ((right - left) * finding.t) / check.duration_s, top + 34);
  await tab.waitForTimeout(100);
  assert.equal(await tab.locator(".detail:not([hidden])").count(), 1);
  await close();
});

test("each question has an answer, and one click shows where it is from", async () => {
  const { tab, close } = await open(file);
  const questions = data(file).questions;
  assert.equal(questions.length, 10);
  assert.deepEqual(await texts(tab, ".questions dd > span"), questions.map((one) => one.answer.replace(/\s+/g, " ")));
  for (const [place, one] of questions.entries()) {
    await tab.locator(".answer button").nth(place).click();
    await tab.waitForTimeout(80);
    if (one.at !== null) near(Number(await tab.locator(".lanes").getAttribute("aria-valuenow")), one.at / 1e6, 0.1);
    const target = one.show === "findings" ? "#findings" : (await tab.locator(`#plot-${one.show}`).count()) ? `#plot-${one.show}` : "#timeline";
    const box = await tab.locator(target).boundingBox();
    assert.ok(box.y < 900 && box.y + box.height > 0, `${one.question}: ${target} is not on the screen`);
  }
  await close();
});

test("on a phone nothing is wider than the screen, a finger moves the cursor, and two zoom", async () => {
  const { tab, wrong, close } = await open(file, { viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true, deviceScaleFactor: 2 });
  await tab.locator("tr.violation button").first().click();
  await tab.waitForTimeout(100);
  assert.ok((await tab.evaluate(() => document.documentElement.scrollWidth)) <= 390);
  await tab.getByRole("button", { name: "The whole recording" }).click();
  await tab.evaluate(() => document.getElementById("timeline").scrollIntoView());
  const { left, right, top } = await area(tab);
  const middle = (left + right) / 2;
  await tab.touchscreen.tap(middle, top + 100);
  await tab.waitForTimeout(100);
  near(Number(await tab.locator(".lanes").getAttribute("aria-valuenow")), check.duration_s / 2, check.duration_s);
  const session = await tab.context().newCDPSession(tab);
  const touch = (type, ...places) => session.send("Input.dispatchTouchEvent", { type, touchPoints: places.map((x, id) => ({ x, y: top + 100, id })) });
  await touch("touchStart", middle - 20, middle + 20);
  for (let wide = 20; wide <= 120; wide += 10) await touch("touchMove", middle - wide, middle + wide);
  await touch("touchEnd");
  await tab.touchscreen.tap(left + 4, top + 100);
  await tab.waitForTimeout(100);
  const from = Number(await tab.locator(".lanes").getAttribute("aria-valuenow"));
  assert.ok(from > check.duration_s * 0.2, `${from} s is still the left edge`);
  assert.deepEqual(wrong, []);
  await close();
});

test("it can be printed, with what nobody has looked at yet", async () => {
  const { tab, wrong, close } = await open(file);
  assert.equal(await tab.locator("#plot-periods canvas").count(), 0, "it is far below the screen");
  await tab.evaluate(() => dispatchEvent(new Event("beforeprint")));
  for (const { id } of data(file).plots) assert.ok((await ink(tab, id)) > 200, id);
  await tab.evaluate(() => dispatchEvent(new Event("afterprint")));
  const pdf = await tab.pdf({ format: "A4" });
  assert.ok(pdf.length > 100_000, `${pdf.length} bytes`);
  assert.deepEqual(wrong, []);
  await close();
});
