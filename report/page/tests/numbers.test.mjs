// The numbers on the page are those of `adsdv check --json`, and its frames those of `adsdv decode`.

import assert from "node:assert/strict";
import { after, test } from "node:test";

import { browser, driven, json, open, page, recording, run, texts } from "./browser.mjs";

after(() => browser.close());

const LOGS = {
  mission: () => recording("mission"),
  "finished-while-moving": () => recording("finished-while-moving"),
  "remote E-stop of 2026": () => driven("remote-estop", "2026"),
  "power cycle of 3.0": () => driven("power-cycle", "3.0"),
};

const justified = { true: "✓ justified", false: "✗ violation", unknown: "? not certain" };
const short = (value, decimals = 2) => String(Number(value.toFixed(decimals)));

for (const [name, log] of Object.entries(LOGS)) {
  test(`${name}: what stands on the page is what --json says`, async () => {
    const check = json(log());
    const { tab, wrong, close } = await open(page(log()));
    const about = await tab.locator("header .about").first().textContent();
    assert.ok(about.startsWith(`${check.frames.toLocaleString("en")} frames in ${check.duration_s.toFixed(3)} s`), about);
    assert.ok(about.includes(`edition ${check.edition}`), about);

    const violations = check.findings.filter((one) => one.severity === "violation").length;
    const verdict = await tab.locator(".verdict h2").textContent();
    assert.match(verdict, check.verdict === "conforms" ? /conforms to the document.* No violation/ : new RegExp(`violates the document: ${violations} violation`));

    const rows = await tab.locator(".findings tbody tr:not(.detail)").evaluateAll((all) => all.map((row) => [...row.cells].map((cell) => cell.textContent)));
    const signs = { violation: "▲", warning: "◆", note: "●" };
    assert.deepEqual(rows, check.findings.map((one) => [`${one.t.toFixed(3)} s`, `${signs[one.severity]} ${one.severity}`, one.party, one.section, one.rule, one.message]));

    const table = (place) => tab.locator(`${place} tbody tr`).evaluateAll((all) => all.map((row) => [...row.cells].map((cell) => cell.textContent)));
    const states = await table("#states-table .scroll:nth-of-type(1)");
    assert.deepEqual(states.map((row) => row.slice(0, 4)), check.transitions.map((one) => [`${one.t.toFixed(3)} s`, `${one.from} → ${one.to}`, one.section, justified[one.justified]]));

    assert.deepEqual(await table("#margins"), check.margins.map((one) => [
      `${one.t.toFixed(3)} s`, one.what + (one.message ? ` ${one.message}` : ""), one.party, one.section,
      `${short(one.value)} ${one.unit}`, `${short(one.limit)} ${one.unit} (${one.basis})`,
      one.basis === "cycle" ? "" : `${one.left < 0 ? "✗ " : ""}${short(one.left * 100, 0)} %`,
    ]));

    const ms = check.handshake_response_ms;
    assert.deepEqual(await table("#answers"), [[String(ms.count), ...[ms.min, ms.median, ms.p99, ms.max].map((value) => `${short(value, 3)} ms`)]]);

    for (const standing of ["violated", "held", "not certain", "not exercised"]) {
      const ids = check.exercised.requirements.filter((one) => one.told === standing).map((one) => one.id);
      const group = tab.locator("#exercised details").filter({ has: tab.locator("summary", { hasText: new RegExp(` ${standing}$`) }) });
      assert.match(await group.locator("summary").textContent(), new RegExp(` ${ids.length} requirements? ${standing}$`));
      assert.deepEqual(await texts(group, "li strong"), ids);
    }
    assert.deepEqual(wrong, []);
    await close();
  });
}

test("the frames around a finding are those of the log, decoded as adsdv decode does it", async () => {
  const log = recording("finished-while-moving");
  const finding = json(log).findings.find((one) => one.rule === "finished-while-moving");
  const { tab, close } = await open(page(log));
  await tab.locator("tr.violation button").first().click();
  const detail = tab.locator(".detail:not([hidden])");
  await detail.locator("input[type=checkbox]").check();
  const rows = await detail.locator(".frames tbody tr").evaluateAll((all) => all.map((row) => ({
    t: Number.parseFloat(row.cells[1].textContent), name: row.cells[2].textContent, says: row.cells[4].textContent, evidence: row.className === "evidence",
  })));
  const lines = run("decode", "--format", "jsonl", log).trim().split("\n").map((line) => JSON.parse(line));
  const us = (seconds) => Math.round(seconds * 1e6);
  const [begin, first, last] = [us(lines[0].time_s), us(rows[0].t), us(rows.at(-1).t)];
  const near = lines.map((line) => ({ ...line, at: us(line.time_s) - begin })).filter(({ at }) => at >= first && at <= last);
  near.sort((a, b) => a.at - b.at || Number.parseInt(a.id, 16) - Number.parseInt(b.id, 16));
  assert.equal(rows.length, near.length);
  for (const [place, { at, id, data, message, signals }] of near.entries()) {
    const row = rows[place];
    assert.deepEqual([us(row.t), row.name], [at, `${message} ${id}h`]);
    assert.ok(row.says.endsWith(`${id}h # ${data.replace(/..(?=.)/g, "$& ")}`), row.says);
    for (const [name, signal] of Object.entries(signals)) {
      const value = signal.name ?? `${short(signal.value, 4)}${signal.unit ? ` ${signal.unit}` : ""}`;
      const says = row.says.includes(`${name}: ${value}`) || row.says.includes(` → ${value}`);
      assert.ok(says || signal.value === 0, `${name} is ${value}: ${row.says}`);
    }
  }
  assert.equal(rows.filter((row) => row.evidence).length, finding.evidence.length);
  for (const one of finding.evidence) assert.ok(rows.some((row) => row.evidence && Math.abs(row.t - one.t) < 1e-6 && row.name.endsWith(one.id)), one.id);
  await close();
});
