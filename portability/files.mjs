// Reads the shaders that the tests write (see crates/antumbra-testing/src/shaders.rs), and tells what a
// check found.

import { readdirSync, readFileSync } from "node:fs";
import { dirname, join, relative } from "node:path";
import { fileURLToPath } from "node:url";

const REFUSED = join(dirname(fileURLToPath(import.meta.url)), "refused.wgsl");
/// Errors that are printed at most.
const SHOWN = 50;

function read(path) {
  return { path: relative(process.cwd(), path), code: readFileSync(path, "utf8") };
}

/// What a browser must refuse and naga takes.
export const control = read(REFUSED);

/// The sets of shaders below a folder.
export function sets(folder) {
  const entries = readdirSync(folder, { withFileTypes: true }).filter((entry) => entry.isDirectory());
  return entries.map(({ name }) => {
    const index = JSON.parse(readFileSync(join(folder, name, "index.json"), "utf8"));
    return { name, shaders: index.map((shader) => ({ ...shader, ...read(join(folder, name, shader.file)) })) };
  });
}

/// Prints what `check` returned and ends the process.
export function tell({ lines, wrong }) {
  lines.forEach((line) => console.log(`portability: ${line}`));
  wrong.slice(0, SHOWN).forEach((line) => console.error(line));
  if (wrong.length > SHOWN) console.error(`… and ${wrong.length - SHOWN} more`);
  process.exit(wrong.length ? 1 : 0);
}
