// Bundles the front end: build/page is the static page, build/widget.js the notebook's; with --tests, build/tests for node.

import { build } from "esbuild";
import { cp, mkdir, readdir, readFile, rm, writeFile } from "node:fs/promises";
import { gzipSync } from "node:zlib";

const shared = { bundle: true, target: "es2022", charset: "utf8", legalComments: "none", define: { "import.meta.url": '""' } };

/** Modules that are made here: the WebAssembly as text, the worker as text, the style sheet as text. */
const virtual = {
  name: "virtual",
  setup(plugin) {
    plugin.onResolve({ filter: /^virtual:/ }, ({ path }) => ({ path, namespace: "virtual" }));
    plugin.onLoad({ filter: /.*/, namespace: "virtual" }, async ({ path }) => ({ contents: await texts[path](), loader: "text" }));
  },
};

const texts = {
  "virtual:module": async () => gzipSync(await readFile("build/module/crustline_bg.wasm"), { level: 9 }).toString("base64"),
  "virtual:worker": async () => {
    const result = await build({ ...shared, entryPoints: ["src/engine/worker.ts"], format: "iife", minify: true, write: false, plugins: [virtual] });
    return result.outputFiles[0].text;
  },
  "virtual:style": async () => (await build({ entryPoints: ["src/page/style.css"], minify: true, write: false })).outputFiles[0].text,
};

async function page() {
  await rm("build/page", { recursive: true, force: true });
  await mkdir("build/page", { recursive: true });
  await build({ ...shared, entryPoints: ["src/page/main.ts"], outfile: "build/page/editor.js", format: "iife", minify: true, plugins: [virtual] });
  await build({ ...shared, entryPoints: ["src/page/widget.ts"], outfile: "build/widget.js", format: "esm", minify: true, plugins: [virtual] });
  await cp("src/page/index.html", "build/page/index.html");
}

async function tests() {
  const files = (await readdir("tests")).filter((name) => name.endsWith(".test.ts"));
  await rm("build/tests", { recursive: true, force: true });
  await build({
    ...shared, define: {}, entryPoints: files.map((name) => `tests/${name}`), outdir: "build/tests", outExtension: { ".js": ".mjs" },
    format: "esm", platform: "node", plugins: [virtual],
  });
}

await (process.argv.includes("--tests") ? tests() : page());
