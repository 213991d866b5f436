// What is asked of the engine, and what it answers: plain data that can be posted between threads.

import type { Curves } from "../model/curves.ts";
import type { Choice } from "../model/document.ts";

/** The parts of an answer that take time and are only made when they are shown. */
export const PARTS = ["triangulation", "voronoi", "axis", "sizes", "certificate", "smooth", "connection"] as const;
export type Part = (typeof PARTS)[number];

export interface Question {
  /** Which points: they are sent when the number is new. */
  readonly version: number;
  readonly xy: Float64Array;
  readonly choice: Choice;
  readonly other: Choice | null;
  readonly parts: readonly Part[];
}

export interface Axis {
  readonly vertices: Float64Array;
  readonly edges: Uint32Array;
  readonly inner: Uint8Array;
  readonly rayOrigins: Uint32Array;
  readonly rayDirections: Float64Array;
}

export interface Certificate {
  readonly theorem: string;
  readonly threshold: number;
  readonly guaranteed: boolean;
  readonly ratios: Float64Array;
  readonly edgeReasons: Uint8Array;
  readonly pointReasons: Uint8Array;
}

/** How sure `connect` is of each of its edges, and what of the crust it leaves out. */
export interface Connection {
  readonly confidence: Float64Array;
  readonly whole: number;
  readonly leftOut: Uint32Array;
}

export const REASONS = ["", "undersampled", "missing", "corner", "endpoint", "branch", "isolated", "unselected"] as const;

export interface Answer {
  readonly version: number;
  readonly xy: Float64Array;
  /** i, j, i, j, … */
  readonly edges: Uint32Array;
  readonly curves: Curves;
  readonly duplicates: number;
  /** The edges of the other method that this one lacks, and those of this one that the other lacks. */
  readonly missing: Uint32Array | null;
  readonly extra: Uint32Array | null;
  readonly triangulation: Uint32Array | null;
  readonly voronoi: Axis | null;
  readonly axis: Axis | null;
  readonly sizes: Float64Array | null;
  readonly certificate: Certificate | null;
  /** Unit tangents of the smooth interpolant, x and y for each point. */
  readonly smooth: Float64Array | null;
  /** Of the method `connect` alone. */
  readonly connection: Connection | null;
  /** How long the work took. */
  readonly milliseconds: number;
}

export type Request =
  | { readonly kind: "ask"; readonly number: number; readonly question: Omit<Question, "xy"> & { readonly xy: Float64Array | null } }
  | { readonly kind: "disk"; readonly number: number; readonly edge: readonly [number, number] };

export type Reply =
  | { readonly number: number; readonly answer: Answer }
  | { readonly number: number; readonly disk: Float64Array | null }
  | { readonly number: number; readonly error: string; readonly dead: boolean };
