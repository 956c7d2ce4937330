// What the parts of the editor need to know of the page around it.

import { Facet } from "@codemirror/state";
import type { EditorView } from "@codemirror/view";
import type { Requests, Definition, Problem } from "../engine/protocol";

export interface Host {
  /** Asks the engine about the text as it stands; the document's name and version are filled in. Null where it
   * cannot answer, or where the text has changed since. */
  ask<K extends "complete" | "hover" | "definition" | "numbers" | "colors" | "present" | "format" | "rename">(
    what: K,
    more: Omit<Requests[K][0], "doc" | "version">,
  ): Promise<Requests[K][1] | null>;
  /** Shows where a name is defined. */
  goTo(definition: Definition): void;
  /** Opens the colour picker at a place of the text. */
  pickColour(view: EditorView, at: { from: number; to: number }): void;
  problems(): readonly Problem[];
  applyFix(problem: Problem, fix: number): void;
  /** Tells something in passing. */
  say(text: string): void;
}

const nobody: Host = {
  ask: () => Promise.resolve(null),
  goTo: () => undefined,
  pickColour: () => undefined,
  problems: () => [],
  applyFix: () => undefined,
  say: () => undefined,
};

/** The page, for the editor's extensions. A view without one is only looked at. */
export const host = Facet.define<Host, Host>({ combine: (all) => all[0] ?? nobody });
