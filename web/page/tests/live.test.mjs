// `adsdv watch --web`: the frames of a bus in the page, judged there while they come; broken connections, restarts, and the end.

import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { readFileSync } from "node:fs";
import { connect, createServer } from "node:net";
import { join } from "node:path";
import { after, test } from "node:test";

import { axe, begin, browser, expected, findings, json, ready, recording, root } from "./web.mjs";

after(() => browser.close());

const lines = (name) => readFileSync(join(root, recording(name)), "utf8").trimEnd().split("\n");
const pause = (ms) => new Promise((done) => setTimeout(done, ms));

/** The command, which hears what is written to it. */
async function watch(...options) {
  const child = spawn(process.env.ADSDV ?? join(root, "target/debug/adsdv"), ["watch", "-", "--web", "--port", "0", ...options], { cwd: root });
  child.stdout.resume();
  const said = await new Promise((done, failed) => {
    let text = "";
    child.stderr.on("data", (data) => {
      text += data;
      if (text.includes("\n")) done(text);
    });
    child.once("exit", () => failed(new Error("it ended")));
  });
  const [, port] = /^http:\/\/127\.0\.0\.1:(\d+)\/ shows it\n$/.exec(said);
  return {
    port: Number(port),
    url: `http://127.0.0.1:${port}/`,
    write: (some) => new Promise((done) => child.stdin.write(some.map((line) => `${line}\n`).join(""), done)),
    end: () => child.stdin.end(),
    kill: () => new Promise((done) => (child.once("exit", done), child.kill())),
  };
}

/** The page, whose own requests for the stream are no mistake. */
async function page(url) {
  const opened = await begin(url);
  await ready(opened.tab);
  const wrong = () => opened.wrong.filter((one) => one !== `it asks for ${url}live`);
  const heard = (count) => opened.tab.waitForFunction((count) => document.documentElement.dataset.heard === String(count), count, { timeout: 60_000 });
  return { ...opened, wrong, heard };
}

test("a log that is piped in is judged in the page as it comes: the finding, the state, Figure 2, what the car waits for, the end", async () => {
  const bus = await watch();
  try {
    const log = lines("finished-while-moving");
    const { tab, wrong, heard, close } = await page(bus.url);
    assert.match(await tab.locator("#link").textContent(), /Connected/);
    // Up to AS_DRIVING, some seconds before FINISHED comes too early.
    const first = Number(/\((.*?)\)/.exec(log[0])[1]);
    const until = (t) => log.findIndex((line) => Number(/\((.*?)\)/.exec(line)[1]) - first > t);
    await bus.write(log.slice(0, until(8)));
    await heard(until(8));
    assert.equal(await tab.locator("#lamp strong").textContent(), "AS_READY");
    assert.equal(await tab.locator(".figure2 .current").textContent(), "AS_READYyellow, continuous");
    assert.match(await tab.locator("#waits").textContent(), /→ AS_DRIVING 3\.2\? needs "Go" signal OFF -> ON: not known \(operator\)/);
    assert.match(await tab.locator("#guard").textContent(), /\? ?not known: +"Go" signal OFF -> ON/);
    assert.match(await tab.locator("#live-verdict").textContent(), /no violation so far/);
    assert.match(await tab.locator('[data-id="1312"] .says').textContent(), /AS_STATE: AS_READY/);
    await bus.write(log.slice(until(8)));
    bus.end();
    await tab.waitForFunction(() => document.documentElement.dataset.ended === "yes");
    await heard(log.length);
    assert.match(await tab.locator("#link").textContent(), /The stream has ended: no more frames come/);
    const check = json(recording("finished-while-moving"));
    const violations = check.findings.filter((one) => one.severity === "violation");
    assert.deepEqual((await tab.locator("#happened .violation strong").allTextContents()).length, violations.length);
    const happened = await tab.locator("#happened").textContent();
    for (const one of violations) assert.ok(happened.includes(`${one.t.toFixed(3)} s ▲ violation by ${one.party} (${one.section}): ${one.message}`), happened);
    assert.equal(await tab.locator("#happened .change").count(), check.transitions.length);
    await tab.evaluate(axe);
    const { violations: against } = await tab.evaluate(() => globalThis.axe.run());
    assert.deepEqual(against.map((one) => `${one.id}: ${one.nodes[0].html}`), []);
    // And the whole report of it.
    await tab.locator("#judge-live").click();
    await ready(tab);
    assert.deepEqual(await findings(tab), expected(check));
    assert.deepEqual(wrong(), []);
    await close();
  } finally {
    await bus.kill();
  }
});

test("who opens the page late gets what was heard before, also when the frames have ended", async () => {
  const bus = await watch("--edition", "3.0");
  try {
    const log = lines("mission");
    await bus.write(log);
    bus.end();
    const { tab, wrong, heard, close } = await page(bus.url);
    await heard(log.length);
    await tab.waitForFunction(() => document.documentElement.dataset.ended === "yes");
    assert.match(await tab.locator("#facts").textContent(), /33,940 frames; interface vcan0; edition 3\.0/);
    assert.equal(await tab.locator("#happened .change").count(), 4);
    assert.deepEqual(wrong(), []);
    await close();
  } finally {
    await bus.kill();
  }
});

test("no frame is lost or doubled at 4000 frames a second, with a connection that breaks twice; the page says so and connects again", async () => {
  const bus = await watch();
  const sockets = new Set();
  // What is between them can break, as a program on this machine may not.
  const proxy = createServer((client) => {
    const server = connect(bus.port, "127.0.0.1");
    for (const one of [client, server]) {
      sockets.add(one);
      one.on("error", () => undefined).on("close", () => (client.destroy(), server.destroy(), sockets.delete(one)));
    }
    client.on("data", (data) => server.write(String(data).replaceAll(`127.0.0.1:${proxy.address().port}`, `127.0.0.1:${bus.port}`)));
    server.pipe(client);
  });
  await new Promise((done) => proxy.listen(0, "127.0.0.1", done));
  try {
    const { tab, heard, close } = await page(`http://127.0.0.1:${proxy.address().port}/`);
    const log = lines("mission");
    const [every, piece] = [50, 200];
    const begun = Date.now();
    let sent = 0;
    let breaks = 0;
    while (sent < 30_000) {
      await bus.write(log.slice(sent, sent + piece));
      sent += piece;
      if (sent === 8_000 || sent === 16_000) {
        breaks++;
        sockets.forEach((one) => one.destroy());
        await tab.waitForFunction(() => document.getElementById("link").className.includes("bad"));
        assert.match(await tab.locator("#link").textContent(), /broken; connecting again/);
      }
      await pause(Math.max(0, begun + (sent / piece) * every - Date.now()));
    }
    const rate = (1000 * sent) / (Date.now() - begun);
    assert.ok(rate > 3500, `${rate} frames a second`);
    await heard(sent);
    assert.equal(breaks, 2);
    assert.match(await tab.locator("#link").textContent(), /Connected/);
    assert.equal(await tab.locator("#lost").textContent(), "");
    await close();
  } finally {
    proxy.close();
    sockets.forEach((one) => one.destroy());
    await bus.kill();
  }
});

test("an interface that looks like a script is text, and the page can ask nobody but its own server", async () => {
  const bus = await watch();
  const image = "<img/src=x/onerror=window.ran=1>";
  try {
    const { tab, close, heard } = await page(bus.url);
    const made = Array.from({ length: 3000 }, (_, cycle) => `(${(1 + cycle / 100).toFixed(6)}) ${image} 520#0${cycle % 2}00010000000000`);
    await bus.write(made);
    await heard(made.length);
    assert.match(await tab.locator("#facts").textContent(), /interface <img/);
    assert.equal(await tab.locator("img").count(), 0);
    assert.equal(await tab.evaluate(() => window.ran), undefined);
    const asked = (url) => tab.evaluate((url) => fetch(url).then((answer) => answer.status, () => "refused"), url);
    assert.equal(await asked("https://example.invalid/"), "refused");
    assert.equal(await asked(`http://127.0.0.1:${bus.port + 1}/`), "refused");
    assert.equal(await asked("/nothing"), 404);
    await close();
  } finally {
    await bus.kill();
  }
});
