// The ES module as a page uses it: all functions of the header, errors, cancelling, files in memory with the same bytes
// as those of the native tool.   node tests/wasm/module.mjs build/wasm MODEL.obj FILES-OF-THE-TOOL...
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { basename } from 'node:path';
import { load } from './load.mjs';

const [folder, model, ...native] = process.argv.slice(2);
const core = await load(folder);
const out = core._malloc(64);

const header = readFileSync(new URL('../../include/tetsoup/tetsoup_c.h', import.meta.url), 'utf8');
const names = [...header.matchAll(/(tetsoup_[a-z_]+)\(/g)].map((match) => match[1]).filter((name) => !name.endsWith('_'));
for (const name of names) assert.equal(typeof core['_' + name], 'function', name);
assert.equal(core._tetsoup_c_version(), Number(/TETSOUP_C_VERSION (\d+)/.exec(header)[1]));

assert.equal(core._tetsoup_soup_sample(core.text('nothing'), 0, 1, out), 1);
assert.match(core.error(), /must be one of torus/);

const bytes = readFileSync(model);
const place = core._malloc(bytes.length);
core.HEAPU8.set(bytes, place);
core.ok(core._tetsoup_soup_parse(place, bytes.length, core.text(basename(model)), out));
const soup = core.at(out);
core.ok(core._tetsoup_pipeline_create(soup, 0, 0, out));
const pipeline = core.at(out);

const stages = new Set();
const stop = core.addFunction((stage) => {
  stages.add(core.UTF8ToString(stage));
  return stages.has('lattice') ? 0 : 1;
}, 'iidi');
const options = core.text('{"voxels": 48, "tets": 500}');
assert.equal(core._tetsoup_pipeline_run(pipeline, options, stop, 0), 3);
assert.equal(core.error(), 'cancelled');
assert.ok(stages.has('distance') && stages.has('lattice'));
assert.equal(core._tetsoup_pipeline_vertices(pipeline, 1, out), 1);
core.ok(core._tetsoup_pipeline_run(pipeline, options, 0, 0));

assert.equal(core._tetsoup_pipeline_set_memory_limit(pipeline, 1e6), 0);
assert.equal(core._tetsoup_pipeline_run(pipeline, core.text('{"voxels": 400}'), 0, 0), 1);
assert.match(core.error(), /must be at most/);
core.ok(core._tetsoup_pipeline_set_memory_limit(pipeline, 0));
core.ok(core._tetsoup_pipeline_run(pipeline, options, 0, 0));

core.ok(core._tetsoup_model_create(pipeline, core.text(basename(model, '.obj')), 0, 0, out));
const hung = core.at(out);
core.ok(core._tetsoup_model_set_up(hung, 1));
for (const file of native) {
  core.ok(core._tetsoup_model_write(hung, core.text('/' + basename(file)), 0, out));
  assert.deepEqual(core.json(out), ['/' + basename(file)]);
  const ours = Buffer.from(core.FS.readFile('/' + basename(file)));
  assert.ok(ours.equals(readFileSync(file)), basename(file) + ' differs from what the tool writes');
}
console.log(`${names.length} functions, ${native.length} files: ok`);
process.exit(0);
