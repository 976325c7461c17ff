// What is saved: every format and every engine, read again.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { existsSync, mkdirSync, readFileSync, rmSync, statSync, writeFileSync } from 'node:fs';
import { basename, extname, join } from 'node:path';
import { after, before, test } from 'node:test';
import { unzipSync } from 'fflate';
import { kOut, kTool, settled, Studio } from './browser.js';

const kQuick = process.env.STUDIO_QUICK === '1';
const kFolder = join(kOut, 'exported');
/** Tets that the native tool reads; the other formats are for others. */
const kReadAgain = ['.msh', '.vtk', '.vtu', '.mesh', '.npz', '.ele'];

let studio;
before(async () => {
  rmSync(kFolder, { recursive: true, force: true });
  mkdirSync(kFolder, { recursive: true });
  studio = await Studio.open();
});
after(() => studio?.close());

/** Saves from the open dialog; the files, those of a zip by themselves. */
async function save(page, value) {
  await page.selectOption('#export-what', value);
  const [download] = await Promise.all([page.waitForEvent('download'), page.click('#export-save')]);
  await page.waitForSelector('dialog .note:has-text("Saved")');
  const folder = join(kFolder, value.replace(':', '-'));
  mkdirSync(folder, { recursive: true });
  const path = join(folder, download.suggestedFilename());
  await download.saveAs(path);
  if (extname(path) !== '.zip') return [path];
  return Object.entries(unzipSync(readFileSync(path))).map(([name, bytes]) => {
    const file = join(folder, name);
    writeFileSync(file, bytes);
    return file;
  });
}

function tetsOf(path) {
  const report = JSON.parse(execFileSync(kTool, ['inspect', path, '--json', '-', '--quiet'], { encoding: 'utf8' }));
  assert.equal(report.quality.inverted_tets, 0, path);
  return report.quality.tet_count;
}

test('every format and every engine is saved, and those that the native tool reads hold the same tets', { skip: kQuick }, async (t) => {
  await studio.with('#sample=heart&voxels=64&tets=800', async (page) => {
    const { tets } = await settled(page);
    await page.click('#export');
    const values = await page.locator('#export-what option').evaluateAll((options) => options.map((option) => option.value));
    let [read, scenes] = [0, 0];
    for (const value of values) {
      const files = await save(page, value);
      for (const file of files) assert.ok(statSync(file).size > 100, file);
      if (value.startsWith('engine:') && files.length > 1) ++scenes;
      if (!existsSync(kTool)) continue;
      const again = files.filter((file) => kReadAgain.includes(extname(file)));
      for (const file of again) assert.equal(String(tetsOf(file)), tets, `${value}: ${basename(file)}`);
      read += again.length;
    }
    console.log(`# ${values.length} formats and engines, ${scenes} of several files, ${read} files read again`);
    if (!existsSync(kTool)) return t.diagnostic('build/release/bin/tetsoup is not there: nothing is read again');
    assert.ok(read >= 15, `${read} files`);
  });
});

test('one file is saved as it is, several in a zip', async (t) => {
  await studio.with('#sample=heart&voxels=48&tets=500', async (page) => {
    const { tets } = await settled(page);
    await page.click('#export');
    await page.fill('#export-name', 'my heart/1');
    const [mesh] = await save(page, 'format:msh22');
    assert.equal(basename(mesh), 'my_heart_1.msh', 'a name that every system takes');
    const files = await save(page, 'engine:mujoco');
    assert.deepEqual(files.map((file) => basename(file)).sort(), ['my_heart_1.msh', 'my_heart_1.xml']);
    if (!existsSync(kTool)) return t.diagnostic('build/release/bin/tetsoup is not there: the file is not read again');
    assert.equal(String(tetsOf(mesh)), tets);
  });
});

test('what is copied as a command makes the same file with the tool, to the bit', async (t) => {
  if (!existsSync(kTool)) return t.skip('build/release/bin/tetsoup is not there');
  await studio.with('#sample=robot&damage=20&voxels=64&tets=900&k=0.97&rho=0.4&rotate=0,15,0&translate=-0.2,0,0.1&passes=4&min_angle=22&stiffness=5.2', async (page) => {
    await settled(page);
    await page.click('#export');
    await page.fill('#export-name', 'again');
    const [mesh] = await save(page, 'format:msh22');
    await page.click('#copy-command');
    const command = await page.textContent('dialog pre');
    const folder = join(kFolder, 'copied');
    mkdirSync(folder, { recursive: true });
    for (const line of command.trim().split('\n')) execFileSync(kTool, [...line.split(' ').slice(1), '--quiet'], { cwd: folder });
    assert.ok(readFileSync(join(folder, 'again.msh')).equals(readFileSync(mesh)));
    await page.click('#copy-python');
    await page.waitForSelector('dialog pre:has-text("import")');
    assert.match(await page.textContent('dialog pre'), /tetsoup\.tetrahedralize\(tetsoup\.sample\("robot", damage=0\.2\), voxels=64, tets=900, k=0\.97, .*math\.radians\(15\)/);
  });
});

test('a picture of the view is saved', async () => {
  await studio.with('#sample=torus&voxels=48', async (page) => {
    await settled(page);
    await page.click('#export');
    const [download] = await Promise.all([page.waitForEvent('download'), page.click('#export-picture')]);
    assert.equal(download.suggestedFilename(), 'torus.png');
    const path = join(kFolder, 'torus.png');
    await download.saveAs(path);
    assert.ok(statSync(path).size > 5000);
  });
});
