// Builds dist/report.html and dist/live.html, which CMake puts into the program.
// Whoever changes src/ runs, with Node 20 or newer, and commits what comes out:
//
//   cd apps/report && npm ci && npm run build
//
// Each page is one file: style and script stand in it. In a report %title% and
// %document% are where `sofof report` writes; a live page asks for what it shows.
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

const digest_of_all = await digest();

/// @param page, style, script  Where they begin, in src/.
async function make(name, { page, style, script, ...more }) {
  const parts = {
    digest: digest_of_all,
    style: await bundle(`src/${style}`),
    script: (await bundle(`src/${script}`)).replaceAll("</script", "<\\/script"),
    ...more,
  };
  const frame = await readFile(here(`src/${page}`), "utf8");
  const whole = frame.replace(/\{\{(\w+)\}\}/g, (_, part) => parts[part]);
  await writeFile(here(`dist/${name}.html`), whole);
  console.log(`dist/${name}.html: ${whole.length} characters`);
}

const licence = await readFile(here("node_modules/uplot/LICENSE"), "utf8");
await make("report", {
  page: "page.html",
  style: "style.css",
  script: "main.js",
  licence: licence.trim(),
});
await make("live", { page: "live.html", style: "live/style.css", script: "live/main.js" });
