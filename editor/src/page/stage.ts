// The canvas: the picture below, what follows the pointer above. A picture that takes long is moved as it is and drawn anew when the
// view rests.

import { CanvasPen } from "../layers/canvas_pen.ts";
import { draw, drawMarked, type Scene } from "../layers/layers.ts";
import type { Palette } from "../layers/palette.ts";
import { toScreen, type View } from "../layers/view.ts";
import type { Box } from "../model/cloud.ts";
import { h } from "./dom.ts";

/** Milliseconds of drawing above which a view on the move shows the picture as it was. */
const SLOW = 14;
/** Milliseconds without a move after which it is drawn anew. */
const REST = 120;
/** How much is drawn around the view of a slow picture, as a part of it. */
const AROUND = 0.3;

export interface Shown {
  readonly scene: Scene;
  readonly layers: ReadonlySet<string>;
  readonly palette: Palette;
}

export class Stage {
  readonly element = h("div", { class: "stage", tabindex: "0", role: "application", "aria-label": "Drawing of points and curves" });
  view: View = { x: 0, y: 0, scale: 100, width: 100, height: 100 };
  rubber: Box | null = null;
  cursor: readonly [number, number] | null = null;
  /** What the last full drawing took. */
  cost = 0;
  private readonly front = h("canvas");
  private readonly above = h("canvas");
  private readonly back = document.createElement("canvas");
  private drawn: { view: View; extra: number } | null = null;
  private frame = 0;
  private timer = 0;
  private stale = true;

  constructor(
    private readonly shown: () => Shown,
    private readonly resized: () => void,
    private readonly after: () => void,
  ) {
    this.element.append(this.front, this.above);
    new ResizeObserver(() => this.fit()).observe(this.element);
  }

  /** The picture has changed. */
  refresh(): void {
    this.stale = true;
    this.schedule();
  }

  /** Only what is above the picture has. */
  touch(): void {
    this.schedule();
  }

  look(view: View): void {
    this.view = view;
    if (this.cost < SLOW) this.stale = true;
    else {
      clearTimeout(this.timer);
      this.timer = window.setTimeout(() => this.refresh(), REST);
    }
    this.schedule();
  }

  private fit(): void {
    const { clientWidth: width, clientHeight: height } = this.element;
    if (!width || !height) return;
    for (const canvas of [this.front, this.above]) {
      canvas.width = Math.round(width * devicePixelRatio);
      canvas.height = Math.round(height * devicePixelRatio);
    }
    this.view = { ...this.view, width, height };
    this.resized();
    this.stale = true;
    this.paint();
  }

  private schedule(): void {
    this.frame ||= requestAnimationFrame(() => this.paint());
  }

  private paint(): void {
    cancelAnimationFrame(this.frame);
    this.frame = 0;
    if (this.stale) this.drawBack();
    this.copy();
    this.drawAbove();
    this.after();
  }

  private drawBack(): void {
    const start = performance.now();
    const { scene, layers, palette } = this.shown();
    const { view } = this;
    const extra = this.cost < SLOW ? 0 : Math.round(AROUND * Math.max(view.width, view.height));
    const ratio = devicePixelRatio;
    this.back.width = Math.round((view.width + 2 * extra) * ratio);
    this.back.height = Math.round((view.height + 2 * extra) * ratio);
    const context = this.back.getContext("2d")!;
    context.fillStyle = palette.paper;
    context.fillRect(0, 0, this.back.width, this.back.height);
    context.setTransform(ratio, 0, 0, ratio, extra * ratio, extra * ratio);
    draw(new CanvasPen(context, view, extra), scene, layers, palette, view);
    this.drawn = { view, extra };
    this.stale = false;
    this.cost = performance.now() - start;
  }

  /** The picture as it was drawn, moved to where it is now. */
  private copy(): void {
    const { drawn, view } = this;
    if (!drawn) return;
    const context = this.front.getContext("2d")!;
    const ratio = devicePixelRatio;
    const zoom = view.scale / drawn.view.scale;
    const [left, top] = toScreen(view, drawn.view.x, drawn.view.y);
    const [width, height] = [drawn.view.width + 2 * drawn.extra, drawn.view.height + 2 * drawn.extra].map((size) => size * zoom) as [number, number];
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.fillStyle = this.shown().palette.paper;
    context.fillRect(0, 0, this.front.width, this.front.height);
    const at = zoom === 1 ? Math.round : (x: number): number => x;
    context.drawImage(this.back, at((left - width / 2) * ratio), at((top - height / 2) * ratio), width * ratio, height * ratio);
  }

  private drawAbove(): void {
    const context = this.above.getContext("2d")!;
    const { scene, palette } = this.shown();
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.clearRect(0, 0, this.above.width, this.above.height);
    context.setTransform(devicePixelRatio, 0, 0, devicePixelRatio, 0, 0);
    drawMarked(new CanvasPen(context, this.view), scene, palette);
    context.strokeStyle = palette.chosen;
    context.lineWidth = 1;
    context.setLineDash([4, 3]);
    if (this.rubber) {
      const [left, top] = toScreen(this.view, this.rubber.left, this.rubber.top);
      const [right, bottom] = toScreen(this.view, this.rubber.right, this.rubber.bottom);
      context.strokeRect(left, top, right - left, bottom - top);
    }
    context.setLineDash([]);
    if (this.cursor) this.cross(context, ...this.cursor);
  }

  /** The place that the keyboard works at. */
  private cross(context: CanvasRenderingContext2D, x: number, y: number): void {
    const [left, top] = toScreen(this.view, x, y);
    context.beginPath();
    for (const [dx, dy] of [[1, 0], [0, 1]] as const) {
      context.moveTo(left - 12 * dx, top - 12 * dy);
      context.lineTo(left + 12 * dx, top + 12 * dy);
    }
    context.stroke();
  }
}
