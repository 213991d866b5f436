// A pen that draws on a canvas. It leaves out what is not seen, and of points that fall on one pixel all but one.

import type { Mark, Pen, Stroke } from "./pen.ts";
import { toScreen, type View } from "./view.ts";

/** Segments to a path: longer paths are slower to fill for each segment. */
const RUN = 800;
/** Points above which those on one pixel are drawn once. */
const MANY = 4000;
/** Half of the room of a label, in pixels. */
const LABEL = [13, 7] as const;
const TAU = 2 * Math.PI;

export class CanvasPen implements Pen {
  constructor(
    private readonly context: CanvasRenderingContext2D,
    private readonly view: View,
    /** Pixels around the view that are drawn, too. */
    private readonly extra = 0,
  ) {}

  edges(xy: Float64Array, pairs: Uint32Array, stroke: Stroke): void {
    const at = (e: number): number => pairs[e >> 1]! * 2 + (e & 1);
    this.lines(pairs.length * 2, (k) => xy[at(k)]!, stroke);
  }

  segments(ends: ArrayLike<number>, stroke: Stroke): void {
    this.lines(ends.length, (k) => ends[k]!, stroke);
  }

  private lines(count: number, value: (k: number) => number, stroke: Stroke): void {
    const { context, view } = this;
    const [low, right, bottom] = [-this.extra, view.width + this.extra, view.height + this.extra];
    this.styled(stroke, () => {
      let run = 0;
      context.beginPath();
      for (let k = 0; k < count; k += 4) {
        const [x0, y0] = toScreen(view, value(k), value(k + 1));
        const [x1, y1] = toScreen(view, value(k + 2), value(k + 3));
        if (Math.max(x0, x1) < low || Math.min(x0, x1) > right || Math.max(y0, y1) < low || Math.min(y0, y1) > bottom) continue;
        context.moveTo(x0, y0);
        context.lineTo(x1, y1);
        if ((run += 1) % RUN === 0) {
          context.stroke();
          context.beginPath();
        }
      }
      context.stroke();
    });
  }

  cubics(control: ArrayLike<number>, stroke: Stroke): void {
    const { context, view } = this;
    this.styled(stroke, () => {
      context.beginPath();
      for (let k = 0; k < control.length; k += 8) {
        const [a, b, c, d] = [0, 2, 4, 6].map((step) => toScreen(view, control[k + step]!, control[k + step + 1]!)) as [number, number][];
        context.moveTo(...a!);
        context.bezierCurveTo(...b!, ...c!, ...d!);
      }
      context.stroke();
    });
  }

  disks(disks: ArrayLike<number>, stroke: Stroke | null, fill: { color: string; alpha: number } | null): void {
    const { context, view } = this;
    for (let k = 0; k < disks.length; k += 3) {
      const [x, y] = toScreen(view, disks[k]!, disks[k + 1]!);
      const radius = disks[k + 2]! * view.scale;
      if (!(radius < 1e6) || x + radius < 0 || y + radius < 0 || x - radius > view.width || y - radius > view.height) continue;
      context.beginPath();
      context.arc(x, y, radius, 0, TAU);
      if (fill) {
        context.globalAlpha = fill.alpha;
        context.fillStyle = fill.color;
        context.fill();
        context.globalAlpha = 1;
      }
      if (stroke) this.styled(stroke, () => context.stroke());
    }
  }

  marks(xy: Float64Array, rows: Iterable<number> | null, mark: Mark, size: number, color: string): void {
    const { context, view } = this;
    const count = xy.length / 2;
    const taken = count > MANY && !rows ? new Uint8Array((Math.ceil(view.width + 2 * this.extra) + 2) * (Math.ceil(view.height + 2 * this.extra) + 2)) : null;
    const across = Math.ceil(view.width + 2 * this.extra) + 2;
    context.fillStyle = color;
    context.strokeStyle = color;
    context.lineWidth = 2;
    const one = (row: number): void => {
      const [x, y] = toScreen(view, xy[2 * row]!, xy[2 * row + 1]!);
      if (!(x >= -this.extra && y >= -this.extra && x <= view.width + this.extra && y <= view.height + this.extra)) return;
      if (taken) {
        const cell = Math.floor(y + this.extra) * across + Math.floor(x + this.extra);
        if (taken[cell]) return;
        taken[cell] = 1;
        context.fillRect(x - size, y - size, 2 * size, 2 * size);
      } else this.mark(mark, x, y, size);
    };
    if (rows) for (const row of rows) one(row);
    else for (let row = 0; row < count; row += 1) one(row);
  }

  private mark(mark: Mark, x: number, y: number, size: number): void {
    const { context } = this;
    context.beginPath();
    if (mark === "dot" || mark === "ring") context.arc(x, y, size, 0, TAU);
    else for (const [dx, dy] of cornersOf(mark)) context.lineTo(x + size * dx, y + size * dy);
    if (mark === "dot") context.fill();
    else {
      context.closePath();
      context.stroke();
    }
  }

  labels(xy: Float64Array, texts: readonly (readonly [number, string])[], color: string): void {
    const { context, view } = this;
    context.fillStyle = color;
    context.font = "11px system-ui, sans-serif";
    const taken = new Set<string>();
    for (const [row, text] of texts) {
      const [x, y] = toScreen(view, xy[2 * row]!, xy[2 * row + 1]!);
      if (!(x >= -20 && y >= -20 && x <= view.width + 20 && y <= view.height + 20)) continue;
      // Labels that would lie on each other are left out: zooming in brings them.
      const [column, line] = [Math.round(x / LABEL[0]), Math.round(y / LABEL[1])];
      if ([-1, 0, 1].some((dx) => [-1, 0, 1].some((dy) => taken.has(`${column + dx},${line + dy}`)))) continue;
      taken.add(`${column},${line}`);
      context.fillText(text, x + 6, y - 5);
    }
  }

  private styled(stroke: Stroke, draw: () => void): void {
    const { context } = this;
    context.strokeStyle = stroke.color;
    context.lineWidth = stroke.width;
    context.globalAlpha = stroke.alpha ?? 1;
    context.setLineDash([...(stroke.dash ?? [])]);
    context.lineCap = stroke.dash ? "butt" : "round";
    draw();
    context.setLineDash([]);
    context.globalAlpha = 1;
  }
}

/** The corners of a mark around the origin, y downwards. */
export function cornersOf(mark: Mark): readonly (readonly [number, number])[] {
  if (mark === "triangle") return [[0, -1.2], [1.05, 0.75], [-1.05, 0.75]];
  if (mark === "diamond") return [[0, -1.25], [1.25, 0], [0, 1.25], [-1.25, 0]];
  if (mark === "cross") return [[-1, -1], [0, 0], [1, -1], [0, 0], [1, 1], [0, 0], [-1, 1], [0, 0]];
  return [[-1, -1], [1, -1], [1, 1], [-1, 1]];
}
