// The pictures of docs/web.md, small enough for a repository.

import { spawn } from "node:child_process";
import { copyFileSync, mkdirSync, readFileSync } from "node:fs";
import { join } from "node:path";

import { begin, browser, choose, driven, folder, ready, recording, root } from "./tests/web.mjs";

const docs = join(root, "docs/web");
mkdirSync(docs, { recursive: true });

async function shot(name, options, act) {
  const { tab, close } = await begin(undefined, options);
  await act(tab);
  await tab.waitForTimeout(300);
  await tab.screenshot({ path: join(docs, `${name}.png`) });
  await close();
}

/** A bus that is watched, and what it has come to. */
async function live() {
  const child = spawn(process.env.ADSDV, ["watch", "-", "--web", "--port", "0"], { cwd: root });
  child.stdout.resume();
  const url = await new Promise((done) => {
    let text = "";
    child.stderr.on("data", (data) => (text += data).includes("\n") && done(/http:\S+/.exec(text)[0]));
  });
  child.stdin.write(readFileSync(join(root, recording("finished-while-moving")), "utf8").split("\n").slice(0, 14_000).join("\n"));
  const { tab, close } = await begin(url, { viewport: { width: 1000, height: 760 } });
  await tab.waitForFunction(() => Number(document.documentElement.dataset.heard) > 13_000);
  await tab.waitForTimeout(300);
  await tab.screenshot({ path: join(docs, "live.png") });
  await close();
  child.kill();
}

const wide = { viewport: { width: 1000, height: 640 } };
const car = async (tab) => {
  await tab.getByRole("button", { name: "Virtual car" }).click();
  await tab.selectOption("#car-speed", "5");
  await tab.selectOption("#car-scenario", "mission");
  await tab.waitForFunction(() => document.querySelector("#lamp strong")?.textContent === "AS_DRIVING", undefined, { timeout: 30_000 });
  await tab.selectOption("#car-speed", "1");
};

await shot("start", { viewport: { width: 1000, height: 660 } }, async () => {});
await shot("edition", wide, async (tab) => {
  await choose(tab, driven("mission", "2026"));
  await ready(tab);
  await tab.locator(".settings summary").click();
  await tab.selectOption("#reading-go-signal", "raw");
  await tab.waitForFunction(() => document.getElementById("before").textContent !== "");
  await ready(tab);
  await tab.locator(".settings summary").click();
  await tab.evaluate(() => {
    document.activeElement?.blur();
    scrollTo(0, 0);
  });
});
await shot("folder", { viewport: { width: 1000, height: 400 } }, async (tab) => {
  const runs = join(folder, "runs");
  mkdirSync(runs, { recursive: true });
  copyFileSync(join(root, recording("mission")), join(runs, "run 1.log"));
  copyFileSync(join(root, recording("finished-while-moving")), join(runs, "run 2.log"));
  copyFileSync(driven("remote-estop", "2026"), join(runs, "run 3.log"));
  copyFileSync(join(root, "formats/tests/samples/python-can.blf"), join(runs, "run 4.blf"));
  copyFileSync(join(root, "LICENSE-MIT"), join(runs, "licence.txt"));
  await tab.setInputFiles("#folder", runs);
  await ready(tab);
});
await shot("car", { viewport: { width: 1100, height: 620 } }, car);
await live();
await shot("figure2", { viewport: { width: 1100, height: 560 } }, async (tab) => {
  await car(tab);
  await tab.evaluate(() => document.getElementById("figure2").scrollIntoView());
});
await shot("judged", { viewport: { width: 1100, height: 620 }, colorScheme: "dark" }, async (tab) => {
  await car(tab);
  await tab.waitForTimeout(1500);
  await tab.locator('[data-slip="says-finished"]').click();
  await tab.waitForFunction(() => document.querySelector("#live-verdict").textContent.startsWith("✗"));
  await tab.evaluate(() => document.getElementById("judged").scrollIntoView());
});
await shot("phone", { viewport: { width: 390, height: 760 }, isMobile: true, hasTouch: true }, car);
await browser.close();
