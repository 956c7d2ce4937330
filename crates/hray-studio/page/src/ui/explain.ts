// What one pixel is made of: the object seen, the tree of rays, each light's part.

import { fill, h } from "../dom";
import { css, hex } from "../editor/colours";
import type { Colour, Explanation, LightShare, Place, Ray, SceneObject, Surface } from "../engine/protocol";

export interface ExplainEvents {
  jump(place: Place): void;
}

/** Rays shown open; what is deeper opens on demand. */
const OPEN_LEVELS = 2;

function short(value: number | null): string {
  if (value === null || !Number.isFinite(value)) return "∞";
  const size = Math.abs(value);
  const text = size !== 0 && (size < 0.0005 || size >= 100_000) ? value.toExponential(1) : String(Number(value.toFixed(size < 1 ? 3 : 2)));
  return text.replace("-", "−");
}

function vector(value: readonly (number | null)[]): string {
  return `(${value.map(short).join(", ")})`;
}

/** From a linear value to what a screen shows. */
function display(color: Colour): Colour {
  return color.map((part) => {
    const c = Math.min(1, Math.max(0, part));
    return c <= 0.0031308 ? c * 12.92 : 1.055 * c ** (1 / 2.4) - 0.055;
  }) as Colour;
}

function swatch(color: Colour, title?: string): HTMLElement {
  const shown = display(color);
  const box = h("span", { class: "swatch", title: title ?? `${vector(color)}, ${hex(shown)}` });
  box.style.backgroundColor = css(shown);
  return box;
}

function nameOf(object: SceneObject): string {
  return object.name ? `${object.kind} of ${object.name}` : object.kind;
}

const rayNames: Record<string, string> = {
  camera: "Ray from the camera",
  reflection: "Mirrored ray",
  transmission: "Ray let through",
  "inner-reflection": "Ray kept inside",
};

const reaches: Record<string, string> = {
  behind: " is behind the surface",
  "outside-cone": " shines past it",
};

export class ExplainPanel {
  readonly element = h("div", { class: "explain" });
  /** The pixel that is explained. */
  pixel: [number, number] | null = null;

  constructor(private readonly events: ExplainEvents) {
    this.clear();
  }

  /** What is shown is of another picture than the one to come. */
  stale(): void {
    this.element.classList.add("stale");
  }

  clear(): void {
    this.pixel = null;
    this.element.classList.remove("stale");
    fill(this.element, h("p", { class: "nothing" }, "Click a pixel of the picture to see what it is made of."));
  }

  waiting(x: number, y: number): void {
    this.pixel = [x, y];
    this.element.classList.remove("stale");
    fill(this.element, h("p", { class: "nothing" }, `Following the rays of pixel ${x}, ${y} …`));
  }

  failed(why: string): void {
    this.element.classList.remove("stale");
    fill(this.element, h("p", { class: "nothing trouble" }, why));
  }

  show(explanation: Explanation): void {
    this.pixel = explanation.pixel;
    this.element.classList.remove("stale");
    const [x, y] = explanation.pixel;
    const big = h("span", { class: "big-swatch" });
    big.style.backgroundColor = explanation.display;
    const { object, rays, seen } = explanation;
    const children = new Map<number | null, Ray[]>();
    for (const ray of rays) children.set(ray.parent, [...(children.get(ray.parent) ?? []), ray]);
    const root = rays[0];
    fill(
      this.element,
      h(
        "div",
        { class: "explain-facts" },
        big,
        h(
          "div",
          {},
          h("h3", {}, object ? nameOf(object) : "Background"),
          object ? this.madeAt(object) : null,
          h(
            "dl",
            {},
            h("dt", {}, "Pixel"),
            h("dd", {}, `${x}, ${y}`),
            h("dt", {}, "Shown"),
            h("dd", { class: "explain-shown" }, explanation.display),
            h("dt", {}, "Value"),
            h("dd", {}, vector(explanation.color)),
            ...(explanation.samples > 1
              ? [
                  h("dt", {}, "Samples"),
                  h("dd", {}, seen.length > 1 ? seen.map((one) => `${one.samples} ${one.object ? nameOf(one.object) : "background"}`).join(", ") : `all ${explanation.samples}`),
                ]
              : []),
          ),
        ),
      ),
      h(
        "div",
        { class: "explain-rays" },
        root ? h("ul", { class: "rays", "aria-label": "Rays of this pixel" }, this.ray(root, children)) : h("p", { class: "quiet" }, "With a depth of −1 there are no rays."),
        explanation.omitted > 0 ? h("p", { class: "quiet" }, `And ${explanation.omitted.toLocaleString("en")} rays more.`) : null,
      ),
    );
  }

  private jump(place: Place, text?: string): HTMLElement {
    return h("button", { type: "button", class: "jump", title: `${place.file}:${place.line}: ${place.text}`, onclick: () => this.events.jump(place) }, text ?? `line ${place.line}`);
  }

  /** The lines that made an object: its own, and those of the calls that led there. */
  private madeAt(object: SceneObject): HTMLElement | null {
    if (!object.place) return null;
    const calls = object.calls.slice(0, 2).filter((call) => call.line !== object.place?.line);
    return h("p", {}, this.jump(object.place), ...calls.flatMap((call) => [h("span", { class: "quiet" }, " called from "), this.jump(call)]));
  }

  private ray(ray: Ray, children: ReadonlyMap<number | null, Ray[]>): HTMLElement {
    const { hit } = ray;
    const summary = h(
      "summary",
      {},
      swatch(ray.color),
      h("strong", {}, rayNames[ray.kind] ?? ray.kind),
      hit ? ` meets ${nameOf(hit.object)}` : " sees the background",
      hit && ray.distance !== null ? h("span", { class: "quiet" }, ` after ${short(ray.distance)}`) : null,
      ray.parent !== null ? h("span", { class: "share", title: "Its share in the ray above" }, `× ${short(ray.weight)}`) : null,
    );
    if (!hit) return h("li", { class: "leaf" }, ...summary.childNodes);
    const below = children.get(ray.index) ?? [];
    const facts = h(
      "div",
      { class: "ray-facts" },
      h(
        "p",
        { class: "quiet" },
        hit.object.place && ray.parent !== null ? h("span", {}, this.jump(hit.object.place), ", ") : null,
        `at ${vector(hit.point)}, normal ${vector(hit.normal)}${hit.inside ? ", seen from inside" : ""}`,
      ),
      h("p", { class: "quiet" }, "surface ", swatch(hit.material.color), ` ${surface(hit.material)}`),
      h("ul", { class: "lights", "aria-label": "Lights" }, ...hit.lights.map((light) => this.light(light))),
      hit.mirrored === "too-deep" || hit.refracted === "too-deep" ? h("p", { class: "quiet" }, "Rays that would follow are deeper than the scene's depth allows; they count as black.") : null,
      hit.clipped ? h("p", { class: "quiet" }, "The sum is brighter than a colour can be, and is cut off.") : null,
      below.length > 0 ? h("ul", { class: "rays" }, ...below.map((child) => this.ray(child, children))) : null,
    );
    return h("li", {}, h("details", { open: ray.level < OPEN_LEVELS }, summary, facts));
  }

  private light(light: LightShare): HTMLElement {
    const name = `${light.kind}${light.kind.endsWith("light") ? "" : " light"}`;
    const by = light.shadowed_by;
    const given =
      light.reach === "shadowed" && by
        ? h("span", { class: "shadowed" }, " in the shadow of ", by.place ? this.jump(by.place, nameOf(by)) : nameOf(by))
        : reaches[light.reach]
          ? h("span", { class: "shadowed" }, reaches[light.reach] ?? "")
          : h("span", { class: "quiet" }, ` adds ${vector(light.contribution)}`, light.highlight.some((part) => part > 0.0005) ? `, highlight ${vector(light.highlight)}` : null);
    return h("li", {}, swatch(light.contribution), light.place ? this.jump(light.place, name) : h("span", {}, name), given);
  }
}

/** A surface in a few words. */
function surface(material: Surface): string {
  const words = [
    material.reflection > 0 ? `mirrors ${short(material.reflection)}` : null,
    material.transparency > 0 ? `lets through ${short(material.transparency)}, index ${short(material.ior)}` : null,
    material.highlight > 0 ? `highlight ${short(material.highlight)}, shine ${short(material.shine)}` : null,
  ].filter((one) => one !== null);
  return words.length > 0 ? words.join("; ") : "matt";
}
