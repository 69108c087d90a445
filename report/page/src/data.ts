// The one object of data that a page shows. What makes it says what each part means: report/src/page.rs, and for `check` the schema
// of `adsdv check --json`. Times are in microseconds, those of `check` in seconds.

export type Mood = "good" | "care" | "bad" | "unknown";
export type Severity = "violation" | "warning" | "note";

export interface Data {
  name: string;
  version: string;
  settings: string[];
  check: Check;
  summary: { mood: Mood; verdict: string; next: string; matters: Matter[] };
  questions: Question[];
  transitions: { decided: { text: string; held: "true" | "false" | "unknown" }[]; or: string[] }[];
  lights: [string, string][];
  requirements: Record<string, string>;
  messages: Message[];
  lanes: Lane[];
  gaps: [number, number][];
  drops: [number, number][];
  interface: string | null;
  others: number;
  end: number;
  plots: Plot[];
  overview: { buckets: number; width: number; packed: string };
  chunks: { from: number; until: number; frames: number; packed: string }[];
}

export interface Matter {
  mood: Mood;
  title: string;
  text: string;
  at: number | null;
  finding?: number;
}

export interface Question {
  question: string;
  answer: string;
  mood: Mood;
  at: number | null;
  show: string;
}

export interface Message {
  id: number;
  name: string;
  from: string;
  cycle_ms: number | null;
  len: number;
  doc: string;
  signals: Signal[];
}

export interface Signal {
  name: string;
  start: number;
  width: number;
  coding: "u" | "i" | "f";
  num: number;
  den: number;
  offset: number;
  unit: string;
  values: [number, string][];
  doc?: string;
}

export type Tone = "off" | "on" | "bad" | "unknown" | "several";

export interface Lane {
  id: string;
  title: string;
  of: string;
  words: [string, Tone][];
  spans: [number, number][];
}

export type Role = "request" | "actual" | "limit";

export interface PlotLine {
  label: string;
  role: Role;
  of: "signal" | "period" | "answer";
  id?: number;
  signal?: string;
}

export interface Plot {
  id: string;
  title: string;
  unit: string;
  lines: PlotLine[];
  limits: { text: string; value: number }[];
}

export interface Finding {
  t: number;
  severity: Severity;
  party: string;
  section: string;
  rule: string;
  requirements: string[];
  message: string;
  seen: string;
  expected: string | null;
  unless: string | null;
  evidence: { t: number; id: string }[];
}

export interface Condition {
  condition: string;
  needs: string;
  seen: string | null;
  whose: string;
  message: string | null;
}

export interface Blocked {
  since: number;
  until: number;
  failed: Condition[];
  unknown: Condition[];
  holding: string[];
}

export interface Arrow {
  to: string;
  section: string;
  requirements: string[];
  blocked: Blocked[];
  not_listed: number;
}

export interface Stay {
  state: string;
  since: number;
  until: number;
  left_to: string | null;
  arrows: Arrow[];
}

export interface Margin {
  what: string;
  message: string | null;
  party: string;
  section: string;
  requirements: string[];
  value: number;
  limit: number;
  unit: string;
  basis: string;
  left: number;
  t: number;
}

export interface Rule {
  name: string;
  line: number;
  rule: string;
  note?: string;
  verdict: string;
  held: number;
  broken: number;
  undecided: number;
  breaches: { t: number; seen: string }[];
  why?: string;
}

export interface Check {
  edition: string;
  recognised?: { certain: boolean; evidence: string[]; against: string[] };
  frames: number;
  duration_s: number;
  transitions: { t: number; from: string; to: string; section: string; justified: string }[];
  findings: Finding[];
  stays: Stay[];
  go_presses: { t: number; ready_for: number; why: string }[];
  margins: Margin[];
  handshake_response_ms: { count: number; min: number; median: number; p99: number; max: number } | null;
  exercised: { ai: boolean; vcu: boolean; states: string[]; requirements: { id: string; told: string }[] };
  rules?: Rule[];
  required?: { what: string; met: boolean }[];
  verdict: string;
}
