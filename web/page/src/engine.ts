// The judge: the module that stands in the page, for what is quick, and in workers for logs.

import type { Data } from "../../../report/page/src/data";
import { unpack } from "../../../report/page/src/packed";
import { Module, Refused, broken } from "./module";
import type { Job, Said } from "./worker";

export interface Reading {
  id: string;
  section: string;
  question: string;
  choices: { id: string; text: string; default: boolean }[];
}

export interface Edition {
  edition: string;
  document: string;
  readings: Reading[];
}

export interface Switch {
  key: string;
  about: string;
  part: "" | "sdc" | "reports";
  positions: string[];
}

/** What there is to choose from. */
export interface About {
  version: string;
  formats: string[];
  editions: Edition[];
  examples: { id: string; title: string; edition: string }[];
  switches: Switch[];
  power_cycle: [string, string];
  slips: [string, string][];
  scenarios: string[];
}

/** A log that was judged. */
export interface Judged {
  format: string;
  edition: string;
  recognised: boolean;
  verdict: string;
  violations: number;
  warnings: number;
  frames: number;
  duration_s: number;
  failure: { what: string; why: string; hint: string } | null;
  data: Data | null;
}

/** By which edition, `null` being the one that the log tells, and with which readings. */
export interface How {
  edition: string | null;
  readings: string[];
}

export const AS_USUAL: How = { edition: null, readings: [] };

/** A log to judge. */
export interface Source {
  name: string;
  /** Gives its bytes, when they are needed. */
  bytes(): Promise<Blob>;
}

export class Engine {
  private constructor(private readonly module: WebAssembly.Module, private readonly here: Module, readonly about: About) {}

  /** Of what stands in the page. */
  static async begin(): Promise<Engine> {
    const packed = await unpack(document.getElementById("module")?.textContent?.trim() ?? "");
    const module = await WebAssembly.compile(packed);
    const here = await Module.of(module);
    return new Engine(module, here, here.ask<About>({ do: "about" }));
  }

  /** A request that is answered at once. */
  ask<T>(request: object): T {
    try {
      return this.here.ask<T>(request);
    } catch (error) {
      throw error instanceof Refused ? error : new Refused(broken(error));
    }
  }

  /** An answer that is the text of a log. */
  log(request: object): Blob {
    return new Blob([this.here.bytes(request)]);
  }

  example(id: string, title: string): Source {
    return { name: title, bytes: () => Promise.resolve(this.log({ do: "example", id })) };
  }

  /** Judges a log in a worker, which the signal ends. */
  async judge(source: Source, how: How, brief: boolean, signal: AbortSignal, progress: (share: number) => void): Promise<Judged> {
    const blob = await source.bytes().catch((error: unknown) => {
      throw new Refused({ what: source.name, why: `cannot be opened: ${String(error)}`, hint: "choose the file again" });
    });
    signal.throwIfAborted();
    const url = URL.createObjectURL(new Blob([document.getElementById("worker")!.textContent!], { type: "text/javascript" }));
    const worker = new Worker(url);
    try {
      const answer = await new Promise<Uint8Array>((done, failed) => {
        signal.addEventListener("abort", () => failed(signal.reason), { once: true });
        worker.onerror = (event) => failed(new Refused(broken(event.message)));
        worker.onmessage = ({ data }: MessageEvent<Said>) => {
          if ("read" in data) progress(data.read / Math.max(blob.size, 1));
          else if ("answer" in data) done(data.answer);
          else failed(new Refused(data.refusal));
        };
        const request = { do: "judge", name: source.name, edition: how.edition, readings: how.readings, brief };
        worker.postMessage({ module: this.module, request, source: blob } satisfies Job);
      });
      return JSON.parse(new TextDecoder().decode(answer)) as Judged;
    } finally {
      worker.terminate();
      URL.revokeObjectURL(url);
    }
  }
}
