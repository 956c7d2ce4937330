// The page: its parts and how they hang together. What concerns files and unsaved text is in `documents.ts`.

import type { EditorView } from "@codemirror/view";
import { Documents } from "./documents";
import { download, fill, h, icon, iconButton, icons, keyName } from "./dom";
import { Gesture } from "./editor/gesture";
import { Editor, readOnlyView } from "./editor/editor";
import type { Host } from "./editor/host";
import { EngineAway, explainError, type Engine } from "./engine/engine";
import type { Colour, Definition, Events, Hello, Place, Problem, Requests, Summary } from "./engine/protocol";
import { PicturePane, type RenderState } from "./picture/pane";
import { encodeShare } from "./share";
import { applyTheme, currentTheme, nextTheme } from "./theme";
import { ask, openDialog, openMenu, Words } from "./ui/dialog";
import { ExplainPanel } from "./ui/explain";
import { openKeys } from "./ui/keys";
import { openPicker } from "./ui/picker";
import { ProblemsPanel } from "./ui/problems";
import { splitter } from "./ui/splitter";

type DockTab = "problems" | "pixel";

export class Studio implements Host {
  readonly words = new Words();
  readonly editor: Editor;
  readonly pane: PicturePane;
  readonly documents: Documents;
  hello: Hello | null = null;
  private readonly banners = h("div", { class: "banners" });
  private readonly fileButton: HTMLButtonElement;
  private readonly saveButton: HTMLButtonElement;
  private readonly summaryBox = h("div", { class: "summary", "aria-label": "The scene", role: "group" });
  private readonly timeBox = h("button", { type: "button", class: "render-time", title: "Stop the render" });
  private readonly problemsPanel: ProblemsPanel;
  private readonly explainPanel: ExplainPanel;
  private readonly dock: HTMLElement;
  private readonly tabs: Record<DockTab, HTMLButtonElement>;
  private readonly editorPane: HTMLElement;
  private readonly bar: HTMLElement;
  private items: Problem[] = [];
  private peek: EditorView | null = null;
  private spotsTimer = 0;
  private edited = false;
  /** The last picture that came to its end. */
  private complete: RenderState = { is: "idle" };
  private explaining = 0;
  /** Whether a picture is on its way to a file. */
  private rendering = false;
  private bannerActions = new Map<string, HTMLElement>();

  constructor(
    root: HTMLElement,
    readonly engine: Engine,
  ) {
    this.problemsPanel = new ProblemsPanel({
      go: (problem) => this.goToProblem(problem),
      fix: (problem, index) => this.applyFix(problem, index),
      position: (problem) => this.placeOf(problem),
    });
    this.explainPanel = new ExplainPanel({ jump: (place) => void this.jump(place, true) });
    this.pane = new PicturePane({
      view: () => this.sendView(),
      pick: (x, y) => void this.explainPixel(x, y),
      menu: (button) => this.pictureMenu(button),
      stop: () => this.send("stop", {}),
      state: (state) => this.showRender(state),
    });
    this.editorPane = h("section", { class: "editor-pane", "aria-label": "Text" });
    this.editor = new Editor(this.editorPane, this, {
      changed: (_, byUser) => this.textChanged(byUser),
      moved: () => undefined,
    });
    this.documents = new Documents(this);

    this.fileButton = h("button", { type: "button", class: "file-button", onclick: () => this.documents.choose(false) });
    this.fileButton.title = `Open (${keyName("Mod-O")})`;
    this.saveButton = iconButton("save", "Save", () => void this.documents.save(), { key: keyName("Mod-S"), text: "Save" });
    this.timeBox.addEventListener("click", () => {
      this.send("stop", {});
      this.pane.stopped();
      fill(this.timeBox, "stopped");
      this.timeBox.classList.remove("busy");
    });
    const playground = engine.kind === "worker";
    this.bar = h(
      "header",
      { class: "bar" },
      h("span", { class: "mark", "aria-hidden": "true" }),
      this.fileButton,
      this.saveButton,
      h("div", { class: "facts" }, this.summaryBox, this.timeBox),
      h(
        "nav",
        { class: "bar-end", "aria-label": "Studio" },
        playground ? iconButton("link", "Share: copy a link to this scene", () => void this.share(), { text: "Share" }) : null,
        iconButton("format", "Lay the text out", () => void this.format(), { key: keyName("Shift-Alt-F") }),
        playground ? null : iconButton("command", "This view as a command line", () => void this.showCommand()),
        iconButton("theme", "Light, dark, or as the system", () => this.switchTheme()),
        iconButton("help", "Keys", () => openKeys(this.hello?.version ?? ""), { key: "F1" }),
      ),
    );
    this.tabs = {
      problems: h("button", { type: "button", role: "tab", id: "tab-problems", "aria-controls": "panel-problems", onclick: () => this.showTab("problems", true) }, "Problems"),
      pixel: h("button", { type: "button", role: "tab", id: "tab-pixel", "aria-controls": "panel-pixel", onclick: () => this.showTab("pixel", true) }, "Pixel"),
    };
    const tablist = h("div", { class: "tabs", role: "tablist", "aria-label": "Below" }, this.tabs.problems, this.tabs.pixel);
    tablist.addEventListener("keydown", (event) => {
      if (event.key !== "ArrowLeft" && event.key !== "ArrowRight") return;
      const other: DockTab = this.tabs.problems.getAttribute("aria-selected") === "true" ? "pixel" : "problems";
      this.showTab(other, true);
      this.tabs[other].focus();
    });
    this.dock = h(
      "section",
      { class: "dock closed", "aria-label": "Problems and pixel" },
      h("div", { class: "dock-head" }, tablist, iconButton("down", "Fold away", () => this.openDock(this.dock.classList.contains("closed")), { class: "fold" })),
      h("div", { id: "panel-problems", role: "tabpanel", "aria-labelledby": "tab-problems", class: "panel" }, this.problemsPanel.element),
      h("div", { id: "panel-pixel", role: "tabpanel", "aria-labelledby": "tab-pixel", class: "panel", hidden: true }, this.explainPanel.element),
    );
    const work = h("main", { class: "work" });
    work.append(this.editorPane, splitter(work, "--left", "x", "Width of the text"), this.pane.element);
    fill(root, this.bar, this.banners, work, splitter(this.dock, "--dock", "y", "Height of the problems"), this.dock, this.words.toasts, this.words.live);
    this.showTab("problems", false);
    this.openDock(false, false);
    this.setProblems([]);
    this.listen();
  }

  // --- What the editor's parts ask for ---

  async ask<K extends "complete" | "hover" | "definition" | "numbers" | "colors" | "present" | "format" | "rename">(
    what: K,
    more: Omit<Requests[K][0], "doc" | "version">,
  ): Promise<Requests[K][1] | null> {
    this.flushEdit();
    const { name, version } = this.documents.current;
    try {
      const answer = await this.engine.request(what, { doc: name, version, ...more } as unknown as Requests[K][0]);
      return this.documents.current.name === name && this.documents.current.version === version ? answer : null;
    } catch (error) {
      if (what === "format" || what === "rename") this.fail(error);
      return null;
    }
  }

  goTo(definition: Definition): void {
    if (definition.doc === null) this.openPeek(definition);
    else if (definition.doc === this.documents.current.name) this.editor.select(definition.from, definition.to);
    else void this.documents.open(definition.doc).then((opened) => opened && this.selectOnDisk(definition));
  }

  pickColour(view: EditorView, at: { from: number; to: number }): void {
    const spot = view.coordsAtPos(at.from);
    const end = view.coordsAtPos(at.to);
    if (!spot || !end) return;
    const color = (at as { color?: Colour }).color ?? [0, 0, 0];
    const gesture = new Gesture(view, at.from, at.to);
    let closed = false;
    let busy = false;
    let next: Colour | null = null;
    const write = async (wanted: Colour) => {
      next = wanted;
      if (busy) return;
      busy = true;
      while (next) {
        const now: Colour = next;
        next = null;
        const { span } = gesture;
        if (!span) break;
        const texts = await this.ask("present", { from: span.from, to: span.to, color: now });
        if (texts?.[0] !== undefined) gesture.set(texts[0]);
      }
      busy = false;
      if (closed) gesture.end(true);
    };
    const close = () => {
      closed = true;
      if (!busy) gesture.end(true);
    };
    openPicker(new DOMRect(spot.left, spot.top, end.right - spot.left, spot.bottom - spot.top), color, (wanted) => void write(wanted), close);
  }

  problems(): readonly Problem[] {
    return this.items;
  }

  applyFix(problem: Problem, index: number): void {
    const fix = problem.fixes[index];
    if (!fix) return;
    const here = this.documents.current.name;
    const elsewhere = fix.edits.find((edit) => edit.file && edit.file !== here)?.file;
    if (elsewhere) {
      this.say(`This mends ${elsewhere}: open that file to take the fix.`);
      return;
    }
    this.editor.edit(fix.edits);
    this.editor.view.focus();
    this.words.announce(`Done: ${fix.title}`);
  }

  say(text: string): void {
    this.words.say(text);
  }

  fail(error: unknown): void {
    if (error instanceof EngineAway) this.say("The engine is away just now. Nothing is lost; try again in a moment.");
    else this.say(explainError(error));
  }

  // --- Text to engine ---

  private textChanged(byUser: boolean): void {
    this.explainPanel.stale();
    this.documents.edited(byUser);
    this.edited = true;
    queueMicrotask(() => this.flushEdit());
  }

  /** Sends the text where the engine does not have it yet. */
  flushEdit(): void {
    if (!this.edited) return;
    this.edited = false;
    const { name, version } = this.documents.current;
    this.send("edit", { doc: name, version, text: this.editor.text });
  }

  /** Tells the engine the whole of what is shown: after a document is opened, and when the engine has come back. */
  sendAll(): void {
    this.edited = true;
    this.flushEdit();
    this.sendView();
  }

  get time(): number {
    return this.pane.time;
  }

  sendView(): void {
    const { name } = this.documents.current;
    if (name) this.send("view", { doc: name, time: this.pane.time, ...this.pane.wanted, overrides: {} });
  }

  /** Sends what needs no answer. Where the engine is away it gets everything when it is back. */
  send<K extends "edit" | "view" | "stop" | "close">(what: K, parameters: Requests[K][0]): void {
    this.engine.request(what, parameters).catch((error: unknown) => {
      if (!(error instanceof EngineAway)) this.fail(error);
    });
  }

  // --- Engine to page ---

  receive(event: Events): void {
    const current = this.documents.current;
    switch (event.event) {
      case "problems":
        if (event.doc !== current.name || event.version !== current.version) return;
        this.setProblems(event.items);
        this.refreshSpots();
        break;
      case "scene":
        if (event.doc !== current.name || event.version !== current.version) return;
        if (event.summary) this.showSummary(event.summary);
        // The render of what was there before the error has ended; the time shown is that of the picture shown.
        if (!event.ok) this.showRender(this.complete);
        this.pane.scene(event.ok, event.summary, event.animated, event.module ?? null);
        this.editorPane.dataset["known"] = String(event.version);
        break;
      case "frame":
        if (event.doc !== current.name) return;
        this.explainPanel.stale();
        this.pane.handle(event);
        break;
      case "disk":
        this.documents.onDisk(event.path, event.disk, event.text);
        break;
      case "files":
        if (this.hello) this.hello.files = event.files;
        break;
      default:
        this.pane.handle(event);
        if (event.event === "done") this.explainAgain();
    }
  }

  /** The pixel that is explained, of the picture that has just become complete. */
  private explainAgain(): void {
    const { pixel } = this.explainPanel;
    if (pixel && this.selected() === "pixel" && !this.dock.classList.contains("closed") && !this.pane.timeline.playing) void this.explainPixel(...pixel, false);
  }

  private refreshSpots(): void {
    clearTimeout(this.spotsTimer);
    this.spotsTimer = window.setTimeout(async () => {
      const [spots, colors] = await Promise.all([this.ask("numbers", {}), this.ask("colors", {})]);
      if (spots) this.editor.setNumbers(spots);
      if (colors) this.editor.setColours(colors);
    }, 60);
  }

  private setProblems(items: Problem[]): void {
    const had = this.items.length;
    const erred = this.items.some((problem) => problem.severity === "error");
    this.items = items;
    const here = items.filter((problem) => !problem.file || problem.file === this.documents?.current.name);
    this.editor.setProblems(here, (problem, index) => this.applyFix(problem, index));
    this.problemsPanel.show(items);
    const errors = items.filter((problem) => problem.severity === "error").length;
    const warnings = items.length - errors;
    const tab = this.tabs.problems;
    fill(
      tab,
      h("span", {}, "Problems"),
      errors > 0 ? h("span", { class: "count error", "aria-label": `${errors} errors` }, String(errors)) : null,
      warnings > 0 ? h("span", { class: "count warning", "aria-label": `${warnings} warnings` }, String(warnings)) : null,
      items.length === 0 ? h("span", { class: "fine" }, "none") : null,
    );
    if (items.length > 0) {
      this.words.announce(`${plural(errors, "error")}, ${plural(warnings, "warning")}. ${items[0]?.message ?? ""}`);
      if (errors > 0 && !erred && this.dock.dataset["folded"] !== "true") this.showTab("problems", true);
    } else if (had > 0) {
      this.words.announce("No problems any more.");
      if (this.selected() === "problems") this.openDock(false, false);
    }
  }

  private showSummary(summary: Summary): void {
    const lights = summary.point_lights + summary.ambient_lights + (summary.directional_lights ?? 0) + (summary.spot_lights ?? 0);
    fill(
      this.summaryBox,
      fact(`${summary.width} × ${summary.height}`, "Resolution in pixels"),
      fact(plural(summary.objects.total, "object"), "Objects in the scene"),
      fact(plural(lights, "light"), "Lights in the scene"),
    );
  }

  private showRender(state: RenderState): void {
    if (state.is === "complete" || state.is === "idle") this.complete = state;
    const box = this.timeBox;
    box.classList.toggle("busy", state.is === "rendering");
    box.disabled = state.is !== "rendering";
    switch (state.is) {
      case "rendering":
        fill(box, state.seconds > 0.3 ? `${Math.round(state.done * 100)} % · ${seconds(state.seconds)}` : "…", h("span", { class: "unseen" }, " rendered. Press to stop."));
        box.title = "Rendering. Press to stop.";
        break;
      case "complete":
        fill(box, h("span", { class: "unseen" }, "Render time "), seconds(state.seconds));
        box.title = `Rendered in ${seconds(state.seconds)}, ${state.rays.toLocaleString()} rays`;
        if (state.seconds > 2) this.words.announce(`The picture is complete, after ${seconds(state.seconds)}.`);
        break;
      case "failed":
        fill(box, "failed");
        box.title = state.message;
        this.words.announce(`The render failed: ${state.message}`);
        break;
      case "idle":
        fill(box);
    }
  }

  /** The bar and the window's title, after the document or whether it is saved has changed. */
  showDocument(): void {
    const { current } = this.documents;
    const dirty = this.documents.dirty;
    const slash = current.name.lastIndexOf("/") + 1;
    fill(
      this.fileButton,
      icon(icons.open) as unknown as Node,
      h("span", { class: "unseen" }, "Open. Now: "),
      h("span", { class: "file-name" }, slash > 0 ? h("span", { class: "quiet" }, current.name.slice(0, slash)) : null, current.name.slice(slash)),
      dirty ? h("span", { class: "unsaved", title: "Not saved yet; kept in this browser until it is" }, "not saved") : null,
      icon(icons.down) as unknown as Node,
    );
    this.saveButton.disabled = !dirty && !current.untitled;
    this.editorPane.dataset["version"] = String(current.version);
    document.title = `${dirty ? "• " : ""}${current.name.slice(slash)} — hray studio`;
  }

  /** A new document is shown: what belonged to the one before goes. */
  documentShown(time: number): void {
    this.closePeek();
    this.items = [];
    this.setProblems([]);
    this.explainPanel.clear();
    fill(this.summaryBox);
    this.pane.reset(time);
    this.showRender({ is: "idle" });
    this.showDocument();
    this.sendAll();
  }

  // --- Below ---

  private selected(): DockTab {
    return this.tabs.problems.getAttribute("aria-selected") === "true" ? "problems" : "pixel";
  }

  private showTab(tab: DockTab, open: boolean): void {
    for (const name of ["problems", "pixel"] as const) {
      const on = name === tab;
      this.tabs[name].setAttribute("aria-selected", String(on));
      this.tabs[name].tabIndex = on ? 0 : -1;
      const panel = this.dock.querySelector<HTMLElement>(`#panel-${name}`);
      if (panel) panel.hidden = !on;
    }
    if (open) this.openDock(true, false);
  }

  private openDock(open: boolean, byHand = true): void {
    this.dock.classList.toggle("closed", !open);
    // Folded away by hand, it does not open by itself again.
    if (byHand) this.dock.dataset["folded"] = String(!open);
    const fold = this.dock.querySelector(".fold");
    fold?.setAttribute("aria-label", open ? "Fold away" : "Unfold");
    fold?.setAttribute("aria-expanded", String(open));
  }

  private placeOf(problem: Problem): string {
    if (problem.file && problem.file !== this.documents.current.name) return problem.file;
    const { line, column } = this.editor.position(problem.from);
    return `${line}:${column}`;
  }

  private goToProblem(problem: Problem): void {
    if (problem.file && problem.file !== this.documents.current.name) {
      void this.documents.open(problem.file).then((opened) => opened && this.selectOnDisk(problem));
    } else {
      this.editor.select(problem.from, problem.to, false);
    }
  }

  private nextProblem(): void {
    const here = this.items.filter((problem) => !problem.file || problem.file === this.documents.current.name);
    const { head } = this.editor.state.selection.main;
    const next = here.find((problem) => problem.from > head) ?? here[0];
    if (next) {
      this.editor.select(next.from, next.from);
      this.showTab("problems", true);
    } else if (this.items[0]) this.goToProblem(this.items[0]);
    else this.say("There are no problems.");
  }

  private async explainPixel(x: number, y: number, asked = true): Promise<void> {
    const turn = ++this.explaining;
    if (asked) {
      this.showTab("pixel", true);
      this.explainPanel.waiting(x, y);
    }
    this.flushEdit();
    const { name, version } = this.documents.current;
    try {
      const explanation = await this.engine.request("explain", { doc: name, version, x, y, time: this.pane.time });
      if (turn !== this.explaining || version !== this.documents.current.version) return;
      this.explainPanel.show(explanation);
      if (!asked) return;
      const place = explanation.object?.place;
      if (place && this.isHere(place)) await this.jump(place, false);
      this.words.announce(explanation.object ? `Pixel ${x}, ${y}: ${explanation.object.kind}${place ? `, line ${place.line}` : ""}` : `Pixel ${x}, ${y}: background`);
    } catch (error) {
      if (turn === this.explaining) this.explainPanel.failed(explainError(error));
    }
  }

  private isHere(place: Place): boolean {
    return place.path === this.documents.current.name;
  }

  /** Selects what the engine found in a file that was not shown. */
  private selectOnDisk({ from, to }: { from: number; to: number }): void {
    this.editor.select(this.documents.fromDisk(from), this.documents.fromDisk(to));
  }

  private async jump(place: Place, focus: boolean): Promise<void> {
    if (this.isHere(place)) this.editor.select(place.from, place.to, focus);
    else if (await this.documents.open(place.path)) this.selectOnDisk(place);
  }

  // --- Read-only texts over the editor ---

  private openPeek(definition: Definition): void {
    this.closePeek();
    if (definition.text === null) {
      this.say(`${definition.name} is part of the language itself.`);
      return;
    }
    const panel = h(
      "div",
      { class: "peek", role: "region", "aria-label": `${definition.name}, read only` },
      h("div", { class: "peek-head" }, h("span", {}, h("strong", {}, definition.name), h("span", { class: "quiet" }, " of the library, read only")), iconButton("close", "Back to the scene", () => this.closePeek(), { key: "Esc" })),
    );
    panel.addEventListener("keydown", (event) => {
      if (event.key === "Escape") {
        event.preventDefault();
        this.closePeek();
      }
    });
    this.editorPane.append(panel);
    this.peek = readOnlyView(panel, definition.text, definition, definition.name);
    this.peek.focus();
  }

  private closePeek(): void {
    if (!this.peek) return;
    this.peek.destroy();
    this.peek = null;
    this.editorPane.querySelector(".peek")?.remove();
    this.editor.view.focus();
  }

  // --- Actions ---

  async format(): Promise<void> {
    const answer = await this.ask("format", {});
    if (!answer) return;
    if (answer.text === this.editor.text) this.say("The text is already laid out in the common style.");
    else {
      const { state } = this.editor;
      const old = state.doc.toString();
      let from = 0;
      while (from < old.length && from < answer.text.length && old[from] === answer.text[from]) from++;
      let end = 0;
      const least = Math.min(old.length, answer.text.length) - from;
      while (end < least && old[old.length - 1 - end] === answer.text[answer.text.length - 1 - end]) end++;
      this.editor.edit([{ from, to: old.length - end, text: answer.text.slice(from, answer.text.length - end) }]);
    }
  }

  private async rename(): Promise<void> {
    const at = this.editor.state.selection.main.head;
    const word = this.editor.state.wordAt(at);
    const old = word ? this.editor.state.sliceDoc(word.from, word.to) : "";
    const name = await ask("Rename", "New name, everywhere in this scene", old, "Rename", (text) => (/^[\p{Ll}\p{Lo}_][\p{L}\p{N}_']*$/u.test(text) ? null : "A name begins with a small letter and has letters, digits, _ and ' after it."));
    if (!name || name === old) return;
    const answer = await this.ask("rename", { at, name });
    if (!answer) return;
    const here = answer.files.find((file) => file.doc === this.documents.current.name)?.edits ?? [];
    const others = answer.files.filter((file) => file.doc !== this.documents.current.name);
    if (others.length === 0 || (await this.documents.changeOthers(others, old))) this.editor.edit(here);
  }

  private pictureMenu(button: HTMLElement): void {
    const formats = this.hello?.formats ?? [];
    openMenu(
      button,
      [
        { label: "Copy to the clipboard", run: () => void this.copyPicture() },
        ...formats.map((format) => ({ label: `Save as ${format.name.toUpperCase()}`, hint: `.${format.extension}`, run: () => void this.savePicture(format.name) })),
      ],
      "Save or copy the picture",
    );
  }

  private async savePicture(format: string): Promise<void> {
    this.flushEdit();
    const { name, version } = this.documents.current;
    if (this.rendering) {
      this.say("A picture is being rendered to be saved. One at a time.");
      return;
    }
    this.rendering = true;
    const late = setTimeout(() => this.say("Rendering the picture to save it; it comes as a download."), 400);
    try {
      const file = await this.engine.request("render-file", { doc: name, version, time: this.pane.time, format });
      download(file.name, file.mime, file.bytes as Uint8Array<ArrayBuffer>);
    } catch (error) {
      this.fail(error);
    } finally {
      clearTimeout(late);
      this.rendering = false;
    }
  }

  private async copyPicture(): Promise<void> {
    try {
      const blob = new Promise<Blob>((resolve, reject) => this.pane.picture.canvas.toBlob((made) => (made ? resolve(made) : reject(new Error("The picture cannot be copied."))), "image/png"));
      await navigator.clipboard.write([new ClipboardItem({ "image/png": blob })]);
      this.say("The picture is on the clipboard.");
    } catch {
      this.say("This browser does not let the page copy a picture; save it instead.");
    }
  }

  private async showCommand(): Promise<void> {
    const { name } = this.documents.current;
    try {
      const { command } = await this.engine.request("command", { doc: name, time: this.pane.time, width: null, height: null });
      const dialog = openDialog("This view as a command line", { class: "narrow" });
      const field = h("pre", { class: "command", tabindex: 0 }, command);
      const { untitled } = this.documents.current;
      if (untitled) dialog.body.append(h("p", { class: "quiet" }, "This scene has no file yet: save it first, under this name."));
      else if (this.documents.dirty) dialog.body.append(h("p", { class: "quiet" }, "The text is not saved yet; the command renders what was saved last."));
      const copy = h(
        "button",
        {
          type: "button",
          class: "primary",
          onclick: async () => {
            await navigator.clipboard.writeText(command);
            copy.textContent = "Copied";
          },
        },
        "Copy",
      );
      dialog.body.append(field, h("div", { class: "actions" }, copy));
      copy.focus();
    } catch (error) {
      this.fail(error);
    }
  }

  private async share(): Promise<void> {
    let fragment: string;
    try {
      fragment = await encodeShare(this.editor.text);
    } catch (error) {
      this.fail(error);
      return;
    }
    history.replaceState(null, "", fragment);
    // A reload shows what is typed from now on, and not the link again.
    sessionStorage.setItem("hray:shared", fragment);
    try {
      await navigator.clipboard.writeText(location.href);
      this.say("The link is on the clipboard. It carries the whole scene.");
    } catch {
      this.say("The link is in the address bar. It carries the whole scene.");
    }
  }

  private switchTheme(): void {
    const theme = nextTheme(currentTheme());
    applyTheme(theme);
    this.say(theme === "auto" ? "Light or dark, as the system has it." : theme === "dark" ? "Dark." : "Light.");
  }

  // --- Words above the work ---

  /** Shows something that stays until it is settled; null takes it away. */
  banner(key: string, text: string | null, ...actions: { label: string; run(): void }[]): void {
    this.bannerActions.get(key)?.remove();
    this.bannerActions.delete(key);
    if (text === null) return;
    const banner = h(
      "div",
      { class: "banner", role: "alert", "data-banner": key },
      h("span", {}, text),
      ...actions.map((action) => h("button", { type: "button", class: "plain", onclick: () => action.run() }, action.label)),
    );
    this.bannerActions.set(key, banner);
    this.banners.append(banner);
  }

  // --- Keys ---

  private listen(): void {
    addEventListener("keydown", (event) => {
      const mod = event.ctrlKey || event.metaKey;
      const key = event.key.toLowerCase();
      const dialogOpen = document.querySelector("dialog[open]") !== null;
      if (mod && key === "s") {
        if (!dialogOpen) void (event.shiftKey ? this.documents.saveAs() : this.documents.save());
      } else if (dialogOpen) return;
      else if (mod && key === "o" && !event.shiftKey) this.documents.choose(false);
      else if (event.key === "F1") openKeys(this.hello?.version ?? "");
      else if (event.key === "F2") void this.rename();
      else if (event.key === "F6") this.nextPart(event.shiftKey ? -1 : 1);
      else if (event.key === "F8") this.nextProblem();
      else if (event.altKey && event.shiftKey && event.code === "KeyF") void this.format();
      else if (event.altKey && event.code === "Space") this.pane.timeline.toggle();
      else if (event.key === "?" && !(event.target as Element).closest("input, textarea, .cm-editor")) openKeys(this.hello?.version ?? "");
      else return;
      event.preventDefault();
    });
  }

  /** Moves the focus to the next part of the page. */
  private nextPart(by: number): void {
    const parts: [HTMLElement, () => void][] = [
      [this.editorPane, () => (this.peek ?? this.editor.view).focus()],
      [this.pane.element, () => this.pane.picture.element.focus()],
      [this.dock, () => this.tabs[this.selected()].focus()],
      [this.bar, () => this.fileButton.focus()],
    ];
    const at = parts.findIndex(([part]) => part.contains(document.activeElement));
    const next = parts[(at + by + parts.length) % parts.length];
    next?.[1]();
  }
}

function fact(text: string, title: string): HTMLElement {
  return h("span", { class: "fact", title }, text);
}

function plural(count: number, word: string): string {
  return `${count.toLocaleString("en")} ${word}${count === 1 ? "" : "s"}`;
}

function seconds(value: number): string {
  if (value < 0.0995) return `${Math.max(1, Math.round(value * 1000))} ms`;
  if (value < 60) return `${value.toFixed(value < 10 ? 2 : 1)} s`;
  return `${Math.floor(value / 60)} min ${Math.round(value % 60)} s`;
}
