// The native engine behind one WebSocket: control messages are JSON text frames, pixels and files are binary ones.

import { Signal } from "../signal";
import { EngineAway, EngineError, type Engine, type EngineState } from "./engine";
import type { Conflict, Events, Requests } from "./protocol";

interface Waiting {
  resolve: (answer: never) => void;
  reject: (error: Error) => void;
}

interface Answer {
  id: number;
  ok?: unknown;
  error?: { message: string; help?: string | null; conflict?: Conflict | null };
}

const FIRST_WAIT = 300;
const LONGEST_WAIT = 4000;

export class SocketEngine implements Engine {
  readonly kind = "socket";
  readonly state = new Signal<EngineState>("connecting");
  private socket: WebSocket | null = null;
  private listeners: ((event: Events) => void)[] = [];
  private waiting = new Map<number, Waiting>();
  /** Answers that promise a file, until its bytes are here. */
  private promised = new Map<number, { name: string; mime: string }>();
  private next = 1;
  private delay = FIRST_WAIT;
  private timer = 0;

  constructor(private readonly token: string) {
    this.connect();
    // A laptop that slept, or a network that came back: do not wait for the timer.
    addEventListener("online", () => this.hurry());
    document.addEventListener("visibilitychange", () => {
      if (document.visibilityState === "visible") this.hurry();
    });
  }

  on(listener: (event: Events) => void): void {
    this.listeners.push(listener);
  }

  request<K extends keyof Requests>(what: K, parameters: Requests[K][0]): Promise<Requests[K][1]> {
    const socket = this.socket;
    if (!socket || socket.readyState !== WebSocket.OPEN) return Promise.reject(new EngineAway());
    const id = this.next++;
    return new Promise((resolve, reject) => {
      this.waiting.set(id, { resolve: resolve as (answer: never) => void, reject });
      socket.send(JSON.stringify({ id, do: what, ...parameters }));
    });
  }

  /** Tries again at once where it is waiting to. */
  hurry(): void {
    if (this.socket || this.state.value === "open") return;
    clearTimeout(this.timer);
    this.connect();
  }

  private connect(): void {
    const address = new URL("ws", document.baseURI);
    address.protocol = address.protocol === "https:" ? "wss:" : "ws:";
    address.search = `?token=${encodeURIComponent(this.token)}`;
    address.hash = "";
    const socket = new WebSocket(address);
    socket.binaryType = "arraybuffer";
    this.socket = socket;
    socket.onopen = () => {
      this.delay = FIRST_WAIT;
      this.state.value = "open";
    };
    socket.onmessage = (message) => {
      if (typeof message.data === "string") this.receive(JSON.parse(message.data));
      else this.receiveBytes(message.data as ArrayBuffer);
    };
    socket.onclose = () => {
      this.socket = null;
      for (const { reject } of this.waiting.values()) reject(new EngineAway());
      this.waiting.clear();
      this.promised.clear();
      this.state.value = this.state.value === "connecting" ? "connecting" : this.state.value === "refused" ? "refused" : "away";
      void this.wait();
    };
  }

  private async wait(): Promise<void> {
    const refused = await this.isRefused();
    if (refused) this.state.value = "refused";
    else if (this.state.value !== "open") this.state.value = "away";
    this.timer = window.setTimeout(() => {
      if (!this.socket) this.connect();
    }, this.delay);
    this.delay = Math.min(this.delay * 1.6, LONGEST_WAIT);
  }

  /** Whether a server is there that does not know this page's token. */
  private async isRefused(): Promise<boolean> {
    try {
      const answer = await fetch(`alive?token=${encodeURIComponent(this.token)}`, { cache: "no-store" });
      if (!answer.ok) return answer.status === 401 || answer.status === 403;
      return ((await answer.json()) as { token?: boolean }).token === false;
    } catch {
      return false;
    }
  }

  private receive(message: Answer & Events): void {
    if (message.id === undefined) {
      this.tell(message);
      return;
    }
    const waiting = this.waiting.get(message.id);
    if (!waiting) return;
    if (message.error) {
      const { message: text, help, conflict } = message.error;
      this.waiting.delete(message.id);
      waiting.reject(new EngineError(text, help ?? null, conflict ?? null));
      return;
    }
    const ok = message.ok as { name?: string; mime?: string } | null;
    if (ok && typeof ok.mime === "string" && typeof ok.name === "string") {
      this.promised.set(message.id, { name: ok.name, mime: ok.mime });
      return;
    }
    this.waiting.delete(message.id);
    waiting.resolve(message.ok as never);
  }

  private receiveBytes(buffer: ArrayBuffer): void {
    const head = new DataView(buffer);
    const kind = head.getUint32(0, true);
    if (kind === 1) {
      const at = (index: number) => head.getUint32(index * 4, true);
      this.tell({
        event: "pixels",
        frame: at(1),
        x: at(2),
        y: at(3),
        w: at(4),
        h: at(5),
        step: at(6),
        data: new Uint8ClampedArray(buffer, 28),
      });
    } else if (kind === 2) {
      const id = head.getUint32(4, true);
      const promised = this.promised.get(id);
      const waiting = this.waiting.get(id);
      this.promised.delete(id);
      this.waiting.delete(id);
      if (promised && waiting) waiting.resolve({ ...promised, bytes: new Uint8Array(buffer, 8) } as never);
    }
  }

  private tell(event: Events): void {
    for (const listener of this.listeners) listener(event);
  }
}
