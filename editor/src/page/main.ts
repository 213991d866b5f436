// The page: what it begins with, and what keeps the work.

import { fromAddress } from "../model/address.ts";
import { opened } from "../model/cloud.ts";
import { blank } from "../model/document.ts";
import type { App } from "./app.ts";
import { example, EXAMPLES } from "./figures.ts";
import { FIGURES, mount, mountFigure } from "./mount.ts";
import { Server } from "./server.ts";
import { Store, type Kept } from "./store.ts";

/** Keeps the latest state; while one is being written, only the newest of those that follow waits. */
function keeping(app: App, store: Store, address: string): void {
  let writing = false;
  let again = false;
  const keep = async (): Promise<void> => {
    if (writing) {
      again = true;
      return;
    }
    writing = true;
    app.element.dataset.kept = "false";
    try {
      await store.keep(app.state, address);
      app.element.dataset.kept = String(!again);
    } catch (error) {
      app.complain(`This browser keeps nothing (${(error as Error)?.message}): save the picture as a file before you leave.`);
    }
    writing = false;
    if (again) {
      again = false;
      void keep();
    }
  };
  app.watchers.push({ changed: () => void keep(), answered: () => undefined });
}

async function keptIn(store: Store, app: App): Promise<Kept | null> {
  try {
    return await store.kept();
  } catch (error) {
    app.complain(`What this tab had kept cannot be read (${(error as Error)?.message}).`);
    return null;
  }
}

/** The work of this tab, else the picture of the address, else the server's file, else an example. */
async function begin(app: App, store: Store, server: Server | null, address: string): Promise<void> {
  const kept = await keptIn(store, app);
  const picture = /[#&]picture=([^&]*)/.exec(address)?.[1];
  if (kept && (kept.address === address || picture === undefined)) return app.restore(kept.state);
  if (picture !== undefined) {
    try {
      return app.restore(await fromAddress(picture));
    } catch (error) {
      app.complain(error);
      return app.restore({ document: blank(), layers: [] });
    }
  }
  const first = server?.configuration.first;
  if (server && first) {
    const { points, source } = await server.first(first);
    return app.restore({ document: { ...blank(), cloud: opened(points), source }, layers: [] });
  }
  app.restore({ document: server ? blank() : { ...blank(), cloud: example(EXAMPLES[0]!) }, layers: [] });
}

async function start(): Promise<void> {
  const figure = new URLSearchParams(location.search).get("figure");
  if (figure !== null) {
    const known = FIGURES[figure];
    if (!known) throw new Error(`There is no live figure “${figure}”: there are ${Object.keys(FIGURES).join(", ")}.`);
    mountFigure(document.body, known);
    return;
  }
  let server: Server | null = null;
  let fault: unknown = null;
  try {
    server = await Server.find();
  } catch (error) {
    fault = error;
  }
  const app = mount(document.body, server);
  if (fault) app.complain(fault);
  const store = new Store();
  const address = location.pathname + location.hash;
  try {
    await begin(app, store, server, address);
  } catch (error) {
    app.complain(error);
    app.restore({ document: blank(), layers: [] });
  }
  keeping(app, store, address);
  addEventListener("hashchange", () => location.reload());
  void server?.stay().then((error) => app.complain(error));
}

start().catch((error: unknown) => {
  const message = document.createElement("p");
  message.setAttribute("role", "alert");
  message.style.cssText = "margin: 2rem; font: 1rem system-ui, sans-serif";
  message.textContent = error instanceof Error ? error.message : String(error);
  document.body.append(message);
});
