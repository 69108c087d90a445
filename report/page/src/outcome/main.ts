// The page of an outcome: of `conform`, of `exam`, or of `verify --readings`.
//
//   data --kind--> conform: deviations, Figure 2, failures, requirements
//             |--> exam: findings, requirements, scenarios
//             \--> readings: what each answer costs

import { h } from "../dom";
import { conform } from "./conform";
import type { Data } from "./data";
import { exam } from "./exam";
import { readings } from "./readings";

const page = document.getElementById("page")!;
try {
  const data = JSON.parse(document.getElementById("data")?.textContent ?? "") as Data;
  page.append(...(data.kind === "conform" ? conform(data) : data.kind === "exam" ? exam(data) : readings(data)));
  // What is closed is not printed.
  let opened: HTMLDetailsElement[] = [];
  addEventListener("beforeprint", () => {
    opened = [...document.querySelectorAll<HTMLDetailsElement>("details:not([open])")];
    opened.forEach((one) => (one.open = true));
  });
  addEventListener("afterprint", () => opened.forEach((one) => (one.open = false)));
  document.documentElement.dataset["ready"] = "yes";
} catch (error) {
  page.append(h("p", { class: "verdict bad", role: "alert" },
    `This page cannot be shown: ${error instanceof Error ? error.message : String(error)}. It is for Chromium 110, Firefox 115, Safari 16.4 and later.`));
}
