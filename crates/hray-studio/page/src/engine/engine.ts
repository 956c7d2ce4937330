// What the page asks of an engine, whichever it is: the native one behind a socket, or WebAssembly in workers.

import type { Conflict, Events, Requests } from "./protocol";
import type { Signal } from "../signal";

export type EngineState =
  | "connecting"
  | "open"
  /** It went away, and is being looked for. */
  | "away"
  /** It is there, but does not know this page: it was started again. */
  | "refused";

export interface Engine {
  readonly kind: "socket" | "worker";
  readonly state: Signal<EngineState>;
  request<K extends keyof Requests>(what: K, parameters: Requests[K][0]): Promise<Requests[K][1]>;
  on(listener: (event: Events) => void): void;
}

/** An engine's answer that something could not be done. */
export class EngineError extends Error {
  constructor(
    message: string,
    readonly help: string | null = null,
    readonly conflict: Conflict | null = null,
  ) {
    super(message);
  }
}

/** The engine is not there; what was asked may be asked again later. */
export class EngineAway extends Error {
  constructor() {
    super("The engine is not connected.");
  }
}

/** The words of anything thrown, help included. */
export function explainError(error: unknown): string {
  if (error instanceof EngineError) return error.help ? `${error.message} (${error.help})` : error.message;
  if (error instanceof Error) return error.message;
  return String(error);
}
