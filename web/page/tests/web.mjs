// What the tests share: the page that was built afresh, opened from a disk, and the same from a site.

import { createRequire } from "node:module";
import { createServer } from "node:http";
import { readFileSync } from "node:fs";
import { dirname, join, resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { inflateRawSync } from "node:zlib";

import { opened, root } from "../../../report/page/tests/browser.mjs";

export { browser, driven, folder, json, recording, root, run, texts, written } from "../../../report/page/tests/browser.mjs";
export const { chromium } = createRequire(join(root, "report/page/package.json"))("playwright-core");
export const axe = readFileSync(createRequire(join(root, "report/page/package.json")).resolve("axe-core/axe.min.js"), "utf8");

/** The page that is checked in, and the one that was just built. */
export const checkedIn = join(root, "site/dist/adsdv.html");
export const fresh = resolve(root, process.env.FRESH ?? checkedIn);

/** Opens the page, and waits until it can be used. */
export const begin = (url = pathToFileURL(fresh).href, options = {}) => opened(url, "begun", { viewport: { width: 1300, height: 900 }, ...options });

/** Waits until what is shown is whole. */
export const ready = (tab) => tab.waitForFunction(() => document.documentElement.dataset.ready === "yes", undefined, { timeout: 60_000 });

/** Drops files, each with a name and its bytes, as a person does. */
export async function drop(tab, files) {
  const list = files.map(([name, bytes]) => [name, Buffer.from(bytes).toString("base64")]);
  const transfer = await tab.evaluateHandle((list) => {
    const transfer = new DataTransfer();
    for (const [name, text] of list) transfer.items.add(new File([Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0))], name));
    return transfer;
  }, list);
  await tab.dispatchEvent("#drop", "drop", { dataTransfer: transfer });
}

/** Chooses files of this machine. */
export const choose = (tab, ...files) => tab.setInputFiles("#file", files.map((file) => resolve(root, file)));

/** The findings that are shown. */
export const findings = (tab) => tab.locator(".findings tbody tr:not(.detail)").evaluateAll((all) => all.map((row) => [...row.cells].map((cell) => cell.textContent)));

/** Those of a report for programs, as they are to be shown. */
export function expected(check) {
  const signs = { violation: "▲", warning: "◆", note: "●" };
  return check.findings.map((one) => [`${one.t.toFixed(3)} s`, `${signs[one.severity]} ${one.severity}`, one.party, one.section, one.rule, one.message]);
}

/** The module in a page, answering as in a browser. */
export function moduleOf(page) {
  const [, packed] = /id="module">([^<]*)</.exec(readFileSync(page, "utf8"));
  const module = new WebAssembly.Module(inflateRawSync(Buffer.from(packed, "base64")));
  let bytes = Buffer.alloc(0);
  let at = 0;
  const read = (place, room) => {
    const some = bytes.subarray(at, at + room);
    new Uint8Array(exports.memory.buffer, place >>> 0, room).set(some);
    at += some.length;
    return some.length;
  };
  const { exports } = new WebAssembly.Instance(module, { host: { read } });
  return (request, log = Buffer.alloc(0)) => {
    [bytes, at] = [log, 0];
    const text = Buffer.from(JSON.stringify(request));
    const place = exports.into(text.length);
    new Uint8Array(exports.memory.buffer, place >>> 0, text.length).set(text);
    const refused = exports.call();
    const answer = Buffer.from(new Uint8Array(exports.memory.buffer, exports.out() >>> 0, exports.out_len() >>> 0)).toString();
    return { refused: refused !== 0, answer };
  };
}

/** A site that has the page, as one that is published; `asked` are the paths that it was asked for. */
export async function site() {
  const files = { "/": [fresh, "text/html; charset=utf-8"], "/sw.js": [join(dirname(fresh), "sw.js"), "text/javascript"] };
  const asked = [];
  const server = createServer((request, response) => {
    asked.push(request.url);
    const file = files[request.url];
    if (file) response.writeHead(200, { "Content-Type": file[1] }).end(readFileSync(file[0]));
    else response.writeHead(404).end();
  });
  await new Promise((done) => server.listen(0, "127.0.0.1", done));
  return { port: server.address().port, asked, close: () => new Promise((done) => (server.closeAllConnections(), server.close(done))) };
}
