// Makes the gallery's small pictures (public/examples) from the examples' own. To be run after an example was added or
// its picture changed: `npm run thumbs`.

import { mkdirSync, readdirSync, readFileSync, writeFileSync } from "node:fs";
import { fileURLToPath } from "node:url";
import { launch } from "./browser.mjs";

const examples = fileURLToPath(new URL("../../../../examples/", import.meta.url));
const out = fileURLToPath(new URL("../public/examples/", import.meta.url));
mkdirSync(out, { recursive: true });
const browser = await launch();
const page = await browser.newPage();
for (const file of readdirSync(examples).filter((name) => name.endsWith(".png"))) {
  const picture = `data:image/png;base64,${readFileSync(examples + file).toString("base64")}`;
  const small = await page.evaluate(async (source) => {
    const image = new Image();
    image.src = source;
    await image.decode();
    const width = 320;
    const height = 200;
    const canvas = document.createElement("canvas");
    canvas.width = width;
    canvas.height = height;
    const context = canvas.getContext("2d");
    context.imageSmoothingQuality = "high";
    const scale = Math.max(width / image.width, height / image.height);
    context.drawImage(image, (width - image.width * scale) / 2, (height - image.height * scale) / 2, image.width * scale, image.height * scale);
    return canvas.toDataURL("image/jpeg", 0.78).split(",")[1];
  }, picture);
  writeFileSync(out + file.replace(/\.png$/, ".jpg"), Buffer.from(small, "base64"));
}
await browser.close();
