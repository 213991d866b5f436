// The worker: the module, and one kernel.

import packed from "virtual:module";
import { initSync } from "../../build/module/crustline.js";
import { Kernel } from "./compute.ts";
import type { Reply, Request } from "./protocol.ts";

async function unpacked(): Promise<ArrayBuffer> {
  const bytes = Uint8Array.from(atob(packed), (letter) => letter.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
  return new Response(stream).arrayBuffer();
}

const ready = unpacked().then((module) => {
  initSync({ module });
  return new Kernel();
});

async function reply(request: Request): Promise<Reply> {
  const { number } = request;
  try {
    const kernel = await ready;
    if (request.kind === "disk") return { number, disk: kernel.disk(request.edge) };
    return { number, answer: kernel.answer(request.question) };
  } catch (error) {
    // A trap leaves the module in no known state: the page starts another.
    const dead = error instanceof WebAssembly.RuntimeError;
    return { number, error: dead ? "There is too little memory for so many points: take fewer." : (error as Error).message, dead };
  }
}

self.onmessage = async (event: MessageEvent<Request>) => {
  self.postMessage(await reply(event.data));
};
