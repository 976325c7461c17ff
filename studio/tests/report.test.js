// The report's template is what its sources make, and a report opens from disk.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { existsSync, mkdirSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { repository, Studio, studio as root } from './browser.js';

const kTool = join(repository, 'build/release/bin/tetsoup');
const kOut = join(root, 'tests/out');

let studio;
before(async () => {
  mkdirSync(kOut, { recursive: true });
  studio = await Studio.open();
});
after(() => studio?.close());

test('the committed template is the one that its sources make', () => {
  const rebuilt = join(kOut, 'report.html');
  execFileSync(join(root, 'node_modules/.bin/vite'), ['build', '--config', 'vite.report.config.ts', '--logLevel', 'error'],
    { cwd: root, env: { ...process.env, REPORT_TARGET: rebuilt } });
  assert.ok(readFileSync(rebuilt).equals(readFileSync(join(root, 'report/report.html'))),
    'studio/report/report.html is old; npm run report in studio/ makes it anew');
});

test('a report opens from disk, asks for nothing, and shows the mesh', async (t) => {
  if (!existsSync(kTool)) return t.skip('build/release/bin/tetsoup is not there');
  const soup = join(kOut, 'heart.obj');
  const report = join(kOut, 'heart.html');
  execFileSync(kTool, ['sample', 'heart', '-o', soup, '-q']);
  execFileSync(kTool, ['mesh', soup, '-o', join(kOut, 'heart.vtk'), '--voxels', '48', '--tets', '500', '--report', report, '-q']);
  const page = await studio.context.newPage();
  const complaints = [];
  const asked = [];
  page.on('console', (message) => message.type() === 'error' && complaints.push(message.text()));
  page.on('pageerror', (error) => complaints.push(String(error)));
  page.on('request', (request) => asked.push(request.url()));
  await page.goto(`file://${report}`);
  await page.waitForSelector('#app[data-state=done]');
  assert.match(await page.textContent('header'), /heart\.obj/);
  assert.match(await page.textContent('aside'), /Checks.*Settings.*Times/s);
  await page.click('[data-control=clip]');
  assert.equal(await page.locator('svg.histogram').count(), 1);
  assert.deepEqual(complaints, []);
  assert.deepEqual(asked.filter((url) => !url.startsWith('data:')), [`file://${report}`]);
  await page.close();
});
