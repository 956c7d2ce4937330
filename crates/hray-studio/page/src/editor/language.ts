// The look of a scene's text: a tokenizer for hry and for the classic language. It knows the grammar's tokens and
// the roles that a line shows by itself (what is defined, which record belongs to which constructor); what a name
// means, the engine knows.

import { HighlightStyle, LanguageSupport, StreamLanguage, syntaxHighlighting, type StringStream } from "@codemirror/language";
import { tags as t } from "@lezer/highlight";

interface State {
  /** How deep in `{- -}`. */
  comment: number;
  /** Whether this is a classic scene; null until the first word is read. */
  classic: boolean | null;
  /** Open brackets, by their opening character. */
  brackets: string[];
  /** In a type annotation, which ends with its line. */
  type: boolean;
}

const word = /^[\p{L}_][\p{L}\p{N}\p{M}_']*/u;
const number = /^[0-9][0-9_]*(?:\.[0-9][0-9_]*)?(?:[eE][+-]?[0-9][0-9_]*)?(?:deg(?![\p{L}\p{N}_'])|%(?![\p{L}\p{N}_(]))?/u;
const keywords = new Set(["let", "in", "if", "then", "else", "match", "import", "as"]);
const operators = /^(?:\|>|>>|->|<-|\.\.|==|!=|<=|>=|\+\+|[-+*/%^<>=|\\:.])/;

const sections = new Set(["renderDescr", "resolution", "scene", "camera", "background", "objects", "lights"]);
const classicConstructors = new Set(["object", "sphere", "plane", "texture", "pointLight", "ambientLight"]);

function inComment(stream: StringStream, state: State): string {
  while (!stream.eol()) {
    if (stream.match("{-")) state.comment++;
    else if (stream.match("-}")) {
      if (--state.comment === 0) break;
    } else stream.next();
  }
  return "comment";
}

function classicToken(stream: StringStream): string | null {
  if (stream.match(/^-?[0-9]+(?:\.[0-9]+)?/)) return "number";
  const found = stream.match(/^[A-Za-z][A-Za-z0-9_]*/) as RegExpMatchArray | null;
  if (found) {
    if (sections.has(found[0])) return "keyword";
    return classicConstructors.has(found[0]) ? "className" : "propertyName";
  }
  stream.next();
  return "punctuation";
}

function hryToken(stream: StringStream, state: State): string | null {
  if (stream.match("{-")) {
    state.comment = 1;
    return inComment(stream, state);
  }
  if (stream.match("--|")) {
    stream.skipToEnd();
    return "docComment";
  }
  if (stream.match("--")) {
    stream.skipToEnd();
    return "comment";
  }
  if (stream.match(/^"(?:[^"\\]|\\.)*"?/)) return "string";
  if (stream.match(/^#[0-9a-fA-F]+/)) return "color";
  if (stream.match(number)) return "number";
  const atStart = stream.column() === stream.indentation();
  const after = stream.string.charAt(stream.pos - 1);
  const found = stream.match(word) as RegExpMatchArray | null;
  if (found) {
    const name = found[0];
    if (after === "." && stream.string.charAt(stream.pos - name.length - 2) !== ".") return "propertyName";
    if (keywords.has(name)) return "keyword";
    if (name === "and" || name === "or" || name === "not") return "operatorKeyword";
    if (name === "true" || name === "false") return "atom";
    if (/^\p{Lu}/u.test(name)) return "typeName";
    const rest = stream.string.slice(stream.pos);
    if (state.type) return "typeName";
    if (state.brackets.at(-1) === "{" && /^\s*(?:=(?![=>])|:)/.test(rest)) return "propertyName";
    if (atStart && state.brackets.length === 0 && stream.indentation() === 0) {
      if (/^\s*:(?!:)/.test(rest)) state.type = true;
      return "definition";
    }
    if (/^\s*\{/.test(rest)) return "className";
    return "variableName";
  }
  if (stream.match(operators)) return "operator";
  const next = stream.next();
  if (next === "{" || next === "(" || next === "[") state.brackets.push(next);
  else if (next === "}" || next === ")" || next === "]") state.brackets.pop();
  return "punctuation";
}

const hry = StreamLanguage.define<State>({
  name: "hry",
  startState: () => ({ comment: 0, classic: null, brackets: [], type: false }),
  copyState: (state) => ({ ...state, brackets: [...state.brackets] }),
  token(stream, state) {
    if (stream.sol()) state.type = false;
    if (state.comment > 0) return inComment(stream, state);
    if (stream.eatSpace()) return null;
    if (state.classic === null && !stream.match("--", false) && !stream.match("{-", false)) {
      state.classic = Boolean(stream.match(/^\uFEFF?renderDescr\b/, false));
    }
    return state.classic ? classicToken(stream) : hryToken(stream, state);
  },
  indent(state, textAfter, context) {
    const closes = /^\s*[\])}]/.test(textAfter);
    return Math.max(0, state.brackets.length - (closes ? 1 : 0)) * context.unit;
  },
  languageData: {
    commentTokens: { line: "--", block: { open: "{-", close: "-}" } },
    closeBrackets: { brackets: ["(", "[", "{", '"'] },
    indentOnInput: /^\s*[\])}]$/,
    wordChars: "'",
  },
  tokenTable: {
    definition: t.definition(t.variableName),
    docComment: t.docComment,
    className: t.className,
    propertyName: t.propertyName,
    color: t.color,
  },
});

/** The classes of tokens; what colour each has is the style sheet's. */
export const look = HighlightStyle.define([
  { tag: t.comment, class: "tk-comment" },
  { tag: t.docComment, class: "tk-doc" },
  { tag: [t.keyword, t.operatorKeyword], class: "tk-keyword" },
  { tag: [t.number, t.color, t.atom], class: "tk-number" },
  { tag: t.string, class: "tk-string" },
  { tag: t.className, class: "tk-constructor" },
  { tag: t.propertyName, class: "tk-field" },
  { tag: t.definition(t.variableName), class: "tk-definition" },
  { tag: t.typeName, class: "tk-type" },
  { tag: [t.operator, t.punctuation], class: "tk-operator" },
]);

export function hryLanguage(): LanguageSupport {
  return new LanguageSupport(hry, syntaxHighlighting(look));
}

export { hry as hryStream };
