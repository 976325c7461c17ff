// The licences of all that is in a build: what npm brought, as found in the bundles, and the libraries in the core.
import { readdirSync, readFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import type { Plugin } from 'vite';

const here = dirname(fileURLToPath(import.meta.url));
const kRule = `\n${'-'.repeat(118)}\n\n`;

/** Packages whose code is in bundles; the worker's bundle is made before the page's. */
export class BundledPackages {
  private readonly folders = new Set<string>();

  /** A plugin that remembers what is in the bundles it sees. */
  collect(): Plugin {
    return {
      name: 'bundled-packages',
      generateBundle: (_, bundle) => {
        for (const file of Object.values(bundle)) {
          if (file.type !== 'chunk') continue;
          for (const [id, module] of Object.entries(file.modules)) {
            const folder = /^.*\/node_modules\/(?:@[^/]+\/)?[^/]+(?=\/)/.exec(id)?.[0];
            if (folder && module.renderedLength) this.folders.add(folder);
          }
        }
      },
    };
  }

  /** Name, version and whole licence of each. */
  notices(): string[] {
    return [...this.folders].sort().map((folder) => {
      const { name, version, license } = JSON.parse(readFileSync(join(folder, 'package.json'), 'utf8'));
      const file = readdirSync(folder).find((entry) => /^licen[cs]e/i.test(entry));
      if (!file) throw new Error(`${name} has no file with its licence`);
      return `${name} ${version}, ${license}\n\n${readFileSync(join(folder, file), 'utf8').trim()}\n`;
    });
  }

  /** A plugin that puts licenses.txt beside the page. */
  write(): Plugin {
    const read = (path: string) => `${readFileSync(join(here, path), 'utf8').trim()}\n`;
    const parts = () => [`tetsoup\n\n${read('../LICENSE')}`, ...this.notices(), read('licenses/core.txt'), read('licenses/apache-2.0.txt')];
    return {
      name: 'licenses',
      enforce: 'post',
      generateBundle() {
        this.emitFile({ type: 'asset', fileName: 'licenses.txt', source: parts().join(kRule) });
      },
    };
  }
}
