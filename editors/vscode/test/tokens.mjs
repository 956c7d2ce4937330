// Tokens as the editor sees them: vscode-textmate with the same regular expression engine.

import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { fileURLToPath } from "node:url";
import oniguruma from "vscode-oniguruma";
import textmate from "vscode-textmate";

const require = createRequire(import.meta.url);
const file = (path) => readFileSync(fileURLToPath(new URL(path, import.meta.url)), "utf8");

const engine = oniguruma
  .loadWASM(readFileSync(require.resolve("vscode-oniguruma/release/onig.wasm")))
  .then(() => ({
    createOnigScanner: (patterns) => new oniguruma.OnigScanner(patterns),
    createOnigString: (text) => new oniguruma.OnigString(text),
  }));

const GRAMMARS = {
  "source.hry": "../syntaxes/hry.tmLanguage.json",
  "markdown.hry.codeblock": "../syntaxes/markdown.tmLanguage.json",
  // Stands for the editor's own grammar of Markdown, which the other is injected into.
  "text.html.markdown": null,
};

const registry = new textmate.Registry({
  onigLib: engine,
  loadGrammar: async (scope) => {
    const path = GRAMMARS[scope];
    if (path === null) return { scopeName: scope, patterns: [{ match: "^#.*$", name: "heading" }], repository: {} };
    return path === undefined ? null : textmate.parseRawGrammar(file(path), path);
  },
  getInjections: (scope) => (scope === "text.html.markdown" ? ["markdown.hry.codeblock"] : []),
});

/** The tokens of a text, in order: line (from 1), text, scopes. White space is left out. */
export async function tokenize(text, scope = "source.hry") {
  const grammar = await registry.loadGrammar(scope);
  const tokens = [];
  let stack = textmate.INITIAL;
  for (const [index, line] of text.split(/\r?\n/).entries()) {
    const result = grammar.tokenizeLine(line, stack);
    stack = result.ruleStack;
    for (const token of result.tokens) {
      const piece = line.slice(token.startIndex, token.endIndex);
      if (piece.trim() !== "") tokens.push({ line: index + 1, text: piece.trim(), scopes: token.scopes });
    }
  }
  return tokens;
}
