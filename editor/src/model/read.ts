// Points from text that is pasted or from a file: columns of numbers, or GeoJSON. What does not fit is said in a sentence.

export class ReadError extends Error {}

const MOST_BYTES = 64 * 2 ** 20;
const NAMES: readonly (readonly [string, string])[] = [
  ["x", "y"], ["lon", "lat"], ["longitude", "latitude"], ["easting", "northing"], ["e", "n"],
];

/** The coordinates in a text: x, y, x, y, … */
export function readPoints(text: string, name: string): number[] {
  if (text.length > MOST_BYTES) {
    throw new ReadError(`${name} has ${(text.length / 2 ** 20).toFixed(0)} MB, more than the ${MOST_BYTES / 2 ** 20} MB that the page takes: thin it first.`);
  }
  if (text.includes("\0")) throw new ReadError(`${name} is in no format that the page reads by itself: columns of numbers, or GeoJSON. crustline edit opens more.`);
  const points = /^\s*[{[]/.test(text) ? readJson(text, name) : readColumns(text, name);
  if (!points.length) throw new ReadError(`${name} holds no points.`);
  return points;
}

function readJson(text: string, name: string): number[] {
  let value: unknown;
  try {
    value = JSON.parse(text);
  } catch (error) {
    throw new ReadError(`${name} is no JSON: ${(error as Error).message}.`);
  }
  const found: number[] = [];
  if (Array.isArray(value)) collect(value, name, false, found);
  else visit(value, name, found);
  return found;
}

/** The positions of a geometry, or of everything in a collection. */
function visit(value: unknown, name: string, found: number[]): void {
  const each = (value ?? {}) as Record<string, unknown>;
  if (each.type === "FeatureCollection") list(each.features).forEach((feature) => visit(feature, name, found));
  else if (each.type === "GeometryCollection") list(each.geometries).forEach((geometry) => visit(geometry, name, found));
  else if (each.type === "Feature") each.geometry && visit(each.geometry, name, found);
  else if (Array.isArray(each.coordinates)) collect(each.coordinates, name, /Polygon/.test(String(each.type)), found);
  else throw new ReadError(`${name} is JSON, but neither GeoJSON nor a list of points.`);
}

function list(value: unknown): unknown[] {
  return Array.isArray(value) ? value : [];
}

/** The positions in nested lists; a ring repeats its first at its end, which is left out. */
function collect(nested: unknown[], name: string, rings: boolean, found: number[]): void {
  if (nested.length && !Array.isArray(nested[0])) {
    found.push(...pair(nested, `${name}: position ${found.length / 2}`));
    return;
  }
  const closes = rings && nested.length > 1 && String(nested[0]) === String(nested.at(-1)) && typeof (nested[0] as unknown[])?.[0] === "number";
  for (const each of closes ? nested.slice(0, -1) : nested) {
    if (!Array.isArray(each)) throw new ReadError(`${name}: ${JSON.stringify(each)} is no position.`);
    collect(each, name, rings, found);
  }
}

function pair(values: unknown[], where: string): [number, number] {
  const [x, y] = values;
  if (typeof x !== "number" || typeof y !== "number" || !Number.isFinite(x) || !Number.isFinite(y)) {
    throw new ReadError(`${where} is ${JSON.stringify(values).slice(0, 60)}, which is no pair of numbers.`);
  }
  return [x, y];
}

function readColumns(text: string, name: string): number[] {
  const found: number[] = [];
  let columns: readonly [number, number] = [0, 1];
  let number = 0;
  let seen = false;
  for (const line of text.split(/\r\n|\n|\r/)) {
    number += 1;
    const fields = fieldsOf(line);
    if (!fields.length) continue;
    const header = !seen && fields.every((field) => !isNumber(field));
    seen = true;
    if (header) columns = columnsOf(fields, name);
    else found.push(...columns.map((column) => numberIn(fields, column, `${name}, line ${number}`)));
  }
  return found;
}

function fieldsOf(line: string): string[] {
  const text = line.trim().replace(/^[([]+|[)\],;]+$/g, "");
  if (!text || text.startsWith("#")) return [];
  if (text.includes(";")) return text.split(";").map((field) => field.trim().replace(",", "."));
  return text.split(/\s*,\s*|\s+/).map((field) => field.replace(/^"(.*)"$/, "$1"));
}

function isNumber(field: string): boolean {
  return field !== "" && Number.isFinite(Number(field));
}

function columnsOf(fields: string[], name: string): [number, number] {
  const known = fields.map((field) => field.toLowerCase());
  for (const [x, y] of NAMES) {
    if (known.includes(x) && known.includes(y)) return [known.indexOf(x), known.indexOf(y)];
  }
  throw new ReadError(`${name} has the columns ${fields.join(", ").slice(0, 80)}: name two of them x and y.`);
}

function numberIn(fields: string[], column: number, where: string): number {
  const field = fields[column];
  if (field === undefined) throw new ReadError(`${where}: there is no column ${column + 1}.`);
  if (!isNumber(field)) throw new ReadError(`${where}: “${field.slice(0, 40)}” is no number.`);
  return Number(field);
}
