// The editor: one document with its history, what is shown of it, and what a user does to it.

import { Engine } from "../engine/engine.ts";
import type { Answer } from "../engine/protocol.ts";
import { LAYERS, partsOf, type Proof } from "../layers/layers.ts";
import { DARK, LIGHT, type Palette } from "../layers/palette.ts";
import { edgeAt, proofOf } from "../layers/proof.ts";
import { fitted, panned, zoomed, type View } from "../layers/view.ts";
import type { State } from "../model/address.ts";
import { boundsOf, type Box, type Cloud } from "../model/cloud.ts";
import { summary } from "../model/curves.ts";
import { amended, begin, blank, changed, redone, undone, type Choice, type Document, type History } from "../model/document.ts";
import { Pointer, type Surface } from "../tools/pointer.ts";
import type { Place, Tool } from "../tools/tool.ts";
import { makeTools } from "../tools/tools.ts";
import { h } from "./dom.ts";
import { sampled } from "./figures.ts";
import { Panel } from "./panel.ts";
import { Stage } from "./stage.ts";

const REACH = { mouse: 8, touch: 20 };
/** How often drawings are measured for `timings`. */
const KEPT_TIMINGS = 500;

export interface Watcher {
  /** After each change of the document or of what is shown; not while something is being dragged. */
  changed(state: State): void;
  /** After each answer. */
  answered(document: Document, answer: Answer): void;
}

export class App implements Surface {
  readonly element = h("div", { class: "crustline" });
  readonly stage: Stage;
  readonly panel: Panel;
  readonly tools = makeTools();
  readonly panner = this.tools.at(-1)!;
  readonly watchers: Watcher[] = [];
  /** From a change of the points to their picture, in milliseconds, the latest last. */
  readonly timings: number[] = [];
  history: History = begin(blank());
  shown: ReadonlySet<string> = new Set(["curve", "points", "difference"]);
  chosen: ReadonlySet<number> = new Set();
  tool: Tool = this.tools[0]!;
  answer: Answer | null = null;
  palette: Palette = LIGHT;
  reach = REACH.mouse;
  private readonly engine = new Engine();
  private readonly status = h("output", { class: "status", "aria-live": "polite" });
  private readonly messages = h("div", { class: "messages", role: "alert" });
  private proof: Proof | null = null;
  private version = 0;
  private edited = 0;
  private weak = -1;

  constructor() {
    const scene = () => ({ xy: this.cloud.xy, answer: this.answer, chosen: this.chosen, hover: this.proof });
    this.stage = new Stage(() => ({ scene: scene(), layers: this.shown, palette: this.palette }), () => this.resized(), () => this.painted());
    this.panel = new Panel({
      choose: (choice, again) => this.change({ ...this.document, choice }, again),
      compare: (other) => this.compare(other),
      show: (layer, on) => this.show(layer, on),
      sample: (curve, k, again) => this.take(sampled(curve, k), again),
      nextWeak: () => this.nextWeak(),
    });
    new Pointer(this.stage.element, this);
    this.stage.element.addEventListener("pointerdown", (event) => (this.reach = event.pointerType === "touch" ? REACH.touch : REACH.mouse));
    this.stage.element.append(this.status, this.messages);
  }

  get document(): Document {
    return this.history.now;
  }

  get cloud(): Cloud {
    return this.document.cloud;
  }

  get view(): View {
    return this.stage.view;
  }

  get pixel(): number {
    return 1 / this.view.scale;
  }

  get state(): State {
    return { document: this.document, layers: [...this.shown] };
  }

  // What tools do

  edit(cloud: Cloud, again = false): void {
    this.edited = performance.now();
    this.change({ ...this.document, cloud }, again);
  }

  choose(rows: ReadonlySet<number>): void {
    this.chosen = rows;
    this.element.classList.toggle("some-chosen", rows.size > 0);
    this.stage.touch();
  }

  rubber(box: Box | null): void {
    this.stage.rubber = box;
    this.stage.touch();
  }

  pan(right: number, down: number): void {
    this.stage.look(panned(this.view, right, down));
  }

  zoom(factor: number, left: number, top: number): void {
    this.stage.look(zoomed(this.view, factor, left, top));
  }

  /** Shows what proves the edge under the pointer. */
  hovered(at: Place | null): void {
    const { answer } = this;
    const edge = at && answer && this.tool.name === "select" && this.cloud.rows.length <= 20_000 ? edgeAt(answer, this.cloud.xy, at.x, at.y, 6 * this.pixel) : null;
    if (!edge || !answer) {
      if (this.proof) this.showProof(null);
      return;
    }
    if (this.proof?.edge[0] === edge[0] && this.proof.edge[1] === edge[1]) return;
    void this.engine.disk(edge).then((disk) => {
      if (this.answer === answer) this.showProof(proofOf(answer, this.cloud.xy, edge, this.document.choice, disk));
    });
  }

  // What changes the document

  change(document: Document, again = false): void {
    const cloud = this.cloud;
    this.history = again ? amended(this.history, document) : changed(this.history, document);
    this.updated(cloud);
  }

  /** Other points in place of all. */
  take(cloud: Cloud, again = false): void {
    this.choose(new Set());
    this.change({ ...this.document, cloud, source: null }, again);
    this.fit();
  }

  /** Another document, as a step that can be undone. */
  open(document: Document): void {
    this.choose(new Set());
    this.change(document);
    this.fit();
  }

  /** A picture from a file, as a step that can be undone. */
  restoreAsStep({ document, layers }: State): void {
    this.look(layers);
    this.open(document);
  }

  /** A picture to begin with. */
  restore({ document, layers }: State): void {
    this.history = begin(document);
    this.look(layers);
    this.updated(null);
    this.fit();
  }

  private look(layers: readonly string[]): void {
    const known = layers.filter((name) => LAYERS.some((layer) => layer.name === name));
    if (known.length) this.shown = new Set(known);
  }

  undo(): void {
    this.travel(undone(this.history));
  }

  redo(): void {
    this.travel(redone(this.history));
  }

  compare(other: Choice | null): void {
    if (other) this.shown = new Set([...this.shown, "difference"]);
    this.change({ ...this.document, other });
  }

  show(layer: string, on: boolean): void {
    this.shown = new Set(on ? [...this.shown, layer] : [...this.shown].filter((name) => name !== layer));
    this.updated(this.cloud);
  }

  use(tool: Tool, quiet = false): void {
    this.tool = tool;
    this.stage.element.style.cursor = tool.cursor;
    for (const button of this.element.querySelectorAll<HTMLElement>("[data-tool]")) button.setAttribute("aria-pressed", String(button.dataset.tool === tool.name));
    if (!quiet) this.say(tool.says);
  }

  fit(): void {
    this.stage.look(fitted(this.view, boundsOf(this.cloud)));
    this.stage.refresh();
  }

  paint(dark: boolean): void {
    this.palette = dark ? DARK : LIGHT;
    this.element.dataset.theme = dark ? "dark" : "light";
    this.panel.showLayers(this.shown, this.palette);
    this.stage.refresh();
  }

  /** A sentence that goes away by itself. */
  say(sentence: string): void {
    this.element.dispatchEvent(new CustomEvent("hint", { detail: sentence }));
  }

  /** A sentence about what went wrong, which stays until it is closed. */
  complain(error: unknown): void {
    const sentence = error instanceof Error ? error.message : String(error);
    const close = h("button", { type: "button", "aria-label": "Close this message", click: () => message.remove() }, "×");
    const message = h("div", { class: "message" }, h("span", {}, sentence), close);
    this.messages.replaceChildren(message);
  }

  close(): void {
    this.engine.close();
    this.element.remove();
  }

  private travel(history: History): void {
    const cloud = this.cloud;
    this.history = history;
    this.choose(new Set());
    this.updated(cloud);
  }

  private updated(before: Cloud | null): void {
    if (this.cloud !== before) {
      this.version += 1;
      this.proof = null;
    }
    this.panel.showDocument(this.document);
    this.panel.showLayers(this.shown, this.palette);
    for (const [name, can] of [["undo", this.history.past.length], ["redo", this.history.future.length]] as const) {
      this.element.querySelector(`[data-action=${name}]`)?.toggleAttribute("disabled", !can);
    }
    for (const watcher of this.watchers) watcher.changed(this.state);
    this.stage.refresh();
    void this.ask();
  }

  private async ask(): Promise<void> {
    const { choice, other } = this.document;
    const [edited, document] = [this.edited, this.document];
    try {
      const answer = await this.engine.ask({ version: this.version, xy: this.cloud.xy, choice, other, parts: partsOf(this.shown) });
      if (!answer) return;
      this.answer = answer;
      this.element.dataset.edited = String(edited);
      this.report();
      this.stage.refresh();
      for (const watcher of this.watchers) watcher.answered(document, answer);
    } catch (error) {
      this.complain(error);
    }
  }

  private report(): void {
    const answer = this.answer!;
    const parts = [summary(answer.curves), `${this.cloud.rows.length.toLocaleString("en")} points`];
    if (answer.duplicates) parts.push(`${answer.duplicates} repeated`);
    if (answer.extra && answer.missing) parts.push(`${answer.extra.length / 2} edges only here, ${answer.missing.length / 2} only in ${this.document.other?.method}`);
    if (this.proof) parts.push(this.proof.says);
    this.status.textContent = parts.join(" · ");
    this.element.dataset.version = String(answer.version);
    this.element.dataset.busy = String(answer.version !== this.version);
    this.panel.showFinding(answer);
  }

  private showProof(proof: Proof | null): void {
    this.proof = proof;
    if (this.answer) this.report();
    this.stage.touch();
  }

  private painted(): void {
    const { edited } = this.element.dataset;
    if (!edited || !Number(edited)) return;
    this.timings.push(performance.now() - Number(edited));
    this.timings.splice(0, this.timings.length - KEPT_TIMINGS);
    delete this.element.dataset.edited;
  }

  private resized(): void {
    if (this.version <= 1) this.stage.view = fitted(this.view, boundsOf(this.cloud));
  }

  private nextWeak(): void {
    const reasons = this.answer?.certificate?.pointReasons;
    if (!reasons) return;
    const rows = Array.from(reasons.keys()).filter((row) => reasons[row]);
    const row = rows.find((each) => each > this.weak) ?? rows[0];
    if (row === undefined) return;
    this.weak = row;
    this.choose(new Set([row]));
    this.stage.look({ ...this.view, x: this.cloud.xy[2 * row]!, y: this.cloud.xy[2 * row + 1]! });
  }
}
