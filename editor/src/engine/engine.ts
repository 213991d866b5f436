// The engine as the page sees it: one question at a time in a worker; of those that wait only the newest is kept.

import worker from "virtual:worker";
import type { Answer, Question, Reply, Request } from "./protocol.ts";

type Settle = (reply: Reply | null) => void;

export class EngineError extends Error {}

export class Engine {
  private worker: Worker | null = null;
  private number = 0;
  private readonly open = new Map<number, Settle>();
  private busy = false;
  private waiting: { question: Question; settle: (answer: Answer | null) => void; fail: (error: Error) => void } | null = null;
  /** The version of the points that the worker has. */
  private sent = -1;

  /** Answers a question; null if a newer one made it pointless. */
  ask(question: Question): Promise<Answer | null> {
    return new Promise((settle, fail) => {
      this.waiting?.settle(null);
      this.waiting = { question, settle, fail };
      void this.next();
    });
  }

  /** The empty disk that proves an edge of the last answer: x, y, radius. */
  async disk(edge: readonly [number, number]): Promise<Float64Array | null> {
    const reply = await this.post({ kind: "disk", number: ++this.number, edge });
    return reply && "disk" in reply ? reply.disk : null;
  }

  close(): void {
    this.worker?.terminate();
    this.worker = null;
  }

  private async next(): Promise<void> {
    if (this.busy || !this.waiting) return;
    const { question, settle, fail } = this.waiting;
    this.waiting = null;
    this.busy = true;
    const xy = question.version === this.sent ? null : question.xy;
    this.sent = question.version;
    try {
      const reply = await this.post({ kind: "ask", number: ++this.number, question: { ...question, xy } });
      if (reply && "answer" in reply) settle(reply.answer);
      else fail(new EngineError(reply && "error" in reply ? reply.error : "The engine stopped."));
    } catch (error) {
      fail(error as Error);
    } finally {
      this.busy = false;
      void this.next();
    }
  }

  private post(request: Request): Promise<Reply | null> {
    const worker = (this.worker ??= this.started());
    return new Promise((settle) => {
      this.open.set(request.number, settle);
      worker.postMessage(request);
    });
  }

  private started(): Worker {
    if (typeof WebAssembly === "undefined" || typeof Worker === "undefined") {
      throw new EngineError("This browser has no WebAssembly, which computes the curves: open the page in a newer one.");
    }
    const address = URL.createObjectURL(new Blob([worker], { type: "text/javascript" }));
    const started = new Worker(address);
    started.onmessage = (event: MessageEvent<Reply>) => this.received(event.data);
    started.onerror = () => this.died("The engine did not start: open the page in a newer browser.");
    return started;
  }

  private received(reply: Reply): void {
    this.open.get(reply.number)?.(reply);
    this.open.delete(reply.number);
    if ("error" in reply) {
      // Its points were not taken, and after a trap nothing of it can be trusted.
      this.sent = -1;
      if (reply.dead) this.died("The engine was started anew.");
    }
  }

  private died(error: string): void {
    this.close();
    this.sent = -1;
    for (const [number, settle] of this.open) settle({ number, error, dead: true });
    this.open.clear();
  }
}
