// What `crustline edit` adds to the page: the library's file formats. Without a server there is none of this.

import type { Cloud } from "../model/cloud.ts";
import type { Choice, Source } from "../model/document.ts";

export class ServerError extends Error {}

export interface Opened {
  readonly points: Float64Array;
  readonly source: Source;
}

interface Configuration {
  readonly read: readonly string[];
  readonly write: Readonly<Record<string, readonly string[]>>;
  readonly limit: number;
  readonly first: string | null;
}

export class Server {
  private constructor(
    private readonly token: string,
    readonly configuration: Configuration,
  ) {}

  /** The server of this page, if its address has a token. */
  static async find(): Promise<Server | null> {
    const token = new URLSearchParams(location.search).get("token");
    if (!token) return null;
    const response = await Server.fetched(token, "api/configuration");
    return new Server(token, (await response.json()) as Configuration);
  }

  /** Tells the server that this tab is here, as long as it is: an answer that does not end. */
  async stay(): Promise<ServerError> {
    try {
      const response = await Server.fetched(this.token, "api/tab");
      const reader = response.body?.getReader();
      while (reader && !(await reader.read()).done);
    } catch {
      // Either way it has ended.
    }
    return new ServerError("crustline edit has ended: it opens and saves no more files. Your points are kept here; save them as a picture file or GeoJSON.");
  }

  /** The points of a file, read by the library. */
  async open(file: Blob, name: string): Promise<Opened> {
    if (file.size > this.configuration.limit) {
      throw new ServerError(`${name} has ${megabytes(file.size)}, more than the ${megabytes(this.configuration.limit)} allowed: start crustline edit with --limit.`);
    }
    const response = await this.post(`api/open?name=${encodeURIComponent(name)}`, file);
    return this.opened(response, name);
  }

  /** The file that the command was started with. */
  async first(name: string): Promise<Opened> {
    return this.opened(await Server.fetched(this.token, "api/first"), name);
  }

  private async opened(response: Response, name: string): Promise<Opened> {
    const source = { id: response.headers.get("x-document") ?? "", name, says: decodeURIComponent(response.headers.get("x-says") ?? "") };
    return { points: new Float64Array(await response.arrayBuffer()), source };
  }

  /** A file of the library's own, of points or of curves. */
  async save(what: "points" | "curves", format: string, cloud: Cloud, choice: Choice, source: Source | null): Promise<{ blob: Blob; name: string; warning: string }> {
    const header = { what, format, method: choice.method, parameters: choice.parameters, document: source?.id ?? null, count: cloud.rows.length };
    const body = new Blob([JSON.stringify(header), "\n", cloud.xy as BlobPart, cloud.rows as BlobPart]);
    const response = await this.post("api/save", body);
    const name = response.headers.get("x-name") ?? `${what}.${format}`;
    return { blob: await response.blob(), name, warning: decodeURIComponent(response.headers.get("x-warning") ?? "") };
  }

  private post(path: string, body: Blob): Promise<Response> {
    return Server.fetched(this.token, path, { method: "POST", body });
  }

  private static async fetched(token: string, path: string, options: RequestInit = {}): Promise<Response> {
    let response: Response;
    try {
      response = await fetch(path, { ...options, headers: { "x-token": token } });
    } catch {
      throw new ServerError("crustline edit does not answer: start it again. Your points are kept here.");
    }
    if (!response.ok) throw new ServerError((await response.text()) || `The server answered ${response.status}.`);
    return response;
  }
}

function megabytes(bytes: number): string {
  return `${(bytes / 2 ** 20).toFixed(bytes < 2 ** 20 ? 2 : 0)} MB`;
}
