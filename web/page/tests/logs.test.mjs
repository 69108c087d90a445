// A log that is dropped or chosen: what is shown is what `adsdv check --json` says of it.

import assert from "node:assert/strict";
import { copyFileSync, mkdirSync, readFileSync, readdirSync, writeFileSync } from "node:fs";
import { basename, join } from "node:path";
import { after, test } from "node:test";
import { gzipSync } from "node:zlib";

import { begin, browser, choose, drop, driven, expected, findings, folder, json, ready, recording, root, texts, written } from "./web.mjs";

after(() => browser.close());

for (const name of ["mission", "finished-while-moving"]) {
  test(`${name}.log, dropped: its findings are those of --json`, async () => {
    const { tab, wrong, close } = await begin();
    await drop(tab, [[`${name}.log`, readFileSync(join(root, recording(name)))]]);
    await ready(tab);
    const check = json(recording(name));
    assert.deepEqual(await findings(tab), expected(check));
    assert.equal(await tab.locator("h1").textContent(), `${name}.log`);
    const about = await tab.locator("header .about").first().textContent();
    assert.ok(about.startsWith(`${check.frames.toLocaleString("en")} frames in ${check.duration_s.toFixed(3)} s`) && about.includes(`edition ${check.edition}`), about);
    const states = await tab.locator("#states-table .scroll:nth-of-type(1) tbody tr").evaluateAll((all) => all.map((row) => row.cells[1].textContent));
    assert.deepEqual(states, check.transitions.map((one) => `${one.from} → ${one.to}`));
    assert.deepEqual(await texts(tab, "#margins tbody td:nth-child(2)"), check.margins.map((one) => one.what + (one.message ? ` ${one.message}` : "")));
    assert.deepEqual(wrong, []);
    await close();
  });
}

test("a log of every format that is read, and one that is compressed", async () => {
  const samples = join(root, "formats/tests/samples");
  const { tab, wrong, close } = await begin();
  const files = readdirSync(samples).filter((name) => /\.(asc|blf|trc|csv|log|mcap)(\.(gz|zst))?$/.test(name));
  const zipped = join(folder, "mission.log.gz");
  writeFileSync(zipped, gzipSync(readFileSync(join(root, recording("mission")))));
  const all = [...files.map((name) => join(samples, name)), zipped];
  assert.ok(new Set(files.map((name) => name.split(".").at(-1))).size >= 3, files.join(", "));
  await choose(tab, ...all);
  await ready(tab);
  const rows = await tab.locator(".logs tbody tr").evaluateAll((all) => all.map((row) => [...row.cells].map((cell) => cell.textContent)));
  const shown = new Map(rows.map(([name, verdict, violations, warnings, edition, , length]) => [name, [verdict, violations, warnings, edition, length]]));
  for (const file of all) {
    // The command reads these only where it was built so.
    if (file.endsWith(".mcap")) {
      assert.match(shown.get(basename(file))[0], /^[✓✗?] (conforms|violates|inconclusive)/, file);
      continue;
    }
    const check = json(file);
    const count = (severity) => String(check.findings.filter((one) => one.severity === severity).length);
    const sign = { conforms: "✓", violates: "✗" }[check.verdict] ?? "?";
    assert.deepEqual(shown.get(basename(file)), [`${sign} ${check.verdict}`, count("violation"), count("warning"), check.edition, `${check.duration_s.toFixed(3)} s`], file);
  }
  assert.deepEqual(wrong, []);
  await close();
});

test("another edition and other readings change the verdict as they do for the command", async () => {
  const log = driven("mission", "2026");
  const { tab, wrong, close } = await begin();
  await choose(tab, log);
  await ready(tab);
  assert.deepEqual(await findings(tab), expected(json(log)));
  const settle = async () => {
    await tab.waitForFunction(() => !document.querySelector(".busy"));
    await ready(tab);
  };
  const outcome = (check) => {
    const count = (severity) => check.findings.filter((one) => one.severity === severity).length;
    const counted = (severity) => `${count(severity)} ${severity}${count(severity) === 1 ? "" : "s"}`;
    return `by edition ${check.edition}: ${check.verdict}, ${counted("violation")}, ${counted("warning")}`;
  };
  const before = () => tab.locator("#before").textContent();

  // A reading that the edition leaves open, by which it is another verdict.
  await tab.locator(".settings summary").click();
  await tab.selectOption("#reading-go-signal", "raw");
  await settle();
  const [usual, pinned] = [json(log), json(log, "--edition", "2026", "--reading", "go-signal=raw")];
  assert.deepEqual([usual.verdict, pinned.verdict], ["conforms", "violates"]);
  assert.deepEqual(await findings(tab), expected(pinned));
  assert.equal(await before(), `Before, ${outcome(usual)}. Now, ${outcome(pinned)}.`);
  assert.match(await tab.locator(".verdict h2").first().textContent(), /violates the document: 1 violation/);
  assert.ok((await texts(tab, "header .about")).some((text) => text.startsWith("reading go-signal=raw: ")), "it says so");

  await tab.selectOption("#reading-go-signal", "");
  await settle();
  assert.deepEqual(await findings(tab), expected(usual));
  await tab.selectOption("#edition", "3.0");
  await settle();
  const older = json(log, "--edition", "3.0");
  assert.deepEqual(await findings(tab), expected(older));
  assert.notEqual(older.findings.length, usual.findings.length);
  assert.equal(await before(), `Before, ${outcome(usual)}. Now, ${outcome(older)}.`);
  assert.deepEqual(wrong, []);
  await close();
});

test("a folder: a verdict each, what is none says so, hidden files are left out, and a click opens one", async () => {
  const logs = join(folder, "runs");
  mkdirSync(join(logs, "day 2"), { recursive: true });
  copyFileSync(join(root, recording("mission")), join(logs, "run2.log"));
  copyFileSync(join(root, recording("finished-while-moving")), join(logs, "run10.log"));
  copyFileSync(driven("remote-estop", "2026"), join(logs, "day 2", "stop.log"));
  writeFileSync(join(logs, "notes.txt"), "bring more batteries\n");
  writeFileSync(join(logs, "archive.zip"), "PK\u0003\u0004rest");
  writeFileSync(join(logs, ".hidden"), "x");
  const { tab, wrong, close } = await begin();
  await tab.setInputFiles("#folder", logs);
  await ready(tab);
  const rows = await tab.locator(".logs tbody tr").evaluateAll((all) => all.map((row) => [...row.cells].slice(0, 2).map((cell) => cell.textContent)));
  assert.deepEqual(rows.map(([name]) => name), ["archive.zip", "day 2/stop.log", "notes.txt", "run2.log", "run10.log"].map((name) => `runs/${name}`));
  const verdict = (place) => rows[place][1];
  assert.match(verdict(0), /^\? no answer: it is a zip archive, which is not read; unpack it first/);
  assert.deepEqual([verdict(1), verdict(3), verdict(4)], ["✓ conforms", "✓ conforms", "✗ violates"]);
  assert.match(verdict(2), /^\? no answer: no readable frame in 1 line; .*give a recording/);
  assert.match(await tab.locator("#list-status").textContent(), /^5 of 5 files judged\. ✗ violates: 1, ✓ conforms: 2, \? no answer: 2$/);
  await tab.getByRole("button", { name: "runs/run10.log" }).click();
  await ready(tab);
  assert.deepEqual(await findings(tab), expected(json(recording("finished-while-moving"))));
  await tab.getByRole("button", { name: "The list" }).click();
  await ready(tab);
  assert.equal(await tab.locator(".logs tbody tr").count(), 5);
  assert.deepEqual(wrong, []);
  await close();
});

test("what is no log says what was given and what to do, and the page goes on", async () => {
  const { tab, wrong, close } = await begin();
  for (const [name, text, says] of [
    ["empty.log", "", /empty\.log: the log is empty.*What to do: give a recording/s],
    ["rubbish.log", "\u0000\u0001rubbish\nmore\n", /no readable frame in 2 lines.*What to do/s],
    ["a.pcap", "\u00d4\u00c3\u00b2\u00a1", /it is a capture of tcpdump.*What to do/s],
  ]) {
    await tab.getByRole("button", { name: "Judge a log" }).click();
    await drop(tab, [[name, Buffer.from(text, "latin1")]]);
    const alert = tab.getByRole("alert");
    await alert.waitFor();
    assert.match(await alert.textContent(), says, name);
  }
  await tab.getByRole("button", { name: "Judge a log" }).click();
  await choose(tab, written("small.log", "(1.0) can0 520#0000010000000000\n"));
  await ready(tab);
  assert.equal(await tab.locator("h1").textContent(), "small.log");
  assert.deepEqual(wrong, []);
  await close();
});

test("a log that is long can be cancelled, and judged after all", async () => {
  const { tab, wrong, close } = await begin();
  const long = written("long.log", readFileSync(join(root, recording("mission")), "utf8").repeat(60));
  await choose(tab, long);
  await tab.getByRole("button", { name: "Cancel" }).click();
  await tab.getByText("Cancelled.").waitFor();
  assert.equal(await tab.locator(".busy").count(), 0);
  await tab.getByRole("button", { name: "Judge it after all" }).click();
  await ready(tab);
  assert.match(await tab.locator("header .about").first().textContent(), /^2,036,400 frames /);
  assert.deepEqual(wrong, []);
  await close();
});

test("every example opens, and those that are of a mistake show it", async () => {
  const { tab, wrong, close } = await begin();
  const count = await tab.locator("[data-example]").count();
  assert.equal(count, 8);
  const verdicts = {};
  for (let place = 0; place < count; place++) {
    const button = tab.locator("[data-example]").nth(place);
    const id = await button.getAttribute("data-example");
    await button.click();
    await ready(tab);
    verdicts[id] = (await tab.title()).split(": ").at(-1);
    await tab.getByRole("button", { name: "Judge a log" }).click();
  }
  assert.deepEqual(verdicts, {
    "mission": "conforms", "mission-2026": "conforms", "finished": "violates", "torque": "conforms", "handshake": "violates",
    "go-too-early": "conforms", "remote-estop": "conforms", "power-cycle": "conforms",
  });
  assert.deepEqual(wrong, []);
  await close();
});
