// Where the page begins: which engine there is, and what happens when it comes and goes.

import "./style/base.css";
import "./style/bar.css";
import "./style/editor.css";
import "./style/picture.css";
import "./style/dock.css";
import "./style/dialogs.css";
import { Studio } from "./app";
import type { Engine } from "./engine/engine";
import { explainError } from "./engine/engine";
import { SocketEngine } from "./engine/socket";
import { WorkerEngine } from "./engine/workers";
import { applyTheme, currentTheme } from "./theme";

applyTheme(currentTheme());

const root = document.getElementById("studio");
if (!root) throw new Error("The page is not whole.");
const token = new URLSearchParams(location.search).get("token");
const engine: Engine = token ? new SocketEngine(token) : new WorkerEngine();
const studio = new Studio(root, engine);
engine.on((event) => studio.receive(event));
// For the suite, which reads from it, and for whoever is curious.
Object.assign(window, { hray: studio });

async function opened(): Promise<void> {
  try {
    const first = studio.hello === null;
    const hello = await engine.request("hello", {});
    studio.hello = hello;
    if (first) await studio.documents.begin(hello);
    else await studio.documents.again(hello);
    document.documentElement.dataset["ready"] = "true";
  } catch (error) {
    studio.fail(error);
  }
}

engine.state.watch((state) => {
  document.documentElement.dataset["engine"] = state;
  switch (state) {
    case "open":
      studio.banner("engine", null);
      void opened().catch((error: unknown) => studio.say(explainError(error)));
      break;
    case "away":
      studio.banner("engine", "The engine is away. What you type is kept, and the picture follows again when it is back.");
      break;
    case "refused":
      studio.banner("engine", "The studio was started again and has another address: open the one it printed. What you typed is kept here.", {
        label: "Copy my text",
        run: () => void navigator.clipboard.writeText(studio.editor.text).then(() => studio.say("The text is on the clipboard.")),
      });
      break;
    case "connecting":
  }
});
