// What layers draw with: a canvas and an SVG file are two pens.

export interface Stroke {
  readonly color: string;
  readonly width: number;
  readonly dash?: readonly number[];
  readonly alpha?: number;
}

export type Mark = "dot" | "ring" | "square" | "diamond" | "triangle" | "cross";

export interface Pen {
  /** Straight segments between rows of xy: i, j, i, j, … */
  edges(xy: Float64Array, pairs: Uint32Array, stroke: Stroke): void;
  /** Straight segments: x, y, x, y for each. */
  segments(ends: ArrayLike<number>, stroke: Stroke): void;
  /** Cubics of Bézier: eight numbers each. */
  cubics(control: ArrayLike<number>, stroke: Stroke): void;
  /** Disks: x, y and the radius of each, in the plane. */
  disks(disks: ArrayLike<number>, stroke: Stroke | null, fill: { readonly color: string; readonly alpha: number } | null): void;
  /** Marks of a size in pixels at some of the points, or at all. */
  marks(xy: Float64Array, rows: Iterable<number> | null, mark: Mark, size: number, color: string): void;
  /** A line of text beside each of the points. */
  labels(xy: Float64Array, texts: readonly (readonly [number, string])[], color: string): void;
}
