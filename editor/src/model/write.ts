// Exports that the page makes by itself: GeoJSON, CSV, and the Python lines that reproduce the picture.

import type { Cloud } from "./cloud.ts";
import { curveOf, type Curves } from "./curves.ts";
import { methodOf } from "./catalog.ts";
import type { Choice } from "./document.ts";

/** A number as the library writes it. */
function decimal(value: number): string {
  return Number.isInteger(value) && Math.abs(value) < 1e16 ? `${Object.is(value, -0) ? "-0" : value}.0` : String(value);
}

export function asCsv(cloud: Cloud): string {
  const lines = ["x,y"];
  for (let k = 0; k < cloud.xy.length; k += 2) lines.push(`${decimal(cloud.xy[k]!)},${decimal(cloud.xy[k + 1]!)}`);
  return `${lines.join("\n")}\n`;
}

/** The curves as a FeatureCollection, as the library writes them: a feature a curve, rings as closed lines, and the isolated points. */
export function asGeoJson(cloud: Cloud, curves: Curves): string {
  const at = (row: number): [number, number] => [cloud.xy[2 * row]!, cloud.xy[2 * row + 1]!];
  const feature = (curve: number | null, closed: boolean, rows: number[], type: string, coordinates: unknown): string =>
    JSON.stringify({ type: "Feature", properties: { curve, closed, rows }, geometry: { type, coordinates } });
  const features = Array.from(curves.closed, (closed, k) => {
    const rows = Array.from(curveOf(curves, k));
    const around = closed ? [...rows, rows[0]!] : rows;
    return feature(k, closed === 1, rows, "LineString", around.map(at));
  });
  const isolated = Array.from(curves.isolated);
  if (isolated.length) features.push(feature(null, false, isolated, "MultiPoint", isolated.map(at)));
  return `{"type":"FeatureCollection","features":[\n${features.join(",\n")}\n]}\n`;
}

/** A name of the command line as one of Python. */
function pythonName(name: string): string {
  return name.replaceAll("-", "_");
}

function argument(choice: Choice, k: number): string {
  const parameter = methodOf(choice.method).parameters[k]!;
  const value = choice.parameters[k]!;
  return `${parameter.name}=${parameter.choices ? `"${parameter.choices[value]}"` : value}`;
}

/** The lines of Python that give the same curves. */
export function asPython(cloud: Cloud, choice: Choice, file: string | null): string {
  const rows = Array.from(cloud.rows.keys(), (k) => `    (${cloud.xy[2 * k]}, ${cloud.xy[2 * k + 1]}),`);
  const points = file ? `cl.read(${JSON.stringify(file)})` : `[\n${rows.join("\n")}\n]`;
  const parameters = methodOf(choice.method).parameters.map((_, k) => argument(choice, k));
  const given = ["points", `method=cl.${pythonName(choice.method)}`, ...parameters].join(", ");
  return `import crustline as cl\n\npoints = ${points}\ncurves = cl.reconstruct(${given})\ncurves.plot()\n`;
}
