// The proof of an edge: the forbidden region of a β-skeleton, or the empty disk of the crust.

import type { Answer } from "../engine/protocol.ts";
import type { Choice } from "../model/document.ts";
import type { Proof } from "./layers.ts";

/** The edge whose segment is nearest to a place, within `reach`. */
export function edgeAt(answer: Answer, xy: Float64Array, x: number, y: number, reach: number): [number, number] | null {
  if (answer.xy.length !== xy.length) return null;
  const candidates = answer.triangulation ?? answer.edges;
  let best = reach;
  let found: [number, number] | null = null;
  for (const pairs of [candidates, answer.edges]) {
    for (let e = 0; e < pairs.length; e += 2) {
      const distance = distanceTo(xy, pairs[e]!, pairs[e + 1]!, x, y);
      if (distance <= best) [best, found] = [distance, [pairs[e]!, pairs[e + 1]!]];
    }
  }
  return found;
}

function distanceTo(xy: Float64Array, i: number, j: number, x: number, y: number): number {
  const [ax, ay, bx, by] = [xy[2 * i]!, xy[2 * i + 1]!, xy[2 * j]!, xy[2 * j + 1]!];
  const [dx, dy] = [bx - ax, by - ay];
  const t = Math.min(Math.max(((x - ax) * dx + (y - ay) * dy) / (dx * dx + dy * dy || 1), 0), 1);
  return Math.hypot(ax + t * dx - x, ay + t * dy - y);
}

/** The disks of an edge's forbidden region (paper, §2): two of radius βd/2 through both ends, or for β < 1 of radius d/2β. */
export function forbiddenRegion(xy: Float64Array, [i, j]: readonly [number, number], beta: number, lune: boolean): number[] {
  const [ax, ay, bx, by] = [xy[2 * i]!, xy[2 * i + 1]!, xy[2 * j]!, xy[2 * j + 1]!];
  const [dx, dy] = [(bx - ax) / 2, (by - ay) / 2];
  const half = Math.hypot(dx, dy);
  const radius = half * (beta >= 1 ? beta : 1 / beta);
  if (lune && beta >= 1) {
    const t = beta - 1;
    return [ax + dx + t * dx, ay + dy + t * dy, radius, ax + dx - t * dx, ay + dy - t * dy, radius];
  }
  const height = Math.sqrt(Math.max(radius * radius - half * half, 0)) / (half || 1);
  return [ax + dx - height * dy, ay + dy + height * dx, radius, ax + dx + height * dy, ay + dy - height * dx, radius];
}

function isIn(edges: Uint32Array, [i, j]: readonly [number, number]): boolean {
  for (let e = 0; e < edges.length; e += 2) if (edges[e] === i && edges[e + 1] === j) return true;
  return false;
}

/** What shows whether an edge belongs; `disk` is the crust's, if there is one. */
export function proofOf(answer: Answer, xy: Float64Array, edge: readonly [number, number], choice: Choice, disk: Float64Array | null): Proof {
  const name = `Edge ${edge[0]}–${edge[1]}`;
  if (choice.method === "beta-skeleton") {
    const [beta, kind] = [choice.parameters[0]!, choice.parameters[1]!];
    const disks = forbiddenRegion(xy, edge, beta, kind === 1);
    const region = kind === 1 || beta < 1 ? "where its two disks meet" : "the two disks together";
    const verdict = isIn(answer.edges, edge) ? "which holds no point" : "which holds a point, so it is no edge";
    return { edge, disks, says: `${name}: its forbidden region is ${region}, ${verdict}.` };
  }
  if (disk) return { edge, disks: Array.from(disk), says: `${name} is in the crust: this disk holds no point and no Voronoi vertex.` };
  return { edge, disks: [], says: `${name} is not in the crust: every disk through its ends holds a point or a Voronoi vertex.` };
}
