// From the pointer's events to tools and to the view: one finger or the left button is the tool, two fingers or the wheel zoom.

import type { Host, Place, Tool } from "./tool.ts";
import { toPlane, type View } from "../layers/view.ts";

export interface Surface extends Host {
  readonly view: View;
  readonly tool: Tool;
  readonly panner: Tool;
  zoom(factor: number, left: number, top: number): void;
  hovered(at: Place | null): void;
}

/** A factor of zoom for a notch of the wheel. */
const NOTCH = 1.0015;

export class Pointer {
  private readonly down = new Map<number, { left: number; top: number }>();
  private active: Tool | null = null;
  /** Where the next pull of the active tool is from. */
  private last: Place | null = null;
  private spread = 0;

  constructor(
    private readonly element: HTMLElement,
    private readonly surface: Surface,
  ) {
    element.addEventListener("pointerdown", (event) => this.pressed(event));
    element.addEventListener("pointermove", (event) => this.pulled(event));
    for (const name of ["pointerup", "pointercancel"] as const) element.addEventListener(name, (event) => this.released(event));
    element.addEventListener("pointerleave", () => surface.hovered(null));
    element.addEventListener("wheel", (event) => this.wheel(event), { passive: false });
    element.addEventListener("contextmenu", (event) => event.preventDefault());
  }

  private place(event: MouseEvent): Place {
    const box = this.element.getBoundingClientRect();
    const [left, top] = [event.clientX - box.left, event.clientY - box.top];
    const [x, y] = toPlane(this.surface.view, left, top);
    return { x, y, left, top, shift: event.shiftKey };
  }

  private pressed(event: PointerEvent): void {
    this.element.focus({ preventScroll: true });
    try {
      this.element.setPointerCapture(event.pointerId);
    } catch {
      // A pointer that is gone already cannot be captured.
    }
    const at = this.place(event);
    this.down.set(event.pointerId, at);
    if (this.down.size > 1) {
      this.stop(at);
      this.spread = this.pinch().spread;
      return;
    }
    this.active = event.button === 0 ? this.surface.tool : this.surface.panner;
    this.active.down?.(this.surface, at);
    this.last = at;
  }

  private pulled(event: PointerEvent): void {
    const at = this.place(event);
    if (this.down.size > 1 && this.down.has(event.pointerId)) return this.pinched(event.pointerId, at);
    if (this.active && this.last) this.last = this.active.pull(this.surface, this.last, at);
    else this.surface.hovered(at);
  }

  private pinched(id: number, at: Place): void {
    const before = this.pinch();
    this.down.set(id, at);
    const after = this.pinch();
    this.surface.pan(after.left - before.left, after.top - before.top);
    if (this.spread > 0 && after.spread > 0) this.surface.zoom(after.spread / this.spread, after.left, after.top);
    this.spread = after.spread;
  }

  /** The middle of the first two fingers, and how far apart they are. */
  private pinch(): { left: number; top: number; spread: number } {
    const [a, b] = [...this.down.values()];
    return { left: (a!.left + b!.left) / 2, top: (a!.top + b!.top) / 2, spread: Math.hypot(a!.left - b!.left, a!.top - b!.top) };
  }

  private released(event: PointerEvent): void {
    this.down.delete(event.pointerId);
    this.stop(this.place(event));
  }

  private stop(at: Place): void {
    this.active?.up?.(this.surface, at);
    this.active = null;
    this.last = null;
  }

  private wheel(event: WheelEvent): void {
    event.preventDefault();
    const at = this.place(event);
    const step = event.deltaMode === 1 ? 16 * event.deltaY : event.deltaY;
    this.surface.zoom(NOTCH ** -step, at.left, at.top);
  }
}
