// Colors: those of the style sheet, which knows dark and light, so that canvases look as all else does.

const known = new Map<string, string>();

/** A color of the style sheet, by its name. */
export function color(name: string): string {
  let value = known.get(name);
  if (value === undefined) {
    value = getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
    known.set(name, value);
  }
  return value;
}

/** Colors are others from here on, and so may be the room beside what is drawn. */
export function forget(): void {
  known.clear();
}

/** The colors of lines, which differ in lightness as well. */
export const LINES = ["line-1", "line-2", "line-3", "line-4", "line-5", "line-6", "line-7", "line-8"];

/** Stripes in a color on another, for what must not be told by color alone. */
export function stripes(context: CanvasRenderingContext2D, on: string, line: string, gap = 6): CanvasPattern | string {
  const scale = devicePixelRatio || 1;
  // A printer may have next to no pixels.
  const size = Math.max(Math.round(gap * scale), 4);
  const tile = new OffscreenCanvas(size, size);
  const brush = tile.getContext("2d");
  if (!brush) return on;
  brush.fillStyle = on;
  brush.fillRect(0, 0, size, size);
  brush.strokeStyle = line;
  brush.lineWidth = Math.max(size / 5, 1);
  brush.beginPath();
  for (const shift of [-size, 0, size]) {
    brush.moveTo(shift, size);
    brush.lineTo(shift + size, 0);
  }
  brush.stroke();
  const pattern = context.createPattern(tile, "repeat");
  pattern?.setTransform(new DOMMatrix().scale(1 / scale));
  return pattern ?? on;
}
