// Opening and saving: files, the clipboard, addresses. With a server the library's formats, without one the page's own.

import { draw, drawMarked } from "../layers/layers.ts";
import { CanvasPen } from "../layers/canvas_pen.ts";
import { SvgPen } from "../layers/svg_pen.ts";
import { asPlain, fromPlain, toAddress } from "../model/address.ts";
import { opened } from "../model/cloud.ts";
import { readPoints } from "../model/read.ts";
import { asCsv, asGeoJson, asPython } from "../model/write.ts";
import type { App } from "./app.ts";
import { download, h } from "./dom.ts";
import type { Server } from "./server.ts";

const PICTURE = /\.crustline(\.json)?$/i;
/** Files larger than this are not read as text. */
const MOST_BYTES = 64 * 2 ** 20;

export class Files {
  constructor(
    private readonly app: App,
    private readonly server: Server | null,
  ) {}

  /** Suffixes that open. */
  get accepted(): string {
    return [...new Set([".csv", ".tsv", ".txt", ".xyz", ".geojson", ".json", ".crustline", ...(this.server?.configuration.read ?? [])])].join(",");
  }

  async open(file: File): Promise<void> {
    await this.guarded(async () => {
      if (PICTURE.test(file.name)) return this.app.restoreAsStep(fromPlain(JSON.parse(await file.text())));
      if (this.server) {
        const { points, source } = await this.server.open(file, file.name);
        return this.app.open({ ...this.app.document, cloud: opened(points), source });
      }
      if (file.size > MOST_BYTES) throw new Error(`${file.name} has ${(file.size / 2 ** 20).toFixed(0)} MB, more than the ${MOST_BYTES / 2 ** 20} MB that the page takes: thin it first.`);
      this.app.open({ ...this.app.document, cloud: opened(readPoints(await file.text(), file.name)), source: null });
    });
  }

  paste(text: string): Promise<boolean> {
    return this.guarded(() => this.app.open({ ...this.app.document, cloud: opened(readPoints(text, "The pasted text")), source: null }));
  }

  /** The kinds of files that can be saved, with what saves them. */
  kinds(): { title: string; save: () => void }[] {
    const own = [
      { title: "Picture to edit again (.crustline)", save: () => this.saveText(JSON.stringify(asPlain(this.app.state)), "picture.crustline", "application/json") },
      { title: "PNG", save: () => this.savePng() },
      { title: "SVG", save: () => this.saveText(this.svg(), "picture.svg", "image/svg+xml") },
      { title: "Python lines", save: () => this.saveText(asPython(this.app.cloud, this.app.document.choice, this.unchangedFile()), "picture.py", "text/x-python") },
    ];
    if (!this.server) {
      own.push({ title: "Curves as GeoJSON", save: () => this.saveCurves() });
      own.push({ title: "Points as CSV", save: () => this.saveText(asCsv(this.app.cloud), "points.csv", "text/csv") });
      return own;
    }
    const { write } = this.server.configuration;
    for (const what of ["curves", "points"] as const) {
      for (const format of write[what] ?? []) own.push({ title: `${what === "curves" ? "Curves" : "Points"}: ${format}`, save: () => void this.saveByServer(what, format) });
    }
    return own;
  }

  svg(): string {
    const { app } = this;
    const pen = new SvgPen(app.view);
    const scene = { xy: app.cloud.xy, answer: app.answer, chosen: new Set<number>(), hover: null };
    draw(pen, scene, app.shown, app.palette, app.view);
    drawMarked(pen, scene, app.palette);
    return pen.text(app.palette.paper);
  }

  /** The address of the picture as it is; it is also written into the address bar. */
  async share(): Promise<string | null> {
    let address: string | null = null;
    await this.guarded(async () => {
      const text = await toAddress(this.app.state);
      const page = new URL(location.href);
      page.hash = `picture=${text}`;
      history.replaceState(null, "", page);
      page.searchParams.delete("token");
      address = page.href;
      await navigator.clipboard?.writeText(address).catch(() => undefined);
      this.app.say("The address of this picture is in the address bar and on the clipboard.");
    });
    return address;
  }

  private unchangedFile(): string | null {
    const { source, cloud } = this.app.document;
    return source && cloud.rows.every((row, k) => row === k) && this.app.history.past.every((each) => each.cloud === cloud || each.source !== source) ? source.name : null;
  }

  private saveCurves(): void {
    const { answer, cloud } = this.app;
    if (!answer || answer.xy.length !== cloud.xy.length) return this.app.complain("The curves are still being computed: try again in a moment.");
    this.saveText(asGeoJson(cloud, answer.curves), "curves.geojson", "application/geo+json");
  }

  private async saveByServer(what: "points" | "curves", format: string): Promise<void> {
    await this.guarded(async () => {
      const { cloud, choice, source } = this.app.document;
      const { blob, name, warning } = await this.server!.save(what, format, cloud, choice, source);
      download(blob, name);
      if (warning) this.app.complain(warning);
    });
  }

  private savePng(): void {
    const { app } = this;
    const scale = 2;
    const canvas = h("canvas", { width: String(app.view.width * scale), height: String(app.view.height * scale) });
    const context = canvas.getContext("2d")!;
    context.fillStyle = app.palette.paper;
    context.fillRect(0, 0, canvas.width, canvas.height);
    context.scale(scale, scale);
    draw(new CanvasPen(context, app.view), { xy: app.cloud.xy, answer: app.answer, chosen: new Set(), hover: null }, app.shown, app.palette, app.view);
    canvas.toBlob((blob) => (blob ? download(blob, "picture.png") : app.complain("The browser makes no PNG of this size: make the window smaller.")));
  }

  private saveText(text: string, name: string, type: string): void {
    download(new Blob([text], { type }), name);
  }

  private async guarded(work: () => void | Promise<void>): Promise<boolean> {
    this.app.element.dataset.working = "true";
    try {
      await work();
      return true;
    } catch (error) {
      this.app.complain(error);
      return false;
    } finally {
      delete this.app.element.dataset.working;
    }
  }
}
