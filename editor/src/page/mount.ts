// Puts the editor into an element: the page and the notebook widget begin here.

import style from "virtual:style";
import { App } from "./app.ts";
import { bar, Commands, keyboard, toolbox, type Theme } from "./bar.ts";
import { h } from "./dom.ts";
import { FIGURES, sampled, RATIOS, type Figure } from "./figures.ts";
import { Files } from "./files.ts";
import { slider } from "./panel.ts";
import type { Server } from "./server.ts";
import { methodOf } from "../model/catalog.ts";

const THEMES: readonly Theme[] = ["auto", "light", "dark"];
const KEY = "crustline-theme";
const HINT_MILLISECONDS = 6000;

function keptTheme(): Theme {
  try {
    return (localStorage.getItem(KEY) as Theme | null) ?? "auto";
  } catch {
    return "auto";
  }
}

/** Follows the system's theme, or the one chosen. */
function themes(app: App): () => void {
  const dark = matchMedia("(prefers-color-scheme: dark)");
  let theme = keptTheme();
  const paint = (): void => app.paint(theme === "dark" || (theme === "auto" && dark.matches));
  dark.addEventListener("change", paint);
  paint();
  return () => {
    theme = THEMES[(THEMES.indexOf(theme) + 1) % THEMES.length]!;
    try {
      localStorage.setItem(KEY, theme);
    } catch {
      // Without a store the choice lasts as long as the page.
    }
    app.say(`Theme: ${theme}`);
    paint();
  };
}

function hints(app: App): HTMLElement {
  const hint = h("div", { class: "hint", role: "status" });
  let timer = 0;
  app.element.addEventListener("hint", (event) => {
    hint.textContent = (event as CustomEvent<string>).detail;
    hint.classList.add("shown");
    clearTimeout(timer);
    timer = window.setTimeout(() => hint.classList.remove("shown"), HINT_MILLISECONDS);
  });
  return hint;
}

function drops(app: App, files: Files): void {
  app.element.addEventListener("dragover", (event) => event.preventDefault());
  app.element.addEventListener("drop", (event) => {
    event.preventDefault();
    const file = event.dataTransfer?.files[0];
    if (file) void files.open(file);
  });
}

/** The editor with its tools. */
export function mount(root: HTMLElement, server: Server | null): App {
  const app = new App();
  Object.assign(app.element, { app });
  const files = new Files(app, server);
  Object.assign(app.element, { files });
  const commands = new Commands(app, files);
  root.append(h("div", { class: "crustline-frame" }, app.element));
  let next = (): void => undefined;
  app.stage.element.append(hints(app));
  app.element.append(h("style", {}, style), bar(app, files, commands, () => next()), toolbox(app, commands), app.stage.element, app.panel.element);
  next = themes(app);
  keyboard(app, commands);
  drops(app, files);
  app.use(app.tools[0]!, true);
  return app;
}

/** A figure of the paper: the picture, and at most one slider. */
export function mountFigure(root: HTMLElement, figure: Figure): App {
  const app = new App();
  Object.assign(app.element, { app });
  app.element.classList.add("figure");
  root.append(h("div", { class: "crustline-frame" }, app.element));
  const control = figure.slider ? controlOf(app, figure.slider) : "";
  app.element.append(h("style", {}, style), app.stage.element, h("figcaption", {}, h("span", {}, figure.title), control));
  themes(app);
  app.restore({ document: figure.document, layers: figure.layers });
  return app;
}

function controlOf(app: App, control: NonNullable<Figure["slider"]>): HTMLElement {
  if ("parameter" in control) {
    const { choice } = app.document;
    const parameter = methodOf("beta-skeleton").parameters[control.parameter]!;
    return slider(parameter, choice.parameters[control.parameter] ?? parameter.start, (value) => {
      const { method, parameters } = app.document.choice;
      app.change({ ...app.document, choice: { method, parameters: parameters.map((old, k) => (k === control.parameter ? value : old)) } });
    });
  }
  const output = h("output", {}, "r");
  const range = h("input", { type: "range", min: "0", max: String(RATIOS.length - 1), value: "5", "aria-label": "r" });
  const set = (): void => {
    output.textContent = `r = ${RATIOS[Number(range.value)]}`;
    app.change({ ...app.document, cloud: sampled(control.curve, Number(range.value)) });
  };
  range.addEventListener("input", set);
  output.textContent = `r = ${RATIOS[5]}`;
  return h("label", { class: "row" }, output, range);
}

export { FIGURES };
