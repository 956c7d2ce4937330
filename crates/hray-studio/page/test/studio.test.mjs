// The real page against the real binary, in a real browser.

import assert from "node:assert/strict";
import { createHash } from "node:crypto";
import { existsSync, mkdtempSync, readdirSync, readFileSync, rmSync, statSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, afterEach, before, beforeEach, test } from "node:test";
import { launch } from "./browser.mjs";
import { clickPixel, cursorLine, folder, hray, known, open, openFile, ppmHash, serve, settled, shownHash, text, type } from "./studio.mjs";

const axe = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");
const classic = process.env.HRAY_CLASSIC;

let browser;
let scenes;
let studio;
let context;
let page;

before(async () => {
  browser = await launch();
});
after(() => browser?.close());

beforeEach(async () => {
  scenes = folder("shadows-1.hry", "mirror-spheres.hry", "glass.hry", "cradle.hry");
  writeFileSync(join(scenes.path, "ball.hry"), BALL);
  studio = await serve(scenes.path);
  context = await browser.newContext({ viewport: { width: 1280, height: 720 }, acceptDownloads: true, permissions: ["clipboard-read", "clipboard-write"] });
  page = await open(context, studio.address);
  await page.keyboard.press("Escape");
});
afterEach(async () => {
  const wrong = page?.wrong ?? [];
  await context?.close();
  await studio?.stop();
  scenes?.remove();
  assert.deepEqual(wrong, [], "nothing went wrong in the page");
});

const BALL = `ball = sphere { radius = 1.0, center = (0, 1, 0), material = classic { color = #d9532c } }

scene = {
  size = (200, 150),
  samples = 1,
  camera = perspective { from = (0, 1, 6), to = (0, 1, 0), fov = 40deg },
  background = #204060,
  lights = [point { position = (4, 6, 5), intensity = 0.9 }, ambient { intensity = 0.2 }],
  objects = [ball],
}
`;

/** The picture that the command line makes of a file, hashed as the shown one is. */
async function commandLine(path, ...more) {
  const out = mkdtempSync(join(tmpdir(), "hray-out-"));
  hray("render", path, "-o", join(out, "picture.ppm"), ...more);
  const hash = await ppmHash(readFileSync(join(out, "picture.ppm")));
  rmSync(out, { recursive: true });
  return hash;
}

test("a classic scene is shown to the pixel as the command line renders it", async () => {
  for (const name of ["shadows-1.hry", "mirror-spheres.hry"]) {
    await openFile(page, name);
    await settled(page);
    assert.equal(await shownHash(page), await commandLine(join(scenes.path, name)), name);
  }
  await assertSummary(/640 × 480.*objects.*lights/);
  assert.match(await page.locator(".render-time").innerText(), /\d+(\.\d+)? m?s$/);
});

test("a scene in hry, and one that moves, are shown as the command line renders them", async () => {
  await openFile(page, "ball.hry");
  await settled(page);
  assert.equal(await shownHash(page), await commandLine(join(scenes.path, "ball.hry")));
  await openFile(page, "cradle.hry");
  await settled(page);
  assert.equal(await shownHash(page), await commandLine(join(scenes.path, "cradle.hry")));
});

test("the scenes of 2005 have their bytes", { skip: classic ? false : "HRAY_CLASSIC is not set" }, async () => {
  const own = await serve(join(classic, "scenes"));
  const other = await open(context, own.address);
  await other.keyboard.press("Escape");
  const names = readdirSync(join(classic, "scenes")).filter((name) => name.endsWith(".hry")).sort();
  assert.ok(names.length > 0);
  for (const name of names.slice(0, 3)) {
    await openFile(other, name);
    await settled(other, 120_000);
    assert.equal(await shownHash(other), await commandLine(join(classic, "scenes", name)), name);
  }
  await own.stop();
});

async function assertSummary(pattern) {
  assert.match((await page.locator(".summary").innerText()).replaceAll("\n", " "), pattern);
}

test("an error is explained, the picture dims, and the quick fix mends it", async () => {
  await openFile(page, "ball.hry");
  await settled(page);
  const good = await shownHash(page);
  await type(page, BALL.replace("radius", "radios"));
  await known(page);
  await page.getByRole("button", { name: /`sphere` has no field `radios`/ }).waitFor();
  assert.match(await page.locator(".rendered").first().innerText(), /did you mean `radius`\?/);
  assert.ok(await page.locator(".picture-well.dimmed").count(), "the last good picture is dimmed");
  assert.equal(await shownHash(page), good, "the last good picture stays");
  await page.locator(".cm-lintRange-error").first().hover();
  await page.locator(".problem-tip").getByText("`sphere` has no field `radios`").waitFor();
  await page.locator(".problems .fix").first().click();
  await settled(page);
  assert.equal(await text(page), BALL);
  assert.equal(await page.locator(".picture-well.dimmed").count(), 0);
  assert.equal(await shownHash(page), good);
});

test("a number is dragged and the picture follows", async () => {
  await openFile(page, "ball.hry");
  await settled(page);
  const before = await shownHash(page);
  const number = page.locator(".cm-number-spot").first();
  const box = await number.boundingBox();
  await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
  await page.mouse.down();
  await page.mouse.move(box.x + box.width / 2 + 30, box.y + box.height / 2, { steps: 8 });
  await page.mouse.up();
  const changed = /radius = ([\d.]+)/.exec(await text(page))[1];
  assert.ok(Number(changed) > 1, `the radius grew, it is ${changed}`);
  await settled(page);
  assert.notEqual(await shownHash(page), before);
  // And by the keyboard, back.
  for (let step = 0; step < 40 && !(await text(page)).includes("radius = 1.0,"); step++) await page.keyboard.press("Alt+ArrowDown");
  await settled(page);
  assert.equal(await shownHash(page), before);
  // A press without a way puts the cursor into the number.
  await page.locator(".cm-number-spot").first().click();
  await page.keyboard.type("7");
  assert.match(await text(page), /radius = \S*7\S*,/);
});

test("a click on a pixel leads to the line that made it", async () => {
  await openFile(page, "mirror-spheres.hry");
  await settled(page);
  await openFile(page, "ball.hry");
  await settled(page);
  await clickPixel(page, 100, 75);
  await page.getByRole("heading", { name: /sphere/ }).waitFor();
  assert.equal(await cursorLine(page), 1);
  await page.getByText("Ray from the camera").waitFor();
  assert.ok((await page.locator(".lights li").count()) >= 2, "each light has its part");
  await clickPixel(page, 3, 3);
  await page.getByRole("heading", { name: "Background" }).waitFor();
});

test("what a pixel is said to hold is what the picture has there", async () => {
  await openFile(page, "ball.hry");
  await settled(page);
  await clickPixel(page, 100, 75);
  await page.getByRole("heading", { name: /sphere/ }).waitFor();
  const said = await page.locator(".explain-shown").innerText();
  assert.equal(await page.locator(".readout-value").innerText(), said);
  const { display } = JSON.parse(hray("explain", join(scenes.path, "ball.hry"), "100", "75", "--json"));
  assert.equal(said, display);
});

test("time is scrubbed, played and paused", async () => {
  await openFile(page, "cradle.hry");
  await settled(page);
  const slider = page.getByLabel("Time in seconds");
  await slider.focus();
  await slider.fill("0.5");
  await page.waitForFunction(() => document.querySelector(".picture-pane").dataset.time === "0.5");
  await settled(page);
  assert.equal(await shownHash(page), await commandLine(join(scenes.path, "cradle.hry"), "--time", "0.5"));
  await page.getByRole("button", { name: "Play", exact: true }).click();
  await page.waitForTimeout(900);
  await page.getByRole("button", { name: "Pause" }).click();
  const time = Number(await slider.inputValue());
  assert.ok(time > 0.6, `time passed: ${time}`);
  await page.waitForFunction((now) => document.querySelector(".picture-pane").dataset.time === String(now), time);
  await settled(page);
  assert.equal((await shownHash(page)).split(":")[0], "640x400", "after playing, the picture has its whole size again");
});

test("saving writes the file, and nothing but the file", async () => {
  await openFile(page, "ball.hry");
  const changed = BALL.replace("#d9532c", "#2c53d9");
  await type(page, changed);
  await page.getByText("not saved", { exact: true }).waitFor();
  assert.equal(readFileSync(join(scenes.path, "ball.hry"), "utf8"), BALL, "nothing is written before it is asked for");
  const others = readdirSync(scenes.path).sort();
  await page.keyboard.press("Control+s");
  await page.getByText("Saved ball.hry.").first().waitFor();
  assert.equal(readFileSync(join(scenes.path, "ball.hry"), "utf8"), changed);
  assert.deepEqual(readdirSync(scenes.path).sort(), others);
  await page.locator(".unsaved").waitFor({ state: "detached" });
});

test("a new scene shows something, and is saved under a name", async () => {
  await page.keyboard.press("Control+o");
  await page.locator('.card[data-example=""]').click();
  await settled(page);
  await page.keyboard.press("Control+s");
  await page.getByLabel("Path in the folder").fill("../outside.hry");
  await page.keyboard.press("Enter");
  await page.getByText("within the opened folder").waitFor();
  await page.getByLabel("Path in the folder").fill("deeper/mine.hry");
  await page.keyboard.press("Enter");
  await page.getByText("Saved deeper/mine.hry.").first().waitFor();
  assert.equal(readFileSync(join(scenes.path, "deeper/mine.hry"), "utf8"), await text(page));
  assert.ok(!existsSync(join(scenes.path, "../outside.hry")));
  await settled(page);
});

test("an example opens with one click", async () => {
  await page.keyboard.press("Control+o");
  const card = page.locator(".card[data-example]:not([data-example=''])").first();
  await card.locator("img").waitFor();
  assert.ok(await card.locator("img").evaluate((image) => image.decode().then(() => image.naturalWidth > 100)), "with its picture");
  await card.click();
  await settled(page, 120_000);
});

test("a change on disk is picked up; one on both sides asks, and loses neither", async () => {
  const path = join(scenes.path, "ball.hry");
  await openFile(page, "ball.hry");
  await settled(page);
  const theirs = BALL.replace("radius = 1.0", "radius = 0.5");
  writeFileSync(path, theirs);
  await page.waitForFunction(() => window.hray.editor.text.includes("radius = 0.5"), null, { timeout: 15_000 });
  await settled(page);
  const mine = theirs.replace("#d9532c", "#111111");
  await type(page, mine);
  writeFileSync(path, BALL);
  await page.getByText("was changed on disk as well").waitFor({ timeout: 15_000 });
  assert.equal(await text(page), mine, "what was typed stays");
  await page.keyboard.press("Control+s");
  await page.getByRole("dialog", { name: /changed here and on disk/ }).waitFor();
  assert.equal(readFileSync(path, "utf8"), BALL, "nothing is overwritten unasked");
  await page.locator('[data-choice="mine"]').click();
  await page.getByText("Saved ball.hry.").first().waitFor();
  assert.equal(readFileSync(path, "utf8"), mine);
  await page.keyboard.press("Control+o");
  await page.locator(".draft button").first().click();
  await page.waitForFunction((other) => window.hray.editor.text === other, BALL);
});

test("taking the text from disk keeps the own one", async () => {
  const path = join(scenes.path, "ball.hry");
  await openFile(page, "ball.hry");
  const mine = BALL.replace("#d9532c", "#222222");
  await type(page, mine);
  const theirs = BALL.replace("#d9532c", "#333333");
  writeFileSync(path, theirs);
  await page.getByText("was changed on disk as well").waitFor({ timeout: 15_000 });
  await page.getByRole("button", { name: "Look at both" }).click();
  await page.locator('[data-choice="disk"]').click();
  await page.waitForFunction((other) => window.hray.editor.text === other, theirs);
  await page.keyboard.press("Control+o");
  await page.locator(".draft button").first().click();
  await page.waitForFunction((other) => window.hray.editor.text === other, mine);
});

test("a drag, and a choice of colour, are one step back", async () => {
  await openFile(page, "ball.hry");
  await settled(page);
  const number = page.locator(".cm-number-spot", { hasText: "1.0" }).first();
  const drag = async (release) => {
    const box = await number.boundingBox();
    await page.mouse.move(box.x + 4, box.y + box.height / 2);
    await page.mouse.down();
    for (let step = 1; step <= 15; step++) await page.mouse.move(box.x + 4 + step * 6, box.y + box.height / 2);
    await page.waitForFunction((before) => window.hray.editor.text !== before, BALL);
    await release();
  };
  await drag(async () => {
    await page.keyboard.press("Escape");
    assert.equal(await text(page), BALL, "Escape gives it up");
    await page.mouse.up();
  });
  assert.equal(await text(page), BALL);
  await drag(() => page.mouse.up());
  assert.notEqual(await text(page), BALL);
  await page.keyboard.press("Control+z");
  assert.equal(await text(page), BALL);
  await page.keyboard.press("Control+y");
  assert.notEqual(await text(page), BALL);
  await page.keyboard.press("Control+z");
  await known(page);
  await page.locator(".cm-content .swatch, .cm-content .cm-swatch").first().click();
  await page.locator(".picker").waitFor();
  for (let press = 0; press < 4; press++) await page.keyboard.press("ArrowRight");
  await page.waitForFunction((before) => window.hray.editor.text !== before, BALL);
  // A change from elsewhere moves the colour, and what is chosen goes where it is by now.
  await page.evaluate(() => window.hray.editor.replace(`-- above\n${window.hray.editor.text}`));
  for (let press = 0; press < 4; press++) await page.keyboard.press("ArrowRight");
  await page.waitForTimeout(300);
  await page.keyboard.press("Escape");
  const chosen = await text(page);
  assert.match(chosen, /^-- above\nball = sphere \{ radius = 1\.0, center = \(0, 1, 0\), material = classic \{ color = #[0-9a-f]{6} \} \}\n/);
  assert.ok(!chosen.includes("#d9532c"));
});

test("a file keeps the line ends that it has", async () => {
  const [path, importer] = ["windows.hry", "importer.hry"].map((name) => join(scenes.path, name));
  writeFileSync(path, `-- one\n-- two\nrust = #d9532c\n${BALL}`.replaceAll("\n", "\r\n"));
  writeFileSync(importer, `import "windows.hry" (rust)\n\n${BALL.replace("#d9532c", "rust")}`);
  await openFile(page, "windows.hry");
  assert.equal(await page.locator(".unsaved").count(), 0);
  await page.keyboard.press("Control+Home");
  await page.locator(".editor-pane > .cm-editor .cm-content").focus();
  await page.keyboard.press("Control+Home");
  await page.keyboard.type("-- typed");
  await page.keyboard.press("Enter");
  await page.keyboard.press("Control+s");
  await page.getByText("Saved windows.hry.").first().waitFor();
  assert.equal(readFileSync(path, "utf8"), `-- typed\n-- one\n-- two\nrust = #d9532c\n${BALL}`.replaceAll("\n", "\r\n"));
  await openFile(page, "importer.hry");
  await settled(page);
  await page.evaluate(() => window.hray.editor.select(window.hray.editor.text.lastIndexOf("rust"), window.hray.editor.text.lastIndexOf("rust")));
  await page.keyboard.press("F12");
  await page.waitForFunction(() => document.title.includes("windows.hry"));
  await page.waitForFunction(() => {
    const { from, to } = window.hray.editor.state.selection.main;
    return window.hray.editor.text.slice(from, to).startsWith("rust");
  });
});

test("a save that ends after another file was opened is that of the file it began with", async () => {
  await openFile(page, "ball.hry");
  const changed = `${BALL}-- saved late\n`;
  await type(page, changed);
  await page.evaluate(() => {
    const { engine } = window.hray;
    const request = engine.request.bind(engine);
    engine.request = async (what, parameters) => {
      const answer = await request(what, parameters);
      if (what === "save") await new Promise((resolve) => setTimeout(resolve, 800));
      return answer;
    };
  });
  await page.keyboard.press("Control+s");
  // Typed while it is being saved: that is not saved, and still there later.
  await type(page, `${changed}-- and later\n`);
  await openFile(page, "cradle.hry");
  await page.getByText("Saved ball.hry.").first().waitFor();
  assert.equal(await page.locator(".unsaved").count(), 0);
  assert.equal(readFileSync(join(scenes.path, "ball.hry"), "utf8"), changed);
  await openFile(page, "ball.hry");
  assert.equal(await text(page), `${changed}-- and later\n`);
  assert.equal(await page.locator(".unsaved").count(), 1);
  assert.equal(await page.locator("[data-banner=disk]").count(), 0, "nobody else has changed it");
});

test("an explanation follows the picture, and an error is shown over it", async () => {
  await openFile(page, "ball.hry");
  await settled(page);
  await clickPixel(page, 100, 75);
  await page.getByRole("heading", { name: /sphere/ }).waitFor();
  await type(page, `-- one more\n${BALL}`);
  await settled(page);
  await page.locator(".explain:not(.stale)").getByText("line 2").first().waitFor();
  await type(page, BALL.replace("radius", "radios"));
  await page.locator("#tab-problems[aria-selected=true]").waitFor();
  await page.locator(".rendered").first().waitFor();
});

test("what was typed is found again after a reload", async () => {
  await openFile(page, "ball.hry");
  const changed = `${BALL}-- typed and not saved\n`;
  await type(page, changed);
  await page.reload();
  await page.waitForFunction(() => document.documentElement.dataset.ready);
  await page.waitForFunction((wanted) => window.hray.editor.text === wanted, changed);
  await page.getByText("Here is the text that was not saved yet").waitFor();
  assert.equal(readFileSync(join(scenes.path, "ball.hry"), "utf8"), BALL);
  await settled(page);
});

test("the server is killed and started again: nothing typed is lost", async () => {
  await openFile(page, "ball.hry");
  await settled(page);
  await studio.stop();
  await page.getByText("The engine is away").waitFor();
  const changed = BALL.replace("#d9532c", "#44cc88");
  await type(page, changed);
  studio = await serve(scenes.path, "--port", studio.port);
  const again = await open(context, studio.address);
  await again.keyboard.press("Escape");
  await page.waitForFunction(() => ["open", "refused"].includes(document.documentElement.dataset.engine), null, { timeout: 20_000 });
  assert.equal(await text(page), changed);
  await page.close();
  await openFile(again, "ball.hry");
  await again.waitForFunction((wanted) => window.hray.editor.text === wanted, changed);
  await settled(again);
  page = again;
});

test("two tabs on one file: each keeps its text, and a save in one reaches the other", async () => {
  await openFile(page, "ball.hry");
  const other = await open(context, studio.address);
  await other.keyboard.press("Escape");
  await openFile(other, "ball.hry");
  await type(page, `${BALL}-- one\n`);
  await page.keyboard.press("Control+s");
  await page.getByText("Saved ball.hry.").first().waitFor();
  await other.waitForFunction((wanted) => window.hray.editor.text === wanted, `${BALL}-- one\n`, { timeout: 15_000 });
  await type(page, `${BALL}-- from here\n`);
  await type(other, `${BALL}-- from there\n`);
  await other.keyboard.press("Control+s");
  await other.getByText("Saved ball.hry.").first().waitFor();
  await page.getByText("was changed on disk as well").waitFor({ timeout: 15_000 });
  assert.equal(await text(page), `${BALL}-- from here\n`);
  await page.reload();
  await page.waitForFunction(() => document.documentElement.dataset.ready);
  await page.getByText("was changed on disk as well").waitFor();
  assert.equal(await text(page), `${BALL}-- from here\n`);
  assert.deepEqual(other.wrong, []);
});

test("completion, documentation, definitions, layout", async () => {
  await openFile(page, "ball.hry");
  await settled(page);
  await type(page, BALL.replace("radius = 1.0, ", ""));
  await page.evaluate(() => window.hray.editor.select(16, 16));
  await page.keyboard.type("rad");
  await page.locator(".cm-tooltip-autocomplete li", { hasText: "radius" }).first().waitFor();
  await page.locator(".cm-completionInfo").waitFor();
  await page.keyboard.press("Escape");
  await type(page, BALL);
  await known(page);
  await page.locator(".tk-constructor", { hasText: "sphere" }).first().hover();
  await page.locator(".cm-tooltip .hover").getByText("radius").first().waitFor();
  await page.mouse.move(900, 300);
  await page.evaluate(() => window.hray.editor.select(window.hray.editor.text.lastIndexOf("ball"), window.hray.editor.text.lastIndexOf("ball")));
  await page.keyboard.press("F12");
  await page.waitForFunction(() => window.hray.editor.state.selection.main.head <= 4);
  await type(page, BALL.replace("ball = sphere {", "ball   =  sphere  {"));
  await known(page);
  await page.keyboard.press("Shift+Alt+F");
  await page.waitForFunction((wanted) => window.hray.editor.text === wanted, BALL);
});

test("a name is renamed wherever it is used, in other files after asking", async () => {
  const paths = ["paints.hry", "other.hry"].map((name) => join(scenes.path, name));
  writeFileSync(paths[0], "rust = #d9532c\n");
  const using = BALL.replace("#d9532c", "paints.rust");
  writeFileSync(paths[1], `import "paints.hry" as paints\n\n${using}`);
  await openFile(page, "paints.hry");
  await known(page);
  const rename = async (button) => {
    await page.evaluate(() => window.hray.editor.select(2, 2));
    await page.keyboard.press("F2");
    await page.locator("#ask-field").fill("ochre");
    await page.keyboard.press("Enter");
    const dialog = page.getByRole("dialog", { name: "Other files use it as well" });
    await dialog.getByText("other.hry (one place)").waitFor();
    await dialog.getByRole("button", { name: button }).click();
    await dialog.waitFor({ state: "detached" });
  };
  await rename("Cancel");
  assert.equal(await text(page), "rust = #d9532c\n");
  assert.ok(readFileSync(paths[1], "utf8").includes("paints.rust"));
  await rename("Rename everywhere");
  await page.waitForFunction(() => window.hray.editor.text === "ochre = #d9532c\n");
  assert.equal(readFileSync(paths[1], "utf8"), `import "paints.hry" as paints\n\n${using.replace("rust", "ochre")}`);
});

test("the library is looked at, and not changed", async () => {
  await openFile(page, "ball.hry");
  await type(page, BALL.replace("#204060", "sky"));
  await known(page);
  await page.evaluate(() => window.hray.editor.select(window.hray.editor.text.indexOf("sky") + 1, window.hray.editor.text.indexOf("sky") + 1));
  await page.keyboard.press("F12");
  await page.locator(".peek").getByText("read only").waitFor();
  await page.keyboard.type("nothing");
  assert.ok(!(await page.locator(".peek .cm-content").innerText()).includes("nothing"));
  await page.keyboard.press("Escape");
  await page.locator(".peek").waitFor({ state: "detached" });
});

test("a colour is chosen and written back", async () => {
  await openFile(page, "ball.hry");
  await settled(page);
  const before = await shownHash(page);
  await page.locator(".cm-swatch").first().click();
  await page.getByLabel("Colour as a hexadecimal number").fill("#3070d0");
  await page.waitForFunction(() => window.hray.editor.text.includes("#3070d0"));
  await page.keyboard.press("Escape");
  await settled(page);
  assert.notEqual(await shownHash(page), before);
});

test("zoom, pixel values, comparison, full screen", async () => {
  await openFile(page, "ball.hry");
  await settled(page);
  await page.locator(".picture-well").focus();
  await page.keyboard.press("1");
  assert.equal(await page.locator(".zoom-label").innerText(), "100 %");
  await page.keyboard.press("+");
  assert.equal(await page.locator(".zoom-label").innerText(), "125 %");
  await page.locator(".picture-well").hover();
  await page.mouse.wheel(0, -400);
  await page.waitForFunction(() => parseInt(document.querySelector(".zoom-label").textContent, 10) > 200);
  await page.keyboard.press("0");
  assert.match(await page.locator(".zoom-label").innerText(), /^Fit/);
  await type(page, BALL.replace("#d9532c", "#d9532d").replace("radius = 1.0", "radius = 1.2"));
  await settled(page);
  await page.locator(".picture-well").focus();
  await page.keyboard.press("c");
  await page.locator(".wipe").waitFor();
  await page.keyboard.press("c");
  const lit = await page.evaluate(() => {
    const canvas = document.querySelector(".picture-before");
    const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
    let count = 0;
    for (let at = 0; at < data.length; at += 4) if (data[at] + data[at + 1] + data[at + 2] > 0) count++;
    return { lit: count, all: data.length / 4 };
  });
  assert.ok(lit.lit > 100 && lit.lit < lit.all / 2, `the ball differs, the background does not: ${JSON.stringify(lit)}`);
  await page.keyboard.press("c");
  await page.keyboard.press("f");
  await page.locator(".picture-pane.full-screen").waitFor();
  await page.keyboard.press("f");
  await page.waitForFunction(() => !document.querySelector(".full-screen"));
});

test("the picture is saved as the command line would, and copied", async () => {
  await openFile(page, "ball.hry");
  await settled(page);
  for (const format of ["PNG", "PPM"]) {
    await page.getByLabel("Save or copy the picture").click();
    const [download] = await Promise.all([page.waitForEvent("download"), page.getByRole("menuitem", { name: new RegExp(`^Save as ${format} `) }).click()]);
    const out = join(scenes.path, "deeper", `out.${format.toLowerCase()}`);
    hray("render", join(scenes.path, "ball.hry"), "-o", out);
    const hash = (path) => createHash("sha256").update(readFileSync(path)).digest("hex");
    assert.equal(hash(await download.path()), hash(out), format);
  }
  await page.getByLabel("Save or copy the picture").click();
  await page.getByRole("menuitem", { name: "Copy to the clipboard" }).click();
  await page.getByText(/on the clipboard/).waitFor();
  const types = await page.evaluate(async () => (await navigator.clipboard.read()).flatMap((item) => item.types));
  assert.deepEqual(types, ["image/png"]);
});

test("the view is told as a command line that gives this picture", async () => {
  await openFile(page, "cradle.hry");
  await settled(page);
  await page.getByLabel("Time in seconds").fill("0.25");
  await page.waitForFunction(() => document.querySelector(".picture-pane").dataset.time === "0.25");
  await settled(page);
  await page.getByLabel("This view as a command line").click();
  const command = await page.locator(".command").innerText();
  assert.match(command, /^hray render .*cradle\.hry/);
  assert.match(command, /--time 0\.25/);
});

test("a scene that cannot be rendered says so, and the next one is", async () => {
  await openFile(page, "ball.hry");
  await type(page, BALL.replace("(200, 150)", "(30000, 30000)"));
  await page.getByText(/^Shown at \d+ % of its size/).waitFor();
  await type(page, BALL.replace("(200, 150)", "(40000, 40000)"));
  await page.locator(".count.error").waitFor();
  await type(page, BALL);
  await settled(page);
  await type(page, BALL.replace("ball = ", "loop n = loop (n + 1)\nball = ").replace("radius = 1.0", "radius = loop 1"));
  await page.locator(".count.error").waitFor({ timeout: 60_000 });
  await type(page, BALL);
  await settled(page);
});

test("a hundred edits a second: the picture is the last one's", async () => {
  await openFile(page, "ball.hry");
  await settled(page);
  await page.evaluate(async () => {
    for (let turn = 0; turn < 200; turn++) {
      window.hray.editor.replace(window.hray.editor.text.replace(/radius = [\d.]+/, `radius = ${(0.5 + turn / 400).toFixed(4)}`));
      await new Promise((resolve) => setTimeout(resolve, 10));
    }
  });
  await settled(page);
  writeFileSync(join(scenes.path, "deeper/last.hry"), await text(page));
  assert.equal(await shownHash(page), await commandLine(join(scenes.path, "deeper/last.hry")));
});

test("a laptop that slept: what was typed and what changed on disk meanwhile is there", async () => {
  await openFile(page, "ball.hry");
  await settled(page);
  const session = await context.newCDPSession(page);
  // The server stands still while the page does not.
  studio.freeze(true);
  const changed = BALL.replace("#d9532c", "#44cc88");
  await type(page, changed);
  await page.waitForTimeout(1500);
  studio.freeze(false);
  await settled(page);
  await page.keyboard.press("Control+s");
  await page.getByText("Saved ball.hry.").first().waitFor();
  // Now both.
  await session.send("Page.setWebLifecycleState", { state: "frozen" });
  studio.freeze(true);
  writeFileSync(join(scenes.path, "ball.hry"), BALL);
  await new Promise((resolve) => setTimeout(resolve, 1500));
  studio.freeze(false);
  await session.send("Page.setWebLifecycleState", { state: "active" });
  await page.waitForFunction((wanted) => window.hray.editor.text === wanted, BALL, { timeout: 15_000 });
  await settled(page);
});

test("memory does not grow with edits", async () => {
  await openFile(page, "ball.hry");
  await settled(page);
  const session = await context.newCDPSession(page);
  const turns = Number(process.env.HRAY_EDITS ?? 2000);
  const edits = (count) =>
    page.evaluate(async (many) => {
      for (let turn = 0; turn < many; turn++) {
        const { text } = window.hray.editor;
        const from = text.indexOf("radius = ") + 9;
        window.hray.editor.edit([{ from, to: from + 3, text: (0.5 + (turn % 10) / 20).toFixed(1) }]);
        await new Promise((resolve) => setTimeout(resolve, 3));
      }
    }, count);
  const used = async () => {
    await settled(page);
    await session.send("HeapProfiler.collectGarbage");
    return (await session.send("Runtime.getHeapUsage")).usedSize / 1048576;
  };
  await edits(500);
  const before = await used();
  await edits(turns);
  const after = await used();
  const nodes = await page.evaluate(() => document.querySelectorAll("*").length);
  console.log(`# ${before.toFixed(1)} MiB before ${turns} edits, ${after.toFixed(1)} after; ${nodes} elements`);
  assert.ok(after - before < 4, `${before} to ${after} MiB`);
});

test("the first pixels follow a key in a gallery scene, and how soon is told", async () => {
  await openFile(page, "glass.hry");
  await settled(page, 120_000);
  const waits = [];
  for (let turn = 0; turn < 5; turn++) {
    waits.push(
      await page.evaluate(
        () =>
          new Promise((resolve) => {
            const { engine, editor } = window.hray;
            let started = 0;
            let frame = -1;
            engine.on((event) => {
              if (event.event === "frame") frame = event.frame;
              if (event.event === "pixels" && event.frame === frame && started) {
                resolve(performance.now() - started);
                started = 0;
              }
            });
            frame = -1;
            started = performance.now();
            editor.view.dispatch({ changes: { from: editor.state.doc.length, insert: " " } });
          }),
      ),
    );
    await page.waitForTimeout(100);
  }
  waits.sort((one, other) => one - other);
  console.log(`# first pixels after ${waits.map((wait) => wait.toFixed(0)).join(", ")} ms`);
  assert.equal(waits.length, 5);
});

async function serious(of, name) {
  await of.evaluate(axe);
  const { violations } = await of.evaluate(() => window.axe.run(document, { resultTypes: ["violations"] }));
  const found = violations.filter((one) => one.impact === "serious" || one.impact === "critical");
  assert.deepEqual(found.map((one) => `${one.id}: ${one.nodes.map((node) => `${node.html.slice(0, 120)} ${node.failureSummary ?? ""}`).slice(0, 3).join(" | ")}`), [], name);
}

for (const scheme of ["light", "dark"]) {
  test(`no serious finding of accessibility, ${scheme}`, async () => {
    await page.emulateMedia({ colorScheme: scheme });
    await openFile(page, "cradle.hry");
    await settled(page);
    await serious(page, "the page");
    await clickPixel(page, 330, 200);
    await page.locator(".rays").first().waitFor();
    await serious(page, "with a pixel explained");
    await type(page, BALL.replace("radius", "radios"));
    await page.locator("#tab-problems").click();
    await page.locator(".rendered").waitFor();
    await serious(page, "with an error");
    await page.keyboard.press("Control+o");
    await page.locator(".card").first().waitFor();
    await serious(page, "the choice of a scene");
    await page.keyboard.press("Escape");
    await page.keyboard.press("F1");
    await serious(page, "the keys");
    await page.keyboard.press("Escape");
    await page.getByLabel("Save or copy the picture").click();
    await serious(page, "a menu");
    await page.keyboard.press("Escape");
  });
}

test("the keyboard alone is enough", async () => {
  await page.keyboard.press("Control+o");
  await page.keyboard.type("ball.hry");
  await page.keyboard.press("Enter");
  await page.waitForFunction(() => document.title.includes("ball.hry"));
  await settled(page);
  const inside = (selector) => page.evaluate((wanted) => document.activeElement?.closest(wanted) !== null, selector);
  // To the picture: a pixel is chosen and explained.
  for (let turn = 0; turn < 5 && !(await inside(".picture-pane")); turn++) await page.keyboard.press("F6");
  assert.ok(await inside(".picture-well"));
  await page.keyboard.press("ArrowRight");
  await page.keyboard.press("Enter");
  await page.getByRole("heading", { name: /sphere/ }).waitFor();
  // To what is below, and through its tabs.
  await page.keyboard.press("F6");
  assert.ok(await inside(".dock"));
  await page.keyboard.press("ArrowLeft");
  assert.equal(await page.locator("#tab-problems").getAttribute("aria-selected"), "true");
  // To the bar, then the text: type an error, go to it, take the fix.
  await page.keyboard.press("F6");
  assert.ok(await inside(".bar"));
  await page.keyboard.press("F6");
  assert.ok(await inside(".editor-pane"));
  await page.keyboard.press("Control+Home");
  await page.keyboard.press("Control+ArrowRight");
  await page.keyboard.press("Control+a");
  await page.keyboard.insertText(BALL.replace("radius", "radios"));
  await known(page);
  await page.keyboard.press("F8");
  assert.equal(await cursorLine(page), 1);
  await page.keyboard.press("Control+.");
  await page.waitForFunction((wanted) => window.hray.editor.text === wanted, BALL);
  // Out of the text by Escape and Tab.
  await page.keyboard.press("Escape");
  await page.keyboard.press("Tab");
  assert.ok(!(await inside(".cm-editor")), "Escape and Tab leave the text");
  // The focus can be seen wherever it is.
  for (let turn = 0; turn < 12; turn++) {
    await page.keyboard.press("Tab");
    const seen = await page.evaluate(() => {
      const style = getComputedStyle(document.activeElement);
      return document.activeElement === document.body || document.activeElement.classList.contains("cm-content") || (style.outlineStyle !== "none" && parseFloat(style.outlineWidth) > 0) || style.backgroundColor !== "rgba(0, 0, 0, 0)";
    });
    assert.ok(seen, await page.evaluate(() => document.activeElement.outerHTML.slice(0, 200)));
  }
  await page.keyboard.press("F1");
  await page.getByRole("dialog", { name: "Keys" }).waitFor();
  await page.keyboard.press("Escape");
  await page.locator("dialog").waitFor({ state: "detached" });
});

test("it fits a tablet, and can be touched", async () => {
  const tablet = await browser.newContext({ viewport: { width: 768, height: 1024 }, hasTouch: true, isMobile: true });
  const other = await open(tablet, studio.address);
  await other.locator(".dialog").getByLabel("Close").tap();
  await other.locator(".file-button").tap();
  await other.getByPlaceholder("Find a scene, or type its path").fill("ball.hry");
  await other.locator(".file-list button").first().tap();
  await settled(other);
  const { wide, tall } = await other.evaluate(() => ({ wide: document.documentElement.scrollWidth, tall: document.documentElement.scrollHeight }));
  assert.ok(wide <= 768 && tall <= 1024, `${wide} x ${tall}`);
  await other.locator(".picture-canvas").tap();
  await other.getByRole("heading", { name: /sphere/ }).waitFor();
  for (const button of await other.locator(".bar button, .picture-tools button").all()) {
    const box = await button.boundingBox();
    if (box) assert.ok(box.height >= 26 && box.width >= 30, `${await button.getAttribute("aria-label")}: ${box.width} x ${box.height}`);
  }
  assert.deepEqual(other.wrong, []);
  await tablet.close();
});

test("the theme is chosen, and stays", async () => {
  await page.emulateMedia({ colorScheme: "light" });
  const background = () => page.evaluate(() => getComputedStyle(document.body).backgroundColor);
  const light = await background();
  await page.getByLabel("Light, dark, or as the system").click();
  const dark = await background();
  assert.notEqual(dark, light);
  await page.reload();
  await page.waitForFunction(() => document.documentElement.dataset.ready);
  assert.equal(await background(), dark);
});

test("the bundle is small", () => {
  const dist = new URL("../../dist/", import.meta.url);
  assert.ok(statSync(new URL("studio.js", dist)).size < 700_000);
});
