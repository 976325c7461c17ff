// What stands between the page and the WebAssembly core, with a core made up: memory that runs out, a scene's time.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { test } from 'node:test';
import ts from 'typescript';

/** A source of the page as it runs; what it imports are types only. */
async function load(name) {
  const text = readFileSync(new URL(`../src/core/${name}.ts`, import.meta.url), 'utf8');
  const { outputText } = ts.transpileModule(text, { compilerOptions: { module: ts.ModuleKind.ES2022, target: ts.ScriptTarget.ES2022 } });
  return import('data:text/javascript,' + encodeURIComponent(outputText));
}

const kEnough = 64;

/** Memory of which each allocation takes 100 bytes; there are so many of them. */
function madeUp(allocations) {
  const heap = new Uint8Array(kEnough * 100);
  const freed = [];
  let next = 100;
  return { heap, freed, module: {
    HEAPU8: heap,
    _malloc: () => (allocations-- > 0 ? (next += 100) - 100 : 0),
    _free: (pointer) => freed.push(pointer),
    addFunction: () => 1,
    lengthBytesUTF8: (text) => text.length,
    stringToUTF8: (text, at) => heap.set(new TextEncoder().encode(text + '\0'), at),
  } };
}

test('where memory runs out nothing is written, and what was taken is given back', async () => {
  const { Core, CoreError } = await load('module');
  const refused = (error) => error instanceof CoreError && error.status === 4 && /does not fit/.test(error.message);
  const full = madeUp(2);  // the place of results, and the first text
  const core = new Core(full.module, null);
  assert.throws(() => core.withTexts(['first', 'second'], () => assert.fail('called')), refused);
  assert.deepEqual(full.freed, [200]);
  assert.throws(() => core.withBytes(new Uint8Array([1, 2, 3]), () => assert.fail('called')), refused);
  assert.throws(() => core.withDoubles([1], () => assert.fail('called')), refused);
  assert.ok(full.heap.subarray(0, 100).every((byte) => byte === 0), 'nothing at address 0');
  assert.throws(() => new Core(madeUp(0).module, null), refused);
});

test('a body of another stiffness goes on at the scene’s own time', async () => {
  const { Player } = await load('player');
  const calls = [];
  let made = 0;
  const core = {
    result: 8, progress: 0,
    call(name, ...args) { calls.push([name, ...args]); },
    number() { return 0; },
    word: () => ++made,
    json: () => ({ bodies: [], tet_count: 1 }),
    withTexts: (texts, body) => body(...texts.map((_, i) => i + 1)),
    floats: () => new Float32Array(0), indices: () => new Uint32Array(0),
    withBytes: (_, body) => body(16),
  };
  const player = new Player(core, {}, {});
  await player.start({ scene: 'stirred', up: 2, material: null });
  for (let i = 0; i < 7; ++i) player.advance();
  calls.length = 0;
  player.setMaterial({ density: 900, young: 1e5, poisson: 0.3 });
  const seek = calls.find(([name]) => name === 'scene_seek');
  assert.deepEqual(seek?.[2], 7);
  assert.ok(calls.findIndex(([name]) => name === 'scene_load') < calls.indexOf(seek));
  await player.start({ scene: 'stirred', up: 2, material: null });
  player.setMaterial({ density: 900, young: 1e5, poisson: 0.3 });
  assert.equal(calls.filter(([name]) => name === 'scene_seek').at(-1)[2], 0);
});
