// Judges one log in a thread of its own, reading of it what fits: a file does not have to fit into memory.

import { Module, type Refusal, Refused, broken } from "./module";

export interface Job {
  module: WebAssembly.Module;
  request: object;
  source: Blob;
}

export type Said = { read: number } | { answer: Uint8Array } | { refusal: Refusal };

/** So much is read at once. */
const PIECE = 1 << 20;
/** So often it is said how far it is, in milliseconds. */
const OFTEN = 100;

// The libraries of a page and of a worker do not go together.
declare const self: {
  onmessage: ((event: MessageEvent<Job>) => void) | null;
  postMessage(said: Said, transfer?: Transferable[]): void;
};
declare class FileReaderSync {
  readAsArrayBuffer(blob: Blob): ArrayBuffer;
}

self.onmessage = async ({ data: { module, request, source } }) => {
  const reader = new FileReaderSync();
  let piece = new Uint8Array(0);
  let used = 0;
  let read = 0;
  let last = 0;
  const next = (room: Uint8Array): number => {
    if (used === piece.length) {
      if (read >= source.size) return 0;
      try {
        piece = new Uint8Array(reader.readAsArrayBuffer(source.slice(read, read + PIECE)));
      } catch {
        return -1;
      }
      used = 0;
      read += piece.length;
      if (performance.now() - last > OFTEN) {
        last = performance.now();
        self.postMessage({ read });
      }
    }
    const some = piece.subarray(used, used + room.length);
    room.set(some);
    used += some.length;
    return some.length;
  };
  try {
    const answer = (await Module.of(module, next)).bytes(request);
    self.postMessage({ answer }, [answer.buffer]);
  } catch (error) {
    self.postMessage({ refusal: error instanceof Refused ? error.refusal : broken(error) });
  }
};
