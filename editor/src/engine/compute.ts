// Answers questions with the module. It keeps one triangulation: that of the points asked about last.

import { aShape, Delaunay } from "../../build/module/crustline.js";
import { THEOREMS } from "../model/catalog.ts";
import type { Curves } from "../model/curves.ts";
import type { Choice } from "../model/document.ts";
import type { Answer, Axis, Certificate, Connection, Part, Question } from "./protocol.ts";

export class Kernel {
  private version = -1;
  private xy: Float64Array = new Float64Array(0);
  private delaunay: Delaunay | null = null;
  private voronoi: Axis | null = null;

  answer(question: Omit<Question, "xy"> & { xy: Float64Array | null }): Answer {
    const start = performance.now();
    const delaunay = this.triangulated(question.version, question.xy);
    const edges = this.select(delaunay, question.choice);
    const other = question.other && this.select(delaunay, question.other);
    const wants = (part: Part): boolean => question.parts.includes(part);
    return {
      version: question.version,
      xy: this.xy,
      edges,
      curves: curvesOf(delaunay, edges),
      duplicates: delaunay.duplicates().length / 2,
      missing: other && without(other, edges),
      extra: other && without(edges, other),
      triangulation: wants("triangulation") ? delaunay.edges() : null,
      voronoi: wants("voronoi") ? (this.voronoi ??= axisOf(delaunay, new Uint32Array(0))) : null,
      axis: wants("axis") ? axisOf(delaunay, edges) : null,
      sizes: wants("sizes") ? delaunay.localFeatureSize(edges) : null,
      certificate: wants("certificate") ? certificateOf(delaunay, edges) : null,
      smooth: wants("smooth") ? delaunay.tangents(edges) : null,
      connection: wants("connection") && question.choice.method === "connect" ? connectionOf(delaunay) : null,
      milliseconds: performance.now() - start,
    };
  }

  /** The empty disk that proves an edge to be in the crust of the points asked about last. */
  disk([i, j]: readonly [number, number]): Float64Array | null {
    return this.delaunay?.emptyDisk(i, j) ?? null;
  }

  private triangulated(version: number, xy: Float64Array | null): Delaunay {
    if (this.delaunay && version === this.version) return this.delaunay;
    if (!xy) throw new Error("the points of this question were not sent");
    this.delaunay?.free();
    this.delaunay = null;
    this.delaunay = new Delaunay(xy);
    [this.version, this.xy, this.voronoi] = [version, xy, null];
    return this.delaunay;
  }

  private select(delaunay: Delaunay, { method, parameters }: Choice): Uint32Array {
    // Of the points and their Voronoi vertices: the crust as the paper computes it.
    if (method === "a-shape") return aShape(this.xy, delaunay.circumcenters().filter(Number.isFinite));
    return delaunay.select(method, Float64Array.from(parameters));
  }
}

function curvesOf(delaunay: Delaunay, edges: Uint32Array): Curves {
  const traced = delaunay.trace(edges);
  const { indices, offsets, closed, isolated, shells } = traced;
  traced.free();
  return { indices, offsets, closed, isolated, shells };
}

function axisOf(delaunay: Delaunay, edges: Uint32Array): Axis {
  const found = delaunay.medialAxis(edges);
  const { vertices, edges: pairs, inner, rayOrigins, rayDirections } = found;
  found.free();
  return { vertices, edges: pairs, inner, rayOrigins, rayDirections };
}

function certificateOf(delaunay: Delaunay, edges: Uint32Array): Certificate {
  const found = delaunay.certify(edges, Float64Array.from(THEOREMS));
  const { theorem, threshold, guaranteed, ratios, edgeReasons, pointReasons } = found;
  found.free();
  return { theorem, threshold, guaranteed, ratios, edgeReasons, pointReasons };
}

function connectionOf(delaunay: Delaunay): Connection {
  const found = delaunay.connection();
  const { confidence, whole, leftOut } = found;
  found.free();
  return { confidence, whole, leftOut };
}

/** The edges that are not among others; both are sorted. */
export function without(edges: Uint32Array, others: Uint32Array): Uint32Array {
  const found: number[] = [];
  let k = 0;
  for (let e = 0; e < edges.length; e += 2) {
    const [i, j] = [edges[e]!, edges[e + 1]!];
    while (k < others.length && (others[k]! < i || (others[k] === i && others[k + 1]! < j))) k += 2;
    if (k >= others.length || others[k] !== i || others[k + 1] !== j) found.push(i, j);
  }
  return Uint32Array.from(found);
}
