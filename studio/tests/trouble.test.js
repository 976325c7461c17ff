// What goes wrong for people, and what the page makes of it.
import assert from 'node:assert/strict';
import { mkdirSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { unzipSync } from 'fflate';
import { PNG } from 'pngjs';
import { boxOf, kOut, played, push, settled, state, Studio, travelOf } from './browser.js';

let studio;
before(async () => {
  mkdirSync(kOut, { recursive: true });
  studio = await Studio.open();
});
after(() => studio?.close());

async function open(page, name, text) {
  await page.setInputFiles('input[type=file]', { name, mimeType: '', buffer: Buffer.from(text) });
}

async function complaint(page) {
  await page.waitForSelector('.notice.watch:not([hidden])', { timeout: 30000 });
  return page.textContent('.notice p');
}

/** A box of some size about the origin. */
function box(x, y, z) {
  const corners = [0, 1, 2, 3, 4, 5, 6, 7].map((i) => `v ${i & 1 ? x : 0} ${i & 2 ? y : 0} ${i & 4 ? z : 0}\n`).join('');
  return corners + 'f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n';
}

/** Triangles upwards and downwards between the same vertices. */
function doubledSheet(cells) {
  const lines = [];
  for (let y = 0; y <= cells; ++y) for (let x = 0; x <= cells; ++x) lines.push(`v ${x / cells} ${y / cells} 0`);
  for (let y = 0; y < cells; ++y)
    for (let x = 0; x < cells; ++x) {
      const a = y * (cells + 1) + x + 1;
      const [b, c, d] = [a + 1, a + cells + 1, a + cells + 2];
      lines.push(`f ${a} ${b} ${d}`, `f ${a} ${d} ${c}`, `f ${a} ${d} ${b}`, `f ${a} ${c} ${d}`);
    }
  return lines.join('\n') + '\n';
}

/** Saves from the open dialog; names and texts of what is saved. */
async function save(page, value) {
  await page.selectOption('#export-what', value);
  const [download] = await Promise.all([page.waitForEvent('download'), page.click('#export-save')]);
  await page.waitForSelector('dialog .note:has-text("Saved")');
  const path = join(kOut, download.suggestedFilename());
  await download.saveAs(path);
  const bytes = readFileSync(path);
  const files = path.endsWith('.zip') ? Object.entries(unzipSync(bytes)) : [[download.suggestedFilename(), bytes]];
  return Object.fromEntries(files.map(([name, content]) => [name, Buffer.from(content).toString('latin1')]));
}

const kUseless = {
  'points.obj': 'v 0 0 0\nv 1 0 0\nv 0 1 0\n',
  'nan.obj': 'v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n',
  'wild.obj': 'v 0 0 0\nv 1 0 0\nv 2 0 0\nf 7 8 9\n',
};

test('a file without a usable triangle is refused, and what was there stays', async () => {
  for (const [name, text] of Object.entries(kUseless)) {
    await studio.with('', async (page) => {
      await open(page, name, text);
      assert.match(await complaint(page), /cannot be read/, name);
      assert.equal(await page.locator('.empty').isVisible(), true);
      assert.equal(await page.locator('.status.busy').isVisible(), false);
    });
    await studio.with('#sample=torus&voxels=48', async (page) => {
      const { tets } = await settled(page);
      await open(page, name, text);
      await complaint(page);
      assert.equal(await page.locator('.status.busy').isVisible(), false);
      assert.equal((await state(page)).tets, tets);
      assert.match(await page.textContent('.model-name'), /Torus/);
    });
  }
});

test('errors say what is wrong, and nothing spins afterwards', async () => {
  await studio.with('#sample=torus&voxels=48', async (page) => {
    await settled(page);
    const cube = { asset: { version: '2.0' }, buffers: [{ uri: 'away.bin', byteLength: 36 }], bufferViews: [{ buffer: 0, byteLength: 36 }],
      accessors: [{ bufferView: 0, componentType: 5126, count: 3, type: 'VEC3' }], meshes: [{ primitives: [{ attributes: { POSITION: 0 } }] }], nodes: [{ mesh: 0 }], scenes: [{ nodes: [0] }], scene: 0 };
    await open(page, 'scene.gltf', JSON.stringify(cube));
    assert.match(await complaint(page), /another file.*\.glb/);
    await open(page, 'words.obj', 'this is no model\nat all\n');
    await page.waitForFunction(() => /words\.obj/.test(document.querySelector('.notice').textContent));
    assert.doesNotMatch(await complaint(page), /\?\.|voxels/);
    await page.fill('#panel-mesh .number >> nth=1', '2048');
    await page.keyboard.press('Enter');
    await page.waitForFunction(() => /fewer voxels/.test(document.querySelector('.notice')?.textContent ?? ''));
    assert.doesNotMatch(await page.textContent('.notice'), /2\^40/);
    await page.waitForTimeout(500);
    assert.equal(await page.locator('.status.busy').isVisible(), false);
  });
});

test('a closed model with edges of more than two triangles is not said to have two at every edge', async () => {
  await studio.with('', async (page) => {
    // Two tets that share an edge and nothing else.
    await open(page, 'two.obj', 'v 0 0 0\nv 0 0 1\nv 1 0 0\nv 1 1 0\nv -1 0 0\nv -1 -1 0\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\nf 1 5 2\nf 1 2 6\nf 1 6 5\nf 2 5 6\n');
    await settled(page);
    const said = await page.textContent('[data-report=soup]');
    assert.match(said, /more than two triangles/);
    assert.doesNotMatch(said, /every edge has two/);
  });
});

test('the material that was chosen is what is written, and the next step is said without folders of this page', async () => {
  await studio.with('#stiffness=5.5&density=200&poisson=0.3&voxels=48', async (page) => {
    await open(page, 'part.v2.obj', box(1, 1, 1));
    await settled(page);
    await page.click('#export');
    const abaqus = Object.values(await save(page, 'engine:abaqus')).join();
    assert.match(abaqus, /\n3160+(\.0*)?, *0\.3|3\.16e\+?0?5, *0\.3/i);
    assert.match(abaqus, /\n200(\.0*)?\b/);
    const files = await save(page, 'engine:mujoco');
    assert.deepEqual(Object.keys(files).sort(), ['part_v2.msh', 'part_v2.xml']);
    assert.match(files['part_v2.xml'], /as asked for/);
    const note = await page.textContent('dialog .note');
    assert.doesNotMatch(note, /\/out\//);
    assert.match(note, /part_v2\.zip.*unpacked.*part_v2\.xml/);
  });
});

test('up is up where a body falls, too', async () => {
  for (const [up, height] of [['x', 1], ['y', 2], ['z', 3]])
    await studio.with(`#voxels=48&tets=500&stiffness=7&up=${up}`, async (page) => {
      await open(page, 'box.obj', box(1, 2, 3));
      await settled(page);
      await page.click('#drop');
      await played(page, 1);
      const sides = await extents(page);
      assert.ok(Math.abs(sides[2] / Math.max(...sides) - height / 3) < 0.05, `${up}: ${sides}`);
    });
});

async function extents(page) {
  const [a, b, c, d, e, f] = (await state(page)).box.split(' ').map(Number);
  return [d - a, e - b, f - c];
}

test('a sheet of triangles back to back is not black where it falls', async () => {
  await studio.with('#voxels=48&tets=500', async (page) => {
    await open(page, 'sheet.obj', doubledSheet(12));
    await settled(page);
    await page.click('#drop');
    await played(page, 30);
    await page.click('#pause');
    await page.waitForTimeout(1000);
    const { data } = PNG.sync.read(await page.locator('.canvas canvas').screenshot());
    let dark = 0;
    for (let i = 0; i < data.length; i += 4) if (Math.max(data[i], data[i + 1], data[i + 2]) < 50) ++dark;
    // Letters of what lies over the picture are dark, too.
    assert.ok(dark < 4000, `${dark} pixels`);
  });
});

test('while robots play, dragging the stiffness meshes them once more, not at every step', async () => {
  await studio.with('', async (page) => {
    const begun = performance.now();
    await page.click('#watch');
    await played(page, 1);
    const once = performance.now() - begun;
    await played(page, 20);
    await page.evaluate(async () => {
      const range = document.querySelector('input[type=range][data-control=stiffness]');
      for (let i = 0; i < 12; ++i) {
        range.value = String(240 + 30 * i);
        range.dispatchEvent(new Event('input', { bubbles: true }));
        await new Promise((done) => setTimeout(done, 60));
      }
    });
    await page.waitForTimeout(700);
    await played(page, Number((await state(page)).frames) + 5, 4 * once + 1000);
  });
});

test('a body that was squeezed does not fly off when it becomes stiff', async () => {
  await studio.with('#sample=sphere&voxels=48&tets=500&stiffness=3.7', async (page) => {
    await settled(page);
    await page.click('#drop');
    await played(page, 120);
    await push(page, 'stiffness', travelOf(7));
    let highest = 0;
    for (let i = 0; i < 20; ++i) {
      await page.waitForTimeout(100);
      const { middle, height } = await boxOf(page);
      highest = Math.max(highest, middle[2] - height / 2);
    }
    assert.ok(highest < 0.5, `${highest} m above the ground`);
  });
});

test('a size that is unlikely is asked about, and is not inherited by the next file', async () => {
  await studio.with('#voxels=48', async (page) => {
    await open(page, 'man.obj', box(60, 190, 30));
    await settled(page);
    assert.match(await page.textContent('.doubt'), /190 m/);
    await page.click('.doubt button');
    assert.match(page.url(), /unit=cm/);
    assert.equal(await page.locator('.doubt').isVisible(), false);
    await page.selectOption('[data-control=sample]', 'torus');
    await page.waitForFunction(() => document.getElementById('app').dataset.state === 'done' && /sample=torus/.test(location.hash));
    await open(page, 'cup.obj', box(0.1, 0.2, 0.1));
    await page.waitForFunction(() => document.getElementById('app').dataset.state === 'done' && !/sample/.test(location.hash));
    assert.equal(await page.inputValue('[data-control=unit]'), 'm');
    assert.equal(await page.locator('.doubt').isVisible(), false);
  });
});

test('a served model keeps what the address says of it, and gives way to a sample', async () => {
  const page = await studio.page('');
  await page.route('**/model/*', (route) => route.fulfill({ body: box(1, 2, 3) }));
  await page.goto(`${studio.server.address}?model=served.obj#up=x&unit=cm&voxels=64`);
  await settled(page);
  for (let i = 0; i < 2; ++i) {
    assert.match(page.url(), /up=x/);
    assert.match(page.url(), /unit=cm/);
    assert.match(page.url(), /voxels=64/);
    await page.reload();
    await settled(page);
  }
  assert.match(await page.textContent('.model-name'), /served\.obj/);
  await page.selectOption('[data-control=sample]', 'torus');
  await page.waitForFunction(() => /Torus/.test(document.querySelector('.model-name').textContent));
  await page.reload();
  await settled(page);
  assert.match(await page.textContent('.model-name'), /Torus/);
  await page.close();
});

test('an address of words that mean something else elsewhere is read as if they were not there', async () => {
  await studio.with('#constructor=1&toString=2&sample=torus&voxels=48', async (page) => {
    await settled(page);
  });
});

test('where nothing can be drawn the page says so', async () => {
  const page = await studio.context.newPage();
  await page.addInitScript(() => {
    const { getContext } = HTMLCanvasElement.prototype;
    HTMLCanvasElement.prototype.getContext = function of(kind, ...more) {
      return /webgl/.test(kind) ? null : getContext.call(this, kind, ...more);
    };
  });
  await page.goto(studio.server.address);
  assert.match(await page.textContent('[role=alert]'), /WebGL 2/);
  await page.close();
});

test('a picture that the graphics card takes away is said to be gone, and comes back', async () => {
  await studio.with('#sample=torus&voxels=48', async (page) => {
    await settled(page);
    await page.waitForTimeout(1200);
    const picture = () => page.locator('.canvas canvas').screenshot();
    const before = await picture();
    await page.evaluate(() => {
      globalThis.loss = document.querySelector('.canvas canvas').getContext('webgl2').getExtension('WEBGL_lose_context');
      globalThis.loss.loseContext();
    });
    assert.match(await complaint(page), /graphics card/);
    await page.evaluate(() => globalThis.loss.restoreContext());
    await page.waitForSelector('.notice', { state: 'hidden' });
    await page.waitForTimeout(1200);
    assert.ok(before.equals(await picture()), 'the same picture');
    page.complaints = page.complaints.filter((text) => !/context/i.test(text));
  });
});

test('what is to look at is said with value and limit, is shown, and is mended in the page', async () => {
  await studio.with('#sample=palm&tets=4000', async (page) => {
    await settled(page);
    assert.match(await page.textContent('#verdict'), /\d+ to look at/);
    await page.click('#verdict');
    const said = await page.textContent('#verdict-card');
    assert.doesNotMatch(said, /--|min-angle|min-part|boundary-only|rho-min/);
    for (const found of await page.locator('.check .found').allTextContents()) assert.match(found, /\d.*, at (most|least) \d/);
    await page.waitForFunction(() => /overlap with the voxels inside/.test(document.getElementById('verdict-card').textContent));
    await page.click('[data-show] >> nth=0');
    assert.match(await page.textContent('.marked:not(:empty)'), /marked/);
    const { job } = await state(page);
    await page.click('[data-fix] >> nth=0');
    await page.waitForFunction((old) => {
      const { dataset } = document.getElementById('app');
      return dataset.state === 'done' && dataset.job !== old;
    }, job);
    await page.keyboard.press('Control+z');
    await page.waitForFunction(() => location.hash === '#sample=palm&tets=4000');
  });
});
