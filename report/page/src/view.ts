// What is looked at: a stretch of time, and the cursor in it. All lanes and plots follow it, once a frame of the screen.

/** The shortest stretch that is shown, in microseconds. */
const SHORTEST = 1000;
/** What changes again within this time, in milliseconds, is moving: it is drawn coarsely, and finely when it rests. */
const RESTS = 120;

export class View {
  from = 0;
  to: number;
  cursor: number | null = null;
  /** Whether the stretch goes on changing. */
  moving = false;
  private resting: ReturnType<typeof setTimeout> | undefined;
  private readonly listeners: ((changed: "range" | "cursor") => void)[] = [];
  private waiting: "range" | "cursor" | null = null;

  constructor(readonly end: number) {
    this.to = Math.max(end, SHORTEST);
  }

  /** Calls back before the next picture after a change. */
  on(listener: (changed: "range" | "cursor") => void): void {
    this.listeners.push(listener);
  }

  get whole(): boolean {
    return this.from <= 0 && this.to >= this.end;
  }

  /** Shows this stretch, as far as there is one. */
  show(from: number, to: number): void {
    const all = Math.max(this.end, SHORTEST);
    const width = Math.min(Math.max(to - from, SHORTEST), all);
    const begin = Math.min(Math.max((from + to - width) / 2, 0), all - width);
    this.from = begin;
    this.to = begin + width;
    this.changed("range");
  }

  /** Zooms by a factor, with a time staying where it is. */
  zoom(factor: number, around: number = this.cursor ?? (this.from + this.to) / 2): void {
    const at = Math.min(Math.max(around, this.from), this.to);
    this.show(at - (at - this.from) * factor, at + (this.to - at) * factor);
  }

  /** Goes on by a share of what is shown. */
  pan(share: number): void {
    const by = (this.to - this.from) * share;
    const kept = Math.min(Math.max(by, -this.from), Math.max(this.end, SHORTEST) - this.to);
    this.show(this.from + kept, this.to + kept);
  }

  /** Puts the cursor there, and brings it into view. */
  at(t: number | null): void {
    this.cursor = t === null ? null : Math.min(Math.max(t, 0), this.end);
    if (this.cursor !== null && (this.cursor < this.from || this.cursor > this.to)) {
      const half = (this.to - this.from) / 2;
      this.show(this.cursor - half, this.cursor + half);
    } else this.changed("cursor");
  }

  /** Looks at a moment from near. */
  jump(t: number, half = 250_000): void {
    this.show(t - half, t + half);
    this.at(t);
  }

  /** Draws all again. */
  redraw(): void {
    this.changed("range");
  }

  private changed(what: "range" | "cursor"): void {
    if (what === "range") this.moves();
    this.ask(what);
  }

  private moves(): void {
    this.moving = this.resting !== undefined;
    clearTimeout(this.resting);
    this.resting = setTimeout(() => {
      this.resting = undefined;
      if (!this.moving) return;
      this.moving = false;
      this.ask("range");
    }, RESTS);
  }

  private ask(what: "range" | "cursor"): void {
    if (this.waiting === null) requestAnimationFrame(() => this.tell());
    this.waiting = this.waiting === "range" ? "range" : what;
  }

  private tell(): void {
    const what = this.waiting ?? "cursor";
    this.waiting = null;
    for (const listener of this.listeners) listener(what);
  }
}
