// The pages of conform, exam and verify --readings: their numbers are those of --json, and what is looked for is found.

import assert from "node:assert/strict";
import { after, test } from "node:test";

import { browser, open, texts } from "./browser.mjs";
import { costs, mutant, outcome, stack } from "./programs.mjs";

after(() => browser.close());

const fast = ["--runs", "20"];
const vcu = outcome("conform", fast, [mutant, "--mutation", "3.6: dropped"]);
const right = outcome("conform", fast, [mutant]);
const ai = outcome("exam", ["--stdio", "--only", "mission", "--only", "ready"], [stack, "never-selects"]);
const count = (all, key, value) => all.filter((one) => one[key] === value).length;

test("a program that deviates: the verdict, what to do next, and each deviation with its scenario come first", async () => {
  const { tab, wrong, close } = await open(vcu.page);
  const { diagnosis, requirements, tests, failed_tests, runs, failed_runs } = vcu.json;
  const verdict = await tab.locator("#verdict h2").textContent();
  assert.ok(verdict.includes("It does not conform"), verdict);
  assert.ok(verdict.includes(`${count(requirements, "outcome", "pass")} of ${requirements.length} requirements`), verdict);
  assert.ok(verdict.includes(`${failed_tests} of ${tests} tests and ${failed_runs} of ${runs} random scenarios`), verdict);
  assert.ok((await tab.locator("#verdict p").textContent()).includes(diagnosis.deviations[0].text));
  assert.deepEqual(await texts(tab, ".deviation h3"), diagnosis.deviations.map((one) => `✗ ${one.text}`));
  assert.deepEqual(await texts(tab, ".deviation dd code"), diagnosis.deviations.map((one) => one.id));
  const steps = JSON.parse(diagnosis.deviations[0].example.test).steps;
  assert.equal(await tab.locator("#deviation-0 tbody tr").count(), steps.length);
  assert.ok((await tab.locator("#deviation-0 tbody tr").last().textContent()).includes(diagnosis.deviations[0].example.differences[0]));
  assert.equal(await tab.locator("#deviation-0 pre").textContent(), diagnosis.deviations[0].example.test);
  assert.equal(await tab.evaluate(() => document.querySelector("main section:nth-of-type(2)").id), "deviations");
  assert.deepEqual(wrong, []);
  await close();
});

test("the program's own Figure 2 is drawn, and what differs is told by a sign, a line and words", async () => {
  const { tab, wrong, close } = await open(vcu.page);
  const { figure } = vcu.json.diagnosis;
  assert.equal(await tab.locator(".figure2 [data-arrow]").count(), figure.length);
  const missing = figure.filter((one) => one.missing);
  assert.equal(missing.length, 1);
  const arrow = tab.locator(`[data-arrow="${missing[0].from}-${missing[0].to}"]`);
  assert.equal(await arrow.locator("text").textContent(), `✗ ${missing[0].section}`);
  assert.ok((await arrow.getAttribute("aria-label")).endsWith(": missing"));
  assert.notEqual(await tab.locator(`[data-line="${missing[0].from}-${missing[0].to}"] .line`).evaluate((line) => getComputedStyle(line).strokeDasharray), "none");
  assert.equal(await tab.locator(".figure2 .arrow.usual .line").first().evaluate((line) => getComputedStyle(line).strokeDasharray), "none");
  assert.deepEqual(await texts(tab, ".legend li"), ["as in the document: a thin line", "✗ missing: a dashed line"]);
  assert.ok((await tab.locator("#guard").textContent()).includes(missing[0].otherwise[0]));
  // With the keyboard.
  const other = figure.find((one) => !one.missing);
  await tab.locator(`[data-arrow="${other.from}-${other.to}"]`).first().press("Enter");
  assert.ok((await tab.locator("#guard").textContent()).includes(other.guard[0]));
  assert.deepEqual(wrong, []);
  await close();
});

test("requirements filter by result and by words, and failures open with their steps", async () => {
  const { tab, wrong, close } = await open(vcu.page);
  const { requirements, failures } = vcu.json;
  const shown = () => tab.locator("#requirements tbody tr:not([hidden])").count();
  const bad = requirements.filter((one) => one.outcome === "fail" || one.outcome === "differs");
  assert.equal(await shown(), bad.length);
  await tab.locator('#requirements [data-kind="pass"]').check();
  await tab.locator('#requirements [data-kind="not checked"]').count().then((there) => there && tab.locator('#requirements [data-kind="not checked"]').check());
  assert.equal(await shown(), requirements.length);
  await tab.locator("#requirements-filter").fill(bad[0].id);
  assert.ok((await texts(tab, "#requirements tbody tr:not([hidden]) strong")).includes(bad[0].id));
  assert.equal(await tab.locator("#requirements [role=status]").textContent(), `${await shown()} of ${requirements.length} requirements shown`);
  assert.equal(await tab.locator("#failures tbody tr:not(.detail) .open").count(), failures.length);
  await tab.locator("#failures .open").first().click();
  const detail = tab.locator("#failures-0-detail");
  const [difference] = failures[0].differences;
  assert.ok((await detail.textContent()).includes(`${difference.key} is ${difference.found}, expected ${difference.expected}`));
  assert.ok((await detail.locator("tbody tr").last().textContent()).includes(`✗ ${difference.found}`));
  assert.deepEqual(wrong, []);
  await close();
});

test("a program that conforms is told so, and nothing is made up", async () => {
  const { tab, wrong, close } = await open(right.page);
  assert.equal(right.json.diagnosis, null);
  assert.ok((await tab.locator("#verdict h2").textContent()).includes("It conforms"));
  assert.equal(await tab.locator("#deviations, #figure2").count(), 0);
  assert.equal(await tab.locator("#failures").textContent(), "FailuresNone.");
  assert.deepEqual(wrong, []);
  await close();
});

test("an exam: what was seen and expected, the requirements and the scenarios, each filterable", async () => {
  const { tab, wrong, close } = await open(ai.page);
  const { requirements, findings, scenarios } = ai.json;
  const verdict = await tab.locator("#verdict h2").textContent();
  const [pass, fail, not] = ["pass", "fail", "not exercised"].map((outcome) => count(requirements, "outcome", outcome));
  assert.ok(verdict.includes(`${pass} passed, ${fail} failed, ${not} were not exercised`), verdict);
  assert.equal(await tab.locator("#findings tr[id]:not(.detail)").count(), findings.length);
  await tab.locator("#findings .open").first().click();
  const detail = await tab.locator("#finding-0-detail").textContent();
  for (const text of [findings[0].seen, findings[0].expected, findings[0].car, findings[0].frames[0].frame, findings[0].operator[0].did, findings[0].shortest]) {
    assert.ok(detail.includes(text), text);
  }
  await tab.locator("#findings-filter").fill(scenarios.at(-1).name);
  const left = findings.filter((one) => JSON.stringify(one).includes(scenarios.at(-1).name));
  assert.equal(await tab.locator("#findings tr[id]:not(.detail):not([hidden])").count(), left.length);
  assert.equal(await tab.locator("#requirements tbody tr").count(), requirements.length);
  assert.equal(await tab.locator("#scenarios tbody tr").count(), scenarios.length);
  await tab.locator('#requirements [data-kind="pass"]').uncheck();
  await tab.locator('#requirements [data-kind="not exercised"]').uncheck();
  assert.deepEqual(await texts(tab, "#requirements tbody tr:not([hidden]) strong"), requirements.filter((one) => one.outcome === "fail").map((one) => one.id));
  assert.deepEqual(wrong, []);
  await close();
});

test("the costs of readings: a ranking, and the shortest run of each property that fails", async () => {
  const { page, json: [json] } = costs();
  const { tab, wrong, close } = await open(page);
  const rows = await texts(tab, "#edition-3-0 tbody tr");
  assert.equal(rows.length, json.ranking.length + json.free.length);
  json.ranking.forEach(({ answers, harm, fails }, place) => {
    for (const text of [String(place + 1), answers[0].id, answers[0].text, answers[0].instead_of, harm, ...fails]) {
      assert.ok(rows[place].includes(text), `${text}: ${rows[place]}`);
    }
  });
  assert.ok((await tab.locator("#edition-3-0 p").first().textContent()).includes(`${json.combinations.toLocaleString("en")} combinations`));
  assert.equal(await tab.locator(".cost").count(), json.costs.length + json.closed.length);
  const first = tab.locator(".cost").first();
  await first.locator("summary").click();
  assert.deepEqual(await first.locator(".run li").evaluateAll((all) => all.map((one) => one.textContent)),
    json.costs[0].run.map(({ ms, text }) => `${(ms / 1000).toFixed(3)} s ${text}`));
  await tab.locator("#edition-3-0-costs-filter").fill(json.costs[0].name);
  assert.ok((await tab.locator(".cost:not([hidden])").count()) < json.costs.length);
  assert.deepEqual(wrong, []);
  await close();
});
