// The page in a real browser, as people use it.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { existsSync, mkdirSync, readdirSync, readFileSync, statSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { gzipSync } from 'node:zlib';
import { unzipSync } from 'fflate';
import { dist, dropFile, kNarrow, model, repository, settled, slide, state, Studio, studio as root } from './browser.js';

const kQuick = process.env.STUDIO_QUICK === '1';
const kTool = join(repository, 'build/release/bin/tetsoup');
const kOut = join(root, 'tests/out');
/** Two megabytes, all of the page and the larger core together. */
const kMostBytes = 2e6;

let studio;
before(async () => {
  mkdirSync(kOut, { recursive: true });
  studio = await Studio.open();
});
after(() => studio?.close());

/** Runs with a page that is closed afterwards and must not have complained. */
async function withPage(hash, body, size) {
  const page = await studio.page(hash, size);
  try {
    await body(page);
    assert.deepEqual(page.complaints, [], 'nothing is said on the console');
  } finally {
    await page.close();
  }
}

async function exportAs(page, value) {
  await page.click('#export');
  await page.selectOption('#export-what', value);
  const [download] = await Promise.all([page.waitForEvent('download'), page.click('#export-save')]);
  const path = join(kOut, download.suggestedFilename());
  await download.saveAs(path);
  return path;
}

test('the page and its core load in under two megabytes, compressed', () => {
  const walk = (folder) => readdirSync(folder).flatMap((name) => {
    const path = join(folder, name);
    return statSync(path).isDirectory() ? walk(path) : [path];
  });
  const size = (paths) => paths.reduce((sum, path) => sum + gzipSync(readFileSync(path)).length, 0);
  const all = walk(dist);
  const threads = all.filter((path) => path.includes('core-threads'));
  const single = all.filter((path) => path.includes('/core/'));
  const page = all.filter((path) => !threads.includes(path) && !single.includes(path));
  const bytes = size(page) + Math.max(size(threads), size(single));
  console.log(`# ${Math.round(bytes / 1000)} kB compressed`);
  assert.ok(bytes < kMostBytes, `${bytes} bytes`);
});

test('without a model the page says what to do, and a sample is one click away', async () => {
  await withPage('', async (page) => {
    assert.match(await page.textContent('.empty'), /nothing is uploaded/);
    assert.ok(await page.isDisabled('#export'));
    await page.click('.empty [data-sample=torus]');
    const done = await settled(page);
    assert.ok(Math.abs(done.tets / 2000 - 1) < 0.1, done.tets);
    assert.match(page.url(), /sample=torus/);
  });
});

test('a real model is dropped, meshed, and said in plain words', async (t) => {
  const path = model('spot-cow.obj');
  if (!path) return t.skip('../shared/models/spot-cow.obj is not there');
  await withPage('', async (page) => {
    await dropFile(page, path);
    const done = await settled(page);
    assert.ok(Math.abs(done.tets / 2000 - 1) < 0.1, done.tets);
    assert.match(await page.textContent('[data-report=soup]'), /5,856 triangles/);
    assert.match(await page.textContent('[data-report=smoothing]'), /Smallest angle \d+°/);
    assert.equal(await page.locator('input[data-control=up][value=y]').isChecked(), true, 'OBJ has y up');
  });
});

test('every slider changes the mesh, undo takes it back, and a link makes the same again', async () => {
  await withPage('#sample=robot&voxels=64', async (page) => {
    const first = await settled(page);
    const more = await slide(page, 'tets', 0.7);
    assert.ok(Number(more.tets) > 1.5 * Number(first.tets), `${first.tets} to ${more.tets}`);
    await page.keyboard.press('Control+z');
    await page.waitForFunction((n) => document.getElementById('app').dataset.tets === n, first.tets);
    await page.keyboard.press('Control+y');
    await page.waitForFunction((n) => document.getElementById('app').dataset.tets === n, more.tets);
    const covered = await slide(page, 'rho', 0.1);
    assert.notEqual(covered.tets, more.tets, 'rho');
    const finer = await slide(page, 'voxels', 0.45);
    assert.notEqual(finer.tets, covered.tets, 'voxels');
    await page.click('[data-control=k-auto]');
    const reached = await slide(page, 'k', 0.8);
    assert.notEqual(reached.tets, finer.tets, 'k');
    const angles = () => page.textContent('#panel-smoothing .brief');
    const smoothed = await angles();
    await slide(page, 'passes', 0);
    assert.notEqual(await angles(), smoothed, 'passes');
    await page.click('#place > summary');
    const shifted = await slide(page, 'translate-x', 0.8);
    assert.match(page.url(), /translate=0\.6,0,0/);
    await withPage(new URL(page.url()).hash, async (other) => {
      assert.equal((await settled(other)).tets, shifted.tets, 'the link');
    });
  });
});

test('a slider that moves on cancels the work in flight, and only the last wish is answered', async () => {
  await withPage('#sample=robot&voxels=192', async (page) => {
    await settled(page);
    const moved = performance.now();
    await page.locator('input[data-control=voxels][type=range]').evaluate(async (input) => {
      for (const value of [200, 208, 216, 224, 232, 240, 64]) {
        input.value = String(value);
        input.dispatchEvent(new Event('input', { bubbles: true }));
        await new Promise((done) => setTimeout(done, 60));
      }
    });
    await page.waitForTimeout(50);
    await settled(page);
    console.log(`# answered ${Math.round(performance.now() - moved - 420)} ms after the last of seven wishes`);
    assert.match(page.url(), /voxels=64/);
  });
});

test('a mesh that is exported is read by the native tool, with as many tets', async (t) => {
  await withPage('#sample=heart&voxels=64&tets=800', async (page) => {
    const done = await settled(page);
    const path = await exportAs(page, 'format:msh');
    assert.ok(statSync(path).size > 1000);
    await page.waitForSelector('dialog .note:has-text("Saved")');
    await page.click('dialog button:has-text("Close")');
    const zip = unzipSync(readFileSync(await exportAs(page, 'engine:mujoco')));
    assert.ok('heart.msh' in zip && Object.keys(zip).length > 1, `mesh and scene: ${Object.keys(zip)}`);
    if (!existsSync(kTool)) return t.diagnostic('build/release/bin/tetsoup is not there: the file is not read again');
    const report = JSON.parse(execFileSync(kTool, ['inspect', path, '--json', '-', '--quiet'], { encoding: 'utf8' }));
    assert.equal(String(report.quality.tet_count), done.tets);
    assert.equal(report.quality.inverted_tets, 0);
  });
});

test('a picture of the view is saved', async () => {
  await withPage('#sample=torus&voxels=48', async (page) => {
    await settled(page);
    await page.click('#export');
    const [download] = await Promise.all([page.waitForEvent('download'), page.click('#export-picture')]);
    assert.equal(download.suggestedFilename(), 'torus.png');
    const path = join(kOut, 'torus.png');
    await download.saveAs(path);
    assert.ok(statSync(path).size > 5000);
  });
});

test('a broken file and too many voxels are errors that say what to do', async () => {
  await withPage('#sample=torus&voxels=48', async (page) => {
    const done = await settled(page);
    const broken = join(kOut, 'broken.stl');
    writeFileSync(broken, 'solid nothing\nfacet normal 0 0\n');
    await dropFile(page, broken);
    await page.waitForSelector('.notice.watch:not([hidden])');
    assert.match(await page.textContent('.notice'), /cannot be read.*Export it again as OBJ/s);
    await page.click('.notice button');
    await page.fill('#panel-volume .number >> nth=0', '2048');
    await page.keyboard.press('Enter');
    await page.waitForSelector('.notice.watch:not([hidden])', { timeout: 60000 });
    assert.match(await page.textContent('.notice'), /memory.*[Cc]hoose fewer voxels/s);
    await page.fill('#panel-volume .number >> nth=0', '48');
    await page.keyboard.press('Enter');
    await settled(page);
    assert.equal((await state(page)).tets, done.tets, 'the page goes on');
  });
});

test('the body falls, is pulled with the mouse, is made softer and starts again', async () => {
  await withPage('#sample=robot&voxels=64', async (page) => {
    await settled(page);
    await page.click('#drop');
    await page.waitForFunction(() => Number(document.getElementById('app').dataset.frames) > 20, null, { timeout: 30000 });
    const box = await page.locator('.canvas canvas').boundingBox();
    const middle = [box.x + box.width / 2, box.y + box.height * 0.6];
    await page.mouse.move(...middle);
    await page.mouse.down();
    await page.mouse.move(middle[0] + 80, middle[1] - 160, { steps: 5 });
    await page.waitForTimeout(400);
    await page.mouse.up();
    await page.locator('input[data-control=stiffness]').evaluate((input) => {
      input.value = '4.2';
      input.dispatchEvent(new Event('input', { bubbles: true }));
      input.dispatchEvent(new Event('change', { bubbles: true }));
    });
    const { frames } = await state(page);
    await page.waitForFunction((n) => Number(document.getElementById('app').dataset.frames) > Number(n) + 20, frames, { timeout: 30000 });
    await page.click('#reset');
    await page.waitForFunction(() => Number(document.getElementById('app').dataset.frames) < 20);
    await page.click('#back');
    await page.waitForSelector('.bar .segments input[value=votes]', { state: 'attached' });
    assert.equal((await state(page)).state, 'done');
  });
});

test('four robots on the tree are simulated at 20 frames a second or better', async () => {
  await withPage('', async (page) => {
    await page.click('#watch');
    await page.waitForFunction(() => Number(document.getElementById('app').dataset.frames) > 40, null, { timeout: 60000 });
    const { simulate, draw, fps } = await state(page);
    console.log(`# simulating ${simulate} ms a frame, drawing without a GPU ${draw} ms, ${fps} frames/s shown`);
    assert.ok(Number(simulate) < 50, `${simulate} ms a frame`);
  });
});

test('all is reached by keyboard, and everything has a name', async () => {
  await withPage('#sample=torus&voxels=48', async (page) => {
    await settled(page);
    const nameless = await page.evaluate(() => [...document.querySelectorAll('button, input, select, summary')].filter((e) => {
      if (e.type === 'file' || e.closest('[hidden]')) return false;
      const label = e.getAttribute('aria-label') || e.textContent.trim() || e.labels?.[0]?.textContent.trim();
      return !label;
    }).map((e) => e.outerHTML.slice(0, 120)));
    assert.deepEqual(nameless, []);
    await page.locator('input[data-control=passes][type=range]').focus();
    const { job } = await state(page);
    await page.keyboard.press('ArrowRight');
    await page.waitForFunction((before) => document.getElementById('app').dataset.job !== before, job);
    await settled(page);
    await page.locator('.canvas canvas').focus();
    await page.keyboard.press('ArrowLeft');
    await page.keyboard.press('2');
    assert.match(page.url(), /view=votes/);
  });
});

test('nothing is wider than a phone', async () => {
  await withPage('#sample=torus&voxels=48', async (page) => {
    await settled(page);
    const width = await page.evaluate(() => document.documentElement.scrollWidth);
    assert.ok(width <= kNarrow.width, `${width} pixels`);
  }, kNarrow);
});

test('a page without shared memory meshes as well, between stages', { skip: kQuick }, async () => {
  const plain = await Studio.open({ isolated: false });
  try {
    const page = await plain.page('#sample=heart&voxels=64');
    const first = await settled(page);
    assert.equal(first.threads, '1');
    const more = await slide(page, 'tets', 0.6);
    assert.ok(Number(more.tets) > Number(first.tets));
    assert.deepEqual(page.complaints, []);
  } finally {
    await plain.close();
  }
});
