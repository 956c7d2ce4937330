// The right pane: the picture with its state (rendering, complete, behind the text), its tools and the time.

import { fill, h, iconButton } from "../dom";
import { hex } from "../editor/colours";
import type { Events, Summary } from "../engine/protocol";
import { Timeline } from "../ui/timeline";
import { PictureView, type Comparison, type Kept, type Pixel } from "./view";

export interface PaneEvents {
  /** Another moment or size is to be shown. */
  view(): void;
  pick(x: number, y: number): void;
  menu(button: HTMLElement): void;
  stop(): void;
  state(state: RenderState): void;
}

export type RenderState =
  | { is: "idle" }
  | { is: "rendering"; done: number; seconds: number }
  | { is: "complete"; seconds: number; rays: number }
  | { is: "failed"; message: string };

interface Frame {
  id: number;
  width: number;
  height: number;
  done: boolean;
}

/** More pixels than this are shown at a fraction of their size; they are saved at their own. */
const MOST_PIXELS = 16_000_000;
/** While a scene plays, a frame should take no longer than this, in seconds; the size gives way. */
const PLAY_FRAME = 0.09;
/** In milliseconds. */
const PATIENCE = 350;
const SMALLEST = 0.125;

export class PicturePane {
  readonly element: HTMLElement;
  readonly picture: PictureView;
  readonly timeline: Timeline;
  private readonly readout = h("div", { class: "readout" });
  private readonly zoomLabel: HTMLButtonElement;
  private readonly compareButton: HTMLButtonElement;
  private readonly pinButton: HTMLButtonElement;
  private readonly progress = h("div", { class: "progress", hidden: true, role: "progressbar", "aria-label": "Rendering", "aria-valuemin": 0, "aria-valuemax": 100 });
  private readonly notice = h("div", { class: "picture-notice", hidden: true });
  private frame: Frame | null = null;
  private summary: Summary | null = null;
  private comparison: Comparison = "none";
  /** The one kept before that, until it is known whether the new picture is another. */
  private earlier: Kept | null = null;
  private keptHash = "";
  private pointed: Pixel | null = null;
  private kept: Kept | null = null;
  private pinned = false;
  private playScale = 1;
  private playFrom = { clock: 0, time: 0 };
  private waiting = false;
  /** When the frame that is waited for was asked for. */
  private asked = 0;

  constructor(private readonly events: PaneEvents) {
    this.picture = new PictureView({
      over: (pixel) => this.show(pixel),
      pick: (x, y) => this.events.pick(x, y),
      zoomed: (scale, fit) => {
        if (this.zoomLabel) this.zoomLabel.textContent = fit ? `Fit · ${percent(scale)}` : percent(scale);
      },
    });
    this.timeline = new Timeline({
      seek: () => this.events.view(),
      play: (on) => this.play(on),
    });
    this.zoomLabel = h("button", { type: "button", class: "button zoom-label", title: "Fit the picture to the pane (0)", onclick: () => this.picture.fit() }, "Fit");
    this.compareButton = iconButton("compare", "Compare with the picture before", () => this.nextComparison(), { text: "Compare", key: "C", class: "compare" });
    this.compareButton.setAttribute("aria-pressed", "false");
    this.pinButton = iconButton("pin", "Keep comparing with this earlier picture", () => this.pin(), { class: "pin" });
    this.pinButton.hidden = true;
    const tools = h(
      "div",
      { class: "picture-tools", role: "toolbar", "aria-label": "Picture" },
      h("div", { class: "group" }, iconButton("minus", "Zoom out", () => this.picture.zoom(0.8), { key: "-" }), this.zoomLabel, iconButton("plus", "Zoom in", () => this.picture.zoom(1.25), { key: "+" })),
      this.readout,
      h(
        "div",
        { class: "group end" },
        this.compareButton,
        this.pinButton,
        iconButton("picture", "Save or copy the picture", (event) => this.events.menu(event.currentTarget as HTMLElement), { text: "Picture" }),
        iconButton("full", "Full screen", () => this.fullScreen(), { key: "F" }),
      ),
    );
    tools.querySelector('[aria-label="Save or copy the picture"]')?.setAttribute("aria-haspopup", "menu");
    this.element = h("section", { class: "picture-pane", "aria-label": "Picture" }, h("div", { class: "picture-frame" }, this.progress, this.picture.element, this.notice), this.timeline.element, tools);
    this.element.addEventListener("keydown", (event) => {
      if (event.ctrlKey || event.metaKey) return;
      const step = event.altKey ? (event.key === "ArrowLeft" ? -0.1 : event.key === "ArrowRight" ? 0.1 : 0) : 0;
      if (step !== 0 && !this.timeline.element.hidden) this.seek(Math.min(this.timeline.length, Math.max(0, this.timeline.time + step)));
      else if (event.altKey || (event.target as Element).closest("input")) return;
      else if (event.key === "c" || event.key === "C") this.nextComparison();
      else if (event.key === "f" || event.key === "F") this.fullScreen();
      else if (event.key === "Escape" && this.element.classList.contains("full-screen")) this.fullScreen();
      else return;
      event.preventDefault();
    });
    this.element.addEventListener("fullscreenchange", () => {
      if (!document.fullscreenElement) this.element.classList.remove("full-screen");
    });
    this.show(null);
    requestAnimationFrame(() => this.tick());
  }

  get time(): number {
    return this.timeline.element.hidden ? 0 : this.timeline.time;
  }

  /** The size to ask for: null is the scene's own. */
  get wanted(): { width: number | null; height: number | null } {
    const summary = this.summary;
    if (!summary) return { width: null, height: null };
    let scale = this.timeline.playing ? this.playScale : 1;
    const pixels = summary.width * summary.height * scale * scale;
    if (pixels > MOST_PIXELS) scale *= Math.sqrt(MOST_PIXELS / pixels);
    if (scale === 1) return { width: null, height: null };
    return { width: Math.max(1, Math.round(summary.width * scale)), height: Math.max(1, Math.round(summary.height * scale)) };
  }

  /** Another scene is shown: nothing of the one before is to be compared with it. */
  reset(time: number): void {
    this.summary = null;
    this.frame = null;
    this.kept = null;
    this.pinned = false;
    this.playScale = 1;
    this.timeline.show(false);
    this.timeline.set(time);
    this.setComparison("none");
    this.picture.setKept(null);
    this.picture.hidePixel();
    this.picture.dim(true);
    this.setNotice(null);
  }

  /** What the text makes of the scene is known. */
  scene(ok: boolean, summary: Summary | null, animated: boolean, module: number | null): void {
    this.picture.dim(!ok);
    if (module !== null) this.setNotice(`No scene here: a file of ${module} definitions, there to be imported.`);
    if (!ok) {
      this.progress.hidden = true;
      this.timeline.setPlaying(false);
      return;
    }
    const before = this.wanted;
    if (summary) this.summary = summary;
    if (animated !== !this.timeline.element.hidden) this.timeline.show(animated);
    const after = this.wanted;
    if (before.width !== after.width || before.height !== after.height) this.events.view();
    this.setNotice(after.width !== null && !this.timeline.playing && summary ? `Shown at ${percent(after.width / summary.width)} of its size; it is saved whole.` : null);
  }

  handle(event: Events): void {
    switch (event.event) {
      case "frame":
        this.begin(event);
        break;
      case "pixels":
        if (event.frame !== this.frame?.id) return;
        this.picture.tile(event.x, event.y, event.w, event.h, event.step, event.data);
        break;
      case "progress":
        if (event.frame !== this.frame?.id) return;
        this.setProgress(event.done, event.seconds);
        break;
      case "done":
        if (event.frame !== this.frame?.id) return;
        this.frame.done = true;
        this.progress.hidden = true;
        this.element.dataset["frame"] = String(event.frame);
        this.element.dataset["hash"] = event.hash ?? "";
        this.element.dataset["state"] = "complete";
        if (this.earlier && this.keptHash !== "" && this.keptHash === event.hash) {
          // Nothing has changed in it: the picture to compare with is still the one before.
          this.kept = this.earlier;
          this.picture.setKept(this.comparison === "none" ? null : this.kept);
        }
        this.earlier = null;
        this.picture.refreshed();
        if (this.pointed) this.show(this.picture.read(this.pointed.x, this.pointed.y));
        this.events.state({ is: "complete", seconds: event.seconds, rays: event.rays });
        this.played(event.seconds);
        break;
      case "failed":
        if (this.frame && event.frame < this.frame.id) return;
        this.progress.hidden = true;
        this.element.dataset["state"] = "failed";
        this.timeline.setPlaying(false);
        this.waiting = false;
        this.setNotice(event.message, "failed");
        this.events.state({ is: "failed", message: event.message });
        break;
      default:
    }
  }

  private begin(event: Extract<Events, { event: "frame" }>): void {
    const before = this.frame;
    if (before?.done && !this.pinned && !this.timeline.playing) {
      this.earlier = this.kept;
      this.keptHash = this.element.dataset["hash"] ?? "";
      this.kept = { width: before.width, height: before.height, data: this.picture.pixels() };
      this.picture.setKept(this.comparison === "none" ? null : this.kept);
    }
    const { width, height } = this.wanted.width !== null && this.summary ? this.summary : event;
    this.frame = { id: event.frame, width: event.width, height: event.height, done: false };
    this.picture.begin(event.width, event.height, width, height);
    this.picture.dim(false);
    if (this.notice.dataset["kind"] === "failed") this.setNotice(null);
    this.element.dataset["state"] = "rendering";
    this.element.dataset["version"] = String(event.version);
    this.element.dataset["time"] = String(event.time);
    this.progress.style.setProperty("--done", "0");
    this.events.state({ is: "rendering", done: 0, seconds: 0 });
  }

  private setProgress(done: number, seconds: number): void {
    this.progress.hidden = this.timeline.playing || seconds < 0.3;
    this.progress.style.setProperty("--done", String(done));
    this.progress.setAttribute("aria-valuenow", String(Math.round(done * 100)));
    this.events.state({ is: "rendering", done, seconds });
  }

  /** The render was ended by hand; what there is of the picture stays. */
  stopped(): void {
    this.timeline.setPlaying(false);
    this.progress.hidden = true;
    this.element.dataset["state"] = "stopped";
  }

  private setNotice(text: string | null, kind: "note" | "failed" = "note"): void {
    this.notice.hidden = text === null;
    this.notice.textContent = text ?? "";
    this.notice.dataset["kind"] = kind;
  }

  private seek(time: number): void {
    this.timeline.setPlaying(false);
    this.timeline.set(time);
    this.events.view();
  }

  private play(on: boolean): void {
    this.waiting = false;
    if (on) {
      const start = this.timeline.time >= this.timeline.length - 0.01 ? 0 : this.timeline.time;
      this.playFrom = { clock: performance.now(), time: start };
    } else {
      this.playScale = 1;
      this.events.view();
    }
  }

  /** While the scene plays: the next moment, once the one before is drawn. */
  private tick(): void {
    requestAnimationFrame(() => this.tick());
    if (!this.timeline.playing) return;
    if (this.waiting) {
      // A frame that takes far too long is given up for a smaller one.
      if (performance.now() - this.asked < PATIENCE || this.playScale <= SMALLEST) return;
      this.playScale /= 2;
    }
    const { length } = this.timeline;
    const time = this.playFrom.time + (performance.now() - this.playFrom.clock) / 1000;
    if (time >= length && !this.timeline.loop) {
      this.timeline.set(length);
      this.timeline.setPlaying(false);
      return;
    }
    this.timeline.set(time % length);
    this.waiting = true;
    this.asked = performance.now();
    this.events.view();
  }

  private played(seconds: number): void {
    this.waiting = false;
    if (!this.timeline.playing) return;
    if (seconds > PLAY_FRAME && this.playScale > SMALLEST) this.playScale /= 2;
    else if (seconds < PLAY_FRAME / 5 && this.playScale < 1) this.playScale *= 2;
  }

  nextComparison(): void {
    const order: Comparison[] = ["none", "wipe", "difference"];
    this.setComparison(order[(order.indexOf(this.comparison) + 1) % order.length] ?? "none");
  }

  private setComparison(how: Comparison): void {
    this.comparison = how;
    const label = this.compareButton.querySelector(".button-text");
    if (label) label.textContent = how === "none" ? "Compare" : how === "wipe" ? "Wipe" : "Difference";
    this.compareButton.setAttribute("aria-pressed", String(how !== "none"));
    this.compareButton.setAttribute("aria-label", `Compare with the picture before${how === "none" ? "" : `: ${how}`}`);
    this.pinButton.hidden = how === "none";
    this.pinButton.setAttribute("aria-pressed", String(this.pinned));
    if (how !== "none" && !this.kept) this.readout.textContent = "There is no earlier picture yet: change something.";
    this.picture.setKept(how === "none" ? null : this.kept);
    this.picture.compare(how);
  }

  private pin(): void {
    this.pinned = !this.pinned;
    this.pinButton.setAttribute("aria-pressed", String(this.pinned));
  }

  fullScreen(): void {
    const on = !this.element.classList.contains("full-screen");
    this.element.classList.toggle("full-screen", on);
    // Where the browser lets a page have the whole screen; else it has the whole window.
    if (on) void this.element.requestFullscreen?.().catch(() => undefined);
    else if (document.fullscreenElement) void document.exitFullscreen();
    this.picture.element.focus();
  }

  private show(pixel: Pixel | null): void {
    this.pointed = pixel;
    if (!pixel) {
      fill(this.readout, h("span", { class: "quiet" }, "Click a pixel to explain it"));
      return;
    }
    const swatch = h("span", { class: "swatch" });
    swatch.style.backgroundColor = `rgb(${pixel.colour.join(" ")})`;
    const [r, g, b] = pixel.colour;
    fill(
      this.readout,
      h("span", { class: "readout-place" }, `${pixel.x}, ${pixel.y}`),
      swatch,
      h("span", { class: "readout-value" }, hex([r / 255, g / 255, b / 255])),
      h("span", { class: "quiet readout-parts" }, pixel.colour.join(" ")),
      pixel.before ? h("span", { class: "quiet" }, `before ${pixel.before.join(" ")}`) : null,
    );
  }
}

function percent(scale: number): string {
  return `${scale >= 0.1 ? Math.round(scale * 100) : Math.round(scale * 1000) / 10} %`;
}
