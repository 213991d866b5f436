// What is edited: points, a method with its parameters, and one to compare with. Plain data; undo and redo are lists of it.

import { EMPTY, type Cloud } from "./cloud.ts";
import { startOf } from "./catalog.ts";

export interface Choice {
  readonly method: string;
  readonly parameters: readonly number[];
}

/** The file that the points came from, where a server keeps it. */
export interface Source {
  readonly id: string;
  readonly name: string;
  readonly says: string;
}

export interface Document {
  readonly cloud: Cloud;
  readonly choice: Choice;
  readonly other: Choice | null;
  readonly source: Source | null;
}

export function choose(method: string): Choice {
  return { method, parameters: startOf(method) };
}

export function blank(): Document {
  return { cloud: EMPTY, choice: choose("connect"), other: null, source: null };
}

export interface History {
  readonly past: readonly Document[];
  readonly now: Document;
  readonly future: readonly Document[];
}

/** Steps kept, and the points that all of them may hold together. */
const MOST_STEPS = 500;
const MOST_POINTS = 20_000_000;

export function begin(document: Document): History {
  return { past: [], now: document, future: [] };
}

export function changed(history: History, next: Document): History {
  const past = [...history.past, history.now].slice(-MOST_STEPS);
  let room = MOST_POINTS;
  let first = past.length;
  while (first > 0 && (room -= past[first - 1]!.cloud.rows.length) > 0) first -= 1;
  return { past: past.slice(first), now: next, future: [] };
}

/** The same step going on: a drag, or a slider on its way. */
export function amended(history: History, next: Document): History {
  return { ...history, now: next };
}

export function undone(history: History): History {
  const last = history.past.at(-1);
  if (!last) return history;
  return { past: history.past.slice(0, -1), now: last, future: [history.now, ...history.future] };
}

export function redone(history: History): History {
  const [next, ...future] = history.future;
  if (!next) return history;
  return { past: [...history.past, history.now], now: next, future };
}
