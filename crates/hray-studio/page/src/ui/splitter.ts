// A line between two parts that can be moved, with the pointer or from the keyboard.

import { h } from "../dom";

/** A splitter that sets a custom property of `target`: a share of its width in percent (x), its height in pixels (y). */
export function splitter(target: HTMLElement, property: string, axis: "x" | "y", name: string): HTMLElement {
  const key = `hray:size:${property}`;
  const element = h("div", {
    class: `splitter ${axis}`,
    role: "separator",
    tabindex: 0,
    "aria-label": name,
    "aria-orientation": axis === "x" ? "vertical" : "horizontal",
    "aria-valuemin": axis === "x" ? 20 : 80,
    "aria-valuemax": axis === "x" ? 80 : 600,
  });
  let value = Number(localStorage.getItem(key)) || (axis === "x" ? 48 : 220);
  const set = (wanted: number) => {
    value = axis === "x" ? Math.min(80, Math.max(20, wanted)) : Math.min(Math.max(120, innerHeight - 260), Math.max(80, wanted));
    target.style.setProperty(property, axis === "x" ? `${value}%` : `${value}px`);
    element.setAttribute("aria-valuenow", String(Math.round(value)));
  };
  const keep = () => localStorage.setItem(key, String(value));
  set(value);
  element.addEventListener("pointerdown", (event) => {
    event.preventDefault();
    element.setPointerCapture(event.pointerId);
    const move = (now: PointerEvent) => {
      if (axis === "x") {
        const box = target.getBoundingClientRect();
        set(((now.clientX - box.left) / box.width) * 100);
      } else {
        set(target.getBoundingClientRect().bottom - now.clientY);
      }
    };
    const up = () => {
      element.removeEventListener("pointermove", move);
      element.removeEventListener("pointerup", up);
      keep();
    };
    element.addEventListener("pointermove", move);
    element.addEventListener("pointerup", up);
  });
  element.addEventListener("keydown", (event) => {
    const by = { ArrowLeft: -2, ArrowRight: 2, ArrowUp: 20, ArrowDown: -20 }[event.key];
    if (by === undefined || (axis === "x") !== (event.key === "ArrowLeft" || event.key === "ArrowRight")) return;
    event.preventDefault();
    set(value + by);
    keep();
  });
  return element;
}
