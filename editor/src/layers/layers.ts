// The layers: each draws a part of an answer, from the bottom to the top of the picture.

import { PARTS, REASONS, type Answer, type Axis, type Part } from "../engine/protocol.ts";
import type { Pen, Mark, Stroke } from "./pen.ts";
import type { Palette } from "./palette.ts";
import { seen, type View } from "./view.ts";

export interface Scene {
  /** The points as they are now; an answer may be about earlier ones. */
  readonly xy: Float64Array;
  readonly answer: Answer | null;
  readonly chosen: ReadonlySet<number>;
  readonly hover: Proof | null;
}

/** What shows that an edge belongs, or does not: disks, and whether they should be empty together. */
export interface Proof {
  readonly edge: readonly [number, number];
  readonly disks: readonly number[];
  readonly says: string;
}

export interface Layer {
  readonly name: string;
  readonly title: string;
  readonly says: string;
  /** The part of the answer that it needs. */
  readonly part?: Part;
  readonly color: (palette: Palette) => string;
  readonly sign: "line" | "thick" | "dashed" | "dot" | "disk" | "mark" | "text";
  draw(pen: Pen, scene: Scene, palette: Palette, view: View): void;
}

/** The coordinates that an answer's rows are drawn at: those of now, if the rows are the same. */
function places({ xy, answer }: Scene): Float64Array {
  return answer && answer.xy.length === xy.length ? xy : (answer?.xy ?? xy);
}

function axisSegments(axis: Axis, view: View): number[] {
  const { vertices, edges, rayOrigins, rayDirections } = axis;
  const at = (vertex: number): [number, number] => [vertices[2 * vertex]!, vertices[2 * vertex + 1]!];
  const ends: number[] = [];
  for (let e = 0; e < edges.length; e += 2) ends.push(...at(edges[e]!), ...at(edges[e + 1]!));
  const box = seen(view);
  for (let k = 0; k < rayOrigins.length; k += 1) {
    const [x, y] = at(rayOrigins[k]!);
    const far = Math.max(box.right - box.left, box.top - box.bottom) + Math.hypot(x - view.x, y - view.y);
    ends.push(x, y, x + far * rayDirections[2 * k]!, y + far * rayDirections[2 * k + 1]!);
  }
  return ends;
}

function disksOf(xy: Float64Array, sizes: Float64Array): number[] {
  return Array.from(sizes).flatMap((size, row) => (size > 0 && Number.isFinite(size) ? [xy[2 * row]!, xy[2 * row + 1]!, size] : []));
}

/** Cubics that have the tangents of the interpolant at the points; a chord where there is none. */
function cubicsOf(xy: Float64Array, tangents: Float64Array, edges: Uint32Array): number[] {
  const control: number[] = [];
  for (let e = 0; e < edges.length; e += 2) {
    const [i, j] = [2 * edges[e]!, 2 * edges[e + 1]!];
    const [dx, dy] = [xy[j]! - xy[i]!, xy[j + 1]! - xy[i + 1]!];
    const third = Math.hypot(dx, dy) / 3;
    const along = (row: number): [number, number] => {
      const [tx, ty] = [tangents[row]!, tangents[row + 1]!];
      if (!Number.isFinite(tx)) return [dx / 3, dy / 3];
      const sign = tx * dx + ty * dy < 0 ? -third : third;
      return [sign * tx, sign * ty];
    };
    const [a, b] = [along(i), along(j)];
    control.push(xy[i]!, xy[i + 1]!, xy[i]! + a[0], xy[i + 1]! + a[1], xy[j]! - b[0], xy[j + 1]! - b[1], xy[j]!, xy[j + 1]!);
  }
  return control;
}

export const WEAK_MARKS: Readonly<Record<string, Mark>> = {
  missing: "cross", corner: "triangle", endpoint: "square", branch: "diamond", isolated: "cross", unselected: "cross",
};

/** What is less sure than the first is drawn as wide as the second. */
const UNSURE = [[0.9, 5], [0.5, 9]] as const;

const thin = (color: string): Stroke => ({ color, width: 1 });

export const LAYERS: readonly Layer[] = [
  {
    name: "sizes", title: "Local feature size", says: "Disks whose radius is the distance to the medial axis", part: "sizes",
    color: (palette) => palette.size, sign: "disk",
    draw(pen, scene, palette) {
      const sizes = scene.answer?.sizes;
      if (sizes) pen.disks(disksOf(places(scene), sizes), { color: palette.size, width: 1, alpha: 0.7 }, { color: palette.size, alpha: 0.06 });
    },
  },
  {
    name: "triangulation", title: "Delaunay triangulation", says: "Triangles whose circles hold no point", part: "triangulation",
    color: (palette) => palette.triangulation, sign: "line",
    draw(pen, scene, palette) {
      if (scene.answer?.triangulation) pen.edges(places(scene), scene.answer.triangulation, thin(palette.triangulation));
    },
  },
  {
    name: "voronoi", title: "Voronoi diagram", says: "Cells of what is nearest to each point", part: "voronoi",
    color: (palette) => palette.voronoi, sign: "dashed",
    draw(pen, scene, palette, view) {
      if (scene.answer?.voronoi) pen.segments(axisSegments(scene.answer.voronoi, view), { color: palette.voronoi, width: 1.1, dash: [5, 3] });
    },
  },
  {
    name: "axis", title: "Medial axis", says: "Voronoi edges that the curve does not cross", part: "axis",
    color: (palette) => palette.axis, sign: "line",
    draw(pen, scene, palette, view) {
      if (scene.answer?.axis) pen.segments(axisSegments(scene.answer.axis, view), { color: palette.axis, width: 1.4 });
    },
  },
  {
    name: "curve", title: "Curve", says: "The edges of the method",
    color: (palette) => palette.curve, sign: "thick",
    draw(pen, scene, palette) {
      if (scene.answer) pen.edges(places(scene), scene.answer.edges, { color: palette.curve, width: 2.4 });
    },
  },
  {
    name: "difference", title: "Differences", says: "Edges of only one of the two methods compared: thick those of the first, dashed those of the other",
    color: (palette) => palette.missing, sign: "dashed",
    draw(pen, scene, palette) {
      const { extra, missing } = scene.answer ?? {};
      if (extra) pen.edges(places(scene), extra, { color: palette.extra, width: 5, alpha: 0.75 });
      if (missing) pen.edges(places(scene), missing, { color: palette.missing, width: 3, dash: [7, 4] });
    },
  },
  {
    name: "confidence", title: "Confidence", part: "connection",
    says: "Edges of connect that are less than 90 % sure, the thicker the less; dashed, edges of the crust that it leaves out",
    color: (palette) => palette.weak, sign: "dashed",
    draw(pen, scene, palette) {
      const { connection, edges } = scene.answer ?? {};
      if (!connection || !edges) return;
      for (const [least, width] of UNSURE) {
        const unsure = Array.from(edges).filter((_, k) => connection.confidence[k >> 1]! < least);
        pen.edges(places(scene), Uint32Array.from(unsure), { color: palette.weak, width, alpha: 0.4 });
      }
      pen.edges(places(scene), connection.leftOut, { color: palette.weak, width: 2, dash: [7, 4] });
    },
  },
  {
    name: "smooth", title: "Smooth curve", says: "Cubics along the tangents of the interpolant that feature sizes rest on", part: "smooth",
    color: (palette) => palette.smooth, sign: "line",
    draw(pen, scene, palette) {
      const { smooth, edges } = scene.answer ?? {};
      if (smooth && edges) pen.cubics(cubicsOf(places(scene), smooth, edges), { color: palette.smooth, width: 2 });
    },
  },
  {
    name: "points", title: "Points", says: "The points",
    color: (palette) => palette.ink, sign: "dot",
    draw(pen, scene, palette) {
      const many = scene.xy.length > 4000;
      pen.marks(scene.xy, null, "dot", many ? (scene.xy.length > 60000 ? 1 : 1.5) : 3, palette.ink);
    },
  },
  {
    name: "weak", title: "Weak places", says: "Where no theorem applies, and why", part: "certificate",
    color: (palette) => palette.weak, sign: "mark",
    draw(pen, scene, palette) {
      const { certificate, edges } = scene.answer ?? {};
      if (!certificate || !edges) return;
      const weak = certificate.edgeReasons;
      pen.edges(places(scene), Uint32Array.from(Array.from(edges).filter((_, k) => weak[k >> 1])), { color: palette.weak, width: 4, alpha: 0.55 });
      REASONS.forEach((reason, code) => {
        const rows = Array.from(certificate.pointReasons.keys()).filter((row) => code && certificate.pointReasons[row] === code);
        if (rows.length && reason !== "undersampled") pen.marks(places(scene), rows, WEAK_MARKS[reason]!, 7, palette.weak);
      });
    },
  },
  {
    name: "indices", title: "Indices", says: "The row of each point",
    color: (palette) => palette.faint, sign: "text",
    draw(pen, scene, palette) {
      const most = Math.min(scene.xy.length / 2, 3000);
      pen.labels(scene.xy, Array.from({ length: most }, (_, row) => [row, String(row)] as const), palette.faint);
    },
  },
];

/** What is drawn above all layers: the selection, and the proof of the edge under the pointer. */
export function drawMarked(pen: Pen, scene: Scene, palette: Palette): void {
  if (scene.chosen.size) pen.marks(scene.xy, scene.chosen, "ring", 6.5, palette.chosen);
  const { hover } = scene;
  if (!hover) return;
  pen.disks(hover.disks, { color: palette.proof, width: 1.6 }, { color: palette.proof, alpha: 0.12 });
  pen.edges(places(scene), Uint32Array.from(hover.edge), { color: palette.proof, width: 4 });
}

export function draw(pen: Pen, scene: Scene, shown: ReadonlySet<string>, palette: Palette, view: View): void {
  for (const layer of LAYERS) if (shown.has(layer.name)) layer.draw(pen, scene, palette, view);
}

/** The parts of an answer that the shown layers need. */
export function partsOf(shown: ReadonlySet<string>): Part[] {
  return PARTS.filter((part) => LAYERS.some((layer) => layer.part === part && shown.has(layer.name)));
}
