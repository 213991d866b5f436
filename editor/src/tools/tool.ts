// What a tool is: it takes what the pointer does and changes points through its host.

import type { Box, Cloud } from "../model/cloud.ts";

export interface Place {
  /** In the plane. */
  readonly x: number;
  readonly y: number;
  /** On the screen, in pixels. */
  readonly left: number;
  readonly top: number;
  /** Whether to add to what is selected, or keep a direction. */
  readonly shift: boolean;
}

export interface Host {
  readonly cloud: Cloud;
  readonly chosen: ReadonlySet<number>;
  /** How far a pixel is in the plane. */
  readonly pixel: number;
  /** How near, in pixels, is on a point: more for fingers. */
  readonly reach: number;
  /** A new step of the history; with `again` the step goes on. */
  edit(cloud: Cloud, again?: boolean): void;
  choose(rows: ReadonlySet<number>): void;
  /** Draws a box while it is pulled open; null when it is not. */
  rubber(box: Box | null): void;
  pan(right: number, down: number): void;
}

export interface Tool {
  readonly name: string;
  readonly title: string;
  readonly key: string;
  readonly says: string;
  readonly icon: string;
  readonly cursor: string;
  down?(host: Host, at: Place): void;
  /** Pulls from a place to the next one; gives the place that the next pull is from. */
  pull(host: Host, from: Place, at: Place): Place;
  up?(host: Host, at: Place): void;
}
