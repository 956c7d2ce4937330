// Time, where the scene is a function of it: a slider, play, loop.

import { h, icon, icons, iconButton } from "../dom";

export interface TimelineEvents {
  /** The user wants to see this moment. */
  seek(time: number): void;
  play(on: boolean): void;
}

const DEFAULT_LENGTH = 4;

export class Timeline {
  readonly element: HTMLElement;
  private readonly slider: HTMLInputElement;
  private readonly label: HTMLElement;
  private readonly button: HTMLButtonElement;
  private readonly loopButton: HTMLButtonElement;
  private readonly lengthField: HTMLInputElement;
  private on = false;
  loop = true;

  constructor(private readonly events: TimelineEvents) {
    this.slider = h("input", { type: "range", class: "time-slider", min: 0, max: DEFAULT_LENGTH, step: 0.01, value: 0, "aria-label": "Time in seconds" });
    this.slider.addEventListener("input", () => {
      this.setPlaying(false);
      this.events.seek(Number(this.slider.value));
      this.draw();
    });
    this.button = iconButton("play", "Play", () => this.toggle(), { key: "Alt+Space" });
    this.loopButton = iconButton("loop", "Play again and again", () => {
      this.loop = !this.loop;
      this.loopButton.setAttribute("aria-pressed", String(this.loop));
    });
    this.loopButton.setAttribute("aria-pressed", "true");
    this.label = h("output", { class: "time-label" });
    this.lengthField = h("input", { type: "number", class: "time-length", min: 0.1, max: 3600, step: 0.5, value: DEFAULT_LENGTH, "aria-label": "Length in seconds" });
    this.lengthField.addEventListener("change", () => {
      const length = Math.min(3600, Math.max(0.1, Number(this.lengthField.value) || DEFAULT_LENGTH));
      this.lengthField.value = String(length);
      this.slider.max = String(length);
      this.events.seek(Number(this.slider.value));
      this.draw();
    });
    this.element = h(
      "div",
      { class: "timeline", role: "group", "aria-label": "Time", hidden: true },
      this.button,
      this.slider,
      this.label,
      h("span", { class: "quiet" }, "of"),
      this.lengthField,
      h("span", { class: "quiet" }, "s"),
      this.loopButton,
    );
    this.draw();
  }

  get time(): number {
    return Number(this.slider.value);
  }

  get length(): number {
    return Number(this.slider.max);
  }

  get playing(): boolean {
    return this.on;
  }

  set(time: number): void {
    this.slider.value = String(time);
    this.draw();
  }

  show(on: boolean): void {
    this.element.hidden = !on;
    if (!on) this.setPlaying(false);
  }

  toggle(): void {
    if (this.element.hidden) return;
    this.setPlaying(!this.on);
  }

  setPlaying(on: boolean): void {
    if (on === this.on) return;
    this.on = on;
    this.button.replaceChildren(icon(icons[on ? "pause" : "play"]));
    this.button.setAttribute("aria-label", on ? "Pause" : "Play");
    this.button.title = on ? "Pause (Alt+Space)" : "Play (Alt+Space)";
    this.events.play(on);
  }

  private draw(): void {
    this.label.textContent = `${this.time.toFixed(2)} s`;
    this.slider.style.setProperty("--done", `${(this.time / this.length) * 100}%`);
    this.slider.setAttribute("aria-valuetext", `${this.time.toFixed(2)} seconds`);
  }
}
