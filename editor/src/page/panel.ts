// The panel beside the picture: method and parameters, comparison, layers, samples, and what is guaranteed.

import { REASONS, type Answer } from "../engine/protocol.ts";
import { LAYERS } from "../layers/layers.ts";
import type { Palette } from "../layers/palette.ts";
import { METHODS, methodOf, THEORY, type Parameter } from "../model/catalog.ts";
import { choose, type Choice, type Document } from "../model/document.ts";
import { h } from "./dom.ts";
import { CURVES, RATIOS } from "./figures.ts";

export interface PanelHost {
  choose(choice: Choice, again?: boolean): void;
  compare(choice: Choice | null): void;
  show(layer: string, on: boolean): void;
  sample(curve: string, k: number, again: boolean): void;
  nextWeak(): void;
}

const TITLES: Readonly<Record<string, string>> = { beta: "β", kind: "Family", angle: "Angle (radians)", ratio: "Ratio", radius: "Radius", c0: "c₀", c1: "c₁" };

/** A slider with a number beside it, and a mark where a theorem holds. */
export function slider(parameter: Parameter, value: number, changed: (value: number, again: boolean) => void): HTMLElement {
  const title = TITLES[parameter.name] ?? parameter.name;
  if (parameter.choices) {
    const options = parameter.choices.map((choice, k) => h("option", { value: String(k), selected: k === value }, choice));
    return h("label", { class: "row" }, title, h("select", { name: parameter.name, change: (event) => changed(Number((event.target as HTMLSelectElement).value), false) }, ...options));
  }
  const { low, high, step, mark } = parameter;
  let going = false;
  const number = h("input", { type: "number", min: String(low), max: String(high), step: "any", value: String(value), "aria-label": `${title}, as a number` });
  const range = h("input", { type: "range", name: parameter.name, min: String(low), max: String(high), step: String(step), value: String(value), "aria-label": title });
  const set = (text: string, again: boolean): void => {
    const next = Number(text);
    if (text === "" || !Number.isFinite(next) || next < low || next > high) return;
    [number.value, range.value] = [text, text];
    changed(next, again);
  };
  range.addEventListener("input", () => {
    set(range.value, going);
    going = true;
  });
  range.addEventListener("change", () => (going = false));
  number.addEventListener("change", () => set(number.value, false));
  const children: Node[] = [h("span", { class: "name" }, title), number, range];
  if (mark) {
    const place = (mark.value - low) / (high - low);
    children.push(h("button", { type: "button", class: "mark", style: `--place: ${place}`, title: mark.says, click: () => set(String(mark.value), false) }, `${mark.value.toFixed(2)} ▲`));
    children.push(h("small", {}, mark.says));
  }
  return h("div", { class: "slider" }, ...children);
}

function methodSelect(name: string, value: string | null, changed: (name: string) => void): HTMLSelectElement {
  const none = value === null || name === "other" ? [h("option", { value: "" }, "nothing")] : [];
  const options = METHODS.map((each) => h("option", { value: each.name, selected: each.name === value }, each.name));
  return h("select", { name, change: (event) => changed((event.target as HTMLSelectElement).value) }, ...none, ...options);
}

export class Panel {
  readonly element = h("aside", { class: "panel", "aria-label": "Method and layers" });
  private readonly method = h("section");
  private readonly finding = h("section", { class: "finding" });
  private readonly layers = h("section");
  private readonly samples: HTMLElement;
  private last: Choice | null = null;
  private lastLayers = "";

  constructor(private readonly host: PanelHost) {
    this.samples = this.sampleSection();
    this.element.append(this.method, this.finding, this.layers, this.samples);
  }

  /** Shows a document; what is being moved is left alone. */
  showDocument({ choice, other }: Document): void {
    const { says, parameters } = methodOf(choice.method);
    const same = this.last?.method === choice.method && this.method.querySelector<HTMLSelectElement>("[name=other]")?.value === (other?.method ?? "");
    this.last = choice;
    if (same) return parameters.forEach((each, k) => this.setValue(each.name, choice.parameters[k]!));
    const sliders = parameters.map((each, k) => slider(each, choice.parameters[k]!, (value, again) => {
      const now = this.last!;
      this.host.choose({ ...now, parameters: now.parameters.map((old, at) => (at === k ? value : old)) }, again);
    }));
    const own = h("label", { class: "row" }, "Method", methodSelect("method", choice.method, (name) => this.host.choose(choose(name))));
    const compared = h("label", { class: "row" }, "Compare with", methodSelect("other", other?.method ?? null, (name) => this.host.compare(name ? choose(name) : null)));
    this.method.replaceChildren(own, h("p", { class: "says" }, says), ...sliders, compared);
  }

  /** Sets a slider and the number beside it, unless someone is writing there. */
  private setValue(name: string, value: number): void {
    const range = this.method.querySelector<HTMLInputElement | HTMLSelectElement>(`[name="${name}"]`);
    if (range) range.value = String(value);
    const number = range?.parentElement?.querySelector<HTMLInputElement>("input[type=number]");
    if (number && number !== document.activeElement) number.value = String(value);
  }

  showLayers(shown: ReadonlySet<string>, palette: Palette): void {
    const key = [palette.paper, ...shown].join();
    if (key === this.lastLayers) return;
    this.lastLayers = key;
    const boxes = [...LAYERS].reverse().map((layer) => {
      const box = h("input", { type: "checkbox", name: layer.name, change: (event) => this.host.show(layer.name, (event.target as HTMLInputElement).checked) });
      box.checked = shown.has(layer.name);
      const sign = h("span", { class: `sign ${layer.sign}`, style: `--color: ${layer.color(palette)}`, "aria-hidden": "true" });
      return h("label", { class: "layer", title: layer.says }, box, sign, layer.title);
    });
    const focused = this.layers.contains(document.activeElement) ? (document.activeElement as HTMLInputElement).name : null;
    this.layers.replaceChildren(h("h2", {}, "Layers"), ...boxes);
    if (focused) this.layers.querySelector<HTMLInputElement>(`[name="${focused}"]`)?.focus();
  }

  /** What is guaranteed, and where not. */
  showFinding(answer: Answer | null): void {
    const certificate = answer?.certificate;
    if (!certificate || !answer?.edges.length) return this.finding.replaceChildren();
    const counts = new Map<string, number>();
    for (const code of certificate.pointReasons) if (code) counts.set(REASONS[code]!, (counts.get(REASONS[code]!) ?? 0) + 1);
    const worst = certificate.ratios.reduce((most, ratio) => Math.max(most, ratio), 0);
    const verdict = certificate.guaranteed ? "Guaranteed" : "Not guaranteed";
    const why = certificate.theorem === "crust" ? "Theorems 14 and 15 of the paper speak of these edges." : certificate.theorem ? `Theorem 20 of the paper (β = ${THEORY.beta.toFixed(2)}) speaks of these edges.` : "No theorem speaks of these edges.";
    const estimate = Number.isFinite(worst) ? `Estimated: a ${worst.toPrecision(3)}-sample; the theorem asks for less than ${certificate.threshold.toFixed(3)}.` : "";
    const list = [...counts].map(([reason, count]) => h("li", {}, `${count} ${reason}`));
    const next = counts.size ? [h("ul", {}, ...list), h("button", { type: "button", click: () => this.host.nextWeak() }, "Go to the next weak place")] : [];
    this.finding.replaceChildren(h("h2", { class: certificate.guaranteed ? "sure" : "unsure" }, verdict), h("p", {}, `${why} ${estimate}`), ...next);
  }

  private sampleSection(): HTMLElement {
    const select = h("select", { name: "curve" }, ...CURVES.map((name) => h("option", { value: name }, name)));
    const range = h("input", { type: "range", name: "r", min: "0", max: String(RATIOS.length - 1), step: "1", value: "3", "aria-label": "r" });
    const value = h("output", {}, `r = ${RATIOS[3]}`);
    let going = false;
    const sample = (again: boolean): void => {
      value.textContent = `r = ${RATIOS[Number(range.value)]}`;
      this.host.sample(select.value, Number(range.value), again);
    };
    range.addEventListener("input", () => {
      sample(going);
      going = true;
    });
    range.addEventListener("change", () => (going = false));
    const button = h("button", { type: "button", click: () => sample(false) }, "Take the sample");
    return h("section", {}, h("h2", {}, "Sample of a known curve"), h("label", { class: "row" }, "Curve", select), h("label", { class: "row" }, value, range), button);
  }
}
