// The document that is shown: where it comes from, whether it is saved, and how its text survives whatever happens.

import type { EditorState } from "@codemirror/state";
import type { Studio } from "./app";
import { claimTab, Drafts, liveTabs, type Draft } from "./drafts";
import { download } from "./dom";
import { EngineError, explainError } from "./engine/engine";
import type { Conflict, Hello, TextEdit } from "./engine/protocol";
import { decodeShare } from "./share";
import { STARTER } from "./starter";
import { openConflict } from "./ui/conflict";
import { ask, confirm } from "./ui/dialog";
import { openChooser } from "./ui/open";

interface Document {
  /** Its path within the folder, or a name of its own while it has none. */
  name: string;
  /** Whether it has no file yet. */
  untitled: boolean;
  /** The state of the file that the text is based on. */
  disk: string | null;
  /** The text that counts as saved. */
  saved: string;
  /** Grows with each change of any document of this page. */
  version: number;
  /** The text of its file as it was read, where that has other line ends than the editor's. */
  raw: string | null;
  /** What is on disk, where that is neither what the text is based on nor the text itself. */
  conflict: Conflict | null;
}

const KEEP_AFTER = 120;

/** A text as the editor has it: with one kind of line end. */
function plain(text: string): string;
function plain(text: string | null): string | null;
function plain(text: string | null): string | null {
  return text === null ? null : text.replace(/\r\n?/g, "\n");
}

export class Documents {
  current: Document = { name: "", untitled: true, disk: null, saved: "", version: 0, raw: null, conflict: null };
  private drafts: Drafts | null = null;
  private root = "";
  private timer = 0;
  private versions = 0;
  /** Editors as they were left, so that undo works when one comes back. */
  private readonly left = new Map<string, EditorState>();
  /** The moments at which they were left. */
  private readonly times = new Map<string, number>();
  private saving: Promise<unknown> = Promise.resolve();

  constructor(private readonly studio: Studio) {
    const flush = () => this.keep();
    addEventListener("pagehide", flush);
    document.addEventListener("visibilitychange", () => {
      if (document.visibilityState === "hidden") flush();
    });
    addEventListener("hashchange", () => void this.openShared());
  }

  get dirty(): boolean {
    return this.studio.editor.text !== this.current.saved;
  }

  /** The first document of this page. */
  async begin(hello: Hello): Promise<void> {
    this.root = hello.root;
    const tab = await claimTab();
    this.drafts = new Drafts(tab, (why) => this.studio.banner("drafts", `The browser does not keep unsaved text (${why}). Save often.`));
    if (await this.openShared()) return;
    const before = sessionStorage.getItem("hray:root") === this.root ? sessionStorage.getItem("hray:doc") : null;
    sessionStorage.setItem("hray:root", this.root);
    if (before) {
      const mine = (await this.drafts.all(this.root)).find((draft) => draft.tab === tab && draft.doc === before);
      const known = hello.files.some((file) => file.path === before);
      if (before.startsWith("untitled-") && !known) {
        if (mine) {
          this.showDraft(mine);
          return;
        }
      } else if (await this.open(before)) return;
    }
    if (hello.start && (await this.open(hello.start))) return;
    await this.empty();
    // Where someone comes for the first time, or to a folder, there is a choice to make; the scene behind it is alive.
    const waiting = await this.orphans();
    if (this.studio.engine.kind === "socket" || waiting.length > 0) this.choose(true);
  }

  /** The engine has come back: it knows nothing. */
  async again(hello: Hello): Promise<void> {
    if (hello.root !== this.root && this.root !== "") {
      this.studio.banner("root", `Another folder was opened here: ${hello.root}. What you typed is kept; saving is off until the old folder is back.`);
      return;
    }
    this.studio.banner("root", null);
    this.studio.sendAll();
    if (this.current.untitled) return;
    try {
      const file = await this.studio.engine.request("open", { path: this.current.name });
      this.onDisk(file.path, file.disk, file.text);
    } catch {
      // It is gone, or the engine is again; saving will tell.
    }
  }

  /** After each change of the text. */
  edited(byUser: boolean): void {
    this.current.version = ++this.versions;
    this.studio.showDocument();
    clearTimeout(this.timer);
    if (byUser || this.dirty) this.timer = window.setTimeout(() => this.keep(), KEEP_AFTER);
  }

  /** Keeps the text in the browser where it is not saved. */
  private keep(): void {
    clearTimeout(this.timer);
    const { name, disk } = this.current;
    if (!this.drafts || !name) return;
    if (this.dirty) this.drafts.keep({ root: this.root, doc: name, text: this.studio.editor.text, disk });
    else this.drafts.drop(this.root, name);
  }

  /** Keeps a text that is about to be replaced, as a document of its own. */
  private async shelve(text: string): Promise<string> {
    const name = await this.untitledName();
    this.drafts?.keep({ root: this.root, doc: name, text, disk: null });
    return name;
  }

  private leave(next: string): void {
    this.keep();
    const { name } = this.current;
    if (!name) return;
    this.left.set(name, this.studio.editor.state);
    this.times.set(name, this.studio.time);
    if (name !== next) this.studio.send("close", { doc: name });
  }

  /** Where an offset into a file is in the text of the editor. */
  fromDisk(offset: number): number {
    const { raw } = this.current;
    return raw === null ? offset : plain(raw.slice(0, offset)).length;
  }

  /** Writes a file, with the line ends that it had. */
  private store(doc: string, text: string, disk: string | null): Promise<{ disk: string }> {
    const { raw } = this.current;
    const end = raw === null ? "\n" : raw.includes("\r\n") ? "\r\n" : "\r";
    return this.studio.engine.request("save", { doc, text: end === "\n" ? text : text.replaceAll("\n", end), disk });
  }

  private show(document: Omit<Document, "version" | "raw"> & { raw?: string | null }, text: string): void {
    this.leave(document.name);
    this.studio.banner("found", null);
    this.current = { raw: null, ...document, version: ++this.versions };
    sessionStorage.setItem("hray:doc", document.name);
    const left = this.left.get(document.name);
    this.studio.editor.show(left && left.doc.toString() === text ? left : text);
    this.studio.documentShown(this.times.get(document.name) ?? 0);
    this.tellConflict();
  }

  private showDraft(draft: Draft): void {
    this.show({ name: draft.doc, untitled: true, disk: null, saved: draft.text === STARTER ? STARTER : "", conflict: null }, draft.text);
  }

  /** Opens a file; false where that cannot be done, which is told. */
  async open(path: string): Promise<boolean> {
    const drafts = this.drafts;
    if (!drafts) return false;
    this.keep();
    const mine = await this.draftOf(path);
    let file: { path: string; text: string; disk: string | null };
    try {
      file = await this.studio.engine.request("open", { path });
    } catch (error) {
      if (mine && error instanceof EngineError) {
        this.show({ name: path, untitled: false, disk: null, saved: "", conflict: null }, mine.text);
        this.studio.banner("found", `${path} cannot be read, but its unsaved text is still here: ${explainError(error)}`);
        return true;
      }
      this.studio.fail(error);
      return false;
    }
    const text = plain(file.text);
    const raw = text === file.text ? null : file.text;
    if (!mine || mine.text === text) {
      if (mine) drafts.drop(this.root, mine.doc, mine.tab);
      this.show({ name: file.path, untitled: false, disk: file.disk, saved: text, raw, conflict: null }, text);
      return true;
    }
    const changed = mine.disk !== file.disk;
    this.show({ name: file.path, untitled: false, disk: mine.disk, saved: text, raw, conflict: changed ? { disk: file.disk, text } : null }, mine.text);
    if (mine.tab !== drafts.tab) {
      drafts.drop(this.root, mine.doc, mine.tab);
      this.keep();
    }
    if (!changed) {
      const when = new Date(mine.at).toLocaleTimeString([], { hour: "2-digit", minute: "2-digit" });
      this.studio.words.say(`Here is the text that was not saved yet, from ${when}.`, {
        label: "Show the file instead",
        run: () => {
          if (this.current.name === file.path) this.studio.editor.replace(text);
        },
      });
    }
    return true;
  }

  /** The unsaved text of a file: this tab's, or that of a tab that is gone. */
  private async draftOf(path: string): Promise<Draft | null> {
    const drafts = this.drafts;
    if (!drafts) return null;
    const all = (await drafts.all(this.root)).filter((draft) => draft.doc === path);
    const live = await liveTabs();
    return all.find((draft) => draft.tab === drafts.tab) ?? all.find((draft) => !live.has(draft.tab)) ?? null;
  }

  /** Unsaved texts of tabs that are gone, and of this one where they are not shown. */
  private async orphans(): Promise<Draft[]> {
    const drafts = this.drafts;
    if (!drafts) return [];
    const live = await liveTabs();
    return (await drafts.all(this.root)).filter((draft) =>
      draft.tab === drafts.tab ? draft.doc !== this.current.name : !live.has(draft.tab),
    );
  }

  private async untitledName(): Promise<string> {
    const taken = new Set((await this.drafts?.all(this.root))?.map((draft) => draft.doc));
    for (const file of this.studio.hello?.files ?? []) taken.add(file.path);
    taken.add(this.current.name);
    for (let number = 1; ; number++) if (!taken.has(`untitled-${number}.hry`)) return `untitled-${number}.hry`;
  }

  /** A new scene that already shows something. */
  empty(): Promise<void> {
    return this.fresh(STARTER);
  }

  private async fresh(text: string): Promise<void> {
    const name = await this.untitledName();
    this.show({ name, untitled: true, disk: null, saved: text, conflict: null }, text);
  }

  private async example(name: string): Promise<void> {
    try {
      const { text } = await this.studio.engine.request("example", { name });
      await this.fresh(text);
    } catch (error) {
      this.studio.fail(error);
    }
  }

  /** The scene that the page's own address carries; false where it carries none. */
  private async openShared(): Promise<boolean> {
    if (!this.drafts) return false;
    try {
      const text = await decodeShare(location.hash);
      if (text === null || text === this.studio.editor.text) return false;
      // A reload of a changed scene shows what was typed, not what the link had.
      const before = sessionStorage.getItem("hray:doc");
      const shared = sessionStorage.getItem("hray:shared");
      if (before && shared === location.hash) return false;
      sessionStorage.setItem("hray:shared", location.hash);
      await this.fresh(text);
      this.current.saved = "";
      this.keep();
      this.current.saved = text;
      return true;
    } catch (error) {
      this.studio.say(`The scene in this link cannot be read: ${explainError(error)}`);
      return false;
    }
  }

  /** The dialog of what there is to open. */
  choose(welcome: boolean): void {
    const hello = this.studio.hello;
    if (!hello) return;
    // The key may come before the welcome is there.
    if (document.querySelector("dialog[open]")) return;
    this.keep();
    const folder = hello.canSave ? hello.root.replace(/^.*[\\/](?=[^\\/])/, "") : null;
    openChooser(
      {
        folder,
        files: hello.files,
        examples: hello.examples,
        drafts: this.orphans(),
        open: (path) => void this.open(path),
        example: (example) => void this.example(example.name),
        empty: () => void this.empty(),
        draft: (draft) => void this.adopt(draft),
        forget: (draft) => this.drafts?.drop(draft.root, draft.doc, draft.tab),
      },
      welcome,
    );
  }

  private async adopt(draft: Draft): Promise<void> {
    const drafts = this.drafts;
    if (!drafts) return;
    if (!draft.doc.startsWith("untitled-")) {
      await this.open(draft.doc);
      return;
    }
    this.showDraft(draft);
    if (draft.tab !== drafts.tab) {
      drafts.drop(draft.root, draft.doc, draft.tab);
      this.keep();
    }
  }

  // --- Saving ---

  save(): Promise<void> {
    return this.one(() => this.saveNow());
  }

  saveAs(): Promise<void> {
    return this.one(() => this.saveUnder());
  }

  /** One save at a time: the next begins where the one before has ended. */
  private one(work: () => Promise<void>): Promise<void> {
    const next = this.saving.then(work, work);
    this.saving = next;
    return next;
  }

  private async saveNow(): Promise<void> {
    const { current, studio } = this;
    if (!studio.hello?.canSave) {
      download(current.name, "text/plain", studio.editor.text);
      studio.say("The scene is in your downloads. In the browser, its text is kept as well.");
      return;
    }
    if (current.untitled) return this.saveUnder();
    if (current.conflict) return this.settle();
    const text = studio.editor.text;
    try {
      const { disk } = await this.store(current.name, text, current.disk);
      this.saved(current, text, disk);
    } catch (error) {
      if (error instanceof EngineError && error.conflict) {
        current.conflict = { ...error.conflict, text: plain(error.conflict.text) };
        if (this.current !== current) {
          studio.say(`${current.name} was not saved: it was changed on disk as well. Its text is kept; open it to look at both.`);
          return;
        }
        this.tellConflict();
        return this.settle();
      }
      studio.fail(error);
    }
  }

  /** A document is saved, which need not be the one that is shown by now. */
  private saved(current: Document, text: string, disk: string): void {
    const { studio } = this;
    current.disk = disk;
    current.saved = text;
    current.conflict = null;
    if (this.current === current) {
      this.tellConflict();
      studio.banner("found", null);
      this.keep();
      studio.showDocument();
    } else void this.savedElsewhere(current.name, text, disk);
    studio.words.announce(`Saved ${current.name}.`);
    studio.words.say(`Saved ${current.name}.`);
  }

  /** Of a document that is no longer shown a text was saved. What was typed after that is still kept. */
  private async savedElsewhere(name: string, text: string, disk: string | null): Promise<void> {
    const { drafts } = this;
    const mine = (await drafts?.all(this.root))?.find((draft) => draft.tab === drafts?.tab && draft.doc === name);
    if (!drafts || !mine) return;
    if (mine.text === text) drafts.drop(this.root, name);
    else if (disk !== null) drafts.keep({ root: this.root, doc: name, text: mine.text, disk });
  }

  private async saveUnder(): Promise<void> {
    const { studio, current } = this;
    if (!studio.hello?.canSave) return this.saveNow();
    const proposed = current.untitled ? "scene.hry" : current.name;
    const path = await ask("Save the scene", "Path in the folder", proposed, "Save", (typed) => {
      if (!typed) return "It needs a name.";
      if (typed.startsWith("/") || typed.split(/[\\/]/).includes("..")) return "The path lies within the opened folder, without `..`.";
      return typed.endsWith(".hry") ? null : "The name of a scene ends with .hry.";
    });
    if (path === null) return;
    const text = studio.editor.text;
    try {
      const known = path === current.name ? current.disk : null;
      const { disk } = await this.store(path, text, known);
      this.move(path, text, disk, current);
    } catch (error) {
      if (error instanceof EngineError && error.conflict) {
        const resolution = await openConflict(path, text, plain(error.conflict.text), `There is ${path} already`, "Write mine over it");
        if (resolution === "mine") {
          if (error.conflict.text !== null) await this.shelve(error.conflict.text);
          try {
            const { disk } = await this.store(path, text, error.conflict.disk);
            this.move(path, text, disk, current);
          } catch (again) {
            studio.fail(again);
          }
        } else if (resolution === "disk") {
          this.keep();
          await this.open(path);
        } else if (resolution === "copy") {
          await this.saveUnder();
        }
        return;
      }
      studio.fail(error);
    }
  }

  /** The document has a file, or another one, from now on. */
  private move(path: string, text: string, disk: string, from: Document): void {
    const { studio } = this;
    const before = from.name;
    if (this.current !== from) {
      void this.savedElsewhere(before, text, null);
      studio.say(`Saved ${path}.`);
      return;
    }
    if (path !== before) {
      this.drafts?.drop(this.root, before);
      this.left.delete(before);
      studio.send("close", { doc: before });
      this.current = { ...from, name: path, untitled: false, disk, saved: text, version: ++this.versions, conflict: null };
      sessionStorage.setItem("hray:doc", path);
      studio.sendAll();
      // From now on the engine tells when the file changes.
      void studio.engine.request("open", { path }).then((file) => this.onDisk(file.path, file.disk, file.text), () => undefined);
    }
    this.current.untitled = false;
    this.saved(this.current, text, disk);
  }

  /** Makes the same change in other files, once the user has agreed; false where nothing was changed. */
  async changeOthers(files: { doc: string; edits: TextEdit[] }[], old: string): Promise<boolean> {
    const { studio, drafts } = this;
    if (!drafts) return false;
    const unsaved = new Set((await drafts.all(this.root)).map((draft) => draft.doc));
    const held = files.find((file) => unsaved.has(file.doc));
    if (held) {
      studio.say(`${held.doc} uses ${old} as well, and has a text that is not saved yet. Save that one first.`);
      return false;
    }
    const places = files.map(({ doc, edits }) => `${doc} (${edits.length === 1 ? "one place" : `${edits.length} places`})`);
    if (!(await confirm("Other files use it as well", `${places.join(", ")}: changed too, and saved at once.`, "Rename everywhere"))) return false;
    const changed: string[] = [];
    try {
      for (const { doc, edits } of files) {
        try {
          const { text, disk } = await studio.engine.request("open", { path: doc });
          let result = text;
          for (const { from, to, text: by } of [...edits].sort((one, other) => other.from - one.from)) {
            if (text.slice(from, to) !== old) throw new Error(`${doc} has just changed.`);
            result = result.slice(0, from) + by + result.slice(to);
          }
          await studio.engine.request("save", { doc, text: result, disk });
        } finally {
          studio.send("close", { doc });
        }
        changed.push(doc);
      }
    } catch (error) {
      studio.say(`${changed.length > 0 ? `Renamed in ${changed.join(", ")}, but then: ` : ""}${explainError(error)}`);
      return changed.length > 0;
    }
    return true;
  }

  // --- The disk ---

  /** A file is not what it was. */
  onDisk(path: string, disk: string | null, found: string | null): void {
    const { current, studio } = this;
    if (path !== current.name || current.untitled || disk === current.disk) return;
    const text = plain(found);
    if (found !== null) current.raw = text === found ? null : found;
    const mine = studio.editor.text;
    if (text === mine && disk !== null) {
      current.disk = disk;
      current.saved = mine;
      current.conflict = null;
      this.tellConflict();
      this.keep();
      studio.showDocument();
      return;
    }
    if (!this.dirty && text !== null && disk !== null) {
      current.disk = disk;
      current.saved = text;
      studio.editor.replace(text);
      this.keep();
      studio.showDocument();
      studio.say(`${path} was changed on disk; this is its new text.`);
      return;
    }
    if (text === null) {
      // Nothing to compare with: what is here is all there is.
      current.disk = null;
      current.saved = "";
      this.keep();
      studio.showDocument();
      studio.banner("disk", `${path} is gone from disk. Its text is still here.`, { label: "Save it again", run: () => void this.save() });
      return;
    }
    current.conflict = { disk, text };
    this.tellConflict();
  }

  private tellConflict(): void {
    const { current, studio } = this;
    if (current.conflict) {
      studio.banner("disk", `${current.name} was changed on disk as well. Both texts are kept.`, { label: "Look at both", run: () => void this.settle() });
    } else {
      studio.banner("disk", null);
    }
  }

  /** Asks what is to become of two texts, and does it. */
  private async settle(): Promise<void> {
    const { current, studio } = this;
    const conflict = current.conflict;
    if (!conflict) return;
    const mine = studio.editor.text;
    const resolution = await openConflict(current.name, mine, conflict.text);
    if (this.current !== current || resolution === null) return;
    if (resolution === "copy") {
      await this.saveUnder();
    } else if (resolution === "disk" && conflict.text !== null) {
      const kept = await this.shelve(mine);
      current.disk = conflict.disk;
      current.saved = conflict.text;
      current.conflict = null;
      studio.editor.replace(conflict.text);
      this.keep();
      this.tellConflict();
      studio.showDocument();
      studio.say(`Your text is kept as ${kept}.`);
    } else {
      try {
        const { disk } = await this.store(current.name, mine, conflict.disk);
        if (conflict.text !== null) await this.shelve(conflict.text);
        this.saved(current, mine, disk);
      } catch (error) {
        if (error instanceof EngineError && error.conflict) {
          current.conflict = { ...error.conflict, text: plain(error.conflict.text) };
          this.tellConflict();
          return this.settle();
        }
        studio.fail(error);
      }
    }
  }
}
