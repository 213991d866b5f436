// The work of this tab, in the browser's own store: it survives a reload, and tabs do not mix.

import { asKept, fromPlain, type State } from "../model/address.ts";

const NAME = "crustline";
const KEY = "crustline-tab";

/** What tells this tab from others: it lives as long as the tab. */
function tabKey(): string {
  const known = sessionStorage.getItem(KEY);
  const key = known ?? crypto.randomUUID();
  if (!known) sessionStorage.setItem(KEY, key);
  return key;
}

function opened(): Promise<IDBDatabase> {
  return new Promise((settle, fail) => {
    const request = indexedDB.open(NAME, 1);
    request.onupgradeneeded = () => request.result.createObjectStore("tabs");
    request.onsuccess = () => settle(request.result);
    request.onerror = () => fail(request.error);
  });
}

export interface Kept {
  readonly state: State;
  /** The address that the work began with: a new one in this tab is opened instead. */
  readonly address: string;
}

export class Store {
  private readonly database = opened();

  async keep(state: State, address: string): Promise<void> {
    const database = await this.database;
    const plain = asKept(state);
    return new Promise((settle, fail) => {
      const change = database.transaction("tabs", "readwrite", { durability: "strict" });
      change.objectStore("tabs").put({ plain, address, at: Date.now() }, tabKey());
      change.oncomplete = () => settle();
      change.onerror = () => fail(change.error);
    });
  }

  async kept(): Promise<Kept | null> {
    const database = await this.database;
    const found = await new Promise<{ plain: Record<string, unknown>; address: string } | undefined>((settle, fail) => {
      const request = database.transaction("tabs").objectStore("tabs").get(tabKey());
      request.onsuccess = () => settle(request.result);
      request.onerror = () => fail(request.error);
    });
    if (!found) return null;
    const { plain, address } = found;
    const state = fromPlain({ ...plain, points: Array.from(plain.points as Float64Array), rows: plain.source ? Array.from(plain.rows as Int32Array) : null });
    return { state, address };
  }
}
