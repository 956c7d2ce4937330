// What each kind of token is called.

import assert from "node:assert/strict";
import { test } from "node:test";
import { tokenize } from "./tokens.mjs";

/** Asserts that, in order, each of these texts is a token with that scope. */
async function expect(text, expected, grammar) {
  const tokens = await tokenize(text, grammar);
  let at = 0;
  for (const [piece, scope] of expected) {
    const found = tokens.findIndex((token, index) => index >= at && token.text === piece);
    const listing = tokens.map((token) => `${token.text}  ${token.scopes.slice(1).join(" ")}`).join("\n");
    assert.ok(found >= 0, `no token ${piece} after number ${at} of:\n${listing}`);
    const scopes = tokens[found].scopes;
    const matches = scopes.some((name) => name === scope || name === `${scope}.hry` || name.startsWith(`${scope}.`));
    assert.ok(matches, `${piece} is ${scopes.join(" ")}, not ${scope}`);
    at = found + 1;
  }
}

test("definitions, annotations and documentation", () =>
  expect(
    [
      "--| `glow t` is a colour.",
      "glow : Number -> numeric2 -> { a : Color, rest : [b] } -> Color",
      "glow t _ { a = c, rest } (x, y) = mix c gold t -- and so on",
      "plain = 3",
    ].join("\n"),
    [
      ["--|", "comment.line.double-dash.documentation"],
      ["`glow t`", "markup.inline.raw"],
      ["glow", "entity.name.function"],
      [":", "punctuation.separator.annotation"],
      ["Number", "support.type"],
      ["->", "keyword.operator.arrow"],
      ["numeric2", "support.type.variable"],
      ["a", "variable.other.property"],
      ["Color", "support.type"],
      ["b", "variable.other.type"],
      ["glow", "entity.name.function"],
      ["t", "variable.parameter"],
      ["_", "variable.language.wildcard"],
      ["a", "variable.other.property"],
      ["c", "variable.parameter"],
      ["rest", "variable.parameter"],
      ["x", "variable.parameter"],
      ["=", "keyword.operator.definition"],
      ["mix", "support.function"],
      ["c", "variable.other"],
      ["gold", "support.constant"],
      ["--", "comment.line.double-dash"],
      ["plain", "variable.other.constant"],
      ["3", "constant.numeric"],
    ],
  ));

test("an annotation over several lines ends by its layout", () =>
  expect("f :\n  { a : Number } ->\n  Hit\n\nf x = Foo y\ng = numeric", [
    ["f", "entity.name.function"],
    ["a", "variable.other.property"],
    ["Hit", "support.type"],
    ["f", "entity.name.function"],
    ["Foo", "entity.name.type"],
    ["g", "variable.other.constant"],
    ["numeric", "variable.other"],
  ]));

test("numbers, colours and texts", () =>
  expect('a = [1_000.5e-3, 40deg, 50%, 7 % 2, #f80, #FF8800, "a\\n\\"é", 1..2]', [
    ["1_000.5e-3", "constant.numeric"],
    ["40", "constant.numeric"],
    ["deg", "keyword.other.unit"],
    ["50", "constant.numeric"],
    ["%", "keyword.other.unit"],
    ["7", "constant.numeric"],
    ["%", "keyword.operator.arithmetic"],
    ["#", "punctuation.definition.constant"],
    ["f80", "constant.other.color.rgb-value"],
    ["FF8800", "constant.other.color.rgb-value"],
    ["a", "string.quoted.double"],
    ["\\n", "constant.character.escape"],
    ['\\"', "constant.character.escape"],
    ["é", "string.quoted.double"],
    ["1", "constant.numeric"],
    ["..", "keyword.operator.range"],
    ["2", "constant.numeric"],
  ]));

test("what is not of the language is marked", () =>
  expect('a = 7%2; b = #12345 + 3px ! "\\q" "open\nc = 1', [
    ["7%", "invalid.illegal.number"],
    [";", "invalid.illegal.character"],
    ["#12345", "invalid.illegal.color"],
    ["3px", "invalid.illegal.number"],
    ["!", "invalid.illegal.character"],
    ["\\q", "invalid.illegal.escape"],
    ["n", "invalid.illegal.unclosed"],
    ["c", "variable.other.constant"],
  ]));

test("comments nest", () =>
  expect("{- a {- b -} c -} x = 1 {- -- -} + y -- {-\nz = 2", [
    ["{-", "punctuation.definition.comment.begin"],
    ["c", "comment.block"],
    ["-}", "punctuation.definition.comment.end"],
    ["1", "constant.numeric"],
    ["--", "comment.block"],
    ["+", "keyword.operator.arithmetic"],
    ["y", "variable.other"],
    ["--", "comment.line.double-dash"],
    ["z", "variable.other.constant"],
  ]));

test("expressions", () =>
  expect(
    [
      "scene time =",
      "  let row = floor (h.p.y * 2)",
      "      f x = x ^ 2",
      "  in sphere {",
      "    center = (0, -1, p.xz) |> g >> \\a { b } -> a,",
      "    material = { m | color = if not even row and true then rgb 1 0 0 else match n { 0 -> red, _ -> c } },",
      "  }",
      "spheres = [f i' | i' <- [0 .. 9], let k = i', k != 2, k <= 3]",
    ].join("\n"),
    [
      ["scene", "entity.name.function"],
      ["time", "variable.parameter"],
      ["let", "keyword.control.let"],
      ["row", "variable.other.constant"],
      ["floor", "support.function"],
      ["h", "variable.other"],
      [".", "punctuation.accessor"],
      ["p", "variable.other.property"],
      ["y", "variable.other.property"],
      ["*", "keyword.operator.arithmetic"],
      ["f", "entity.name.function"],
      ["x", "variable.parameter"],
      ["in", "keyword.control.let"],
      ["sphere", "support.class.constructor"],
      ["center", "variable.other.property"],
      ["xz", "variable.other.property"],
      ["|>", "keyword.operator.pipe"],
      [">>", "keyword.operator.pipe"],
      ["\\", "keyword.operator.lambda"],
      ["a", "variable.parameter"],
      ["b", "variable.parameter"],
      ["->", "keyword.operator.arrow"],
      ["a", "variable.other"],
      ["material", "variable.other.property"],
      ["|", "punctuation.separator.bar"],
      ["color", "variable.other.property"],
      ["if", "keyword.control.conditional"],
      ["not", "keyword.operator.logical"],
      ["true", "constant.language.boolean"],
      ["rgb", "support.function"],
      ["match", "keyword.control.conditional"],
      ["red", "support.constant"],
      ["_", "variable.language.wildcard"],
      ["}", "punctuation.section.record.end"],
      ["spheres", "variable.other.constant"],
      ["i'", "variable.other"],
      ["<-", "keyword.operator.arrow"],
      ["..", "keyword.operator.range"],
      ["let", "keyword.control.let"],
      ["k", "variable.other.constant"],
      ["!=", "keyword.operator.comparison"],
      ["<=", "keyword.operator.comparison"],
    ],
  ));

test("imports", () =>
  expect('import "palette.hry" (gold, ink)\nimport "p.hry" as p\nx = p.gold', [
    ["import", "keyword.control.import"],
    ["palette.hry", "string.quoted.double"],
    ["import", "keyword.control.import"],
    ["as", "keyword.control.import"],
    ["p", "entity.name.namespace"],
    ["x", "variable.other.constant"],
    ["gold", "variable.other.property"],
  ]));

test("a file that begins with renderDescr is classic, whatever is before it", async () => {
  await expect("\n-- old\n  renderDescr ( resolution (8,6) ) 1 [ scene { camera (0.0,0.0,-150.0) (100,75) } sphere sin ]", [
    ["renderDescr", "keyword.control.section.classic"],
    ["resolution", "keyword.control.section.classic"],
    ["8", "constant.numeric.classic"],
    ["camera", "keyword.control.section.classic"],
    ["-150.0", "constant.numeric.classic"],
    ["sphere", "support.class.classic"],
    ["sin", "invalid.illegal.word"],
  ]);
  await expect("x = renderDescr sin", [
    ["x", "variable.other.constant"],
    ["renderDescr", "variable.other"],
    ["sin", "support.function"],
  ]);
});

test("a block of hry in Markdown", () =>
  expect(
    "# Spheres\n\n```hry\nx = sphere {}\n```\n# After",
    [
      ["# Spheres", "heading"],
      ["hry", "fenced_code.block.language"],
      ["x", "variable.other.constant"],
      ["sphere", "support.class.constructor"],
      ["# After", "heading"],
    ],
    "text.html.markdown",
  ));
