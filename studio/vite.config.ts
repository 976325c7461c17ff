import { defineConfig } from 'vite';
import { BundledPackages } from './licenses';

// The page works from any folder, so every address in it is relative. Cross-origin isolation gives it shared memory,
// which threads and cancelling in the middle of a stage need.
const isolation = {
  'Cross-Origin-Opener-Policy': 'same-origin',
  'Cross-Origin-Embedder-Policy': 'require-corp',
};

const packages = new BundledPackages();

export default defineConfig({
  base: './',
  build: { target: 'es2021', chunkSizeWarningLimit: 900, modulePreload: { polyfill: false } },
  worker: { format: 'es', plugins: () => [packages.collect()] },
  plugins: [packages.collect(), packages.write()],
  server: { headers: isolation },
  preview: { headers: isolation },
});
