// Makes the pictures of the README and the book: the studio in both themes, and a short animation of typing and the
// picture following. `npm run pictures`.

import { mkdirSync, writeFileSync } from "node:fs";
import { fileURLToPath } from "node:url";
import gifenc from "gifenc";
import { launch } from "./browser.mjs";
import { clickPixel, folder, open, openFile, serve, settled } from "./studio.mjs";

const out = fileURLToPath(new URL("../../../../docs/src/images/", import.meta.url));
mkdirSync(out, { recursive: true });
const scenes = folder();
const studio = await serve(scenes.path);
const browser = await launch();

for (const [scheme, name] of [["light", "studio.png"], ["dark", "studio-dark.png"]]) {
  const context = await browser.newContext({ viewport: { width: 1280, height: 720 }, colorScheme: scheme });
  const page = await open(context, studio.address);
  await page.keyboard.press("Escape");
  await openFile(page, "cradle.hry");
  await settled(page, 300_000);
  await clickPixel(page, 300, 320);
  await page.locator(".rays").first().waitFor();
  await page.waitForTimeout(400);
  await page.screenshot({ path: out + name });
  await context.close();
}

// The animation.
const size = { width: 1120, height: 600 };
const context = await browser.newContext({ viewport: size, colorScheme: "light" });
const page = await open(context, studio.address);
await page.locator('.card[data-example=""]').click();
await settled(page, 300_000);
await page.getByLabel("Unfold").click();
await page.getByLabel("Fold away").click();
const frames = [];
const shoot = async (delay) => {
  const shot = await page.screenshot();
  frames.push({ delay, picture: shot.toString("base64") });
};
const place = (what, end = true) =>
  page.evaluate(
    ([text, after]) => {
      const at = window.hray.editor.text.indexOf(text) + (after ? text.length : 0);
      window.hray.editor.select(at, at);
    },
    [what, end],
  );
await place("[ground, ball");
await shoot(900);
for (const part of [", ball", " |> tr", "anslate ", "(-2.2,", " 0, -1)"]) {
  await page.keyboard.insertText(part);
  await page.waitForTimeout(250);
  await shoot(220);
}
await settled(page, 300_000);
await shoot(900);
await place("radius = 1.0");
await page.keyboard.press("ArrowLeft");
for (let step = 0; step < 4; step++) {
  await page.keyboard.press("Alt+ArrowDown");
  await settled(page, 300_000);
  await shoot(step === 3 ? 900 : 130);
}
await page.locator(".cm-swatch").first().click();
await page.getByLabel("Hue").waitFor();
for (const hue of [14, 40, 70, 110, 150, 180, 200]) {
  await page.getByLabel("Hue").fill(String(hue));
  await page.waitForTimeout(60);
  await settled(page, 300_000);
  await shoot(hue === 200 ? 800 : 140);
}
await page.keyboard.press("Escape");
await shoot(1600);

/** The pixels of a PNG, by the browser. */
const pixels = (picture) =>
  page.evaluate(async (source) => {
    const image = new Image();
    image.src = `data:image/png;base64,${source}`;
    await image.decode();
    const canvas = new OffscreenCanvas(image.width, image.height);
    const context2d = canvas.getContext("2d");
    context2d.drawImage(image, 0, 0);
    const bytes = context2d.getImageData(0, 0, image.width, image.height).data;
    let text = "";
    for (let at = 0; at < bytes.length; at += 32768) text += String.fromCharCode(...bytes.subarray(at, at + 32768));
    return btoa(text);
  }, picture);

const { GIFEncoder, quantize, applyPalette } = gifenc;
const gif = GIFEncoder();
let before = null;
for (const { delay, picture } of frames) {
  const rgba = new Uint8ClampedArray(Buffer.from(await pixels(picture), "base64"));
  const palette = quantize(rgba, 127);
  const index = applyPalette(rgba, palette);
  // What did not change is left as it was.
  const none = palette.length;
  if (before) for (let at = 0; at < index.length; at++) if ([0, 1, 2].every((part) => rgba[at * 4 + part] === before[at * 4 + part])) index[at] = none;
  gif.writeFrame(index, size.width, size.height, { palette: [...palette, [0, 0, 0]], delay, transparent: before !== null, transparentIndex: none, dispose: 1 });
  before = rgba;
}
gif.finish();
writeFileSync(out + "studio.gif", gif.bytes());

await browser.close();
await studio.stop();
scenes.remove();
