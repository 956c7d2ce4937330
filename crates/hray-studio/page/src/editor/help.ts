// Help while typing: completion, documentation under the pointer, definitions, fixes.

import { autocompletion, snippet, type Completion, type CompletionContext, type CompletionResult } from "@codemirror/autocomplete";
import { forEachDiagnostic } from "@codemirror/lint";
import { EditorView, hoverTooltip, type Command } from "@codemirror/view";
import { h } from "../dom";
import type { CompletionItem } from "../engine/protocol";
import { markdown } from "../markdown";
import { css } from "./colours";
import { codeBlock } from "./highlight";
import { host } from "./host";

const completionTypes: Record<string, string> = {
  function: "function",
  constructor: "class",
  value: "constant",
  local: "variable",
  field: "property",
  keyword: "keyword",
  file: "text",
  type: "type",
};

/** A snippet of the Language Server Protocol in the editor's form: numbered fields, the last place `$0`. */
export function snippetFor(source: string): string {
  return source
    .replace(/\\([$}\\])/g, (_, character: string) => (character === "}" ? "\\}" : character))
    .replace(/\$(\d+)/g, (_, place: string) => `\${${place === "0" ? "" : place}}`)
    .replace(/\$\{0(?::[^}]*)?\}/g, "${}");
}

function completionOf(item: CompletionItem): Completion {
  const completion: Completion = { label: item.label };
  const type = completionTypes[item.kind];
  if (type) completion.type = type;
  if (item.detail) completion.detail = item.detail;
  const documentation = item.documentation;
  if (documentation) completion.info = () => markdown(documentation, codeBlock);
  const text = item.insert ?? item.label;
  completion.apply = item.snippet ? snippet(snippetFor(item.snippet)) : text;
  return completion;
}

async function complete(context: CompletionContext): Promise<CompletionResult | null> {
  const view = context.view;
  if (!view) return null;
  const before = context.matchBefore(/[\p{L}_][\p{L}\p{N}_']*|[.{(,"|>]\s?/u);
  if (!context.explicit && !before) return null;
  const answer = await view.state.facet(host).ask("complete", { at: context.pos });
  if (!answer || context.aborted || answer.items.length === 0) return null;
  // Where nothing has been typed yet, a list that opens by itself would be in the way, but for the fields of a record.
  if (!context.explicit && answer.from === context.pos && !answer.items.some((item) => item.kind === "field" || item.kind === "file")) return null;
  return {
    from: answer.from,
    to: answer.to,
    options: answer.items.map(completionOf),
    validFor: /^[\p{L}\p{N}_']*$/u,
  };
}

const hover = hoverTooltip(
  async (view, position) => {
    const answer = await view.state.facet(host).ask("hover", { at: position });
    if (!answer) return null;
    return {
      pos: answer.from,
      end: answer.to,
      above: true,
      create: () => {
        const dom = h("div", { class: "hover" });
        if (answer.code) {
          const head = h("div", { class: "hover-code" }, codeBlock(answer.code));
          if (answer.color) {
            const swatch = h("span", { class: "hover-swatch" });
            swatch.style.backgroundColor = css(answer.color);
            head.prepend(swatch);
          }
          dom.append(head);
        }
        if (answer.text) dom.append(markdown(answer.text, codeBlock));
        return { dom };
      },
    };
  },
  { hoverTime: 350 },
);

/** Goes where the name at the cursor is defined. */
export const goToDefinition: Command = (view) => {
  void define(view, view.state.selection.main.head);
  return true;
};

async function define(view: EditorView, at: number): Promise<void> {
  const page = view.state.facet(host);
  const answer = await page.ask("definition", { at });
  if (answer) page.goTo(answer);
  else page.say("No definition is known for what is here.");
}

const clickDefinition = EditorView.domEventHandlers({
  mousedown(event, view) {
    if (event.button !== 0 || !(event.ctrlKey || event.metaKey)) return false;
    const at = view.posAtCoords(event);
    if (at === null) return false;
    event.preventDefault();
    void define(view, at);
    return true;
  },
});

/** Takes the first fix of the problem at the cursor, or of the nearest on its line. */
export const takeFix: Command = (view) => {
  const page = view.state.facet(host);
  const { head } = view.state.selection.main;
  const line = view.state.doc.lineAt(head);
  let best: { distance: number; apply: () => void } | null = null;
  forEachDiagnostic(view.state, (diagnostic, from, to) => {
    const action = diagnostic.actions?.[0];
    if (!action || to < line.from || from > line.to) return;
    const distance = head < from ? from - head : head > to ? head - to : 0;
    if (!best || distance < best.distance) best = { distance, apply: () => action.apply(view, from, to) };
  });
  const found = best as { distance: number; apply: () => void } | null;
  if (found) found.apply();
  else page.say("No fix is known for this line.");
  return true;
};

export const helpWhileTyping = [
  autocompletion({ override: [complete], icons: true, activateOnTypingDelay: 60, interactionDelay: 40 }),
  hover,
  clickDefinition,
];
