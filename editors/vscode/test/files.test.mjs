// The grammar over every scene of the repository.

import assert from "node:assert/strict";
import { existsSync, readdirSync, readFileSync } from "node:fs";
import { join, relative } from "node:path";
import { test } from "node:test";
import { fileURLToPath } from "node:url";
import { path as grammarPath, text as grammarText } from "../scripts/grammar.mjs";
import { library } from "../scripts/library.mjs";
import { tokenize } from "./tokens.mjs";

const repository = fileURLToPath(new URL("../../../", import.meta.url));
const folders = ["examples", "crates/hray-lang/std", "docs"].map((folder) => join(repository, folder));

function scenes(folder) {
  if (!existsSync(folder)) return [];
  const entries = readdirSync(folder, { withFileTypes: true, recursive: true });
  return entries
    .filter((entry) => entry.isFile() && entry.name.endsWith(".hry"))
    .map((entry) => join(entry.parentPath ?? entry.path, entry.name))
    .sort();
}

const files = folders.flatMap(scenes);

test("there are scenes to look at", () => {
  assert.ok(files.length >= 10, `${files.length} files`);
});

for (const file of files) {
  test(`nothing in ${relative(repository, file)} is invalid`, async () => {
    const tokens = await tokenize(readFileSync(file, "utf8"));
    const bad = tokens.filter(({ scopes }) => scopes.some((scope) => scope.startsWith("invalid")));
    assert.deepEqual(bad, []);
    // Every token but stray white space has a scope of its own.
    const bare = tokens.filter(({ scopes }) => scopes.length < 2);
    assert.deepEqual(bare, []);
  });
}

test("every definition of the library is highlighted as one", async () => {
  const names = new Set();
  for (const file of scenes(join(repository, "crates/hray-lang/std"))) {
    const text = readFileSync(file, "utf8");
    const tokens = await tokenize(text);
    const found = tokens.filter(({ scopes }) =>
      scopes.some((scope) => scope === "entity.name.function.hry" || scope === "variable.other.constant.hry"),
    );
    const defined = [...text.matchAll(/^([a-z_][\w']*)[^\n=:]*=/gm)].map((match) => match[1]);
    for (const name of defined) {
      assert.ok(found.some((token) => token.text === name), `${name} in ${file}`);
      names.add(name);
    }
  }
  assert.ok(names.size > 50);
});

test("the grammar is what scripts/grammar.mjs writes; `npm run grammar` brings it up to date", () => {
  assert.equal(readFileSync(grammarPath, "utf8"), grammarText());
});

test("the library's names are found", () => {
  const { constructors, functions, values } = library();
  for (const name of ["sphere", "classic", "perspective"]) assert.ok(constructors.includes(name), name);
  for (const name of ["sin", "fold", "checker", "smoothstep", "rotate"]) assert.ok(functions.includes(name), name);
  for (const name of ["pi", "gold", "whitted", "srgb"]) assert.ok(values.includes(name), name);
});
