// Renders scenes with the engine as WebAssembly, and compares the pictures with those of the command to the byte:
//
//     node same.mjs FOLDER-OF-THE-PLAYGROUND PATH-TO-HRAY SCENE...
//
// Two engines share the tiles, as workers of a page do.
import { execFileSync } from "node:child_process";
import { createHash } from "node:crypto";
import { readFileSync } from "node:fs";
import { basename, join, resolve } from "node:path";
import { pathToFileURL } from "node:url";

const [, , folder, hray, ...scenes] = process.argv;
if (scenes.length === 0) throw new Error("usage: node same.mjs FOLDER-OF-THE-PLAYGROUND PATH-TO-HRAY SCENE...");
const engine = resolve(join(folder, "engine"));
const { default: init, Engine } = await import(pathToFileURL(join(engine, "hray_playground.js")));
await init({ module_or_path: readFileSync(join(engine, "hray_playground_bg.wasm")) });

let wrong = 0;
for (const scene of scenes) {
  const doc = basename(scene);
  const text = readFileSync(scene, "utf8");
  const engines = [new Engine(2, 2000), new Engine(2, 2000)];
  const start = performance.now();
  const told = engines.map((one) => {
    one.request(JSON.stringify({ id: 1, do: "edit", doc, version: 1, text }));
    return JSON.parse(one.show(1, JSON.stringify({ doc })));
  })[0];
  const frame = told.events.find((event) => event.event === "frame");
  if (!frame) {
    console.error(`${doc}: ${JSON.stringify(told.events[0])}`);
    wrong += 1;
    continue;
  }
  const { width, height } = frame;
  const rgb = Buffer.alloc(3 * width * height);
  const last = told.tiles.length - 1;
  for (let index = 0; index < told.tiles[last]; index += 1) {
    const message = Buffer.from(engines[index % 2].tile(last, index));
    const [x, y, w, h] = [8, 12, 16, 20].map((at) => message.readUInt32LE(at));
    for (let sample = 0; sample < w * h; sample += 1) {
      const to = 3 * ((y + Math.floor(sample / w)) * width + x + (sample % w));
      message.copy(rgb, to, 28 + 4 * sample, 31 + 4 * sample);
    }
  }
  const seconds = ((performance.now() - start) / 1000).toFixed(2);
  const hash = (bytes) => createHash("sha256").update(bytes).digest("hex");
  const found = hash(Buffer.concat([Buffer.from(`P6\n${width} ${height}\n255\n`), rgb]));
  const most = { maxBuffer: 1 << 30, stdio: ["ignore", "pipe", "ignore"] };
  const expected = hash(execFileSync(hray, ["render", scene, "-o", "-", "--format", "ppm"], most));
  const same = found === expected;
  console.log(`${same ? "same" : "DIFFERENT"}  ${doc}  ${width}x${height}  ${seconds} s`);
  if (!same) wrong += 1;
  engines.forEach((one) => one.free());
}
process.exit(wrong === 0 ? 0 : 1);
