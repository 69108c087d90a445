// Reads what report/src/packed.rs packs.

/** The bytes that were packed. */
export async function unpack(text: string): Promise<Uint8Array<ArrayBuffer>> {
  const letters = atob(text);
  const bytes = new Uint8Array(letters.length);
  for (let i = 0; i < bytes.length; i++) bytes[i] = letters.charCodeAt(i);
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate-raw"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

/** Takes bytes apart. */
export class Reader {
  private place = 0;

  constructor(private readonly bytes: Uint8Array) {}

  /** A number of seven bits a byte. */
  number(): number {
    let value = 0;
    let scale = 1;
    for (;;) {
      const byte = this.bytes[this.place++];
      if (byte === undefined) throw new Error("the data of this report is cut off");
      value += (byte & 0x7f) * scale;
      if (byte < 0x80) return value;
      scale *= 128;
    }
  }

  /** One that may be negative. */
  signed(): number {
    const number = this.number();
    return number % 2 === 0 ? number / 2 : -(number + 1) / 2;
  }

  /** Times: how each step differs from the one before it. */
  times(count: number, from: number): Float64Array {
    const times = new Float64Array(count);
    let before = from;
    let step = 0;
    for (let i = 0; i < count; i++) {
      step += this.signed();
      before += step;
      times[i] = before;
    }
    return times;
  }

  /** Bytes: how each differs from the one before it; they go to every so many-th place of `into`. */
  differences(count: number, into: Uint8Array, first: number, every: number): void {
    let before = 0;
    for (let i = 0; i < count; i++) {
      before = (before + (this.bytes[this.place++] ?? 0)) & 0xff;
      into[first + i * every] = before;
    }
  }
}
