// One worker with one instance of the engine. It does one thing at a time, as it is told.

import type { FromWorker, ToWorker } from "./workers";

interface WasmEngine {
  request(message: string): string;
  show(number: number, view: string): string;
  tile(pass: number, index: number): Uint8Array<ArrayBuffer>;
  rays(): number;
  file(message: string): { answer(): string; bytes(): Uint8Array<ArrayBuffer>; free(): void };
}

interface Glue {
  default(start: { module_or_path: WebAssembly.Module }): Promise<unknown>;
  Engine: new (cores: number, depth: number) => WasmEngine;
}

let engine: WasmEngine | null = null;

function tell(message: FromWorker, transfer: Transferable[] = []): void {
  postMessage(message, { transfer });
}

async function act(message: ToWorker): Promise<void> {
  if (message.kind === "start") {
    const glue = (await import(/* @vite-ignore */ message.glue)) as Glue;
    await glue.default({ module_or_path: message.module });
    engine = new glue.Engine(message.cores, message.depth);
    tell({ kind: "ready" });
    return;
  }
  if (!engine) throw new Error("The engine was asked before it was started.");
  switch (message.kind) {
    case "ask":
      tell({ kind: "answer", answer: engine.request(message.message) });
      break;
    case "file": {
      const file = engine.file(message.message);
      const bytes = file.bytes();
      tell({ kind: "file", answer: file.answer(), bytes: bytes.buffer }, [bytes.buffer]);
      file.free();
      break;
    }
    case "show":
      tell({ kind: "shown", number: message.number, shown: engine.show(message.number, message.view) });
      break;
    case "tile": {
      const bytes = engine.tile(message.pass, message.index);
      tell({ kind: "tile", number: message.number, pass: message.pass, bytes: bytes.buffer, rays: engine.rays() }, [bytes.buffer]);
    }
  }
}

onmessage = (event: MessageEvent<ToWorker>) => {
  act(event.data).catch((error: unknown) => tell({ kind: "crashed", deep: error instanceof RangeError }));
};
