// Where the plane is on the screen.

import type { Box } from "../model/cloud.ts";

export interface View {
  /** The place in the middle of the screen. */
  readonly x: number;
  readonly y: number;
  /** Pixels of the style sheet for a unit. */
  readonly scale: number;
  readonly width: number;
  readonly height: number;
}

const MARGIN = 0.09;

export function toScreen(view: View, x: number, y: number): [number, number] {
  return [(x - view.x) * view.scale + view.width / 2, (view.y - y) * view.scale + view.height / 2];
}

export function toPlane(view: View, left: number, top: number): [number, number] {
  return [view.x + (left - view.width / 2) / view.scale, view.y - (top - view.height / 2) / view.scale];
}

/** The part of the plane that is seen, and `extra` pixels around it. */
export function seen(view: View, extra = 0): Box {
  const [halfWidth, halfHeight] = [(view.width / 2 + extra) / view.scale, (view.height / 2 + extra) / view.scale];
  return { left: view.x - halfWidth, right: view.x + halfWidth, bottom: view.y - halfHeight, top: view.y + halfHeight };
}

/** The view that shows a box; an empty one is given the size of a unit. */
export function fitted(view: View, box: Box | null): View {
  const { left, bottom, right, top } = box ?? { left: -1, bottom: -1, right: 1, top: 1 };
  const room = 1 - 2 * MARGIN;
  const scale = Math.min((view.width * room) / (right - left || 1e-300), (view.height * room) / (top - bottom || 1e-300));
  const largest = Math.max(Math.abs(left), Math.abs(right), Math.abs(bottom), Math.abs(top), 1e-300);
  const usable = scale < 1e15 / largest ? scale : view.width / (2 * (right === left && top === bottom ? 1 : largest));
  return { ...view, x: left + (right - left) / 2, y: bottom + (top - bottom) / 2, scale: usable };
}

/** Zoomed by a factor, so that what is at a place of the screen stays there. */
export function zoomed(view: View, factor: number, left: number, top: number): View {
  const [x, y] = toPlane(view, left, top);
  const scale = Math.min(Math.max(view.scale * factor, 1e-290), 1e290);
  const next = { ...view, scale };
  const [nextX, nextY] = toPlane(next, left, top);
  return { ...next, x: view.x + x - nextX, y: view.y + y - nextY };
}

export function panned(view: View, right: number, down: number): View {
  return { ...view, x: view.x - right / view.scale, y: view.y + down / view.scale };
}
