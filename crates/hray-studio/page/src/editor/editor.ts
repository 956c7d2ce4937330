// The text pane: CodeMirror with everything the studio adds to it.

import { closeBrackets, closeBracketsKeymap, completionKeymap } from "@codemirror/autocomplete";
import { defaultKeymap, history, historyKeymap, indentWithTab } from "@codemirror/commands";
import { bracketMatching, codeFolding, foldGutter, foldKeymap, indentOnInput, indentUnit } from "@codemirror/language";
import { lintGutter, setDiagnostics, type Diagnostic } from "@codemirror/lint";
import { highlightSelectionMatches, search, searchKeymap } from "@codemirror/search";
import { Compartment, EditorState, Prec, Transaction, type Extension } from "@codemirror/state";
import {
  crosshairCursor,
  drawSelection,
  dropCursor,
  EditorView,
  highlightActiveLine,
  highlightActiveLineGutter,
  keymap,
  lineNumbers,
  rectangularSelection,
} from "@codemirror/view";
import { h } from "../dom";
import type { ColourSpot, NumberSpot, Problem, TextEdit } from "../engine/protocol";
import { colours, pickAtCursor, setColours } from "./colours";
import { goToDefinition, helpWhileTyping, takeFix } from "./help";
import { host, type Host } from "./host";
import { hryLanguage } from "./language";
import { numberTools, setNumbers, turnBy } from "./numbers";

/** What the text is shown with, wherever it cannot be changed as well. */
const appearance: Extension = [
  lineNumbers(),
  drawSelection(),
  hryLanguage(),
  indentUnit.of("  "),
  EditorState.tabSize.of(2),
  bracketMatching(),
];

/** A read-only view of a text, scrolled to a span of it. */
export function readOnlyView(parent: HTMLElement, text: string, span: { from: number; to: number }, label: string): EditorView {
  const to = Math.min(span.to, text.length);
  const from = Math.min(span.from, to);
  const view = new EditorView({
    parent,
    state: EditorState.create({
      doc: text,
      selection: { anchor: from, head: to },
      extensions: [
        appearance,
        highlightActiveLine(),
        EditorState.readOnly.of(true),
        EditorView.contentAttributes.of({ "aria-label": label, "aria-readonly": "true", tabindex: "0" }),
        keymap.of([...defaultKeymap, ...searchKeymap]),
        search({ top: true }),
      ],
    }),
  });
  view.dispatch({ effects: EditorView.scrollIntoView(from, { y: "center" }) });
  return view;
}

/** The explanation that opens over an underlined place. */
function explanationOf(problem: Problem): HTMLElement {
  const lines: HTMLElement[] = problem.notes.map((note) => h("p", { class: "note" }, note));
  if (problem.help) lines.push(h("p", { class: "advice" }, problem.help));
  return h(
    "div",
    { class: "problem-tip" },
    h("p", { class: `problem-head ${problem.severity}` }, problem.message, problem.code ? h("span", { class: "code-name" }, ` ${problem.code}`) : null),
    ...lines,
  );
}

export interface EditorEvents {
  changed(text: string, byUser: boolean): void;
  moved(position: number): void;
}

export class Editor {
  readonly view: EditorView;
  private readonly extensions: Extension;
  private readonly writable = new Compartment();
  /** While a text is put in place of another: not the user's change. */
  private replacing = false;

  constructor(parent: HTMLElement, page: Host, events: EditorEvents) {
    this.extensions = [
      host.of(page),
      Prec.high(
        keymap.of([
          { key: "Alt-ArrowUp", run: turnBy(1) },
          { key: "Alt-ArrowDown", run: turnBy(-1) },
          { key: "Shift-Alt-ArrowUp", run: turnBy(10) },
          { key: "Shift-Alt-ArrowDown", run: turnBy(-10) },
          { key: "Ctrl-Alt-ArrowUp", run: turnBy(0.1) },
          { key: "Ctrl-Alt-ArrowDown", run: turnBy(-0.1) },
          { key: "Alt-c", run: pickAtCursor },
          { key: "Mod-.", run: takeFix },
          { key: "F12", run: goToDefinition },
        ]),
      ),
      appearance,
      highlightActiveLineGutter(),
      highlightActiveLine(),
      lintGutter(),
      foldGutter({ openText: "⌄", closedText: "›" }),
      codeFolding(),
      history(),
      dropCursor(),
      EditorState.allowMultipleSelections.of(true),
      indentOnInput(),
      closeBrackets(),
      rectangularSelection(),
      crosshairCursor(),
      highlightSelectionMatches(),
      search({ top: true }),
      keymap.of([
        ...closeBracketsKeymap,
        ...defaultKeymap,
        ...searchKeymap,
        ...historyKeymap,
        ...foldKeymap,
        ...completionKeymap,
        indentWithTab,
      ]),
      helpWhileTyping,
      numberTools,
      colours,
      this.writable.of(EditorState.readOnly.of(false)),
      EditorView.contentAttributes.of({ "aria-label": "Scene text", tabindex: "0", spellcheck: "false", autocapitalize: "off", autocorrect: "off" }),
      EditorView.updateListener.of((update) => {
        if (update.docChanged) events.changed(update.state.doc.toString(), !this.replacing);
        if (update.selectionSet || update.docChanged) events.moved(update.state.selection.main.head);
      }),
    ];
    this.view = new EditorView({ parent, state: this.fresh("") });
  }

  private fresh(text: string): EditorState {
    return EditorState.create({ doc: text, extensions: this.extensions });
  }

  get text(): string {
    return this.view.state.doc.toString();
  }

  get state(): EditorState {
    return this.view.state;
  }

  /** Shows another document: as it was left, or from its text. */
  show(document: EditorState | string): void {
    this.view.setState(typeof document === "string" ? this.fresh(document) : document);
  }

  /** Makes the text another one by the smallest change, so that cursor, folds and history stay. */
  replace(text: string): void {
    const old = this.text;
    if (old === text) return;
    let from = 0;
    const least = Math.min(old.length, text.length);
    while (from < least && old[from] === text[from]) from++;
    let end = 0;
    while (end < least - from && old[old.length - 1 - end] === text[text.length - 1 - end]) end++;
    this.replacing = true;
    try {
      this.view.dispatch({ changes: { from, to: old.length - end, insert: text.slice(from, text.length - end) } });
    } finally {
      this.replacing = false;
    }
  }

  /** Makes changes that the user asked for, as one step of the history. */
  edit(edits: readonly TextEdit[]): void {
    const length = this.view.state.doc.length;
    const changes = edits
      .filter((edit) => edit.from <= edit.to && edit.to <= length)
      .map((edit) => ({ from: edit.from, to: edit.to, insert: edit.text }));
    if (changes.length === 0) return;
    this.view.dispatch({ changes, userEvent: "input.fix", annotations: Transaction.addToHistory.of(true) });
  }

  /** Puts the cursor on a span and brings it into view. */
  select(from: number, to: number, focus = true): void {
    const length = this.view.state.doc.length;
    const head = Math.min(to, length);
    const anchor = Math.min(from, head);
    this.view.dispatch({
      selection: { anchor, head },
      effects: EditorView.scrollIntoView(anchor, { y: "center" }),
      userEvent: "select",
    });
    if (focus) this.view.focus();
  }

  position(offset: number): { line: number; column: number } {
    const line = this.view.state.doc.lineAt(Math.min(Math.max(0, offset), this.view.state.doc.length));
    return { line: line.number, column: offset - line.from + 1 };
  }

  setNumbers(spots: NumberSpot[]): void {
    this.view.dispatch({ effects: setNumbers.of(spots) });
  }

  setColours(spots: ColourSpot[]): void {
    this.view.dispatch({ effects: setColours.of(spots) });
  }

  setProblems(problems: readonly Problem[], fix: (problem: Problem, index: number) => void): void {
    const length = this.view.state.doc.length;
    const diagnostics = problems.map((problem): Diagnostic => {
      const to = Math.min(problem.to, length);
      return {
        from: Math.min(problem.from, to),
        to,
        severity: problem.severity,
        message: problem.message,
        ...(problem.unnecessary ? { markClass: "cm-unnecessary" } : {}),
        renderMessage: () => explanationOf(problem),
        actions: problem.fixes.map((one, index) => ({ name: one.title, apply: () => fix(problem, index) })),
      };
    });
    this.view.dispatch(setDiagnostics(this.view.state, diagnostics));
  }
}
