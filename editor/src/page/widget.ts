// The notebook's widget: points come in from Python and go back with every edit.

import { opened } from "../model/cloud.ts";
import { blank, choose } from "../model/document.ts";
import { mount } from "./mount.ts";

interface Model {
  get(name: string): unknown;
  set(name: string, value: unknown): void;
  on(event: string, listener: () => void): void;
  off(event: string, listener: () => void): void;
  save_changes(): void;
}

/** Milliseconds without a change after which Python is told. */
const PAUSE = 120;

function numbers(value: unknown): Float64Array {
  const view = value as DataView | undefined;
  if (!view?.byteLength) return new Float64Array(0);
  return new Float64Array(view.buffer.slice(view.byteOffset, view.byteOffset + view.byteLength));
}

function render({ model, el }: { model: Model; el: HTMLElement }): () => void {
  const frame = document.createElement("div");
  frame.style.cssText = `height: ${Number(model.get("height")) || 480}px; position: relative`;
  el.append(frame);
  const app = mount(frame, null);
  let own = false;
  const read = (): void => {
    if (own) return;
    const method = String(model.get("method") || "connect");
    app.restore({ document: { ...blank(), cloud: opened(numbers(model.get("_xy"))), choice: choose(method) }, layers: [] });
  };
  read();
  const send = (): void => {
    const { cloud, choice } = app.document;
    own = true;
    model.set("_xy", new DataView(cloud.xy.slice().buffer));
    model.set("_rows", new DataView(cloud.rows.slice().buffer));
    model.set("method", choice.method);
    model.set("parameters", [...choice.parameters]);
    model.save_changes();
    own = false;
  };
  let timer = 0;
  const changed = (): void => {
    clearTimeout(timer);
    timer = window.setTimeout(send, PAUSE);
  };
  app.watchers.push({ changed, answered: () => undefined });
  model.on("change:_xy", read);
  return () => {
    model.off("change:_xy", read);
    app.close();
  };
}

export default { render };
