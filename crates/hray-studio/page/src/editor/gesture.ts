// A place in the text that is changed many times while a number is dragged or a colour chosen, and counts as one change.

import { isolateHistory } from "@codemirror/commands";
import { StateEffect, StateField, Transaction } from "@codemirror/state";
import type { EditorView } from "@codemirror/view";

interface Held {
  from: number;
  to: number;
  by: Gesture;
}

const hold = StateEffect.define<Held | null>();

/** Where the place is by now, whatever else is changed meanwhile. */
export const heldPlace = StateField.define<Held | null>({
  create: () => null,
  update(value, transaction) {
    for (const effect of transaction.effects) if (effect.is(hold)) return effect.value;
    if (!value || !transaction.docChanged) return value;
    const { changes } = transaction;
    return { from: changes.mapPos(value.from, -1), to: changes.mapPos(value.to, 1), by: value.by };
  },
});

export class Gesture {
  private readonly before: string;

  constructor(
    private readonly view: EditorView,
    from: number,
    to: number,
  ) {
    this.before = view.state.sliceDoc(from, to);
    view.dispatch({ effects: hold.of({ from, to, by: this }) });
  }

  /** Null once another document is shown, or something else is held. */
  get span(): { from: number; to: number } | null {
    const held = this.view.state.field(heldPlace, false);
    return held?.by === this ? held : null;
  }

  set(text: string): void {
    const { span, view } = this;
    if (!span || view.state.sliceDoc(span.from, span.to) === text) return;
    view.dispatch({
      changes: { from: span.from, to: span.to, insert: text },
      selection: { anchor: span.from, head: span.from + text.length },
      annotations: Transaction.addToHistory.of(false),
    });
  }

  /** Ends it: as one step that can be undone, or as if nothing had been. */
  end(keep: boolean): void {
    const { span, view } = this;
    if (!span) return;
    const now = view.state.sliceDoc(span.from, span.to);
    this.set(this.before);
    if (keep && now !== this.before) {
      const to = span.from + this.before.length;
      view.dispatch({
        changes: { from: span.from, to, insert: now },
        selection: { anchor: span.from, head: span.from + now.length },
        annotations: isolateHistory.of("full"),
        userEvent: "input.turn",
      });
    }
    view.dispatch({ effects: hold.of(null) });
  }
}
