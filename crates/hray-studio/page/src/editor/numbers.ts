// Numbers that can be dragged, or turned by Alt with the arrow keys.

import { StateEffect, StateField, type Range } from "@codemirror/state";
import { Decoration, EditorView, type Command, type DecorationSet } from "@codemirror/view";
import { Gesture, heldPlace } from "./gesture";
import type { NumberSpot } from "../engine/protocol";

/** Pixels of the pointer's way for one step of a number. */
const PIXELS_PER_STEP = 3;
/** Pixels before a press becomes a drag. */
const SLACK = 3;

export const setNumbers = StateEffect.define<NumberSpot[]>();

interface Field {
  spots: NumberSpot[];
  marks: DecorationSet;
}

function marksOf(spots: NumberSpot[]): DecorationSet {
  const marks: Range<Decoration>[] = spots.map((spot) => Decoration.mark({ class: "cm-number-spot" }).range(spot.from, spot.to));
  return Decoration.set(marks, true);
}

/** The numbers of the text that the engine has told, carried along with changes until it tells anew. */
export const numbers = StateField.define<Field>({
  create: () => ({ spots: [], marks: Decoration.none }),
  update(field, transaction) {
    let { spots, marks } = field;
    if (transaction.docChanged) {
      spots = spots
        .map((spot) => ({ ...spot, from: transaction.changes.mapPos(spot.from, -1), to: transaction.changes.mapPos(spot.to, 1) }))
        .filter((spot) => spot.to > spot.from);
      marks = marks.map(transaction.changes);
    }
    for (const effect of transaction.effects) {
      if (effect.is(setNumbers)) {
        const length = transaction.newDoc.length;
        spots = effect.value.filter((spot) => spot.from < spot.to && spot.to <= length);
        marks = marksOf(spots);
      }
    }
    return spots === field.spots && marks === field.marks ? field : { spots, marks };
  },
  provide: (field) => EditorView.decorations.from(field, (value) => value.marks),
});

const literal = /^(-?)([0-9][0-9_]*(?:\.[0-9_]+)?)(?:[eE]([+-]?[0-9]+))?(deg|%)?$/;

/** A number of the text while it is being changed. */
export interface Grip {
  from: number;
  to: number;
  value: number;
  decimals: number;
  unit: string;
  step: number;
  min: number | null;
  max: number | null;
}

/** What can be gripped of `text` at a spot: the literal, with the sign that belongs to it. */
export function grip(text: string, spot: NumberSpot): Grip | null {
  let from = spot.from;
  if (text[from - 1] === "-" && !/[\p{L}\p{N}_'\])}]/u.test(text[from - 2] ?? "(")) from--;
  const found = literal.exec(text.slice(from, spot.to));
  if (!found) return null;
  const [, sign = "", digits = "0", exponent, unit = ""] = found;
  const plain = digits.replaceAll("_", "");
  const scale = exponent ? 10 ** Number(exponent) : 1;
  const value = Number(sign + plain) * scale;
  const inText = exponent ? 6 : (plain.split(".")[1]?.length ?? 0);
  const step = spot.step > 0 ? spot.step : 10 ** -inText;
  return { from, to: spot.to, value, decimals: Math.max(inText, decimalsOf(step)), unit, step, min: spot.min, max: spot.max };
}

function decimalsOf(step: number): number {
  for (let decimals = 0; decimals < 8; decimals++) {
    const scaled = step * 10 ** decimals;
    if (Math.abs(scaled - Math.round(scaled)) < 1e-9) return decimals;
  }
  return 8;
}

/** The literal after so many steps from where the grip began. */
export function turned(held: Grip, steps: number): string {
  const fine = steps !== 0 && Math.abs(steps) < 1;
  const decimals = fine || steps % 1 !== 0 ? held.decimals + 1 : held.decimals;
  let value = held.value + steps * held.step;
  if (held.min !== null) value = Math.max(held.min, value);
  if (held.max !== null) value = Math.min(held.max, value);
  let text = value.toFixed(decimals);
  if (Number(text) === 0) text = text.replace("-", "");
  return text + held.unit;
}

function spotAt(view: EditorView, position: number): NumberSpot | null {
  return view.state.field(numbers).spots.find((spot) => spot.from <= position && position <= spot.to) ?? null;
}

function gripAt(view: EditorView, spot: NumberSpot): Grip | null {
  const from = Math.max(0, spot.from - 2);
  const held = grip(view.state.sliceDoc(from, spot.to), { ...spot, from: spot.from - from, to: spot.to - from });
  return held && { ...held, from: held.from + from, to: held.to + from };
}

/** Drags begin on a number and go sideways; a press without a way puts the cursor there, as anywhere. */
const drag = EditorView.domEventHandlers({
  pointerdown(event, view) {
    if (event.button !== 0 || event.shiftKey || event.ctrlKey || event.metaKey || event.detail > 1) return false;
    if (!(event.target as Element).closest(".cm-number-spot") || view.state.readOnly) return false;
    const position = view.posAtCoords(event);
    const spot = position === null ? null : spotAt(view, position);
    const held = spot && gripAt(view, spot);
    if (!held || position === null) return false;
    const touch = event.pointerType !== "mouse";
    let gesture: Gesture | null = null;
    let kind: "press" | "turn" | "select" = "press";
    const move = (now: PointerEvent) => {
      const dx = now.clientX - event.clientX;
      const dy = now.clientY - event.clientY;
      if (kind === "press") {
        if (Math.abs(dx) > SLACK && Math.abs(dx) >= Math.abs(dy)) {
          kind = "turn";
          gesture = new Gesture(view, held.from, held.to);
          document.documentElement.classList.add("turning");
        } else if (Math.abs(dy) > SLACK * 2) kind = "select";
        else return;
      }
      if (kind === "select") {
        if (touch) return;
        const head = view.posAtCoords(now);
        if (head !== null) view.dispatch({ selection: { anchor: position, head } });
        return;
      }
      now.preventDefault();
      const factor = now.shiftKey ? 10 : now.altKey ? 0.1 : 1;
      const steps = Math.round(dx / PIXELS_PER_STEP) * factor;
      gesture?.set(turned(held, steps));
    };
    const end = (keep: boolean) => {
      document.removeEventListener("pointermove", move);
      document.removeEventListener("pointerup", up);
      document.removeEventListener("pointercancel", up);
      document.removeEventListener("keydown", escape, true);
      gesture?.end(keep);
      document.documentElement.classList.remove("turning");
      if (kind === "press") {
        view.focus();
        view.dispatch({ selection: { anchor: position } });
      }
    };
    const up = () => end(true);
    const escape = (pressed: KeyboardEvent) => {
      if (pressed.key !== "Escape" || kind !== "turn") return;
      pressed.preventDefault();
      pressed.stopPropagation();
      end(false);
    };
    document.addEventListener("keydown", escape, true);
    document.addEventListener("pointermove", move);
    document.addEventListener("pointerup", up);
    document.addEventListener("pointercancel", up);
    return false;
  },
  mousedown(event, view) {
    // The pointer handler has it; the editor would begin a selection.
    if (event.button !== 0 || event.shiftKey || event.ctrlKey || event.metaKey || event.detail > 1) return false;
    if (!(event.target as Element).closest(".cm-number-spot") || view.state.readOnly) return false;
    view.focus();
    return true;
  },
});

/** Turns the number at the cursor by so many steps; false where there is none, so that another command may. */
export function turnBy(steps: number): Command {
  return (view) => {
    if (view.state.readOnly) return false;
    const { head } = view.state.selection.main;
    const spot = spotAt(view, head);
    const held = spot && gripAt(view, spot);
    if (!held) return false;
    const insert = turned(held, steps);
    view.dispatch({
      changes: { from: held.from, to: held.to, insert },
      selection: { anchor: held.from, head: held.from + insert.length },
      userEvent: "input.turn",
      scrollIntoView: true,
    });
    return true;
  };
}

export const numberTools = [numbers, drag, heldPlace];
