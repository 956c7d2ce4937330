// A swatch before each colour of the text, which opens the picker.

import { StateEffect, StateField } from "@codemirror/state";
import { Decoration, EditorView, WidgetType, type Command, type DecorationSet } from "@codemirror/view";
import type { Colour, ColourSpot } from "../engine/protocol";
import { host } from "./host";

export const setColours = StateEffect.define<ColourSpot[]>();

/** A colour as a style sheet writes it. */
export function css(color: Colour): string {
  return `rgb(${color.map((part) => Math.round(Math.min(1, Math.max(0, part)) * 255)).join(" ")})`;
}

export function hex(color: Colour): string {
  return `#${color.map((part) => Math.round(Math.min(1, Math.max(0, part)) * 255).toString(16).padStart(2, "0")).join("")}`;
}

class Swatch extends WidgetType {
  constructor(readonly color: Colour) {
    super();
  }

  override eq(other: Swatch): boolean {
    return hex(other.color) === hex(this.color);
  }

  toDOM(view: EditorView): HTMLElement {
    const box = document.createElement("span");
    box.className = "cm-swatch";
    box.style.backgroundColor = css(this.color);
    box.title = "Choose another colour (Alt+C)";
    box.addEventListener("mousedown", (event) => {
      event.preventDefault();
      const at = view.posAtDOM(box);
      const spot = colourAt(view, at);
      if (spot) view.state.facet(host).pickColour(view, spot);
    });
    return box;
  }

  override ignoreEvent(): boolean {
    return true;
  }
}

interface Field {
  spots: ColourSpot[];
  marks: DecorationSet;
}

export const colours = StateField.define<Field>({
  create: () => ({ spots: [], marks: Decoration.none }),
  update(field, transaction) {
    let { spots, marks } = field;
    if (transaction.docChanged) {
      spots = spots
        .map((spot) => ({ ...spot, from: transaction.changes.mapPos(spot.from, 1), to: transaction.changes.mapPos(spot.to, -1) }))
        .filter((spot) => spot.to > spot.from);
      marks = marks.map(transaction.changes);
    }
    for (const effect of transaction.effects) {
      if (effect.is(setColours)) {
        const length = transaction.newDoc.length;
        spots = effect.value.filter((spot) => spot.to <= length);
        marks = Decoration.set(
          spots.map((spot) => Decoration.widget({ widget: new Swatch(spot.color), side: -1 }).range(spot.from)),
          true,
        );
      }
    }
    return spots === field.spots && marks === field.marks ? field : { spots, marks };
  },
  provide: (field) => EditorView.decorations.from(field, (value) => value.marks),
});

export function colourAt(view: EditorView, position: number): ColourSpot | null {
  return view.state.field(colours).spots.find((spot) => spot.from <= position && position <= spot.to) ?? null;
}

/** Opens the picker for the colour at the cursor, or the first one of its line. */
export const pickAtCursor: Command = (view) => {
  const { head } = view.state.selection.main;
  const line = view.state.doc.lineAt(head);
  const spot =
    colourAt(view, head) ?? view.state.field(colours).spots.find((one) => one.from >= line.from && one.to <= line.to) ?? null;
  if (!spot) {
    view.state.facet(host).say("There is no colour on this line.");
    return true;
  }
  view.state.facet(host).pickColour(view, spot);
  return true;
};
