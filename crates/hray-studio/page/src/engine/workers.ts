// The same engine compiled to WebAssembly, one instance in each of several workers. All are given the same texts and
// views; one answers questions; the tiles of a picture are dealt out among all.

import { Signal } from "../signal";
import { EngineError, type Engine, type EngineState } from "./engine";
import type { Conflict, Events, Requests } from "./protocol";

export type ToWorker =
  | { kind: "start"; glue: string; module: WebAssembly.Module; cores: number; depth: number }
  | { kind: "ask"; message: string }
  | { kind: "file"; message: string }
  | { kind: "show"; number: number; view: string }
  | { kind: "tile"; number: number; pass: number; index: number };

export type FromWorker =
  | { kind: "ready" }
  | { kind: "answer"; answer: string }
  | { kind: "file"; answer: string; bytes: ArrayBuffer }
  | { kind: "shown"; number: number; shown: string }
  | { kind: "tile"; number: number; pass: number; bytes: ArrayBuffer; rays: number }
  /** It is of no more use; `deep` where it had called too deeply for the browser. */
  | { kind: "crashed"; deep: boolean };

/** How long a worker may be at something that is no longer wanted, in milliseconds. */
const PATIENCE = 1500;
/** How long it may be at anything but starting. */
const MOST_PATIENCE = 60_000;
const MOST_WORKERS = 16;
/** How deeply a scene may call: as far as the browser's stack goes, or, where that was not enough, as is safe in all. */
const DEPTH = 2000;
const CAREFUL_DEPTH = 150;

interface Question {
  message: string;
  file: boolean;
  resolve: (answer: never) => void;
  reject: (error: Error) => void;
}

/** One worker: what it does, and what it has still to be told. */
interface Lane {
  worker: Worker;
  depth: number;
  busy: ToWorker | null;
  since: number;
  started: boolean;
  /** Documents whose newest text, or end, it does not have yet. */
  behind: Set<string>;
  questions: Question[];
  asking: Question | null;
  /** The number of the picture that it has prepared, or could not. */
  shown: number;
  rays: number;
}

/** The picture that is being rendered. */
interface Picture {
  number: number;
  tiles: number[];
  pass: number;
  next: number;
  out: number;
  began: number;
  told: number;
  raysBefore: number;
  rgb: Uint8Array | null;
  width: number;
  height: number;
}

interface Answer {
  id: number;
  ok?: unknown;
  error?: { message: string; help?: string | null; conflict?: Conflict | null };
}

export class WorkerEngine implements Engine {
  readonly kind = "worker";
  readonly state = new Signal<EngineState>("connecting");
  private readonly lanes: Lane[] = [];
  private readonly listeners: ((event: Events) => void)[] = [];
  private readonly documents = new Map<string, { version: number; text: string }>();
  private module: WebAssembly.Module | null = null;
  private view: Requests["view"][0] | null = null;
  private number = 0;
  private began = 0;
  /** Whether the events of the newest picture were told. */
  private told = 0;
  private picture: Picture | null = null;
  private next = 1;
  /** How deeply new workers may call. */
  private depth = DEPTH;
  private readonly cores = Math.max(1, Math.min(MOST_WORKERS, navigator.hardwareConcurrency || 2));

  constructor() {
    void this.start();
    setInterval(() => this.watch(), 300);
  }

  on(listener: (event: Events) => void): void {
    this.listeners.push(listener);
  }

  private tell(event: Events): void {
    for (const listener of this.listeners) listener(event);
  }

  private async start(): Promise<void> {
    try {
      const answer = await fetch(new URL("engine/hray_playground_bg.wasm", document.baseURI));
      if (answer.status === 404) {
        this.tell({ event: "failed", frame: 0, doc: "", message: "There is no engine here. Is this `hray studio`? Then open the whole address that it printed, with its token." });
        return;
      }
      if (!answer.ok) throw new Error(`${answer.status}`);
      // Servers that do not know the type of WebAssembly are common.
      this.module = await WebAssembly.compile(await answer.arrayBuffer());
    } catch (error) {
      this.tell({ event: "failed", frame: 0, doc: "", message: `The engine cannot be loaded (${String(error)}). Reload the page to try again.` });
      return;
    }
    for (let index = 0; index < this.cores; index++) this.lanes.push(this.hire());
  }

  private hire(): Lane {
    const worker = new Worker(new URL("./engine-worker.ts", import.meta.url), { type: "module" });
    const lane: Lane = { worker, depth: this.depth, busy: null, since: 0, started: false, behind: new Set(this.documents.keys()), questions: [], asking: null, shown: 0, rays: 0 };
    worker.onmessage = (event: MessageEvent<FromWorker>) => this.receive(lane, event.data);
    worker.onerror = () => this.receive(lane, { kind: "crashed", deep: false });
    if (this.module) this.order(lane, { kind: "start", glue: new URL("engine/hray_playground.js", document.baseURI).href, module: this.module, cores: this.cores, depth: this.depth });
    return lane;
  }

  private order(lane: Lane, message: ToWorker): void {
    lane.busy = message;
    lane.since = performance.now();
    lane.worker.postMessage(message);
  }

  request<K extends keyof Requests>(what: K, parameters: Requests[K][0]): Promise<Requests[K][1]> {
    type Result = Requests[K][1];
    switch (what) {
      case "edit": {
        const { doc, version, text } = parameters as Requests["edit"][0];
        this.documents.set(doc, { version, text });
        for (const lane of this.lanes) lane.behind.add(doc);
        this.dare();
        if (this.view?.doc === doc) this.show();
        else this.pump();
        return Promise.resolve({} as Result);
      }
      case "close": {
        const { doc } = parameters as Requests["close"][0];
        this.documents.delete(doc);
        for (const lane of this.lanes) lane.behind.add(doc);
        if (this.view?.doc === doc) {
          this.view = null;
          this.picture = null;
        }
        this.pump();
        return Promise.resolve({} as Result);
      }
      case "view":
        this.view = parameters as Requests["view"][0];
        this.show();
        return Promise.resolve({} as Result);
      case "stop":
        this.picture = null;
        return Promise.resolve({} as Result);
      default:
    }
    return new Promise((resolve, reject) => {
      const message = JSON.stringify({ id: this.next++, do: what, ...parameters });
      const file = what === "render-file";
      // Questions go to the first; a file, which takes long, to the last.
      const lane = this.lanes[file ? this.lanes.length - 1 : 0];
      if (!lane) {
        reject(new EngineError("The engine is not loaded yet."));
        return;
      }
      lane.questions.push({ message, file, resolve: resolve as (answer: never) => void, reject });
      this.pump();
    });
  }

  /** What is shown has changed: the picture in progress is not wanted any more. */
  private show(): void {
    this.number++;
    this.picture = null;
    this.began = performance.now();
    this.pump();
  }

  private pump(): void {
    for (const lane of this.lanes) if (!lane.busy && lane.started) this.give(lane);
  }

  /** Gives a worker that waits the most urgent of what there is for it to do. */
  private give(lane: Lane): void {
    const [late] = lane.behind;
    if (late !== undefined) {
      lane.behind.delete(late);
      const document = this.documents.get(late);
      const message = document ? { do: "edit", doc: late, ...document } : { do: "close", doc: late };
      this.order(lane, { kind: "ask", message: JSON.stringify({ id: 0, ...message }) });
      return;
    }
    const question = lane.questions.shift();
    if (question) {
      lane.asking = question;
      this.order(lane, { kind: question.file ? "file" : "ask", message: question.message });
      return;
    }
    if (this.view && lane.shown !== this.number) {
      this.order(lane, { kind: "show", number: this.number, view: JSON.stringify(this.view) });
      return;
    }
    const { picture } = this;
    if (picture && picture.number === lane.shown && picture.next < (picture.tiles[picture.pass] ?? 0)) {
      picture.out++;
      this.order(lane, { kind: "tile", number: picture.number, pass: picture.pass, index: picture.next++ });
    }
  }

  private receive(lane: Lane, message: FromWorker): void {
    if (message.kind === "crashed") {
      if (message.deep && lane.busy?.kind !== "tile" && lane.depth > CAREFUL_DEPTH) {
        // Another one comes to the same place, and says which call goes too deep.
        this.depth = CAREFUL_DEPTH;
        this.replace(lane);
      } else this.crashed(lane, "the engine gave up on this scene, which may need more memory or a deeper stack than a browser has; the program itself has them");
      return;
    }
    lane.busy = null;
    switch (message.kind) {
      case "ready":
        lane.started = true;
        if (lane === this.lanes[0]) this.state.value = "open";
        break;
      case "answer":
        this.answer(lane, JSON.parse(message.answer || "{}"), null);
        break;
      case "file":
        this.answer(lane, JSON.parse(message.answer), message.bytes);
        break;
      case "shown":
        lane.shown = message.number;
        this.shown(message.number, JSON.parse(message.shown));
        break;
      case "tile":
        lane.rays = message.rays;
        this.tile(message);
    }
    this.pump();
  }

  private answer(lane: Lane, answer: Answer, bytes: ArrayBuffer | null): void {
    const question = lane.asking;
    if (!question) return;
    lane.asking = null;
    if (answer.error) question.reject(new EngineError(answer.error.message, answer.error.help ?? null, answer.error.conflict ?? null));
    else if (bytes) question.resolve({ ...(answer.ok as object), bytes: new Uint8Array(bytes, 8) } as never);
    else question.resolve(answer.ok as never);
  }

  private shown(number: number, shown: { events: Events[]; tiles: number[] }): void {
    // All workers say the same; the first is heard.
    if (number !== this.number || this.told === number) return;
    this.told = number;
    for (const event of shown.events) {
      if (event.event === "frame") {
        this.picture = {
          number,
          tiles: shown.tiles,
          pass: 0,
          next: 0,
          out: 0,
          began: this.began,
          told: 0,
          raysBefore: this.rays(),
          rgb: new Uint8Array(event.width * event.height * 3),
          width: event.width,
          height: event.height,
        };
      }
      this.tell(event);
    }
  }

  private rays(): number {
    return this.lanes.reduce((sum, lane) => sum + lane.rays, 0);
  }

  private tile(message: Extract<FromWorker, { kind: "tile" }>): void {
    const { picture } = this;
    if (!picture || picture.number !== message.number) return;
    picture.out--;
    const head = new DataView(message.bytes);
    if (message.bytes.byteLength >= 28) {
      const at = (index: number) => head.getUint32(index * 4, true);
      const [x, y, w, h, step] = [at(2), at(3), at(4), at(5), at(6)];
      const data = new Uint8ClampedArray(message.bytes, 28);
      if (picture.rgb && picture.pass === picture.tiles.length - 1) put(picture.rgb, picture.width, x, y, w, h, data);
      this.tell({ event: "pixels", frame: picture.number, x, y, w, h, step, data });
    }
    const all = picture.tiles[picture.pass] ?? 0;
    const now = performance.now();
    const seconds = (now - picture.began) / 1000;
    if (picture.next >= all && picture.out === 0) {
      // A pass ends before the next begins, or a coarse tile might cover a fine one.
      picture.pass++;
      picture.next = 0;
      if (picture.pass >= picture.tiles.length) {
        this.picture = null;
        void this.done(picture, seconds);
        return;
      }
    }
    if (now - picture.told > 100) {
      picture.told = now;
      const last = picture.pass === picture.tiles.length - 1;
      const done = last ? picture.next / Math.max(1, picture.tiles[picture.pass] ?? 1) : 0;
      this.tell({ event: "progress", frame: picture.number, pass: picture.pass, done, seconds });
    }
  }

  private async done(picture: Picture, seconds: number): Promise<void> {
    const rays = this.rays() - picture.raysBefore;
    const hash = picture.rgb && crypto.subtle ? await ppmHash(picture.rgb, picture.width, picture.height) : null;
    this.tell({ event: "done", frame: picture.number, seconds, rays, hash });
  }

  /** The text is another: it may call as deeply as ever. */
  private dare(): void {
    if (this.depth === DEPTH) return;
    this.depth = DEPTH;
    for (const lane of [...this.lanes]) if (lane.depth !== DEPTH) this.replace(lane);
  }

  /** Another worker in the place of one, that is asked the same again. */
  private replace(lane: Lane): Lane {
    lane.worker.terminate();
    const fresh = this.hire();
    fresh.questions = lane.asking ? [lane.asking, ...lane.questions] : lane.questions;
    this.lanes[this.lanes.indexOf(lane)] = fresh;
    return fresh;
  }

  /** A worker is given up, and another one takes its place. */
  private crashed(lane: Lane, why: string): void {
    const index = this.lanes.indexOf(lane);
    if (index < 0) return;
    if (!lane.started) {
      lane.worker.terminate();
      this.tell({ event: "failed", frame: 0, doc: "", message: "The engine cannot be started in this browser. It needs WebAssembly with SIMD." });
      this.lanes.splice(index, 1);
      return;
    }
    const { busy, asking } = lane;
    lane.asking = null;
    asking?.reject(new EngineError(why));
    const fresh = this.replace(lane);
    if (busy?.kind === "show" || busy?.kind === "tile") {
      // The same would happen again: this picture is not tried again.
      fresh.shown = busy.number;
      if (busy.number === this.number && this.told !== -busy.number) {
        this.told = -busy.number;
        this.picture = null;
        for (const other of this.lanes) other.shown = this.number;
        this.tell({ event: "failed", frame: busy.number, doc: this.view?.doc ?? "", message: why });
      }
    }
  }

  /** Ends what takes too long: nothing inside a worker can be interrupted. */
  private watch(): void {
    const now = performance.now();
    for (const lane of [...this.lanes]) {
      const { busy } = lane;
      if (!busy || !lane.started) continue;
      const took = now - lane.since;
      const unwanted = (busy.kind === "show" || busy.kind === "tile") && busy.number !== this.number;
      if (unwanted && took > PATIENCE) this.crashed(lane, "this took too long");
      else if (busy.kind !== "file" && took > MOST_PATIENCE) this.crashed(lane, "the scene takes too long; make it simpler, or render it with the program");
    }
  }
}

/** Copies a tile into a picture. */
function put(rgb: Uint8Array, width: number, x: number, y: number, w: number, h: number, data: Uint8ClampedArray): void {
  for (let row = 0; row < h; row++) {
    let to = ((y + row) * width + x) * 3;
    let from = row * w * 4;
    for (let column = 0; column < w; column++) {
      rgb[to++] = data[from] ?? 0;
      rgb[to++] = data[from + 1] ?? 0;
      rgb[to++] = data[from + 2] ?? 0;
      from += 4;
    }
  }
}

/** SHA-256 of a picture as a PPM file. */
async function ppmHash(rgb: Uint8Array, width: number, height: number): Promise<string> {
  const head = new TextEncoder().encode(`P6\n${width} ${height}\n255\n`);
  const file = new Uint8Array(head.length + rgb.length);
  file.set(head);
  file.set(rgb, head.length);
  const digest = await crypto.subtle.digest("SHA-256", file);
  return [...new Uint8Array(digest)].map((byte) => byte.toString(16).padStart(2, "0")).join("");
}
