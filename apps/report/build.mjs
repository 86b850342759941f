// Builds dist/report.html, which CMake puts into the program. Whoever changes
// src/ runs, with Node 20 or newer, and commits what comes out:
//
//   cd apps/report && npm ci && npm run build
//
// The page is one file: style and script stand in it, %title% and %document%
// are where `sofof report` writes.
import { build } from "esbuild";
import { createHash } from "node:crypto";
import { readFile, readdir, writeFile } from "node:fs/promises";

const here = (name) => new URL(name, import.meta.url).pathname;

async function bundle(entry) {
  const made = await build({
    entryPoints: [here(entry)],
    bundle: true,
    minify: true,
    format: "iife",
    target: "es2020",
    charset: "utf8",
    legalComments: "none",
    write: false,
  });
  return made.outputFiles[0].text.trim();
}

/// @returns a digest of all that the page is made from; tests/report knows it
/// too.
async function digest() {
  const below = await readdir(here("src"), { recursive: true, withFileTypes: true });
  const files = below
    .filter((entry) => entry.isFile())
    .map((entry) => `${entry.parentPath}/${entry.name}`.replace(here("."), ""));
  const all = createHash("sha256");
  for (const file of [...files, "build.mjs", "package-lock.json"].sort())
    all.update(await readFile(here(file)));
  return all.digest("hex");
}

const page = await readFile(here("src/page.html"), "utf8");
const licence = await readFile(here("node_modules/uplot/LICENSE"), "utf8");
const parts = {
  licence: licence.trim(),
  digest: await digest(),
  style: await bundle("src/style.css"),
  script: (await bundle("src/main.js")).replaceAll("</script", "<\\/script"),
};
const whole = page.replace(/\{\{(\w+)\}\}/g, (_, name) => parts[name]);
await writeFile(here("dist/report.html"), whole);
console.log(`dist/report.html: ${whole.length} characters`);
