// Curves as the module traces them, and the walk over them that every export shares.

export interface Curves {
  readonly indices: Uint32Array;
  readonly offsets: Uint32Array;
  readonly closed: Uint8Array;
  readonly isolated: Uint32Array;
  readonly shells: Int32Array;
}

export function curveOf(curves: Curves, k: number): Uint32Array {
  return curves.indices.subarray(curves.offsets[k], curves.offsets[k + 1]);
}

export function countsOf(curves: Curves): { rings: number; lines: number; isolated: number } {
  const rings = curves.closed.reduce((sum, each) => sum + each, 0);
  return { rings, lines: curves.closed.length - rings, isolated: curves.isolated.length };
}

function counted(count: number, noun: string): string {
  return `${count.toLocaleString("en")} ${noun}${count === 1 ? "" : "s"}`;
}

/** What there is, in words. */
export function summary(curves: Curves): string {
  const { rings, lines, isolated } = countsOf(curves);
  const parts = [counted(rings, "ring"), counted(lines, "line")];
  if (isolated) parts.push(counted(isolated, "isolated point"));
  return parts.join(", ");
}
