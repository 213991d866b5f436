// The methods and thresholds of the library, as its build wrote them down, and what a slider needs beside them.

import data from "../../build/data/catalog.json";

export interface Parameter {
  readonly name: string;
  readonly low: number;
  readonly high: number;
  readonly step: number;
  readonly start: number;
  /** A value worth marking, and why. */
  readonly mark?: { readonly value: number; readonly says: string };
  /** The choices of a parameter that is not a quantity, by their numbers. */
  readonly choices?: readonly string[];
}

export interface Method {
  readonly name: string;
  readonly says: string;
  readonly parameters: readonly Parameter[];
}

export const VERSION: string = data.version;
export const THEORY = data.theory;
/** β, the sampling ratios that the two theorems ask for, and the margin: what a certificate asks for. */
export const THEOREMS: readonly number[] = [THEORY.beta, THEORY.of_skeleton, THEORY.of_crust, THEORY.margin];

type Slider = Omit<Parameter, "name" | "start"> & { readonly start?: number };

const SLIDERS: Readonly<Record<string, Slider>> = {
  "beta-skeleton.beta": {
    low: 0.5, high: 3, step: 0.01,
    mark: { value: THEORY.beta, says: `β = ${THEORY.beta.toFixed(2)}: Theorem 20 holds for r < ${THEORY.of_skeleton.toFixed(3)}` },
  },
  "beta-skeleton.kind": { low: 0, high: 1, step: 1, start: 0, choices: ["circle", "lune"] },
  "compatible-crust.angle": { low: 0.1, high: 3, step: 0.01 },
  "conservative-crust.ratio": { low: 0.1, high: 5, step: 0.05 },
  "gathan.angle": { low: 0, high: 1.57, step: 0.01 },
  "gathan.ratio": { low: 0, high: 5, step: 0.05 },
  "gamma-graph.c0": { low: -1, high: 1, step: 0.01, start: 0.2 },
  "gamma-graph.c1": { low: -1, high: 1, step: 0.01, start: 0.2 },
  "crossing-angle-graph.angle": { low: 0.05, high: 3.1, step: 0.01, start: Math.PI / 2 },
  "alpha-shape.radius": { low: 0.01, high: 10, step: 0.01, start: 1 },
};

function parameterOf(method: string, { name, default: start }: { name: string; default: number | null }): Parameter {
  const slider = SLIDERS[`${method}.${name}`];
  if (!slider) throw new Error(`the editor has no slider for ${name} of ${method}`);
  return { ...slider, name, start: start ?? slider.start ?? 1 };
}

export const METHODS: readonly Method[] = data.methods.map(({ name, says, parameters }) => ({
  name,
  says,
  parameters: parameters.map((each) => parameterOf(name, each)),
}));

export function methodOf(name: string): Method {
  const found = METHODS.find((each) => each.name === name);
  if (!found) throw new Error(`There is no method “${name}”.`);
  return found;
}

/** The parameters that a method starts with, in order. */
export function startOf(name: string): number[] {
  return methodOf(name).parameters.map((each) => each.start);
}
