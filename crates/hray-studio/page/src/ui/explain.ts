// What one pixel is made of: the object seen, the tree of rays, each light's part.

import { fill, h } from "../dom";
import { css, hex } from "../editor/colours";
import type { Colour, Explanation, LightFacts, Place, Ray } from "../engine/protocol";

export interface ExplainEvents {
  jump(place: Place): void;
}

/** Rays shown open; what is deeper opens on demand. */
const OPEN_LEVELS = 2;

function short(value: number): string {
  if (!Number.isFinite(value)) return value > 0 ? "∞" : "−∞";
  const size = Math.abs(value);
  const text = size !== 0 && (size < 0.001 || size >= 100_000) ? value.toExponential(2) : String(Number(value.toPrecision(4)));
  return text.replace("-", "−");
}

function vector(value: readonly number[]): string {
  return `(${value.map(short).join(", ")})`;
}

/** From a linear value to what a screen shows. */
function display(color: Colour): Colour {
  return color.map((part) => {
    const c = Math.min(1, Math.max(0, part));
    return c <= 0.0031308 ? c * 12.92 : 1.055 * c ** (1 / 2.4) - 0.055;
  }) as Colour;
}

export class ExplainPanel {
  readonly element = h("div", { class: "explain" });

  constructor(private readonly events: ExplainEvents) {
    this.clear();
  }

  clear(): void {
    fill(this.element, h("p", { class: "nothing" }, "Click a pixel of the picture to see what it is made of."));
  }

  waiting(x: number, y: number): void {
    fill(this.element, h("p", { class: "nothing" }, `Following the rays of pixel ${x}, ${y} …`));
  }

  failed(why: string): void {
    fill(this.element, h("p", { class: "nothing trouble" }, why));
  }

  show(explanation: Explanation): void {
    const [x, y] = explanation.pixel;
    const swatch = h("span", { class: "big-swatch" });
    swatch.style.backgroundColor = explanation.display;
    const object = explanation.object;
    fill(
      this.element,
      h(
        "div",
        { class: "explain-facts" },
        swatch,
        h(
          "div",
          {},
          h("h3", {}, object ? nameOf(object.kind, object.name) : "Background"),
          object?.place ? this.jump(object.place) : null,
          h(
            "dl",
            {},
            h("dt", {}, "Pixel"),
            h("dd", {}, `${x}, ${y}`),
            h("dt", {}, "Shown"),
            h("dd", {}, explanation.display),
            h("dt", {}, "Value"),
            h("dd", {}, vector(explanation.color)),
            ...(explanation.samples > 1 ? [h("dt", {}, "Samples"), h("dd", {}, String(explanation.samples))] : []),
          ),
        ),
      ),
      h("div", { class: "explain-rays" }, h("ul", { class: "rays", "aria-label": "Rays of this pixel" }, this.ray(explanation.root, 0))),
    );
  }

  private jump(place: Place, text?: string): HTMLElement {
    const name = text ?? `line ${place.line}`;
    return h("button", { type: "button", class: "jump", onclick: () => this.events.jump(place) }, name);
  }

  private ray(ray: Ray, level: number): HTMLElement {
    const hit = ray.hit;
    const swatch = h("span", { class: "swatch", title: hex(display(ray.color)) });
    swatch.style.backgroundColor = css(display(ray.color));
    const share = level === 0 ? null : typeof ray.weight === "number" ? ray.weight : Math.max(...ray.weight);
    const what = hit ? nameOf(hit.kind, hit.name) : "background";
    const summary = h(
      "summary",
      {},
      swatch,
      h("strong", {}, rayKind(ray.kind)),
      h("span", {}, " meets ", what),
      ray.distance !== null && Number.isFinite(ray.distance) ? h("span", { class: "quiet" }, ` after ${short(ray.distance)}`) : null,
      share !== null ? h("span", { class: "share", title: "Its share in the ray above" }, `${short(share * 100)} %`) : null,
    );
    const facts = h("div", { class: "ray-facts" });
    if (hit) {
      const base = hit.base ? h("span", { class: "swatch" }) : null;
      if (base && hit.base) base.style.backgroundColor = css(display(hit.base));
      facts.append(
        h(
          "p",
          { class: "quiet" },
          hit.place ? this.jump(hit.place) : null,
          ` at ${vector(hit.point)}, normal ${vector(hit.normal)}`,
          hit.inside ? ", from inside" : null,
          base ? ", colour " : null,
          base,
        ),
      );
    }
    if (ray.lights.length > 0) facts.append(h("ul", { class: "lights", "aria-label": "Lights" }, ...ray.lights.map((light) => this.light(light))));
    if (ray.children.length > 0) facts.append(h("ul", { class: "rays" }, ...ray.children.map((child) => this.ray(child, level + 1))));
    return h("li", {}, h("details", { open: level < OPEN_LEVELS }, summary, facts));
  }

  private light(light: LightFacts): HTMLElement {
    const swatch = h("span", { class: "swatch", title: vector(light.contribution) });
    swatch.style.backgroundColor = css(display(light.contribution));
    const shadow = light.shadowed_by;
    const seen = typeof light.visible === "number" ? light.visible : light.visible ? 1 : 0;
    const parts = Object.entries(light.parts ?? {}).filter(([, value]) => value.some((part) => part !== 0));
    return h(
      "li",
      {},
      swatch,
      light.place ? this.jump(light.place, `${light.kind} light`) : h("span", {}, `${light.kind} light`),
      shadow
        ? h("span", { class: "shadowed" }, " in the shadow of ", shadow.place ? this.jump(shadow.place, nameOf(shadow.kind, shadow.name)) : nameOf(shadow.kind, shadow.name))
        : seen === 0
          ? h("span", { class: "shadowed" }, " does not reach it")
          : h("span", { class: "quiet" }, ` adds ${vector(light.contribution)}`, seen < 1 ? ` (${short(seen * 100)} % visible)` : null),
      parts.length > 1 ? h("span", { class: "quiet parts" }, ` — ${parts.map(([name, value]) => `${name} ${short(Math.max(...value))}`).join(", ")}`) : null,
    );
  }
}

function nameOf(kind: string, name?: string | null): string {
  return name && name !== kind ? `${kind} “${name}”` : kind;
}

function rayKind(kind: string): string {
  return kind === "camera" ? "Ray from the camera" : kind === "reflection" ? "Reflection" : kind === "transmission" ? "Light let through" : kind;
}
