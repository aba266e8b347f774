// Builds the pages: node build.mjs --out FOLDER [PAGE…]. A page is a folder here with an index.html; it becomes FOLDER/PAGE.html, one
// file that asks for nothing else.

import { existsSync, mkdirSync, mkdtempSync, readdirSync, renameSync, rmSync } from "node:fs";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";
import { parseArgs } from "node:util";
import { build } from "vite";
import { viteSingleFile } from "vite-plugin-singlefile";

const here = dirname(fileURLToPath(import.meta.url));
const { values, positionals } = parseArgs({ options: { out: { type: "string", default: "dist" } }, allowPositionals: true });
const out = resolve(values.out);
const pages = positionals.length > 0 ? positionals : readdirSync(here).filter((name) => existsSync(join(here, name, "index.html")));

mkdirSync(out, { recursive: true });
for (const page of pages) {
  // A page appears whole or not at all.
  const work = mkdtempSync(join(out, `.${page}-`));
  try {
    await build({
      root: join(here, page),
      configFile: false,
      logLevel: "warn",
      plugins: [viteSingleFile()],
      build: {
        outDir: work,
        emptyOutDir: true,
        target: "es2020",
        chunkSizeWarningLimit: 4096,
        reportCompressedSize: false,
        modulePreload: { polyfill: false },
      },
    });
    renameSync(join(work, "index.html"), join(out, `${page}.html`));
  } finally {
    rmSync(work, { recursive: true, force: true });
  }
}
