// What people do every day: going back, ending what takes long, keys, links, small screens.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import pixelmatch from 'pixelmatch';
import { PNG } from 'pngjs';
import { kNarrow, kWide, model, played, settled, state, Studio } from './browser.js';

const kSmall = { width: 320, height: 640 };
const kLying = { width: 844, height: 390 };
/** Milliseconds after which also a busy machine has drawn the finer picture. */
const kRest = 4000;
/** Milliseconds of one task while the edges of 400,000 triangles are made; it took some seconds. */
const kLongestEdges = 1000;

let studio;
before(async () => {
  studio = await Studio.open();
});
after(() => studio?.close());

function dropped(page, files, address = '') {
  return page.evaluate(([names, uri]) => {
    const data = new DataTransfer();
    const corner = 'v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n';
    names.forEach((name) => data.items.add(new File([corner], name)));
    if (uri) data.setData('text/uri-list', uri);
    document.body.dispatchEvent(new DragEvent('drop', { bubbles: true, cancelable: true, dataTransfer: data }));
  }, [files, address]);
}

async function hashHas(page, wanted) {
  await page.waitForFunction((text) => location.hash.includes(text), wanted);
}

test('what is cut away, coloured and looked at is undone, and is in the link', async () => {
  await studio.with('#sample=robot&voxels=48', async (page) => {
    await settled(page);
    await page.click('[data-control=clip]');
    await page.click('[data-flag=quality]');
    await hashHas(page, 'cut=x');
    await hashHas(page, 'quality=on');
    await page.keyboard.press('Control+z');
    await page.waitForFunction(() => !location.hash.includes('quality'));
    assert.equal(await page.getAttribute('[data-flag=quality]', 'aria-pressed'), 'false');
    assert.equal(await page.isChecked('[data-control=clip]'), true);
    await page.locator('.canvas canvas').focus();
    await page.keyboard.press('ArrowLeft');
    await hashHas(page, 'camera=');
    const camera = new URLSearchParams(new URL(page.url()).hash.slice(1)).get('camera');
    await page.waitForTimeout(kRest);
    const picture = await page.locator('.canvas canvas').screenshot();
    await studio.with(new URL(page.url()).hash, async (other) => {
      await settled(other);
      await other.waitForTimeout(kRest);
      const [then, now] = [picture, await other.locator('.canvas canvas').screenshot()].map((shot) => PNG.sync.read(shot));
      const different = pixelmatch(now.data, then.data, null, now.width, now.height, { threshold: 0.2 });
      assert.ok(different < 0.01 * now.width * now.height, `a link shows the same picture but for ${different} pixels`);
    });
    await page.keyboard.press('Control+z');
    assert.equal(new URLSearchParams(new URL(page.url()).hash.slice(1)).get('camera'), camera, 'steps back leave the camera');
    assert.equal(await page.isChecked('[data-control=clip]'), false);
    await page.keyboard.press('f');
    await page.waitForFunction(() => !location.hash.includes('camera'));
  });
});

test('beginning to play again leaves the camera where it is', async () => {
  await studio.with('#sample=sphere&voxels=48&tets=500', async (page) => {
    await settled(page);
    await page.click('#drop');
    await played(page, 5);
    await page.locator('.canvas canvas').focus();
    const press = async (key) => {
      await page.keyboard.press(key);
      return (await state(page)).camera;
    };
    const seen = await press('ArrowLeft');
    await page.click('#reset');
    await page.waitForTimeout(1000);
    await played(page, 5);
    await page.locator('.canvas canvas').focus();
    await press('ArrowRight');
    assert.equal(await press('ArrowLeft'), seen);
  });
});

test('work that takes long is cancelled by a button, and the settings are those of the mesh that is shown', async () => {
  await studio.with('#sample=robot&tets=20000', async (page) => {
    const { volume } = await settled(page);
    await page.click('#panel-advanced > summary');
    await page.click('#place > summary');
    await page.click('[data-control=fit]');
    await page.click('#cancel', { timeout: 8000 });
    const now = await settled(page);
    assert.equal(now.volume, volume);
    assert.doesNotMatch(page.url(), /fit/);
    assert.equal(await page.locator('#cancel').isVisible(), false);
  });
  await studio.with('#sample=robot&voxels=440&tets=50000&fit=search', async (page) => {
    await page.click('#cancel', { timeout: 8000 });
    await page.waitForFunction(() => document.getElementById('app').dataset.state === 'cancelled');
    await page.waitForTimeout(500);
    assert.equal(await page.locator('.status.busy').isVisible(), false);
  });
});

test('space drops and holds, escape goes back, a question mark lists the keys', async () => {
  await studio.with('#sample=sphere&voxels=48&tets=500', async (page) => {
    await settled(page);
    await page.locator('.canvas canvas').focus();
    await page.keyboard.press(' ');
    await played(page, 5);
    await page.keyboard.press(' ');
    assert.equal(await page.getAttribute('#pause', 'aria-label'), 'Go on');
    await page.keyboard.press('Escape');
    await page.waitForFunction(() => document.getElementById('app').dataset.state === 'done');
    await page.keyboard.press('c');
    await hashHas(page, 'cut=x');
    await page.keyboard.press('t');
    await hashHas(page, 'up=x');
    await page.keyboard.press('?');
    assert.match(await page.textContent('dialog[open]'), /Space/);
    await page.keyboard.press('Escape');
    assert.equal(await page.locator('dialog[open]').count(), 0);
  });
});

test('the first stop of the keyboard skips to the model, and samples are near', async () => {
  await studio.with('', async (page) => {
    await page.keyboard.press('Tab');
    assert.match(await page.evaluate(() => document.activeElement.textContent), /Skip/);
    await page.keyboard.press('Enter');
    for (let i = 0; i < 3 && !(await page.evaluate(() => document.activeElement.dataset.sample)); ++i) await page.keyboard.press('Tab');
    assert.ok(await page.evaluate(() => document.activeElement.dataset.sample));
    assert.equal(await page.locator('aside').isVisible(), false, 'nothing to set without a model');
  });
});

test('a scan that stands is not laid on its back', async (t) => {
  const path = model('bunny-69k.ply');
  if (!path) return t.skip('../shared/models/bunny-69k.ply is not there');
  await studio.with('#voxels=48', async (page) => {
    await page.setInputFiles('input[type=file]', path);
    await settled(page);
    assert.equal(await page.isChecked('[data-control=up][value=y]'), true);
    await page.keyboard.press('Control+z');
    await page.waitForSelector('.empty:not([hidden])');
  });
});

test('good news go away by themselves', async () => {
  await studio.with('#sample=torus&voxels=48', async (page) => {
    await settled(page);
    await page.click('[aria-label="Copy a link to this mesh"]');
    await page.waitForSelector('.notice:not([hidden])');
    await page.mouse.move(5, 300);
    await page.evaluate(() => document.activeElement.blur());
    await page.waitForSelector('.notice', { state: 'hidden', timeout: 8000 });
  });
});

test('of several files one is opened and the rest is said; an address is fetched', async () => {
  await studio.with('#voxels=48', async (page) => {
    await dropped(page, ['notes.txt', 'first.obj', 'second.obj']);
    await settled(page);
    assert.match(await page.textContent('.model-name'), /first\.obj/);
    assert.match(await page.textContent('.notice'), /2 other files were left out/);
    await page.route('**/away/box.obj', (route) => route.fulfill({ body: 'v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n' }));
    await dropped(page, [], `${studio.server.address}away/box.obj`);
    await page.waitForFunction(() => /box\.obj/.test(document.querySelector('.model-name').textContent));
  });
});

test('settings are reset, and the model stays', async () => {
  await studio.with('#sample=torus&voxels=48&tets=700&passes=2&quality=on', async (page) => {
    await settled(page);
    await page.click('#reset-settings');
    await page.waitForFunction(() => location.hash === '#sample=torus');
    await settled(page);
  });
});

test('a k that reaches less than a voxel is said to make no difference', async () => {
  await studio.with('#sample=torus&voxels=48&k=0.999', async (page) => {
    await settled(page);
    assert.match(await page.textContent('[data-report=volume]'), /reaches less far than a voxel/);
  });
});

for (const [name, size] of [['320 pixels', kSmall], ['a phone on its side', kLying], ['a phone', kNarrow], ['a desk', kWide]])
  test(`on ${name} all is in the page, and half of the picture is free`, async () => {
    await studio.with('#sample=robot&voxels=48', async (page) => {
      await settled(page);
      for (const playing of [false, true]) {
        if (playing) {
          await page.click('#drop');
          await played(page, 3);
        }
        const found = await page.evaluate(() => {
          const out = [...document.querySelectorAll('header button, .bar button, .bar label')].filter((e) => e.checkVisibility()).filter((e) => {
            const box = e.getBoundingClientRect();
            return box.left < 0 || box.right > innerWidth + 0.5;
          }).map((e) => e.outerHTML.slice(0, 60));
          const view = document.querySelector('.canvas').getBoundingClientRect();
          let [free, all] = [0, 0];
          for (let x = view.left + 4; x < view.right; x += 8)
            for (let y = view.top + 4; y < view.bottom; y += 8) {
              ++all;
              if (document.elementFromPoint(x, y)?.tagName === 'CANVAS') ++free;
            }
          return { out, wide: document.documentElement.scrollWidth - innerWidth, free: free / all };
        });
        assert.deepEqual(found.out, []);
        assert.ok(found.wide <= 0, `${found.wide} pixels too wide`);
        assert.ok(found.free > 0.5, `${Math.round(100 * found.free)} % free`);
      }
    }, size);
  });

test('edges of many triangles do not stop the page', async () => {
  await studio.with('#voxels=16&tets=100&view=tets', async (page) => {
    const side = 447;
    await page.evaluate((n) => {
      const lines = [];
      for (let y = 0; y <= n; ++y) for (let x = 0; x <= n; ++x) lines.push(`v ${x / n} ${y / n} ${(x * y) % 7 / n}`);
      for (let y = 0; y < n; ++y)
        for (let x = 0; x < n; ++x) {
          const a = y * (n + 1) + x + 1;
          lines.push(`f ${a} ${a + 1} ${a + n + 2}`, `f ${a} ${a + n + 2} ${a + n + 1}`);
        }
      const data = new DataTransfer();
      data.items.add(new File([lines.join('\n')], 'sheet.obj'));
      document.body.dispatchEvent(new DragEvent('drop', { bubbles: true, cancelable: true, dataTransfer: data }));
    }, side);
    await settled(page, 120000);
    await page.evaluate(() => {
      globalThis.longest = 0;
      new PerformanceObserver((list) => list.getEntries().forEach((task) => (globalThis.longest = Math.max(globalThis.longest, task.duration)))).observe({ type: 'longtask' });
    });
    await page.keyboard.press('1');
    await page.waitForTimeout(4000);
    const longest = await page.evaluate(() => globalThis.longest);
    console.log(`# ${2 * side * side} triangles' edges: longest task ${longest} ms`);
    assert.ok(longest < kLongestEdges, `${longest} ms`);
  });
});
