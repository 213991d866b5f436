// A pen that writes SVG: each call is a group with one path.

import { cornersOf } from "./canvas_pen.ts";
import type { Mark, Pen, Stroke } from "./pen.ts";
import { toScreen, type View } from "./view.ts";

function short(value: number): string {
  return String(Math.round(value * 100) / 100);
}

export class SvgPen implements Pen {
  private readonly parts: string[] = [];

  constructor(private readonly view: View) {}

  text(paper: string): string {
    const { width, height } = this.view;
    const size = `width="${short(width)}" height="${short(height)}" viewBox="0 0 ${short(width)} ${short(height)}"`;
    const ground = `<rect width="100%" height="100%" fill="${paper}"/>`;
    return `<svg xmlns="http://www.w3.org/2000/svg" ${size}>\n${[ground, ...this.parts].join("\n")}\n</svg>\n`;
  }

  edges(xy: Float64Array, pairs: Uint32Array, stroke: Stroke): void {
    this.segments(Float64Array.from(Array.from(pairs).flatMap((row) => [xy[2 * row]!, xy[2 * row + 1]!])), stroke);
  }

  segments(ends: ArrayLike<number>, stroke: Stroke): void {
    const lines: string[] = [];
    for (let k = 0; k < ends.length; k += 4) lines.push(`M${this.at(ends, k)}L${this.at(ends, k + 2)}`);
    this.path(lines, stroke);
  }

  cubics(control: ArrayLike<number>, stroke: Stroke): void {
    const pieces: string[] = [];
    for (let k = 0; k < control.length; k += 8) {
      pieces.push(`M${this.at(control, k)}C${[2, 4, 6].map((step) => this.at(control, k + step)).join(" ")}`);
    }
    this.path(pieces, stroke);
  }

  disks(disks: ArrayLike<number>, stroke: Stroke | null, fill: { color: string; alpha: number } | null): void {
    const style = `${fill ? `fill="${fill.color}" fill-opacity="${fill.alpha}"` : `fill="none"`} ${stroke ? strokeOf(stroke) : ""}`;
    const circles: string[] = [];
    for (let k = 0; k < disks.length; k += 3) {
      const [x, y] = toScreen(this.view, disks[k]!, disks[k + 1]!);
      const radius = disks[k + 2]! * this.view.scale;
      if (Number.isFinite(radius)) circles.push(`<circle cx="${short(x)}" cy="${short(y)}" r="${short(radius)}"/>`);
    }
    this.parts.push(`<g ${style}>${circles.join("")}</g>`);
  }

  marks(xy: Float64Array, rows: Iterable<number> | null, mark: Mark, size: number, color: string): void {
    const marks: string[] = [];
    for (const row of rows ?? Array.from({ length: xy.length / 2 }, (_, k) => k)) {
      const [x, y] = toScreen(this.view, xy[2 * row]!, xy[2 * row + 1]!);
      if (mark === "dot" || mark === "ring") marks.push(`<circle cx="${short(x)}" cy="${short(y)}" r="${size}"/>`);
      else marks.push(`<path d="M${cornersOf(mark).map(([dx, dy]) => `${short(x + size * dx)} ${short(y + size * dy)}`).join("L")}Z"/>`);
    }
    const style = mark === "dot" ? `fill="${color}"` : `fill="none" stroke="${color}" stroke-width="2"`;
    this.parts.push(`<g ${style}>${marks.join("")}</g>`);
  }

  labels(xy: Float64Array, texts: readonly (readonly [number, string])[], color: string): void {
    const labels = texts.map(([row, text]) => {
      const [x, y] = toScreen(this.view, xy[2 * row]!, xy[2 * row + 1]!);
      return `<text x="${short(x + 6)}" y="${short(y - 5)}">${text}</text>`;
    });
    this.parts.push(`<g fill="${color}" font-family="sans-serif" font-size="11">${labels.join("")}</g>`);
  }

  private at(values: ArrayLike<number>, k: number): string {
    return toScreen(this.view, values[k]!, values[k + 1]!).map(short).join(" ");
  }

  private path(pieces: string[], stroke: Stroke): void {
    this.parts.push(`<path fill="none" ${strokeOf(stroke)} d="${pieces.join("")}"/>`);
  }
}

function strokeOf({ color, width, dash, alpha }: Stroke): string {
  const dashes = dash ? ` stroke-dasharray="${dash.join(" ")}"` : ` stroke-linecap="round"`;
  return `stroke="${color}" stroke-width="${width}"${dashes}${alpha === undefined ? "" : ` stroke-opacity="${alpha}"`}`;
}
