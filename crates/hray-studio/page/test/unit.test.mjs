// What can be tested without a browser.

import assert from "node:assert/strict";
import { deflateRawSync } from "node:zlib";
import { readdirSync, readFileSync } from "node:fs";
import { test } from "node:test";
import { fileURLToPath } from "node:url";
import { build } from "esbuild";

const here = (path) => fileURLToPath(new URL(path, import.meta.url));

/** Compiles modules of the page and imports them. */
async function load(...names) {
  const entry = names.map((name) => `export * from ${JSON.stringify(here(`../src/${name}.ts`))};`).join("\n");
  const { outputFiles } = await build({ stdin: { contents: entry, resolveDir: here("..") }, bundle: true, write: false, format: "esm", platform: "node" });
  return import(`data:text/javascript;base64,${Buffer.from(outputFiles[0].contents).toString("base64")}`);
}

globalThis.navigator ??= { platform: "Linux", userAgent: "", vendor: "" };
const page = await load("editor/numbers", "editor/help", "editor/language", "share", "ui/open", "ui/picker", "dom");

test("a number keeps its digits, unit and sign when it is turned", () => {
  const spot = (text, from, more = {}) => ({ from, to: text.length, value: 0, unit: "", step: 0.1, min: null, max: null, ...more });
  const turned = (text, from, steps, more) => {
    const held = page.grip(text, spot(text, from, more));
    return text.slice(0, held.from) + page.turned(held, steps);
  };
  assert.equal(turned("x = 0.4", 4, 1), "x = 0.5");
  assert.equal(turned("x = 0.40", 4, 3), "x = 0.70");
  assert.equal(turned("fov = 35deg", 6, 2, { step: 1 }), "fov = 37deg");
  assert.equal(turned("f 50%", 2, -1, { step: 1 }), "f 49%");
  assert.equal(turned("(-1.5", 2, 20), "(0.5");
  assert.equal(turned("(0.1", 1, -1), "(0.0");
  assert.equal(turned("(0.1", 1, -3), "(-0.2");
  assert.equal(turned("a-1.0", 2, 1), "a-1.1", "a minus between two numbers is not the number's sign");
  assert.equal(turned("r = 0.1", 4, -9, { min: 0 }), "r = 0.0");
  assert.equal(turned("1_000", 0, 1, { step: 100 }), "1100");
});

test("a snippet of the language server becomes one of the editor", () => {
  assert.equal(page.snippetFor("sphere { radius = ${1:1}, center = ${2:(0, 0, 0)} }$0"), "sphere { radius = ${1:1}, center = ${2:(0, 0, 0)} }${}");
  assert.equal(page.snippetFor("radius = $1"), "radius = ${1}");
  assert.equal(page.snippetFor("a ${1:b \\}} c"), "a ${1:b \\}} c");
});

test("a scene survives a link", async () => {
  const text = 'ball = sphere {} -- "ä λ 🜁"\n'.repeat(40);
  const fragment = await page.encodeShare(text);
  assert.ok(fragment.length < text.length / 3);
  assert.equal(await page.decodeShare(fragment), text);
  assert.equal(await page.decodeShare("#other"), null);
  await assert.rejects(page.decodeShare("#s=AAAA"));
});

test("a link cannot unpack to more than a scene", async () => {
  const long = " ".repeat(5 * 1024 * 1024);
  await assert.rejects(page.encodeShare(long), /longer than/);
  // As somebody else might make one.
  const fragment = `#s=${deflateRawSync(long).toString("base64url")}`;
  assert.ok(fragment.length < 20_000);
  await assert.rejects(page.decodeShare(fragment), /longer than/);
});

test("paths are found by what is typed", () => {
  assert.equal(page.fits("old/still-life.hry", "old/still-life.hry"), 0);
  assert.equal(page.fits("old/still-life.hry", "still"), 1);
  assert.equal(page.fits("old/still-life.hry", "life"), 2);
  assert.equal(page.fits("old/still-life.hry", "osl"), 3);
  assert.equal(page.fits("old/still-life.hry", "xyz"), null);
});

test("colours go to hue and back", () => {
  for (const color of [[1, 0, 0], [0, 1, 0], [0.2, 0.4, 0.6], [0.5, 0.5, 0.5], [0, 0, 0], [1, 1, 1], [0.9, 0.1, 0.8]]) {
    page.fromHsv(page.toHsv(color)).forEach((part, index) => assert.ok(Math.abs(part - color[index]) < 1e-12));
  }
});

test("keys have names", () => {
  assert.equal(page.keyName("-"), "-");
  assert.match(page.keyName("Mod-s"), /S$/);
});

/** Each token of a text with its style. */
function tokens(text) {
  const found = [];
  page.hryStream.parser.parse(text).iterate({
    enter: (node) => {
      if (!node.node.firstChild && node.name !== "Document") found.push([text.slice(node.from, node.to), node.name]);
    },
  });
  return found;
}

test("the roles of a line are seen", () => {
  const seen = tokens('--| About it.\nball i = sphere { radius = 0.4, center = (i, 0, 0) } -- note\nf : Number -> Color\nback = "x"\n');
  const style = (text) => seen.find(([word]) => word === text)?.[1];
  assert.match(style("--| About it."), /docComment/);
  assert.match(style("ball"), /definition/);
  assert.match(style("sphere"), /className/);
  assert.match(style("radius"), /propertyName/);
  assert.match(style("0.4"), /number/);
  assert.match(style("-- note"), /comment/);
  assert.match(style("Color"), /typeName/);
  assert.match(style('"x"'), /string/);
});

test("every example is coloured to its end", () => {
  const examples = here("../../../../examples/");
  for (const name of readdirSync(examples).filter((file) => file.endsWith(".hry"))) {
    const text = readFileSync(examples + name, "utf8");
    const seen = tokens(text);
    assert.ok(seen.length > 20, name);
    const last = text.trimEnd().length;
    assert.ok(text.lastIndexOf(seen.at(-1)[0]) + seen.at(-1)[0].length >= last, `${name} ends uncoloured`);
  }
});

test("a classic scene has its own words", () => {
  const seen = tokens("renderDescr ( resolution (640,480) ) 3 [ scene { objects ( object ( sphere 1.0 (0.0,0.0,-1.0) ) ) } ]");
  assert.ok(seen.some(([word, style]) => word === "renderDescr" && /keyword/.test(style)));
  assert.ok(seen.some(([word, style]) => word === "sphere" && /className/.test(style)));
  assert.ok(seen.some(([word, style]) => word === "-1.0" && /number/.test(style)));
});
