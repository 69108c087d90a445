// The one object of data that the page of an outcome shows: report/src/outcome/mod.rs. `json` is what the command prints with --json; the
// schemas of adsdv say what each part of it means.

import type { Message, Mood } from "../data";
import type { Picture } from "../figure";

interface Common {
  version: string;
  title: string;
  about: string[];
  mood: Mood;
  verdict: string;
  next: string;
  requirements: Record<string, string>;
  /** Questions that the document leaves open by their ids, and answers as `question=answer`, in words. */
  readings: Record<string, string>;
}

export interface ConformData extends Common {
  kind: "conform";
  picture: Picture | null;
  json: Conform;
}

export interface ExamData extends Common {
  kind: "exam";
  messages: Message[];
  json: Exam;
}

export interface ReadingsData extends Common {
  kind: "readings";
  json: Costs[];
}

export type Data = ConformData | ExamData | ReadingsData;

export type Value = boolean | number | string | null;

export interface Step {
  dt_ms: number;
  inputs: Record<string, Value>;
  expected: Record<string, Value>;
  actual: Record<string, Value>;
}

export interface Failure {
  name: string;
  about: string;
  requirements: string[];
  also: string[];
  explained_by: string[];
  why: string | null;
  row: { from: string; to: string; section: string; guard: string[] } | null;
  differences: { key: string; found: Value; expected: Value }[];
  steps: Step[];
}

export interface Deviation {
  id: string;
  text: string;
  requirements: string[];
  observed: boolean;
  accepted: string | null;
  example: { differences: string[]; beside: string[]; test: string } | null;
}

export interface OwnArrow {
  from: string;
  to: string;
  section: string | null;
  guard: string[];
  otherwise: string[];
  missing: boolean;
  not_shown: boolean;
}

export interface Conform {
  edition: string;
  tests: number;
  failed_tests: number;
  runs: number;
  failed_runs: number;
  requirements: { id: string; outcome: string; tests: number; checked: number; failed: string[] }[];
  about_the_vcu: number;
  failures: Failure[];
  more_failures: number;
  observations: Failure[];
  follows: { reading: string; possible: string[]; mixes: { choice: string; tests: string[] }[] }[];
  not_shown: string[];
  not_told: string[];
  notes: string[];
  diagnosis: {
    experiments: number;
    deviations: Deviation[];
    readings: Record<string, string>;
    figure: OwnArrow[];
    unexplained: number;
    left_out: string[];
    cut: boolean;
    unused: string[];
  } | null;
  conforms: boolean;
}

export interface ExamFinding {
  scenario: string;
  t: number;
  section: string;
  rule: string;
  requirements: string[];
  accepted: boolean;
  seen: string;
  expected: string;
  operator: { t: number; did: string }[];
  car: string;
  frames: { t: number; by: string; frame: string }[];
  shortest: string | null;
  trace?: string;
}

export interface Exam {
  edition: string;
  scenarios: { name: string; about: string; duration: number; frames: number; findings: number; exercised: string[]; stuck: string | null }[];
  requirements: { id: string; section: string; about: string; outcome: string; accepted: string | null; findings: number[]; why: string | null }[];
  findings: ExamFinding[];
  slowest_answer_ms: number | null;
  notes: string[];
  unused: string[];
  passes: boolean;
}

export interface Answer {
  id: string;
  text: string;
  instead_of: string;
}

export interface StoryLine {
  ms: number;
  text: string;
}

export interface Property {
  name: string;
  statement: string;
  requirements: string[];
}

/** What the readings of an edition cost: a line of `adsdv verify --readings --json`. */
export interface Costs {
  edition: string;
  same: string[];
  combinations: number;
  steps: number;
  complete: boolean;
  ranking: { answers: Answer[]; harm: string; fails: string[] }[];
  free: Answer[];
  costs: (Property & { answers: Answer[]; undone_by: string[]; harm: string; run: StoryLine[] })[];
  closed: (Property & { answers: Answer[]; run: StoryLine[] })[];
  unreachable: { name: string; statement: string; answers: Answer[] }[];
  holding: Property[];
}
