// Loads a WebAssembly build into Node.js: node SCRIPT.mjs build/wasm
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { resolve } from 'node:path';
import { pathToFileURL } from 'node:url';

/** @returns the module, with `text` to hand texts over, `at` to read addresses, `ok` to check a status. */
export async function load(folder) {
  const base = resolve(folder);
  // An ES module of Emscripten 3.1 takes Node.js for one of the old modules, and would fetch its other half.
  globalThis.require = createRequire(import.meta.url);
  globalThis.__dirname = base;
  const { default: create } = await import(pathToFileURL(base + '/tetsoup.js').href);
  const core = await create({
    wasmBinary: readFileSync(base + '/tetsoup.wasm'),
    mainScriptUrlOrBlob: base + '/tetsoup.js',
  });
  core.text = (words) => {
    const size = core.lengthBytesUTF8(words) + 1;
    const place = core._malloc(size);
    core.stringToUTF8(words, place, size);
    return place;
  };
  core.at = (place) => core.HEAPU32[place >> 2];
  core.error = () => core.UTF8ToString(core._tetsoup_last_error());
  core.ok = (status) => {
    if (status !== 0) throw new Error(core.error());
  };
  core.json = (place) => JSON.parse(core.UTF8ToString(core.at(place)));
  return core;
}
