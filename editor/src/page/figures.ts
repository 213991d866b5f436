// Figures of the paper, live: a state without tools, with one slider or points to drag.

import examples from "../../build/data/examples.json";
import samples from "../../build/data/samples.json";
import { fresh, type Cloud } from "../model/cloud.ts";
import { blank, choose, type Document } from "../model/document.ts";

export interface Figure {
  readonly title: string;
  readonly document: Document;
  readonly layers: readonly string[];
  /** What the slider changes: the number of a parameter of the method, or r of a named curve. */
  readonly slider: { readonly parameter: number } | { readonly curve: string } | null;
}

export const CURVES: readonly string[] = Object.keys(samples.curves);
export const RATIOS: readonly number[] = samples.ratios;
export const EXAMPLES: readonly string[] = Object.keys(examples);

/** An r-sample of a named curve, drawn ahead by the library. */
export function sampled(curve: string, k: number): Cloud {
  return fresh((samples.curves as Record<string, number[][]>)[curve]![k]!);
}

export function example(name: string): Cloud {
  return fresh((examples as Record<string, number[]>)[name]!);
}

function figure(title: string, cloud: Cloud, method: string, layers: readonly string[], slider: Figure["slider"], other: string | null = null): Figure {
  const document = { ...blank(), cloud, choice: choose(method), other: other === null ? null : choose(other) };
  return { title, document, layers: ["curve", "points", ...layers], slider };
}

export const FIGURES: Readonly<Record<string, Figure>> = {
  "3": figure("Figure 3: point at an edge to see its forbidden region; β sets its size", sampled("Trefoil", 9), "beta-skeleton", ["triangulation"], { parameter: 0 }),
  "6": figure("Figure 6: the same points sample one curve, or two: drag them", example(EXAMPLES[1]!), "crust", ["difference"], null, "beta-skeleton"),
  "8": figure("Figure 8: samples as dense as r times the local feature size", sampled("Ellipse", 5), "crust", ["sizes", "axis"], { curve: "Ellipse" }),
  "11": figure("Figure 11: the β-skeleton; a larger β leaves out more edges", example(EXAMPLES[0]!), "beta-skeleton", [], { parameter: 0 }),
  "14": figure("Figure 14: the crust of sparser and sparser samples", sampled("Flower", 4), "crust", ["weak"], { curve: "Flower" }),
};
