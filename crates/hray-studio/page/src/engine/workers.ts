// The same engine compiled to WebAssembly, one instance in each of several workers.

import { Signal } from "../signal";
import { EngineAway, type Engine, type EngineState } from "./engine";
import type { Events, Requests } from "./protocol";

export class WorkerEngine implements Engine {
  readonly kind = "worker";
  readonly state = new Signal<EngineState>("connecting");
  private listeners: ((event: Events) => void)[] = [];
  request<K extends keyof Requests>(_what: K, _parameters: Requests[K][0]): Promise<Requests[K][1]> {
    return Promise.reject(new EngineAway());
  }
  on(listener: (event: Events) => void): void {
    this.listeners.push(listener);
  }
}
