// The bar above the picture, and the tools beside it.

import { jittered, without } from "../model/cloud.ts";
import { curveOf } from "../model/curves.ts";
import { blank } from "../model/document.ts";
import type { App } from "./app.ts";
import { h, icon } from "./dom.ts";
import { example, EXAMPLES } from "./figures.ts";
import type { Files } from "./files.ts";

/** How far the jitter tool moves points, in pixels. */
const JITTER = 4;

export type Theme = "auto" | "light" | "dark";

export class Commands {
  constructor(
    private readonly app: App,
    private readonly files: Files,
  ) {}

  /** The chosen points, or all. */
  private get rows(): number[] {
    return this.app.chosen.size ? [...this.app.chosen] : [...this.app.cloud.rows.keys()];
  }

  erase(): void {
    const { app } = this;
    if (!app.chosen.size) return app.say("Select points first: pull a box around them.");
    const chosen = app.chosen;
    app.choose(new Set());
    app.edit(without(app.cloud, chosen));
  }

  jitter(): void {
    this.app.edit(jittered(this.app.cloud, this.rows, JITTER * this.app.pixel, Math.random));
  }

  /** Leaves out every second point along the curves. */
  thin(): void {
    const { answer, cloud } = this.app;
    if (!answer || answer.xy.length !== cloud.xy.length) return;
    const among = new Set(this.rows);
    const out = new Set<number>();
    for (let k = 0; k < answer.curves.closed.length; k += 1) {
      const rows = Array.from(curveOf(answer.curves, k)).filter((row) => among.has(row));
      rows.forEach((row, place) => place % 2 && out.add(row));
    }
    this.app.choose(new Set());
    this.app.edit(without(cloud, out));
  }

  clear(): void {
    this.app.open({ ...blank(), choice: this.app.document.choice });
  }

  pick(): void {
    const input = h("input", { type: "file", accept: this.files.accepted });
    input.addEventListener("change", () => input.files?.[0] && void this.files.open(input.files[0]));
    input.click();
  }

  pasteDialog(): void {
    const text = h("textarea", { rows: "10", placeholder: "x, y on each line, with a header or without; or GeoJSON", "aria-label": "Coordinates" });
    const dialog = h("dialog", { class: "paste" });
    const take = async (): Promise<void> => {
      if (await this.files.paste(text.value)) dialog.close();
    };
    const buttons = h("div", { class: "buttons" }, h("button", { type: "button", class: "primary", click: () => void take() }, "Take these points"), h("button", { type: "button", click: () => dialog.close() }, "Cancel"));
    dialog.append(h("h2", {}, "Paste coordinates"), text, buttons);
    dialog.addEventListener("close", () => dialog.remove());
    this.app.element.append(dialog);
    dialog.showModal();
  }
}

function menu(title: string, path: string, items: () => { title: string; save: () => void }[]): HTMLElement {
  const list = h("div", { class: "items" });
  const details = h("details", { class: "menu" }, h("summary", {}, icon(path), h("span", {}, title)), list);
  details.addEventListener("toggle", () => {
    if (!details.open) return;
    list.replaceChildren(...items().map((item) => h("button", { type: "button", click: () => {
      details.open = false;
      item.save();
    } }, item.title)));
  });
  details.addEventListener("focusout", (event) => {
    if (!details.contains(event.relatedTarget as Node | null)) details.open = false;
  });
  details.addEventListener("keydown", (event) => {
    if (event.key === "Escape") details.open = false;
  });
  return details;
}

function button(action: string, title: string, path: string, click: () => void, key = ""): HTMLElement {
  const label = key ? `${title} (${key})` : title;
  return h("button", { type: "button", "data-action": action, title: label, "aria-label": label, click }, icon(path), h("span", {}, title));
}

export function bar(app: App, files: Files, commands: Commands, theme: () => void): HTMLElement {
  return h(
    "header", { class: "bar" },
    h("strong", {}, "crustline"),
    button("new", "New", "M6 3h8l5 5v13H6zM14 3v5h5", () => commands.clear()),
    button("open", "Open", "M3 6h6l2 3h10v10H3z", () => commands.pick(), "Ctrl+O"),
    button("paste", "Paste", "M8 5h8v3H8zM6 6h-1v15h14V6h-1M8 12h8M8 16h5", () => commands.pasteDialog()),
    menu("Examples", "M5 5h6v6H5zM13 5h6v6h-6zM5 13h6v6H5zM13 13h6v6h-6z", () => EXAMPLES.map((name) => ({ title: name, save: () => app.take(example(name)) }))),
    menu("Save", "M5 4h11l3 3v13H5zM8 4v5h7V4M8 20v-6h8v6", () => files.kinds()),
    button("share", "Share", "M10 14l8-8M13 5h6v6M18 13v6H5V6h6", () => void files.share()),
    h("span", { class: "space" }),
    button("undo", "Undo", "M9 7L4 12l5 5M4 12h10a5 5 0 0 1 0 10h-2", () => app.undo(), "Ctrl+Z"),
    button("redo", "Redo", "M15 7l5 5-5 5M20 12H10a5 5 0 0 0 0 10h2", () => app.redo(), "Ctrl+Y"),
    button("fit", "Fit", "M4 9V4h5M20 9V4h-5M4 15v5h5M20 15v5h-5", () => app.fit(), "0"),
    button("theme", "Theme", "M12 4a8 8 0 1 0 8 8 6 6 0 0 1-8-8z", theme),
    button("panel", "Panel", "M4 5h16M4 12h16M4 19h16", () => app.element.classList.toggle("panel-open")),
  );
}

export function toolbox(app: App, commands: Commands): HTMLElement {
  const tools = app.tools.map((tool) =>
    h("button", { type: "button", "data-tool": tool.name, title: `${tool.title} (${tool.key.toUpperCase()})`, "aria-label": tool.title, "aria-pressed": "false", click: () => app.use(tool) }, icon(tool.icon)));
  const actions = [
    button("erase", "Delete", "M5 7h14M9 7V4h6v3M7 7l1 13h8l1-13", () => commands.erase(), "Del"),
    button("jitter", "Jitter", "M4 14l3-5 3 7 3-10 3 9 2-4 2 3", () => commands.jitter(), "J"),
    button("thin", "Thin", "M4 12h2M10 12h.1M14 12h2M20 12h.1", () => commands.thin(), "T"),
  ];
  return h("nav", { class: "tools", "aria-label": "Tools" }, ...tools, h("hr"), ...actions);
}

/** What keys do while the picture has the focus. */
export function keyboard(app: App, commands: Commands): void {
  const { stage } = app;
  const plain: Readonly<Record<string, () => void>> = {
    Delete: () => commands.erase(), Backspace: () => commands.erase(),
    Escape: () => {
      app.choose(new Set());
      stage.cursor = null;
      stage.touch();
    },
    Enter: () => place(app), " ": () => place(app),
    "+": () => app.zoom(1.25, app.view.width / 2, app.view.height / 2), "-": () => app.zoom(0.8, app.view.width / 2, app.view.height / 2),
    0: () => app.fit(), j: () => commands.jitter(), t: () => commands.thin(),
    ArrowLeft: () => nudge(app, -1, 0), ArrowRight: () => nudge(app, 1, 0), ArrowUp: () => nudge(app, 0, 1), ArrowDown: () => nudge(app, 0, -1),
  };
  const control: Readonly<Record<string, () => void>> = {
    z: () => app.undo(), y: () => app.redo(), Z: () => app.redo(), o: () => commands.pick(),
    a: () => app.choose(new Set(app.cloud.rows.keys())),
  };
  app.element.addEventListener("keydown", (event) => {
    if ((event.target as HTMLElement).matches("input, textarea, select") && !(event.target as HTMLElement).matches("[type=range], [type=checkbox]")) return;
    const onStage = event.target === stage.element;
    const tool = !event.ctrlKey && !event.metaKey && onStage ? app.tools.find((each) => each.key === event.key) : undefined;
    const act = event.ctrlKey || event.metaKey ? control[event.key] : onStage ? plain[event.key] : undefined;
    if (tool) app.use(tool);
    else act?.();
    if (tool || act) event.preventDefault();
  });
}

/** Moves what is chosen, else the place that the keyboard works at, by some pixels. */
function nudge(app: App, right: number, up: number): void {
  const step = (app.chosen.size ? 2 : 12) * app.pixel;
  if (app.chosen.size) {
    const xy = app.cloud.xy.slice();
    for (const row of app.chosen) {
      xy[2 * row]! += right * step;
      xy[2 * row + 1]! += up * step;
    }
    return app.edit({ xy, rows: app.cloud.rows });
  }
  const [x, y] = app.stage.cursor ?? [app.view.x, app.view.y];
  app.stage.cursor = [x + right * step, y + up * step];
  app.stage.touch();
}

/** A point at the keyboard's place, or the choice of the one that is there. */
function place(app: App): void {
  const [x, y] = (app.stage.cursor ??= [app.view.x, app.view.y]);
  const at = { x, y, left: 0, top: 0, shift: false };
  const tool = app.tool.name === "select" ? app.tools[0]! : app.tools.find((each) => each.name === "draw")!;
  tool.down?.(app, at);
  tool.up?.(app, at);
}

