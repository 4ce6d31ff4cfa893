// Takes shaders through Tint, the WGSL compiler of Chromium: node check.mjs FOLDER
//
// Dawn, WebGPU as Chromium has it, runs in Node with its null backend: it compiles and validates, and needs
// no driver.

import { create, globals } from "webgpu";
import { control, sets, tell } from "./files.mjs";
import { check } from "./shaders.mjs";

const [folder] = process.argv.slice(2);
if (!folder) {
  console.error("usage: node check.mjs FOLDER");
  process.exit(2);
}
Object.assign(globalThis, globals);
tell(await check(create(["backend=null"]), sets(folder), control));
