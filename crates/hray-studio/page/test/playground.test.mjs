// The playground: the same page as static files, with the engine as WebAssembly. HRAY_PLAYGROUND names the folder that
// `cargo xtask playground --out FOLDER` has made.

import assert from "node:assert/strict";
import { createServer } from "node:http";
import { mkdtempSync, readdirSync, readFileSync, rmSync, statSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { extname, join, normalize } from "node:path";
import { after, afterEach, before, beforeEach, test } from "node:test";
import { brotliCompressSync } from "node:zlib";
import { launch } from "./browser.mjs";
import { clickPixel, cursorLine, examples, hray, known, open, ppmHash, settled, shownHash, text, type } from "./studio.mjs";

const built = process.env.HRAY_PLAYGROUND;
const skip = built ? false : "HRAY_PLAYGROUND is not set";
const classic = process.env.HRAY_CLASSIC;
const axe = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");
const types = { ".html": "text/html", ".js": "text/javascript", ".css": "text/css", ".wasm": "application/wasm", ".svg": "image/svg+xml", ".jpg": "image/jpeg", ".woff2": "font/woff2" };

let server;
let browser;
let context;
let page;
let address;

before(async () => {
  if (!built) return;
  server = createServer((request, answer) => {
    const path = normalize(decodeURIComponent(new URL(request.url, "http://localhost").pathname)).replace(/\/$/, "/index.html");
    try {
      const bytes = readFileSync(join(built, path));
      answer.writeHead(200, { "content-type": types[extname(path)] ?? "text/plain" }).end(bytes);
    } catch {
      answer.writeHead(404).end();
    }
  });
  await new Promise((resolve) => server.listen(0, "127.0.0.1", resolve));
  address = `http://127.0.0.1:${server.address().port}/`;
  browser = await launch();
});
after(async () => {
  await browser?.close();
  server?.close();
});
beforeEach(async () => {
  if (!built) return;
  context = await browser.newContext({ viewport: { width: 1280, height: 720 }, permissions: ["clipboard-read", "clipboard-write"] });
  page = await open(context, address);
});
afterEach(async () => {
  if (!built) return;
  const { wrong } = page;
  await context.close();
  assert.deepEqual(wrong, [], "nothing went wrong in the page");
});

/** The picture that the native engine makes of a text. */
async function native(source) {
  const folder = mkdtempSync(join(tmpdir(), "hray-playground-"));
  writeFileSync(join(folder, "scene.hry"), source);
  hray("render", join(folder, "scene.hry"), "-o", join(folder, "picture.ppm"));
  const hash = await ppmHash(readFileSync(join(folder, "picture.ppm")));
  rmSync(folder, { recursive: true });
  return hash;
}

test("it shows something at once, the same to the pixel as natively", { skip }, async () => {
  await settled(page, 120_000);
  assert.equal(await shownHash(page), await native(await text(page)));
});

test("classic scenes have the bytes of the native engine", { skip }, async () => {
  for (const name of ["shadows-1.hry", "mirror-spheres.hry"]) {
    const source = readFileSync(join(examples, name), "utf8");
    await type(page, source);
    await settled(page, 120_000);
    assert.equal(await shownHash(page), await native(source), name);
  }
});

test("the scenes of 2005 have their bytes", { skip: skip || (classic ? false : "HRAY_CLASSIC is not set") }, async () => {
  const names = readdirSync(join(classic, "scenes")).filter((name) => name.endsWith(".hry")).sort();
  for (const name of names.slice(0, 2)) {
    const source = readFileSync(join(classic, "scenes", name), "utf8");
    await type(page, source);
    await settled(page, 120_000);
    assert.equal(await shownHash(page), await native(source), name);
  }
});

test("an example opens with one click", { skip }, async () => {
  await page.keyboard.press("Control+o");
  await page.locator('.card[data-example="shadows-2"]').click();
  await settled(page, 120_000);
  assert.equal(await text(page), readFileSync(join(examples, "shadows-2.hry"), "utf8"));
});

test("an error is explained and mended", { skip }, async () => {
  await settled(page, 120_000);
  const before = await text(page);
  await type(page, before.replace("radius", "radios"));
  await known(page);
  await page.getByRole("button", { name: /`sphere` has no field `radios`/ }).waitFor();
  await page.locator(".problems .fix").first().click();
  await settled(page, 120_000);
  assert.equal(await text(page), before);
});

test("a pixel is explained", { skip }, async () => {
  await settled(page, 120_000);
  await clickPixel(page, 320, 230);
  await page.getByRole("heading", { name: /sphere/ }).waitFor();
  assert.equal(await cursorLine(page), 2);
});

test("a link carries the scene", { skip }, async () => {
  const mine = (await text(page)).replace("radius = 1.0", "radius = 0.7");
  await type(page, mine);
  await page.getByLabel("Copy a link to this scene").click();
  await page.getByText("The link is on the clipboard").waitFor();
  const link = await page.evaluate(() => navigator.clipboard.readText());
  assert.match(link, /#s=/);
  const other = await open(await browser.newContext(), link);
  await other.waitForFunction((wanted) => window.hray.editor.text === wanted, mine);
  await settled(other, 120_000);
  assert.equal(await shownHash(other), await native(mine));
  assert.deepEqual(other.wrong, []);
  await other.context().close();
});

test("what was typed is found again after a reload", { skip }, async () => {
  const mine = `${await text(page)}-- mine\n`;
  await type(page, mine);
  await page.reload();
  await page.waitForFunction(() => document.documentElement.dataset.ready);
  await page.waitForFunction((wanted) => window.hray.editor.text === wanted, mine);
  await settled(page, 120_000);
});

test("a scene that never ends is ended, and the next one is shown", { skip }, async () => {
  await settled(page, 120_000);
  const before = await text(page);
  await type(page, `loop n = loop (n + 1)\n${before.replace("radius = 1.0", "radius = loop 1")}`);
  await page.waitForFunction(() => document.querySelector(".count.error") || document.querySelector(".picture-pane").dataset.state === "failed", null, { timeout: 90_000 });
  await type(page, before);
  await settled(page, 120_000);
});

test("calls that go too deep are explained, as deep as they go is up to the browser", { skip }, async () => {
  await settled(page, 120_000);
  const before = await text(page);
  const deep = (depth) => `deep n = if n == 0 then 1 else deep (n - 1) * 1\n${before.replace("radius = 1.0", `radius = deep ${depth}`)}`;
  for (let turn = 0; turn < 2; turn++) {
    await type(page, deep(100_000));
    await page.locator(".count.error").waitFor();
    await page.locator("#tab-problems").click();
    await page.locator(".rendered").getByText("calls go deeper than").waitFor();
    await type(page, deep(400));
    await settled(page, 120_000);
  }
});

test("no serious finding of accessibility", { skip }, async () => {
  await settled(page, 120_000);
  await page.evaluate(axe);
  const { violations } = await page.evaluate(() => window.axe.run(document, { resultTypes: ["violations"] }));
  assert.deepEqual(violations.filter((one) => one.impact === "serious" || one.impact === "critical").map((one) => one.id), []);
});

test("it is under 1.5 MB, pictures and fonts aside", { skip }, () => {
  let size = 0;
  const walk = (folder) => {
    for (const name of readdirSync(folder)) {
      const path = join(folder, name);
      if (statSync(path).isDirectory()) walk(path);
      else if (!/\.(jpg|png|woff2)$/.test(name)) size += brotliCompressSync(readFileSync(path)).length;
    }
  };
  walk(built);
  console.log(`# ${(size / 1e6).toFixed(2)} MB with brotli`);
  assert.ok(size < 1_500_000, `${size} bytes`);
});
