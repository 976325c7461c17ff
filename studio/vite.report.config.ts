// Builds the report's template: one file that needs no other, into report/report.html, which the tool is compiled with.
import { mkdirSync, writeFileSync } from 'node:fs';
import { dirname, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';
import { defineConfig, type Plugin } from 'vite';
import { BundledPackages } from './licenses';

const here = dirname(fileURLToPath(import.meta.url));
const target = process.env.REPORT_TARGET ?? resolve(here, 'report/report.html');
const packages = new BundledPackages();

/** Puts scripts and styles into the page, and the page where it belongs. */
function oneFile(): Plugin {
  return {
    name: 'one-file',
    enforce: 'post',
    generateBundle(_, bundle) {
      const files = Object.values(bundle);
      const page = files.find((file) => file.fileName.endsWith('.html'));
      if (page?.type !== 'asset') throw new Error('there is no page');
      let html = String(page.source);
      for (const file of files) {
        if (file.type === 'chunk') {
          const code = file.code.replace(/<\/script/g, '<\\/script').trim();
          html = html.replace(/<script type="module"[^>]*src=[^>]*><\/script>\s*/, '')
            .replace('</body>', () => `<script type="module">${code}</script>\n  </body>`);
        } else if (file.fileName.endsWith('.css')) {
          html = html.replace(/<link rel="stylesheet"[^>]*>/, () => `<style>${String(file.source).trim()}</style>`);
        }
      }
      // Their licences ask for a copy of themselves wherever the code goes.
      html = html.replace('</head>', () => `<!--\n${packages.notices().join('\n')}-->\n  </head>`);
      mkdirSync(dirname(target), { recursive: true });
      writeFileSync(target, html);
      for (const name of Object.keys(bundle)) delete bundle[name];
    },
  };
}

export default defineConfig({
  root: resolve(here, 'src/report'),
  base: './',
  publicDir: false,
  build: { target: 'es2021', write: false, modulePreload: { polyfill: false }, chunkSizeWarningLimit: 900, assetsInlineLimit: 1 << 20 },
  plugins: [packages.collect(), oneFile()],
});
