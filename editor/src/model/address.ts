// A state as a part of an address, so that a picture can be shared: JSON, deflated, in letters that addresses may hold.

import { fresh, opened, type Cloud } from "./cloud.ts";
import { METHODS } from "./catalog.ts";
import type { Choice, Document } from "./document.ts";

export interface State {
  readonly document: Document;
  readonly layers: readonly string[];
}

/** Longer addresses are cut off by browsers and mail. */
const LONGEST = 100_000;

export class AddressError extends Error {}

/** A state as plain data, for a file or an address. */
export function asPlain({ document, layers }: State): object {
  const { cloud, choice, other, source } = document;
  const rows = source ? { rows: Array.from(cloud.rows), source } : {};
  return { crustline: 1, points: Array.from(cloud.xy), choice, other, layers, ...rows };
}

/** The same for the browser's store, which takes arrays as they are. */
export function asKept({ document, layers }: State): object {
  const { cloud, choice, other, source } = document;
  return { crustline: 1, points: cloud.xy, rows: cloud.rows, choice, other, layers, source };
}

export function fromPlain(value: unknown): State {
  const plain = (value ?? {}) as Record<string, unknown>;
  if (plain.crustline !== 1) throw new AddressError("it is of no known version");
  const { points, layers, source } = plain;
  const numbers = Array.isArray(points) && points.length % 2 === 0 && points.every((x) => Number.isFinite(x));
  if (!numbers) throw new AddressError("its points are no numbers");
  const other = plain.other == null ? null : choiceFrom(plain.other);
  const kept = isSource(source) ? source : null;
  const document = { cloud: cloudFrom(points as number[], kept ? plain.rows : null), choice: choiceFrom(plain.choice), other, source: kept };
  return { document, layers: Array.isArray(layers) ? layers.map(String) : [] };
}

function isSource(value: unknown): value is NonNullable<Document["source"]> {
  const each = value as Record<string, unknown> | null;
  return !!each && ["id", "name", "says"].every((key) => typeof each[key] === "string");
}

function cloudFrom(points: number[], rows: unknown): Cloud {
  if (!Array.isArray(rows)) return fresh(points);
  if (rows.length !== points.length / 2) throw new AddressError("its rows do not fit its points");
  return { xy: opened(points).xy, rows: Int32Array.from(rows as number[]) };
}

function choiceFrom(value: unknown): Choice {
  const { method, parameters } = (value ?? {}) as Partial<Choice>;
  const known = METHODS.find((each) => each.name === method);
  const fits = known && Array.isArray(parameters) && parameters.length === known.parameters.length && parameters.every((x) => Number.isFinite(x));
  if (!known || !fits) throw new AddressError("its method is unknown");
  return { method: known.name, parameters: [...parameters] };
}

async function through(stream: CompressionStream | DecompressionStream, bytes: Uint8Array): Promise<Uint8Array> {
  const input = new Blob([bytes as BlobPart]).stream().pipeThrough(stream as ReadableWritablePair<Uint8Array, BlobPart>);
  return new Uint8Array(await new Response(input as ReadableStream).arrayBuffer());
}

export async function toAddress(state: State): Promise<string> {
  const plain = asPlain({ ...state, document: { ...state.document, source: null } });
  const bytes = await through(new CompressionStream("deflate-raw"), new TextEncoder().encode(JSON.stringify(plain)));
  let letters = "";
  for (const byte of bytes) letters += String.fromCharCode(byte);
  const text = btoa(letters).replaceAll("+", "-").replaceAll("/", "_").replaceAll("=", "");
  if (text.length > LONGEST) throw new AddressError(`These are too many points for an address (${state.document.cloud.rows.length}): save the picture as a file.`);
  return text;
}

export async function fromAddress(text: string): Promise<State> {
  try {
    const letters = atob(text.replaceAll("-", "+").replaceAll("_", "/"));
    const bytes = Uint8Array.from(letters, (letter) => letter.charCodeAt(0));
    const plain = await through(new DecompressionStream("deflate-raw"), bytes);
    return fromPlain(JSON.parse(new TextDecoder().decode(plain)));
  } catch (error) {
    const why = error instanceof AddressError ? error.message : "a part of it is missing or was changed";
    throw new AddressError(`The address holds a damaged picture: ${why}. Ask for it again.`);
  }
}
