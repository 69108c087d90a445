// The module of web/: a request goes in, an answer comes out, and the bytes of a log are read as it asks for them.

interface Exports {
  memory: WebAssembly.Memory;
  into(length: number): number;
  call(): number;
  out(): number;
  out_len(): number;
}

/** Writes the next bytes of a log, and says how many; 0 at the end, and -1 where it cannot be read. */
export type Read = (room: Uint8Array) => number;

/** What was given, what is wrong with it, and what to do. */
export interface Refusal {
  what: string;
  why: string;
  hint: string;
}

/** There is no answer, and why. */
export class Refused extends Error {
  constructor(readonly refusal: Refusal) {
    super(`${refusal.what}: ${refusal.why}`);
  }
}

/** What is no answer of the module, which is a mistake in it, or a machine without memory. */
export function broken(error: unknown): Refusal {
  return {
    what: "the judge",
    why: `has stopped: ${error instanceof Error ? error.message : String(error)}`,
    hint: "the file may be too large for this browser; the program adsdv judges it in little memory. If it is small, that is a mistake of adsdv: please report it with the file",
  };
}

export class Module {
  private constructor(private readonly exports: Exports) {}

  static async of(module: WebAssembly.Module, read: Read = () => 0): Promise<Module> {
    let exports: Exports;
    const host = { read: (at: number, room: number) => read(new Uint8Array(exports.memory.buffer, at >>> 0, room >>> 0)) };
    const instance = await WebAssembly.instantiate(module, { host });
    exports = instance.exports as unknown as Exports;
    return new Module(exports);
  }

  /** The bytes of an answer. */
  bytes(request: object): Uint8Array<ArrayBuffer> {
    const text = new TextEncoder().encode(JSON.stringify(request));
    const at = this.exports.into(text.length);
    new Uint8Array(this.exports.memory.buffer, at >>> 0, text.length).set(text);
    const refused = this.exports.call();
    const answer = new Uint8Array(this.exports.memory.buffer, this.exports.out() >>> 0, this.exports.out_len() >>> 0).slice();
    if (refused) throw new Refused(JSON.parse(new TextDecoder().decode(answer)) as Refusal);
    return answer as Uint8Array<ArrayBuffer>;
  }

  ask<T>(request: object): T {
    return JSON.parse(new TextDecoder().decode(this.bytes(request))) as T;
  }
}
