// Figures of the page: how large a file is, how soon the first picture is there, and how long a frame takes while an hour is zoomed.

import { statSync, createReadStream, createWriteStream } from "node:fs";
import { createInterface } from "node:readline";
import { join } from "node:path";
import { once } from "node:events";
import { pathToFileURL } from "node:url";

import { browser, folder, page, recording, root } from "./tests/browser.mjs";

/** The mission over and over, until it is an hour. */
async function hour() {
  const log = join(folder, "hour.log");
  const out = createWriteStream(log);
  let at = 0;
  while (at < 3600) {
    let [first, last] = [undefined, 0];
    for await (const line of createInterface({ input: createReadStream(join(root, recording("mission"))) })) {
      const time = Number.parseFloat(line.slice(1));
      first ??= time;
      last = time - first;
      if (!out.write(`(${(1.7e9 + at + last).toFixed(6)})${line.slice(line.indexOf(")") + 1)}\n`)) await once(out, "drain");
    }
    at += last + 0.01;
  }
  out.end();
  await once(out, "close");
  return log;
}

const median = (list) => list.toSorted((a, b) => a - b)[Math.floor(list.length / 2)];
const frame = (list) => `${median(list).toFixed(1)} ms (median), ${percentile(list, 0.95).toFixed(1)} ms (95 %), ${Math.max(...list).toFixed(1)} ms (longest)`;
const percentile = (list, share) => list.toSorted((a, b) => a - b)[Math.min(Math.floor(list.length * share), list.length - 1)];

async function measured(name, log) {
  const file = page(log);
  const opened = [];
  let frames = [];
  let all = 0;
  for (let i = 0; i < 5; i++) {
    const context = await browser.newContext({ viewport: { width: 1400, height: 900 } });
    const tab = await context.newPage();
    await tab.goto(pathToFileURL(file).href, { waitUntil: "commit" });
    await tab.waitForFunction(() => document.documentElement.dataset.ready === "yes", null, { timeout: 120_000 });
    const mark = (name) => tab.evaluate((name) => performance.getEntriesByName(name)[0].startTime, name);
    opened.push(await mark("adsdv-first-picture"));
    all = await mark("adsdv-every-frame");
    if (i === 4) frames = await zoomed(tab);
    await context.close();
  }
  const bytes = statSync(file).size;
  console.log(`${name}: ${bytes.toLocaleString("en")} bytes; first picture ${median(opened).toFixed(0)} ms (5 times), every frame ${all.toFixed(0)} ms; `
    + `while zooming: work of a frame ${frame(frames.work)}; from frame to frame ${frame(frames.between)}`);
}

/** Zooms from all to a second and back, a step a frame, and tells how long the script and the drawing of each frame took. */
async function zoomed(tab) {
  await tab.evaluate(() => document.getElementById("timeline").scrollIntoView());
  await tab.locator(".lanes").focus();
  await tab.waitForTimeout(500);
  return tab.evaluate(async () => {
    const stack = document.querySelector(".stack");
    const box = stack.getBoundingClientRect();
    const frame = () => new Promise((next) => requestAnimationFrame(next));
    const times = { work: [], between: [] };
    let last = await frame().then(() => performance.now());
    for (const by of [-60, 60]) {
      for (let i = 0; i < 70; i++) {
        stack.dispatchEvent(new WheelEvent("wheel", { deltaY: by, ctrlKey: true, clientX: box.left + 700, clientY: box.top + 100, cancelable: true }));
        await frame();
        times.between.push(performance.now() - last);
        last = performance.now();
        // The callbacks of this frame have begun; what follows them ends its work.
        const begun = performance.now();
        await new Promise((done) => {
          const channel = new MessageChannel();
          channel.port1.onmessage = done;
          channel.port2.postMessage(0);
        });
        times.work.push(performance.now() - begun);
      }
    }
    return times;
  });
}

await measured("mission.log", recording("mission"));
await measured("an hour", await hour());
await browser.close();
