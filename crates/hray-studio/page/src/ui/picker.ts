// The colour picker: hue, saturation, lightness and the hexadecimal name, each of which can be used from the keyboard.

import { h } from "../dom";
import { css, hex } from "../editor/colours";
import type { Colour } from "../engine/protocol";
import { placeBy } from "./dialog";

/** Hue in degrees, saturation and value in 0..1. */
export function toHsv([r, g, b]: Colour): Colour {
  const most = Math.max(r, g, b);
  const spread = most - Math.min(r, g, b);
  let hue = 0;
  if (spread > 0) {
    if (most === r) hue = ((g - b) / spread + 6) % 6;
    else if (most === g) hue = (b - r) / spread + 2;
    else hue = (r - g) / spread + 4;
  }
  return [hue * 60, most === 0 ? 0 : spread / most, most];
}

export function fromHsv([hue, saturation, value]: Colour): Colour {
  const part = (n: number) => {
    const k = (n + hue / 60) % 6;
    return value - value * saturation * Math.max(0, Math.min(k, 4 - k, 1));
  };
  return [part(5), part(3), part(1)];
}

/** Opens the picker beside a place of the page. `choose` is called with each colour on the way. */
export function openPicker(at: DOMRect, start: Colour, choose: (color: Colour) => void, closed: () => void): void {
  document.querySelector(".picker")?.dispatchEvent(new Event("leave"));
  let hsv = toHsv(start);
  const before = document.activeElement as HTMLElement | null;
  const sliders = [
    { name: "Hue", max: 360, step: 1 },
    { name: "Saturation", max: 100, step: 1 },
    { name: "Brightness", max: 100, step: 1 },
  ].map(({ name, max, step }) => h("input", { type: "range", class: "colour-slider", min: 0, max, step, "aria-label": name }));
  const field = h("input", { class: "field hex", "aria-label": "Colour as a hexadecimal number", maxlength: 7, spellcheck: "false" });
  const sample = h("span", { class: "big-swatch" });
  const old = h("button", { type: "button", class: "big-swatch", "aria-label": "Back to the colour before", title: "Back to the colour before" });
  old.style.backgroundColor = css(start);
  const picker = h(
    "div",
    { class: "picker", role: "dialog", "aria-label": "Choose a colour" },
    h("div", { class: "picker-head" }, h("span", { class: "pair" }, old, sample), field),
    ...sliders.map((slider, index) => h("label", {}, h("span", {}, ["Hue", "Saturation", "Brightness"][index]), slider)),
  );
  const draw = (withField: boolean) => {
    const color = fromHsv(hsv);
    sample.style.backgroundColor = css(color);
    if (withField) field.value = hex(color);
    const values = [hsv[0], hsv[1] * 100, hsv[2] * 100];
    sliders.forEach((slider, index) => (slider.value = String(Math.round(values[index] ?? 0))));
    const [hue, saturation, value] = hsv;
    sliders[1]?.style.setProperty("--track", `linear-gradient(to right, ${css(fromHsv([hue, 0, value]))}, ${css(fromHsv([hue, 1, value]))})`);
    sliders[2]?.style.setProperty("--track", `linear-gradient(to right, black, ${css(fromHsv([hue, saturation, 1]))})`);
  };
  sliders[0]?.style.setProperty("--track", "linear-gradient(to right, red, yellow, lime, cyan, blue, magenta, red)");
  sliders.forEach((slider, index) =>
    slider.addEventListener("input", () => {
      hsv[index] = Number(slider.value) / (index === 0 ? 1 : 100);
      draw(true);
      choose(fromHsv(hsv));
    }),
  );
  field.addEventListener("input", () => {
    const found = /^#?([0-9a-f]{6})$/i.exec(field.value.trim());
    if (!found?.[1]) return;
    const value = parseInt(found[1], 16);
    hsv = toHsv([(value >> 16) / 255, ((value >> 8) & 255) / 255, (value & 255) / 255]);
    draw(false);
    choose(fromHsv(hsv));
  });
  old.addEventListener("click", () => {
    hsv = toHsv(start);
    draw(true);
    choose(start);
  });
  const close = (focus: boolean) => {
    if (!picker.isConnected) return;
    picker.remove();
    document.removeEventListener("pointerdown", outside, true);
    if (focus) before?.focus();
    closed();
  };
  const outside = (event: Event) => {
    if (!picker.contains(event.target as Node)) close(false);
  };
  picker.addEventListener("leave", () => close(false));
  picker.addEventListener("keydown", (event) => {
    if (event.key === "Escape" || event.key === "Enter") {
      event.preventDefault();
      event.stopPropagation();
      close(true);
    } else if (event.key === "Tab") {
      const all = [...picker.querySelectorAll<HTMLElement>("input, button")];
      const at = all.indexOf(document.activeElement as HTMLElement);
      event.preventDefault();
      all[(at + (event.shiftKey ? all.length - 1 : 1)) % all.length]?.focus();
    }
  });
  document.body.append(picker);
  draw(true);
  placeBy(picker, at);
  document.addEventListener("pointerdown", outside, true);
  sliders[0]?.focus();
}
