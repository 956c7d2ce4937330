// A real studio for a test: the binary over a folder of its own, and a page that looks at it.

import assert from "node:assert/strict";
import { execFileSync, spawn } from "node:child_process";
import { cpSync, mkdirSync, mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { createInterface } from "node:readline";
import { fileURLToPath } from "node:url";

const root = fileURLToPath(new URL("../../../../", import.meta.url));
export const examples = join(root, "examples");
export const binary = process.env.HRAY_BIN ?? join(process.env.CARGO_TARGET_DIR ?? join(root, "target"), "release/hray");

/** A folder with copies of some examples (or of all). */
export function folder(...names) {
  const path = mkdtempSync(join(tmpdir(), "hray-studio-"));
  if (names.length === 0) cpSync(examples, path, { recursive: true, filter: (from) => !from.endsWith(".png") });
  for (const name of names) cpSync(join(examples, name), join(path, name));
  mkdirSync(join(path, "deeper"));
  return { path, remove: () => rmSync(path, { recursive: true, force: true }) };
}

/** Starts `hray studio` and waits for its address. */
export async function serve(target, ...more) {
  const child = spawn(binary, ["studio", target, "--no-open", ...more], { stdio: ["ignore", "pipe", "inherit"] });
  const lines = createInterface({ input: child.stdout });
  const address = await new Promise((resolve, reject) => {
    lines.once("line", resolve);
    child.once("error", reject);
    child.once("exit", (code) => reject(new Error(`hray studio ended with ${code}`)));
  });
  return {
    address: address.trim(),
    port: new URL(address.trim()).port,
    /** Lets it neither run nor end, or run again. */
    freeze: (still) => child.kill(still ? "SIGSTOP" : "SIGCONT"),
    stop: () =>
      new Promise((resolve) => {
        if (child.exitCode !== null || child.signalCode !== null) return resolve();
        child.removeAllListeners("exit");
        child.once("exit", resolve);
        child.kill("SIGKILL");
      }),
  };
}

/** Runs `hray` and gives what it printed. */
export function hray(...args) {
  return execFileSync(binary, args, { encoding: "utf8", stdio: ["ignore", "pipe", "pipe"] });
}

/** While the page is worked on: the bundle as it lies here, in place of the one in the binary (HRAY_PAGE=1). */
async function fresh(context, address) {
  if (!process.env.HRAY_PAGE) return;
  const dist = fileURLToPath(new URL("../../dist/", import.meta.url));
  const { origin } = new URL(address);
  await context.route(
    (url) => url.origin === origin && !["/ws", "/alive"].includes(url.pathname),
    (route) => route.fulfill({ path: join(dist, new URL(route.request().url()).pathname.slice(1) || "index.html") }),
  );
}

/** A page that fails the test when something in it goes wrong. */
export async function open(context, address) {
  await fresh(context, address);
  const page = await context.newPage();
  page.wrong = [];
  page.on("pageerror", (error) => page.wrong.push(error.stack ?? error.message));
  page.on("console", (message) => {
    if (message.type() === "error" && !/WebSocket|ERR_CONNECTION|Failed to load resource/.test(message.text())) page.wrong.push(message.text());
  });
  await page.goto(address);
  await page.waitForFunction(() => document.documentElement.dataset.ready);
  return page;
}

/** Waits until the picture is that of the text as it stands. */
export async function settled(page, timeout = 60_000) {
  await page.waitForFunction(
    () => {
      const text = document.querySelector(".editor-pane").dataset;
      const picture = document.querySelector(".picture-pane").dataset;
      return text.known === text.version && picture.version === text.version && picture.state === "complete";
    },
    null,
    { timeout },
  );
}

/** Waits until the engine has said what is wrong with the text as it stands. */
export async function known(page) {
  await page.waitForFunction(() => {
    const text = document.querySelector(".editor-pane").dataset;
    return text.known === text.version;
  });
}

/** Opens a file through the dialog, by typing its path. */
export async function openFile(page, path) {
  await page.keyboard.press("Control+o");
  await page.getByPlaceholder("Find a scene, or type its path").fill(path);
  await page.keyboard.press("Enter");
  await page.waitForFunction((name) => document.title.includes(name), path.split("/").at(-1));
}

/** Replaces the whole text, as typing would. */
export async function type(page, text) {
  await page.locator(".editor-pane > .cm-editor .cm-content").focus();
  await page.keyboard.press("Control+a");
  await page.keyboard.insertText(text);
}

/** The whole text, scrolled out of sight or not. */
export function text(page) {
  return page.evaluate(() => window.hray.editor.text);
}

/** The line that the cursor is on. */
export function cursorLine(page) {
  return page.evaluate(() => window.hray.editor.position(window.hray.editor.state.selection.main.from).line);
}

/** SHA-256 of the shown pixels, as red, green, blue. */
export function shownHash(page) {
  return page.evaluate(async () => {
    const canvas = document.querySelector(".picture-canvas");
    const { data, width, height } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
    return `${width}x${height}:${await hash(data)}`;
    async function hash(rgba) {
      const rgb = new Uint8Array((rgba.length / 4) * 3);
      for (let at = 0, to = 0; at < rgba.length; at += 4) {
        rgb[to++] = rgba[at];
        rgb[to++] = rgba[at + 1];
        rgb[to++] = rgba[at + 2];
      }
      const digest = await crypto.subtle.digest("SHA-256", rgb);
      return [...new Uint8Array(digest)].map((byte) => byte.toString(16).padStart(2, "0")).join("");
    }
  });
}

/** The same of a PPM file (P6). */
export async function ppmHash(bytes) {
  const head = /^P6\s+(\d+)\s+(\d+)\s+255\s/.exec(bytes.subarray(0, 64).toString("latin1"));
  assert.ok(head, "a PPM file");
  const digest = await crypto.subtle.digest("SHA-256", bytes.subarray(head[0].length));
  return `${head[1]}x${head[2]}:${Buffer.from(digest).toString("hex")}`;
}

/** Presses and releases the mouse at a pixel of the picture. */
export async function clickPixel(page, x, y) {
  const at = await page.evaluate(
    ([px, py]) => {
      const canvas = document.querySelector(".picture-canvas");
      const box = canvas.getBoundingClientRect();
      return { x: box.left + ((px + 0.5) * box.width) / canvas.width, y: box.top + ((py + 0.5) * box.height) / canvas.height };
    },
    [x, y],
  );
  await page.mouse.click(at.x, at.y);
}
