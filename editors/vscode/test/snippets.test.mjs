// The snippets, expanded with their defaults, and what the manifest promises.

import assert from "node:assert/strict";
import { existsSync, readFileSync } from "node:fs";
import { test } from "node:test";
import { fileURLToPath } from "node:url";
import { tokenize } from "./tokens.mjs";

const folder = new URL("../", import.meta.url);
const json = (path) => JSON.parse(readFileSync(new URL(path, folder), "utf8"));

/** The text that a snippet inserts where its defaults are kept. */
function expanded(body) {
  const text = [body].flat().join("\n");
  return text
    .replace(/\$\{\d+:((?:[^}\\]|\\.)*)\}/g, "$1")
    .replace(/\$\d+/g, "")
    .replace(/\\([}$\\])/g, "$1");
}

for (const [name, { prefix, description, body }] of Object.entries(json("snippets/hry.json"))) {
  test(`the snippet ${name}`, async () => {
    assert.ok(prefix.length > 0 && description.length > 0);
    const text = expanded(body);
    const tokens = await tokenize(text);
    assert.deepEqual(tokens.filter(({ scopes }) => scopes.some((scope) => scope.startsWith("invalid"))), []);
    for (const [open, close] of ["()", "[]", "{}"]) {
      assert.equal(text.split(open).length, text.split(close).length, `${open}${close} in ${text}`);
    }
  });
}

test("the files that the manifest names exist", () => {
  const { contributes, main } = json("package.json");
  const paths = [
    main,
    ...contributes.grammars.map(({ path }) => path),
    ...contributes.snippets.map(({ path }) => path),
    ...contributes.languages.map(({ configuration }) => configuration),
  ];
  for (const path of paths) assert.ok(existsSync(fileURLToPath(new URL(path, folder))), path);
});

test("every command has a handler", () => {
  const source = ["extension", "render"].map((name) => readFileSync(new URL(`src/${name}.ts`, folder), "utf8")).join();
  for (const { command } of json("package.json").contributes.commands) {
    assert.ok(source.includes(`registerCommand("${command}"`), command);
  }
});

test("the patterns of the language configuration compile", () => {
  const { wordPattern, indentationRules, onEnterRules } = json("language-configuration.json");
  const word = new RegExp(wordPattern, "gu");
  assert.deepEqual("été' + h.p #ff8800 40deg 1.5e-3".match(word), ["été'", "h", "p", "#ff8800", "40deg", "1.5e-3"]);
  const more = new RegExp(indentationRules.increaseIndentPattern);
  for (const line of ["scene = {", "  let x =", "  then", "f = \\x ->"]) assert.match(line, more);
  for (const line of ["-- scene = {", "x = 1", "  outlet"]) assert.doesNotMatch(line, more);
  assert.match("  ],", new RegExp(indentationRules.decreaseIndentPattern));
  for (const { beforeText, afterText } of onEnterRules) {
    assert.ok(new RegExp(beforeText) && (afterText === undefined || new RegExp(afterText)));
  }
});
