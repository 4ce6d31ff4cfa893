// Takes shaders through Chromium itself, with its software driver: node browser.mjs FOLDER
//
// Those of techniques in their defaults, since that driver compiles every pipeline.
//
// The environment variable CHROMIUM names the program, else it is `chromium`.

import { spawn } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import { createServer } from "node:http";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { control, sets, tell } from "./files.mjs";

const PATIENCE = 10 * 60 * 1000;
const PAGE = `<!doctype html><title>antumbra</title><script type="module">
import { check } from "/shaders.mjs";
const send = (result) => fetch("/result", { method: "POST", body: JSON.stringify(result) });
try {
  const { sets, control } = await (await fetch("/shaders")).json();
  await send(navigator.gpu ? await check(navigator.gpu, sets, control) : { lines: [], wrong: ["no WebGPU"] });
} catch (error) {
  await send({ lines: [], wrong: [String(error.stack ?? error)] });
}
</script>`;

const [folder] = process.argv.slice(2);
if (!folder) {
  console.error("usage: node browser.mjs FOLDER");
  process.exit(2);
}
const inDefaults = ({ name }) => !name.includes("=");
const some = sets(folder).map((set) => ({ ...set, shaders: set.shaders.filter(inDefaults) }));
const answers = {
  "/": ["text/html", PAGE],
  "/shaders": ["application/json", JSON.stringify({ sets: some, control })],
  "/shaders.mjs": ["text/javascript", readFileSync(new URL("shaders.mjs", import.meta.url))],
};
const profile = mkdtempSync(join(tmpdir(), "antumbra-browser-"));

/// Starts the browser on a page of this server.
function browse(port) {
  const flags = [
    "--headless",
    "--no-sandbox",
    "--no-first-run",
    "--enable-unsafe-webgpu",
    "--use-webgpu-adapter=swiftshader",
    `--user-data-dir=${profile}`,
  ];
  return spawn(process.env.CHROMIUM ?? "chromium", [...flags, `http://localhost:${port}/`], { stdio: "ignore" });
}

/// Ends it, and then its helpers, which may still write to the profile for a moment.
async function close(browser) {
  const ended = new Promise((resolve) => browser.on("exit", resolve));
  if (browser.exitCode === null && browser.kill()) await ended;
  for (let tries = 0; tries < 50; tries += 1) {
    try {
      return rmSync(profile, { recursive: true, force: true });
    } catch {
      await new Promise((resolve) => setTimeout(resolve, 100));
    }
  }
}

/// What the page answers, and the browser that shows it.
function ask() {
  return new Promise((resolve) => {
    let browser;
    const answer = (result) => resolve({ browser, result });
    const fail = (what) => answer({ lines: [], wrong: [what] });
    const server = createServer((request, response) => {
      if (request.url === "/result") {
        const parts = [];
        request.on("data", (part) => parts.push(part));
        request.on("end", () => {
          response.end();
          answer(JSON.parse(Buffer.concat(parts)));
        });
        return;
      }
      const [type, body] = answers[request.url] ?? ["text/plain", ""];
      response.writeHead(answers[request.url] ? 200 : 404, { "content-type": type }).end(body);
    });
    server.listen(0, "localhost", () => {
      browser = browse(server.address().port);
      browser.on("error", (error) => fail(`${error.message}; CHROMIUM names the program`));
      browser.on("exit", (code) => fail(`the browser ended by itself (${code})`));
    });
    setTimeout(() => fail("no answer from the browser"), PATIENCE).unref();
  });
}

const { browser, result } = await ask();
await close(browser);
tell(result);
