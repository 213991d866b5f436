// The points: coordinates, and for each the row of the opened file that it came from. Nothing here changes a cloud; edits make new ones.

export interface Cloud {
  /** x, y, x, y, … */
  readonly xy: Float64Array;
  /** The row of the file that each point was read from; −1 for new ones. */
  readonly rows: Int32Array;
}

export interface Box {
  readonly left: number;
  readonly bottom: number;
  readonly right: number;
  readonly top: number;
}

export const EMPTY: Cloud = { xy: new Float64Array(0), rows: new Int32Array(0) };

export function sizeOf(cloud: Cloud): number {
  return cloud.rows.length;
}

/** Points that come from no file. */
export function fresh(xy: ArrayLike<number>): Cloud {
  return { xy: Float64Array.from(xy), rows: new Int32Array(xy.length / 2).fill(-1) };
}

/** Points as they were read: row k is row k of the file. */
export function opened(xy: ArrayLike<number>): Cloud {
  return { xy: Float64Array.from(xy), rows: Int32Array.from({ length: xy.length / 2 }, (_, k) => k) };
}

export function appended(cloud: Cloud, xy: ArrayLike<number>): Cloud {
  const more = fresh(xy);
  const joined = { xy: new Float64Array(cloud.xy.length + more.xy.length), rows: new Int32Array(sizeOf(cloud) + sizeOf(more)) };
  joined.xy.set(cloud.xy);
  joined.xy.set(more.xy, cloud.xy.length);
  joined.rows.set(cloud.rows);
  joined.rows.set(more.rows, cloud.rows.length);
  return joined;
}

/** The points whose index `keep` keeps, in their order. */
export function filtered(cloud: Cloud, keep: (index: number) => boolean): Cloud {
  const kept = Array.from(cloud.rows.keys()).filter(keep);
  return {
    xy: Float64Array.from(kept.flatMap((k) => [cloud.xy[2 * k]!, cloud.xy[2 * k + 1]!])),
    rows: Int32Array.from(kept, (k) => cloud.rows[k]!),
  };
}

export function without(cloud: Cloud, indices: ReadonlySet<number>): Cloud {
  return filtered(cloud, (index) => !indices.has(index));
}

export function moved(cloud: Cloud, indices: Iterable<number>, dx: number, dy: number): Cloud {
  const xy = cloud.xy.slice();
  for (const k of indices) {
    xy[2 * k] += dx;
    xy[2 * k + 1] += dy;
  }
  return { xy, rows: cloud.rows };
}

/** Each point moved by up to `size` in x and in y; `random` gives numbers from 0 to 1. */
export function jittered(cloud: Cloud, indices: Iterable<number>, size: number, random: () => number): Cloud {
  const xy = cloud.xy.slice();
  for (const k of indices) {
    xy[2 * k] += size * (2 * random() - 1);
    xy[2 * k + 1] += size * (2 * random() - 1);
  }
  return { xy, rows: cloud.rows };
}

export function boundsOf(cloud: Cloud): Box | null {
  const box = { left: Infinity, bottom: Infinity, right: -Infinity, top: -Infinity };
  for (let k = 0; k < cloud.xy.length; k += 2) {
    box.left = Math.min(box.left, cloud.xy[k]!);
    box.right = Math.max(box.right, cloud.xy[k]!);
    box.bottom = Math.min(box.bottom, cloud.xy[k + 1]!);
    box.top = Math.max(box.top, cloud.xy[k + 1]!);
  }
  return cloud.xy.length ? box : null;
}

/** The index of the point nearest to a place, if one is within `reach`. */
export function nearest(cloud: Cloud, x: number, y: number, reach: number): number | null {
  let best = reach * reach;
  let found: number | null = null;
  for (let k = 0; k < cloud.xy.length; k += 2) {
    const square = (cloud.xy[k]! - x) ** 2 + (cloud.xy[k + 1]! - y) ** 2;
    if (square <= best) {
      best = square;
      found = k / 2;
    }
  }
  return found;
}

export function within(cloud: Cloud, box: Box): Set<number> {
  const found = new Set<number>();
  for (let k = 0; k < cloud.xy.length; k += 2) {
    const [x, y] = [cloud.xy[k]!, cloud.xy[k + 1]!];
    if (x >= box.left && x <= box.right && y >= box.bottom && y <= box.top) found.add(k / 2);
  }
  return found;
}

/** The points within `reach` of the segment from one place to another. */
export function along(cloud: Cloud, from: { x: number; y: number }, to: { x: number; y: number }, reach: number): Set<number> {
  const [dx, dy] = [to.x - from.x, to.y - from.y];
  const found = new Set<number>();
  for (let k = 0; k < cloud.xy.length; k += 2) {
    const [x, y] = [cloud.xy[k]! - from.x, cloud.xy[k + 1]! - from.y];
    const t = Math.min(Math.max((x * dx + y * dy) / (dx * dx + dy * dy || 1), 0), 1);
    if (Math.hypot(x - t * dx, y - t * dy) <= reach) found.add(k / 2);
  }
  return found;
}
