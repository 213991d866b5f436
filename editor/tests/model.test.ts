// The model without a browser: clouds, history, reading, writing, addresses; and that imports point one way.

import assert from "node:assert/strict";
import { readdirSync, readFileSync } from "node:fs";
import { test } from "node:test";

import { asPlain, fromAddress, fromPlain, toAddress, AddressError } from "../src/model/address.ts";
import { METHODS, startOf } from "../src/model/catalog.ts";
import { along, appended, boundsOf, EMPTY, fresh, jittered, moved, nearest, opened, within, without } from "../src/model/cloud.ts";
import { summary, type Curves } from "../src/model/curves.ts";
import { amended, begin, blank, changed, choose, redone, undone } from "../src/model/document.ts";
import { ReadError, readPoints } from "../src/model/read.ts";
import { asCsv, asGeoJson, asPython } from "../src/model/write.ts";
import { without as edgesWithout } from "../src/engine/compute.ts";
import { forbiddenRegion } from "../src/layers/proof.ts";
import { fitted, toPlane, toScreen, zoomed } from "../src/layers/view.ts";

const RING: Curves = {
  indices: Uint32Array.of(0, 1, 2), offsets: Uint32Array.of(0, 3), closed: Uint8Array.of(1), isolated: Uint32Array.of(3), shells: Int32Array.of(0),
};

test("edits make new clouds and leave the old ones as they were", () => {
  const cloud = opened([0, 0, 1, 0, 2, 0]);
  assert.deepEqual([...moved(cloud, [1], 1, 2).xy], [0, 0, 2, 2, 2, 0]);
  assert.deepEqual([...without(cloud, new Set([0])).rows], [1, 2]);
  assert.deepEqual([...appended(cloud, [5, 6]).rows], [0, 1, 2, -1]);
  assert.deepEqual([...jittered(cloud, [0], 2, () => 1).xy].slice(0, 2), [2, 2]);
  assert.deepEqual([...cloud.xy], [0, 0, 1, 0, 2, 0]);
});

test("points are found by place", () => {
  const cloud = fresh([0, 0, 1, 0, 2, 0]);
  assert.equal(nearest(cloud, 1.1, 0, 0.2), 1);
  assert.equal(nearest(cloud, 1.5, 5, 0.2), null);
  assert.deepEqual([...within(cloud, { left: 0.5, right: 2, bottom: -1, top: 1 })], [1, 2]);
  assert.deepEqual([...along(cloud, { x: 0, y: 0.1 }, { x: 1, y: 0.1 }, 0.2)], [0, 1]);
  assert.equal(boundsOf(EMPTY), null);
});

test("history: what is undone is redone, a new step forgets what was undone, a drag is one step", () => {
  const first = blank();
  const second = { ...first, cloud: fresh([1, 1]) };
  let history = changed(begin(first), second);
  history = amended(history, { ...second, cloud: fresh([2, 2]) });
  assert.equal(history.past.length, 1);
  assert.equal(undone(history).now, first);
  assert.deepEqual(redone(undone(history)).now, history.now);
  assert.equal(changed(undone(history), second).future.length, 0);
  assert.equal(undone(begin(first)).now, first);
  assert.equal(redone(begin(first)).now, first);
});

test("text is read as columns or GeoJSON", () => {
  assert.deepEqual(readPoints("1,2\n3,4\n", "a"), [1, 2, 3, 4]);
  assert.deepEqual(readPoints("# made by hand\nid;y;x\n7;1,5;2,5\n", "a"), [2.5, 1.5]);
  assert.deepEqual(readPoints("(1, 2),\n(3, 4)\n", "a"), [1, 2, 3, 4]);
  assert.deepEqual(readPoints("[[1, 2], [3, 4]]", "a"), [1, 2, 3, 4]);
  const polygon = { type: "Polygon", coordinates: [[[0, 0], [1, 0], [1, 1], [0, 0]]] };
  assert.deepEqual(readPoints(JSON.stringify({ type: "Feature", geometry: polygon }), "a"), [0, 0, 1, 0, 1, 1]);
});

test("what cannot be read is said in a sentence that names the place", () => {
  for (const [text, words] of [["1,2\n3\n", "a, line 2: there is no column 2."], ["1,2\n3,x", "a, line 2: “x” is no number."], ["\n\n", "a holds no points."]] as const) {
    assert.throws(() => readPoints(text, "a"), (error: Error) => error instanceof ReadError && error.message === words);
  }
});

test("exports are as the library writes them", () => {
  const cloud = fresh([0, 0, 1, 0, 0.5, 1, 9, 9]);
  assert.equal(asCsv(fresh([1, 2.5])), "x,y\n1.0,2.5\n");
  const { features } = JSON.parse(asGeoJson(cloud, RING));
  assert.deepEqual(features[0].properties, { curve: 0, closed: true, rows: [0, 1, 2] });
  assert.deepEqual(features[0].geometry.coordinates, [[0, 0], [1, 0], [0.5, 1], [0, 0]]);
  assert.deepEqual(features[1].geometry, { type: "MultiPoint", coordinates: [[9, 9]] });
  assert.match(asPython(cloud, { method: "beta-skeleton", parameters: [1.7, 1] }, null), /method=cl\.beta_skeleton, beta=1\.7, kind="lune"/);
  assert.equal(summary(RING), "1 ring, 0 lines, 1 isolated point");
});

test("a state survives an address, and a damaged one is refused", async () => {
  const document = { ...blank(), cloud: fresh([0.1, 2, 3e-17, 4]), choice: choose("beta-skeleton"), other: choose("crust") };
  const state = { document, layers: ["points"] };
  const text = await toAddress(state);
  assert.match(text, /^[\w-]+$/);
  assert.deepEqual(await fromAddress(text), state);
  await assert.rejects(fromAddress(text.slice(0, 20)), AddressError);
  await assert.rejects(fromAddress("%"), AddressError);
  for (const wrong of [null, 1, {}, { crustline: 2 }, { crustline: 1, points: [1] }, { crustline: 1, points: [1, null] }, { crustline: 1, points: [], choice: { method: "x" } }]) {
    assert.throws(() => fromPlain(wrong), AddressError);
  }
  assert.deepEqual(fromPlain(JSON.parse(JSON.stringify(asPlain(state)))), state);
});

test("every method of the library has its sliders", () => {
  assert.ok(METHODS.length >= 20);
  for (const { name, parameters } of METHODS) {
    startOf(name).forEach((start, k) => assert.ok(start >= parameters[k]!.low && start <= parameters[k]!.high, `${name}.${parameters[k]!.name}`));
  }
});

test("edges that are not among others", () => {
  assert.deepEqual([...edgesWithout(Uint32Array.of(0, 1, 0, 3, 2, 5), Uint32Array.of(0, 1, 1, 2, 2, 5))], [0, 3]);
  assert.deepEqual([...edgesWithout(Uint32Array.of(0, 1), new Uint32Array(0))], [0, 1]);
});

test("the forbidden region touches both ends", () => {
  const xy = Float64Array.of(0, 0, 2, 0);
  for (const beta of [0.5, 1, 1.7, 3]) {
    const disks = forbiddenRegion(xy, [0, 1], beta, false);
    for (const k of [0, 3]) {
      assert.ok(Math.abs(Math.hypot(disks[k]!, disks[k + 1]!) - disks[k + 2]!) < 1e-12);
      assert.ok(Math.abs(Math.hypot(disks[k]! - 2, disks[k + 1]!) - disks[k + 2]!) < 1e-12);
    }
  }
  assert.deepEqual(forbiddenRegion(xy, [0, 1], 2, true), [2, 0, 2, 0, 0, 2]);
});

test("a view leads to the screen and back, and zooms about a place", () => {
  const view = fitted({ x: 0, y: 0, scale: 1, width: 400, height: 300 }, { left: 1, right: 3, bottom: 5, top: 6 });
  assert.deepEqual(toPlane(view, ...toScreen(view, 1.5, 5.5)).map((x) => Math.round(x * 1e9) / 1e9), [1.5, 5.5]);
  const [x, y] = toPlane(view, 100, 50);
  const near = zoomed(view, 3, 100, 50);
  assert.ok(Math.abs(toPlane(near, 100, 50)[0] - x) < 1e-9 && Math.abs(toPlane(near, 100, 50)[1] - y) < 1e-9);
  for (const box of [null, { left: 5, right: 5, bottom: 5, top: 5 }, { left: -1e300, right: 1e300, bottom: 0, top: 0 }]) {
    assert.ok(Number.isFinite(fitted(view, box).scale) && fitted(view, box).scale > 0);
  }
});

const LAYERS = ["model", "engine", "layers", "tools", "page"];

test("imports point one way: model, engine, layers, tools, page", () => {
  for (const [depth, layer] of LAYERS.entries()) {
    for (const name of readdirSync(`src/${layer}`).filter((each) => each.endsWith(".ts"))) {
      const text = readFileSync(`src/${layer}/${name}`, "utf8");
      for (const [, used] of text.matchAll(/from "\.\.\/(\w+)\//g)) {
        assert.ok(LAYERS.indexOf(used!) <= depth, `${layer}/${name} imports ${used}`);
      }
    }
  }
});
