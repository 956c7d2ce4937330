// The picture pane: the pixels as they arrive, zoom and pan, what lies under the pointer, the comparison with an
// earlier picture.

import { h } from "../dom";

/** A picture that is kept to compare with. */
export interface Kept {
  width: number;
  height: number;
  data: ImageData;
}

export type Comparison = "none" | "wipe" | "difference";

export interface PictureEvents {
  /** The pointer is over a pixel, or (null) over none. */
  over(pixel: Pixel | null): void;
  /** A pixel was chosen. */
  pick(x: number, y: number): void;
  zoomed(scale: number, fit: boolean): void;
}

export interface Pixel {
  x: number;
  y: number;
  colour: [number, number, number];
  before: [number, number, number] | null;
}

const CLICK_SLACK = 4;

export class PictureView {
  readonly element: HTMLElement;
  /** The pixels shown, at the picture's own size. */
  readonly canvas: HTMLCanvasElement;
  private readonly context: CanvasRenderingContext2D;
  private readonly before: HTMLCanvasElement;
  private readonly wipe: HTMLElement;
  private readonly stage: HTMLElement;
  private readonly cursor: HTMLElement;
  /** The size that the scene's picture has; the canvas may hold a smaller one while the scene plays. */
  private size = { width: 0, height: 0 };
  private scale = 1;
  private left = 0;
  private top = 0;
  private fitting = true;
  private chosen: { x: number; y: number } | null = null;
  private keyboard = false;
  private kept: Kept | null = null;
  private comparison: Comparison = "none";
  private wipeAt = 0.5;
  private readonly pointers = new Map<number, { x: number; y: number }>();

  constructor(private readonly events: PictureEvents) {
    this.canvas = h("canvas", { class: "picture-canvas", width: 1, height: 1, role: "img", "aria-label": "The rendered picture" });
    this.before = h("canvas", { class: "picture-before", width: 1, height: 1, hidden: true, "aria-hidden": "true" });
    const context = this.canvas.getContext("2d", { alpha: false, willReadFrequently: true });
    if (!context) throw new Error("This browser cannot draw.");
    this.context = context;
    this.wipe = h("div", {
      class: "wipe",
      hidden: true,
      role: "slider",
      tabindex: 0,
      "aria-label": "Where the earlier picture ends and the new one begins",
      "aria-valuemin": 0,
      "aria-valuemax": 100,
    });
    this.cursor = h("div", { class: "pixel-cursor", hidden: true, "aria-hidden": "true" });
    this.stage = h("div", { class: "stage" }, this.canvas, this.before, this.cursor, this.wipe);
    this.element = h(
      "div",
      {
        class: "picture-well",
        tabindex: 0,
        role: "application",
        "aria-roledescription": "picture",
        "aria-label": "Picture. Arrow keys move the pixel cursor, Enter explains the pixel, plus and minus zoom, 0 fits.",
      },
      this.stage,
    );
    this.listen();
    new ResizeObserver(() => {
      if (this.fitting) this.fit();
      else this.place();
    }).observe(this.element);
  }

  get width(): number {
    return this.canvas.width;
  }

  get height(): number {
    return this.canvas.height;
  }

  /** Where the pixel cursor is. */
  get pixel(): { x: number; y: number } | null {
    return this.chosen;
  }

  /** A new render begins: its pixels replace those there are, as they come. */
  begin(width: number, height: number, sceneWidth: number, sceneHeight: number): void {
    if (width !== this.canvas.width || height !== this.canvas.height) {
      // What was there stays in sight until the first pixels are, so nothing flickers.
      const old = this.canvas.width > 1 ? this.copyCanvas() : null;
      this.canvas.width = width;
      this.canvas.height = height;
      if (old) this.context.drawImage(old, 0, 0, width, height);
    }
    if (sceneWidth !== this.size.width || sceneHeight !== this.size.height) {
      this.size = { width: sceneWidth, height: sceneHeight };
      if (this.fitting) this.fit();
    }
    this.place();
    this.drawComparison();
  }

  /** Pixels have come: `w` by `h` samples, each standing for a square of `step` pixels. */
  tile(x: number, y: number, w: number, hh: number, step: number, data: Uint8ClampedArray): void {
    if (step <= 1) {
      this.context.putImageData(new ImageData(data as Uint8ClampedArray<ArrayBuffer>, w, hh), x, y);
      return;
    }
    const width = Math.min(w * step, this.canvas.width - x);
    const height = Math.min(hh * step, this.canvas.height - y);
    if (width <= 0 || height <= 0) return;
    const source = new Uint32Array(data.buffer, data.byteOffset, w * hh);
    const target = new Uint32Array(width * height);
    for (let row = 0; row < height; row++) {
      const line = Math.floor(row / step) * w;
      const start = row * width;
      for (let column = 0; column < width; column++) target[start + column] = source[line + Math.floor(column / step)] ?? 0;
    }
    this.context.putImageData(new ImageData(new Uint8ClampedArray(target.buffer), width, height), x, y);
  }

  /** After the last pixels of a pass. */
  refreshed(): void {
    if (this.comparison === "difference") this.drawComparison();
  }

  pixels(): ImageData {
    return this.context.getImageData(0, 0, this.canvas.width, this.canvas.height);
  }

  setKept(kept: Kept | null): void {
    this.kept = kept;
    this.drawComparison();
  }

  compare(how: Comparison): void {
    this.comparison = how;
    this.drawComparison();
  }

  dim(on: boolean): void {
    this.element.classList.toggle("dimmed", on);
  }

  showPixel(x: number, y: number): void {
    this.chosen = {
      x: Math.min(Math.max(0, x), Math.max(0, this.size.width - 1)),
      y: Math.min(Math.max(0, y), Math.max(0, this.size.height - 1)),
    };
    this.place();
  }

  hidePixel(): void {
    this.chosen = null;
    this.place();
  }

  fit(): void {
    this.fitting = true;
    const { clientWidth, clientHeight } = this.element;
    const { width, height } = this.size;
    if (!width || !height || !clientWidth || !clientHeight) return;
    const margin = 24;
    const scale = Math.min((clientWidth - margin) / width, (clientHeight - margin) / height);
    // Small pictures are shown pixel for pixel, or in whole steps.
    this.scale = scale > 1 ? Math.max(1, Math.min(Math.floor(scale), 4)) : Math.max(scale, 0.01);
    this.left = (clientWidth - width * this.scale) / 2;
    this.top = (clientHeight - height * this.scale) / 2;
    this.place();
  }

  /** Zooms by a factor around a point of the pane (its middle where none is given). */
  zoom(factor: number, at?: { x: number; y: number }): void {
    this.zoomTo(this.scale * factor, at);
  }

  zoomTo(wanted: number, at?: { x: number; y: number }): void {
    this.fitting = false;
    const center = at ?? { x: this.element.clientWidth / 2, y: this.element.clientHeight / 2 };
    const scale = Math.min(64, Math.max(0.02, wanted));
    this.left = center.x - ((center.x - this.left) * scale) / this.scale;
    this.top = center.y - ((center.y - this.top) * scale) / this.scale;
    this.scale = scale;
    this.place();
  }

  private pan(dx: number, dy: number): void {
    this.fitting = false;
    this.left += dx;
    this.top += dy;
    this.place();
  }

  private place(): void {
    const { width, height } = this.size;
    // At least a corner of the picture stays in sight.
    const keep = 40;
    this.left = Math.min(this.element.clientWidth - keep, Math.max(keep - width * this.scale, this.left));
    this.top = Math.min(this.element.clientHeight - keep, Math.max(keep - height * this.scale, this.top));
    const device = devicePixelRatio || 1;
    const left = Math.round(this.left * device) / device;
    const top = Math.round(this.top * device) / device;
    this.stage.style.transform = `translate(${left}px, ${top}px)`;
    this.stage.style.width = `${width * this.scale}px`;
    this.stage.style.height = `${height * this.scale}px`;
    this.stage.classList.toggle("pixelated", this.scale * device >= 1.5);
    this.stage.classList.toggle("empty", width === 0);
    if (this.chosen) {
      this.cursor.hidden = false;
      this.cursor.style.left = `${this.chosen.x * this.scale}px`;
      this.cursor.style.top = `${this.chosen.y * this.scale}px`;
      this.cursor.style.width = this.cursor.style.height = `${Math.max(this.scale, 1)}px`;
    } else {
      this.cursor.hidden = true;
    }
    this.placeWipe();
    this.events.zoomed(this.scale, this.fitting);
  }

  private placeWipe(): void {
    const on = this.comparison === "wipe" && this.kept !== null;
    this.wipe.hidden = !on;
    this.wipe.style.left = `${this.wipeAt * 100}%`;
    this.wipe.setAttribute("aria-valuenow", String(Math.round(this.wipeAt * 100)));
    this.before.style.clipPath = on ? `inset(0 ${(1 - this.wipeAt) * 100}% 0 0)` : "none";
  }

  private copyCanvas(): HTMLCanvasElement {
    const copy = document.createElement("canvas");
    copy.width = this.canvas.width;
    copy.height = this.canvas.height;
    copy.getContext("2d")?.drawImage(this.canvas, 0, 0);
    return copy;
  }

  private drawComparison(): void {
    const { kept, comparison } = this;
    // What has another size cannot be subtracted.
    const differs = kept !== null && (kept.width !== this.canvas.width || kept.height !== this.canvas.height);
    this.before.hidden = comparison === "none" || !kept || (comparison === "difference" && differs);
    if (kept && comparison !== "none") {
      this.before.width = kept.width;
      this.before.height = kept.height;
      const context = this.before.getContext("2d", { alpha: false });
      if (comparison === "wipe") {
        context?.putImageData(kept.data, 0, 0);
      } else if (!differs) {
        context?.putImageData(difference(this.pixels(), kept.data), 0, 0);
      }
    }
    this.placeWipe();
  }

  private pixelAt(clientX: number, clientY: number): { x: number; y: number } | null {
    const box = this.element.getBoundingClientRect();
    const x = Math.floor((clientX - box.left - this.left) / this.scale);
    const y = Math.floor((clientY - box.top - this.top) / this.scale);
    return x >= 0 && y >= 0 && x < this.size.width && y < this.size.height ? { x, y } : null;
  }

  /** What a pixel holds, in the picture's own coordinates. */
  read(x: number, y: number): Pixel {
    const fx = this.canvas.width / this.size.width;
    const fy = this.canvas.height / this.size.height;
    const [r = 0, g = 0, b = 0] = this.context.getImageData(Math.floor(x * fx), Math.floor(y * fy), 1, 1).data;
    let before: Pixel["before"] = null;
    const { kept } = this;
    if (kept && kept.width === this.canvas.width && kept.height === this.canvas.height && this.comparison !== "none") {
      const at = (Math.floor(y * fy) * kept.width + Math.floor(x * fx)) * 4;
      before = [kept.data.data[at] ?? 0, kept.data.data[at + 1] ?? 0, kept.data.data[at + 2] ?? 0];
    }
    return { x, y, colour: [r, g, b], before };
  }

  private over(pixel: { x: number; y: number } | null): void {
    this.events.over(pixel && this.size.width ? this.read(pixel.x, pixel.y) : null);
  }

  private listen(): void {
    const well = this.element;
    well.addEventListener(
      "wheel",
      (event) => {
        event.preventDefault();
        if (event.shiftKey) {
          this.pan(-event.deltaY - event.deltaX, 0);
          return;
        }
        const box = well.getBoundingClientRect();
        const lines = event.deltaMode === 1 ? 16 : 1;
        this.zoom(Math.exp(-event.deltaY * lines * 0.0016), { x: event.clientX - box.left, y: event.clientY - box.top });
      },
      { passive: false },
    );
    well.addEventListener("pointerdown", (event) => this.press(event));
    well.addEventListener("pointermove", (event) => {
      if (this.pointers.size === 0) this.over(this.pixelAt(event.clientX, event.clientY));
    });
    well.addEventListener("pointerleave", () => this.over(this.keyboard ? this.chosen : null));
    well.addEventListener("dblclick", (event) => event.preventDefault());
    well.addEventListener("keydown", (event) => this.key(event));
    this.wipe.addEventListener("keydown", (event) => {
      const by = event.key === "ArrowLeft" ? -0.02 : event.key === "ArrowRight" ? 0.02 : 0;
      if (by === 0) return;
      event.preventDefault();
      event.stopPropagation();
      this.wipeAt = Math.min(1, Math.max(0, this.wipeAt + by));
      this.placeWipe();
    });
  }

  private press(event: PointerEvent): void {
    if (event.button > 1) return;
    const onWipe = (event.target as Element).closest(".wipe") !== null;
    this.element.setPointerCapture(event.pointerId);
    this.pointers.set(event.pointerId, { x: event.clientX, y: event.clientY });
    let travelled = 0;
    let last = { x: event.clientX, y: event.clientY };
    const several = () => this.pointers.size > 1;
    const move = (now: PointerEvent) => {
      if (now.pointerId !== event.pointerId) return;
      if (onWipe) {
        const box = this.stage.getBoundingClientRect();
        this.wipeAt = Math.min(1, Math.max(0, (now.clientX - box.left) / box.width));
        this.placeWipe();
        return;
      }
      const before = this.spread();
      this.pointers.set(now.pointerId, { x: now.clientX, y: now.clientY });
      travelled += Math.abs(now.clientX - last.x) + Math.abs(now.clientY - last.y);
      if (several()) {
        const after = this.spread();
        const box = this.element.getBoundingClientRect();
        if (before && after && before.distance > 0) {
          this.pan(after.x - before.x, after.y - before.y);
          this.zoom(after.distance / before.distance, { x: after.x - box.left, y: after.y - box.top });
        }
        travelled = Infinity;
      } else if (travelled > CLICK_SLACK) {
        this.pan(now.clientX - last.x, now.clientY - last.y);
        this.element.classList.add("panning");
      }
      last = { x: now.clientX, y: now.clientY };
    };
    const up = (now: PointerEvent) => {
      if (now.pointerId !== event.pointerId) return;
      this.pointers.delete(now.pointerId);
      this.element.classList.remove("panning");
      this.element.removeEventListener("pointermove", move);
      this.element.removeEventListener("pointerup", up);
      this.element.removeEventListener("pointercancel", up);
      if (now.type === "pointerup" && !onWipe && event.button === 0 && travelled <= CLICK_SLACK) {
        const pixel = this.pixelAt(now.clientX, now.clientY);
        if (pixel) {
          this.keyboard = false;
          this.showPixel(pixel.x, pixel.y);
          this.over(pixel);
          this.events.pick(pixel.x, pixel.y);
        }
      }
    };
    this.element.addEventListener("pointermove", move);
    this.element.addEventListener("pointerup", up);
    this.element.addEventListener("pointercancel", up);
  }

  /** The middle of the fingers and how far apart they are. */
  private spread(): { x: number; y: number; distance: number } | null {
    const [one, two] = [...this.pointers.values()];
    if (!one || !two) return null;
    return { x: (one.x + two.x) / 2, y: (one.y + two.y) / 2, distance: Math.hypot(one.x - two.x, one.y - two.y) };
  }

  private key(event: KeyboardEvent): void {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const step = event.shiftKey ? 10 : 1;
    const ways: Record<string, [number, number]> = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
    const way = ways[event.key];
    if (way) {
      const from = this.chosen ?? { x: Math.floor(this.size.width / 2) - way[0] * step, y: Math.floor(this.size.height / 2) - way[1] * step };
      this.keyboard = true;
      this.showPixel(from.x + way[0] * step, from.y + way[1] * step);
      this.over(this.chosen);
    } else if (event.key === "Enter" || event.key === " ") {
      const at = this.chosen ?? { x: Math.floor(this.size.width / 2), y: Math.floor(this.size.height / 2) };
      this.keyboard = true;
      this.showPixel(at.x, at.y);
      this.over(this.chosen);
      this.events.pick(at.x, at.y);
    } else if (event.key === "+" || event.key === "=") this.zoom(1.25);
    else if (event.key === "-") this.zoom(0.8);
    else if (event.key === "0") this.fit();
    else if (event.key === "1") this.zoomTo(1);
    else return;
    event.preventDefault();
  }
}

/** How far two pictures of one size are apart, four times as bright as it is, so that a step of one is seen. */
export function difference(now: ImageData, before: ImageData): ImageData {
  const out = new ImageData(now.width, now.height);
  for (let at = 0; at < now.data.length; at += 4) {
    for (let part = 0; part < 3; part++) {
      out.data[at + part] = Math.min(255, Math.abs((now.data[at + part] ?? 0) - (before.data[at + part] ?? 0)) * 4);
    }
    out.data[at + 3] = 255;
  }
  return out;
}
