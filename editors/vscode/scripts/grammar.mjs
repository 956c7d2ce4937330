// Writes syntaxes/hry.tmLanguage.json: the lexical grammar of hry and of the scenes of 2005.
//
// It is written here and not in the JSON because its patterns are made of named parts, and because the names of the
// library come from the program's own tables.

import { writeFileSync } from "node:fs";
import { fileURLToPath } from "node:url";
import { library } from "./library.mjs";

const CONTINUES = "[\\p{L}\\p{N}\\p{M}_']";
const NAME = `[\\p{Ll}\\p{Lo}\\p{Lm}_]${CONTINUES}*+`;
const TYPE = `[\\p{Lu}\\p{Lt}]${CONTINUES}*+`;
const STARTS = `(?<!${CONTINUES})`;
const ENDS = `(?!${CONTINUES})`;
/** A parameter: a name, or something in brackets. */
const PARAMETER = `(?:\\s+${NAME}|\\s*\\([^()=]*\\)|\\s*\\{[^{}]*\\}|\\s*\\[[^\\[\\]=]*\\])`;
/** The `=` of a definition, which is not `==`. */
const DEFINES = "=(?![=>])";
/** Where a `let` without an `in` ends: at what closes or separates around it. */
const CLOSES = "(?=[\\]\\)\\},])";

const words = (list) => `${STARTS}(?:${list.join("|")})${ENDS}`;
const rule = (name, match) => ({ name: `${name}.hry`, match });
const include = (...names) => names.map((name) => ({ include: `#${name}` }));
const captures = (...names) =>
  Object.fromEntries(names.flatMap((name, at) => (name ? [[`${at + 1}`, { name: `${name}.hry` }]] : [])));

/** Whatever is in brackets. */
const bracketed = (kind, open, close, patterns) => ({
  name: `meta.${kind}.hry`,
  begin: open,
  beginCaptures: { 0: { name: `punctuation.section.${kind}.begin.hry` } },
  end: close,
  endCaptures: { 0: { name: `punctuation.section.${kind}.end.hry` } },
  patterns,
});

const CLASSIC_SECTIONS = ["renderDescr", "resolution", "scene", "camera", "background", "objects", "lights"];
const CLASSIC_ELEMENTS = ["object", "sphere", "plane", "texture", "pointLight", "ambientLight"];
const CLASSIC_TEXTURES = [
  "perlinMarbleBase", "perlinSemiTurb", "perlinMarble", "perlinPlasma", "perlinSolid", "perlinTurb", "perlinFire",
  "perlinWood", "perlin", "diff", "solid",
];

export function grammar() {
  const { constructors, functions, values } = library();
  return {
    $schema: "https://raw.githubusercontent.com/martinring/tmlanguage/master/tmlanguage.json",
    name: "hry",
    scopeName: "source.hry",
    fileTypes: ["hry"],
    // A file whose first word is `renderDescr` is classic; the first other thing makes it hry, to its end.
    patterns: [...include("comments"), ...include("classic", "hry")],
    repository: {
      hry: { begin: "(?=[^\\s\\x{FEFF}])", end: "(?!)", patterns: include("definitions", "expression") },

      comments: {
        patterns: [
          {
            name: "comment.block.hry",
            begin: "\\{-",
            beginCaptures: { 0: { name: "punctuation.definition.comment.begin.hry" } },
            end: "-\\}",
            endCaptures: { 0: { name: "punctuation.definition.comment.end.hry" } },
            patterns: include("nested-comment"),
          },
          {
            name: "comment.line.double-dash.documentation.hry",
            begin: "--\\|",
            beginCaptures: { 0: { name: "punctuation.definition.comment.hry" } },
            end: "$",
            patterns: [{ name: "markup.inline.raw.hry", match: "`[^`]*`" }],
          },
          {
            name: "comment.line.double-dash.hry",
            match: "(--).*$",
            captures: captures("punctuation.definition.comment"),
          },
        ],
      },
      "nested-comment": { begin: "\\{-", end: "-\\}", patterns: include("nested-comment") },

      definitions: { patterns: include("annotation", "function-definition", "value-definition") },
      import: {
        match: `${STARTS}(?:(import)|(as)(?:\\s+(${NAME}))?)${ENDS}`,
        captures: captures("keyword.control.import", "keyword.control.import", "entity.name.namespace"),
      },
      annotation: {
        name: "meta.type.annotation.hry",
        begin: `^(\\s*)(${NAME})\\s*(:)(?!:)`,
        beginCaptures: captures(null, "entity.name.function", "punctuation.separator.annotation"),
        // The layout rule: up to a line that starts at or left of the name.
        end: "^(?!\\1[ \\t]|\\s*$)",
        patterns: include("comments", "type"),
      },
      "function-definition": {
        begin: `(?:^|(?<=\\blet)(?=\\s))\\s*(?!${words(["let", "in", "if", "then", "else", "match", "not", "import"])})(${NAME})(?=${PARAMETER}+\\s*${DEFINES})`,
        beginCaptures: captures("entity.name.function"),
        end: DEFINES,
        endCaptures: { 0: { name: "keyword.operator.definition.hry" } },
        patterns: include("pattern"),
      },
      "value-definition": {
        match: `(?:^|(?<=\\blet)(?=\\s))\\s*(${NAME})\\s*(${DEFINES})`,
        captures: captures("variable.other.constant", "keyword.operator.definition"),
      },

      expression: {
        patterns: include(
          "comments", "text", "color", "number", "let", "lambda", "import", "keywords", "brackets", "field", "library",
          "types", "names", "operators", "illegal",
        ),
      },

      text: {
        name: "string.quoted.double.hry",
        begin: '"',
        beginCaptures: { 0: { name: "punctuation.definition.string.begin.hry" } },
        end: '(")|((?:[^"\\\\\\n]|\\\\.)?$)',
        endCaptures: captures("punctuation.definition.string.end", "invalid.illegal.unclosed"),
        patterns: [
          rule("constant.character.escape", '\\\\[nt"\\\\]'),
          rule("invalid.illegal.escape", "\\\\."),
        ],
      },
      color: {
        patterns: [
          {
            name: "constant.other.color.rgb-value.hry",
            match: `(#)(?:[0-9a-fA-F]{6}|[0-9a-fA-F]{3})${ENDS}`,
            captures: captures("punctuation.definition.constant"),
          },
          rule("invalid.illegal.color", `#${CONTINUES}*`),
        ],
      },
      number: {
        patterns: [
          {
            name: "constant.numeric.hry",
            match: `${STARTS}[0-9][0-9_]*+(?:\\.[0-9][0-9_]*+)?(?:[eE][+-]?[0-9][0-9_]*+)?(?:(deg)${ENDS}|(%)(?![\\p{L}\\p{N}_(])|${ENDS}(?!%))`,
            captures: captures("keyword.other.unit", "keyword.other.unit"),
          },
          rule("invalid.illegal.number", `${STARTS}[0-9]${CONTINUES}*+%?`),
        ],
      },

      let: {
        name: "meta.let.hry",
        begin: `${STARTS}(let)${ENDS}`,
        beginCaptures: captures("keyword.control.let"),
        end: `${STARTS}(in)${ENDS}|${CLOSES}`,
        endCaptures: captures("keyword.control.let"),
        patterns: [
          ...include("definitions"),
          rule("keyword.operator.definition", DEFINES),
          ...include("expression"),
        ],
      },
      lambda: {
        begin: "\\\\",
        beginCaptures: { 0: { name: "keyword.operator.lambda.hry" } },
        end: "(->)|(?=[\\])}])|$",
        endCaptures: captures("keyword.operator.arrow"),
        patterns: include("pattern"),
      },
      keywords: {
        patterns: [
          rule("keyword.control.conditional", words(["if", "then", "else", "match"])),
          rule("keyword.control.let", words(["in"])),
          rule("keyword.operator.logical", words(["and", "or", "not"])),
          rule("constant.language.boolean", words(["true", "false"])),
        ],
      },
      brackets: {
        patterns: [
          bracketed("parens", "\\(", "\\)", include("expression")),
          bracketed("list", "\\[", "\\]", include("expression")),
          bracketed("record", "\\{", "\\}", [
            {
              match: `${STARTS}(${NAME})\\s*(${DEFINES})`,
              captures: captures("variable.other.property", "keyword.operator.definition"),
            },
            ...include("expression"),
          ]),
        ],
      },
      field: {
        match: `(?<=[\\p{L}\\p{N}\\p{M}_')\\]}])(\\.)(${NAME}|${TYPE})`,
        captures: captures("punctuation.accessor", "variable.other.property"),
      },

      library: {
        patterns: [
          rule("support.class.constructor", words(constructors)),
          rule("support.function", words(functions)),
          rule("support.constant", words(values)),
        ],
      },
      types: {
        patterns: [
          rule(
            "support.type",
            words([
              "Number", "Bool", "Text", "Vec2", "Vec3", "Color", "Shape", "Material", "Light", "Camera", "Image", "Hit",
              "Integrator", "Encoding",
            ]),
          ),
          rule("entity.name.type", `${STARTS}${TYPE}`),
        ],
      },
      type: {
        patterns: [
          ...include("types"),
          bracketed("record-type", "\\{", "\\}", [
            {
              match: `${STARTS}(${NAME})\\s*(:)`,
              captures: captures("variable.other.property", "punctuation.separator.annotation"),
            },
            ...include("comments", "type"),
          ]),
          rule("support.type.variable", words(["(?:numeric|vector|placeable|appendable)[0-9]*+"])),
          rule("variable.other.type", `${STARTS}${NAME}`),
          ...include("operators"),
          rule("punctuation.section.brackets", "[()\\[\\]]"),
          ...include("illegal"),
        ],
      },
      names: {
        patterns: [
          rule("variable.language.wildcard", words(["_"])),
          rule("variable.other", `${STARTS}${NAME}`),
        ],
      },
      pattern: {
        patterns: [
          ...include("comments", "text", "number"),
          rule("constant.language.boolean", words(["true", "false"])),
          rule("variable.language.wildcard", words(["_"])),
          {
            match: `${STARTS}(${NAME})\\s*(${DEFINES})(?=[^{}]*\\})`,
            captures: captures("variable.other.property", "keyword.operator.definition"),
          },
          bracketed("record-pattern", "\\{", "\\}", [
            {
              match: `${STARTS}(${NAME})\\s*(${DEFINES})`,
              captures: captures("variable.other.property", "keyword.operator.definition"),
            },
            ...include("pattern"),
          ]),
          rule("variable.parameter", `${STARTS}${NAME}`),
          rule("punctuation.separator.comma", ","),
          rule("keyword.operator.range", "\\.\\."),
          rule("punctuation.section.brackets", "[()\\[\\]]"),
        ],
      },

      operators: {
        patterns: [
          rule("keyword.operator.pipe", "\\|>|>>"),
          rule("keyword.operator.arrow", "->|<-"),
          rule("keyword.operator.range", "\\.\\."),
          rule("keyword.operator.comparison", "==|!=|<=|>=|<|>"),
          rule("keyword.operator.append", "\\+\\+"),
          rule("keyword.operator.arithmetic", "[-+*/%^]"),
          rule("keyword.operator.definition", DEFINES),
          rule("punctuation.separator.bar", "\\|"),
          rule("punctuation.separator.comma", ","),
          rule("punctuation.separator.annotation", ":"),
          rule("punctuation.accessor", "\\."),
        ],
      },
      illegal: { patterns: [rule("invalid.illegal.character", "[^\\s\\p{L}\\p{N}\\p{M}\\x{FEFF}\\])}]")] },

      classic: {
        name: "meta.classic.hry",
        begin: `${STARTS}(renderDescr)${ENDS}`,
        beginCaptures: captures("keyword.control.section.classic"),
        end: "(?!)",
        patterns: [
          rule("keyword.control.section.classic", words(CLASSIC_SECTIONS)),
          rule("support.class.classic", words(CLASSIC_ELEMENTS)),
          rule("support.function.texture.classic", words(CLASSIC_TEXTURES)),
          rule("constant.numeric.classic", `${STARTS}-?[0-9]+(?:\\.[0-9]+)?${ENDS}`),
          rule("punctuation.section.brackets", "[()\\[\\]{}]"),
          rule("punctuation.separator.comma", ","),
          rule("invalid.illegal.word", `[^\\s()\\[\\]{},]+`),
        ],
      },
    },
  };
}

export const path = fileURLToPath(new URL("../syntaxes/hry.tmLanguage.json", import.meta.url));
export const text = () => `${JSON.stringify(grammar(), null, 2)}\n`;

if (process.argv[1] === fileURLToPath(import.meta.url)) {
  writeFileSync(path, text());
}
