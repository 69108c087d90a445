// What the tests share: logs, pages made of them by adsdv, and a browser that opens them.

import { execFileSync, spawnSync } from "node:child_process";
import { mkdtempSync, readFileSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import { chromium } from "playwright-core";

export const root = new URL("../../..", import.meta.url).pathname;
const adsdv = process.env.ADSDV ?? join(root, "target/debug/adsdv");
export const folder = mkdtempSync(join(tmpdir(), "adsdv-page-"));

/** A recording of the repository. */
export const recording = (name) => `tests/logs/${name}.log`;

/** What adsdv prints; whatever its verdict. */
export function run(...args) {
  const { status, stdout, stderr } = spawnSync(adsdv, args, { cwd: root, encoding: "utf8", maxBuffer: 1 << 30 });
  if (status === null || status > 1) throw new Error(`adsdv ${args.join(" ")}: ${stderr}`);
  return stdout;
}

/** A log that a scenario drives. */
export function driven(scenario, edition) {
  const log = join(folder, `${scenario}-${edition}.log`);
  run("demo", "--edition", edition, "--scenario", join(root, "can/scenarios", `${scenario}.txt`), "--log", log);
  return log;
}

/** A log that is written here. */
export function written(name, text) {
  const log = join(folder, name);
  writeFileSync(log, text);
  return log;
}

/** The report of a log for programs. */
export const json = (log, ...more) => JSON.parse(run("check", "--json", ...more, log));

/** The page of a log. */
export function page(log, ...more) {
  const file = join(folder, `${Math.random().toString(36).slice(2)}.html`);
  run("check", "--html", file, ...more, log);
  return file;
}

/** A page of a template and of data that nobody made. */
export function template(name, data) {
  const file = join(folder, `${Math.random().toString(36).slice(2)}.html`);
  const text = JSON.stringify(data).replaceAll("<", "\\u003c");
  writeFileSync(file, readFileSync(join(root, `report/page/dist/${name}.html`), "utf8").replace('"adsdv-data"', () => text));
  return file;
}

/** The object of data in a page. */
export function data(file) {
  const [, text] = /id="data">(.*?)<\/script>/s.exec(readFileSync(file, "utf8"));
  return JSON.parse(text);
}

export const browser = await chromium.launch({
  executablePath: process.env.CHROMIUM ?? execFileSync("sh", ["-c", "command -v chromium || command -v chromium-browser"], { encoding: "utf8" }).trim(),
  args: ["--no-sandbox"],
});

/** Opens a page, and waits until its element `html` says so. What it asks of a network, and what goes wrong in it, is an error. */
export async function opened(url, begun, options) {
  const context = await browser.newContext({ viewport: { width: 1400, height: 900 }, reducedMotion: "reduce", ...options });
  const tab = await context.newPage();
  const wrong = [];
  tab.on("request", (request) => request.url() !== url && !/^(blob|data):/.test(request.url()) && wrong.push(`it asks for ${request.url()}`));
  tab.on("console", (message) => ["error", "warning"].includes(message.type()) && wrong.push(message.text()));
  tab.on("pageerror", (error) => wrong.push(String(error)));
  tab.on("dialog", (dialog) => {
    wrong.push(`a dialog: ${dialog.message()}`);
    void dialog.dismiss();
  });
  await tab.goto(url);
  await tab.waitForFunction((begun) => document.documentElement.dataset[begun] === "yes", begun);
  return { tab, wrong, close: () => context.close() };
}

/** Opens the page of a report, and waits until every frame is unpacked. */
export const open = (file, options = {}) => opened(pathToFileURL(file).href, "ready", options);

/** The texts of all elements. */
export const texts = (tab, selector) => tab.locator(selector).evaluateAll((all) => all.map((one) => one.textContent.trim().replace(/\s+/g, " ")));

/** Where the timeline is drawn, on the screen. */
export async function area(tab) {
  const box = await tab.locator(".lanes").boundingBox();
  const gutter = await tab.evaluate(() => Number.parseFloat(getComputedStyle(document.documentElement).getPropertyValue("--gutter")) || 0);
  return { left: box.x + gutter + 48, right: box.x + box.width - 14, top: box.y, height: box.height };
}

/** The time under a place of the screen, in seconds. */
export async function timeAt(tab, x, y) {
  await tab.mouse.move(x - 3, y);
  await tab.mouse.move(x, y);
  await tab.waitForTimeout(60);
  return Number(await tab.locator(".lanes").getAttribute("aria-valuenow"));
}

/** From when to when the timeline shows. */
export async function range(tab) {
  const { left, right, top } = await area(tab);
  return [await timeAt(tab, left + 1, top + 60), await timeAt(tab, right - 1, top + 60)];
}
