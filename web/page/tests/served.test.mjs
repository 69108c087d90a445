// The page from `adsdv web`, from a site that is gone, and the one that is checked in.

import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { createHash } from "node:crypto";
import { readFileSync, readdirSync } from "node:fs";
import { join } from "node:path";
import { after, test } from "node:test";

import { begin, browser, checkedIn, choose, chromium, expected, findings, fresh, json, moduleOf, ready, recording, root, run, site } from "./web.mjs";

after(() => browser.close());

test("adsdv web serves the page that is checked in, and it judges", async () => {
  const server = spawn(process.env.ADSDV ?? join(root, "target/debug/adsdv"), ["web", "--port", "0"], { cwd: root });
  try {
    const line = await new Promise((done, failed) => {
      server.stdout.once("data", (data) => done(String(data)));
      server.once("exit", () => failed(new Error("it ended")));
    });
    const [, url] = /^(http:\/\/127\.0\.0\.1:\d+\/) \(stop with Ctrl-C\)\n$/.exec(line);
    assert.equal(await (await fetch(url)).text(), readFileSync(checkedIn, "utf8"));
    const { tab, wrong, close } = await begin(url);
    await choose(tab, recording("finished-while-moving"));
    await ready(tab);
    assert.deepEqual(await findings(tab), expected(json(recording("finished-while-moving"))));
    assert.deepEqual(wrong, []);
    await close();
  } finally {
    server.kill();
  }
});

test("once loaded from a site it opens again without a network, and judges", async () => {
  const { port, asked, close } = await site();
  const origin = `http://adsdv.test:${port}`;
  const own = await chromium.launch({
    executablePath: process.env.CHROMIUM,
    // As a site with a certificate.
    args: ["--no-sandbox", "--host-resolver-rules=MAP adsdv.test 127.0.0.1", `--unsafely-treat-insecure-origin-as-secure=${origin}`],
  });
  try {
    const tab = await own.newPage();
    await tab.goto(`${origin}/`);
    await tab.evaluate(() => navigator.serviceWorker.ready);
    await tab.reload();
    assert.ok(asked.includes("/sw.js"), asked.join(" "));
    await close();
    await tab.reload();
    await tab.waitForFunction(() => document.documentElement.dataset.begun === "yes");
    await choose(tab, recording("mission"));
    await ready(tab);
    assert.deepEqual(await findings(tab), expected(json(recording("mission"))));
  } finally {
    await own.close();
  }
});

test("the judge that is checked in answers as the one that was just built, and as the command", async () => {
  const [built, there] = [fresh, checkedIn].map(moduleOf);
  assert.deepEqual(there({ do: "about" }), built({ do: "about" }), "scripts/web.sh --build builds it anew");
  const logs = ["mission", "finished-while-moving"].map((name) => readFileSync(join(root, recording(name))));
  for (const { id } of JSON.parse(built({ do: "about" }).answer).examples) logs.push(Buffer.from(built({ do: "example", id }).answer));
  const samples = join(root, "formats/tests/samples");
  for (const name of readdirSync(samples)) logs.push(readFileSync(join(samples, name)));
  logs.push(Buffer.from("rubbish\n"), Buffer.alloc(0));
  for (const edition of [null, "3.0", "4.0", "2026"]) {
    for (const log of logs) {
      const request = { do: "judge", name: "run", edition };
      const [one, other] = [built(request, log), there(request, log)];
      assert.equal(other.refused, one.refused);
      assert.ok(other.answer === one.answer, `another answer by ${edition}: run scripts/web.sh --build, and commit what it builds`);
    }
  }
  const [log] = logs;
  const { data } = JSON.parse(there({ do: "judge", name: "run" }, log).answer);
  assert.deepEqual(data.check, json(recording("mission")));
  assert.equal(run("web", "--print"), readFileSync(checkedIn, "utf8"));
  for (const part of ["script", "worker", "style"]) {
    const of = (page) => new RegExp(`<${part === "worker" ? 'script type="text/plain" id="worker"' : part}>(.*?)</`, "s").exec(readFileSync(page, "utf8"))[1];
    assert.ok(of(checkedIn) === of(fresh), `another ${part}: run scripts/web.sh --build, and commit what it builds`);
  }
});

test("nothing that is asked of the judge makes it stop", () => {
  const judge = moduleOf(fresh);
  const requests = [
    {}, [], null, 7, "", { do: "nothing" }, { do: "judge" }, { do: "judge", name: "x", edition: "9" }, { do: "judge", name: "x", readings: ["a=b", "", "="] },
    { do: "judge", name: "x", edition: "3.0", readings: ["go-edge=edge", "go-edge=seen-low"] }, { do: "example", id: "" }, { do: "run", ms: 10 }, { do: "run", ms: -1 },
    { do: "act", action: "asms on" }, { do: "drive-log" }, { do: "begin", edition: "9" }, { do: "begin", scenario: "none" }, { do: "slip", slip: "x", on: true },
  ];
  for (const request of requests) {
    const { refused, answer } = judge(request, Buffer.from("(1.0) can0 520#00\n"));
    assert.ok(refused, JSON.stringify(request));
    const { what, why, hint } = JSON.parse(answer);
    assert.ok(what && why && hint, answer);
  }
  judge({ do: "begin", edition: "2026" });
  assert.ok(judge({ do: "act", action: "asms up" }).refused);
  assert.ok(!judge({ do: "run", ms: 4_000_000_000 }).refused);
  // Bits and pieces of every format, and what is none.
  const samples = join(root, "formats/tests/samples");
  // Any numbers, the same in every run.
  let draws = 0;
  const random = (below) => createHash("sha256").update(`${draws++}`).digest().readUInt32LE() % below;
  for (const name of readdirSync(samples)) {
    const whole = readFileSync(join(samples, name));
    for (let round = 0; round < 12; round++) {
      const log = Buffer.from(whole.subarray(0, 1 + random(whole.length)));
      for (let hit = 0; hit < round; hit++) log[random(log.length)] = random(256);
      const { refused, answer } = judge({ do: "judge", name, brief: round % 2 === 0 }, log);
      assert.ok(JSON.parse(answer)[refused ? "why" : "verdict"], name);
    }
  }
});
