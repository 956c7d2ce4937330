// Renders the open file with `hray render` and shows the picture.

import { execFile } from "node:child_process";
import { mkdtemp } from "node:fs/promises";
import { tmpdir } from "node:os";
import * as path from "node:path";
import * as vscode from "vscode";

/** How much of what the program says is kept. */
const MOST_OUTPUT = 16 * 1024 * 1024;

export function registerRendering(context: vscode.ExtensionContext): void {
  const output = vscode.window.createOutputChannel("hray render");
  context.subscriptions.push(
    output,
    vscode.commands.registerCommand("hray.render", () => renderBeside(output)),
    vscode.commands.registerCommand("hray.renderTo", () => renderTo(output)),
  );
}

/** To a temporary picture that is shown beside the text. */
async function renderBeside(output: vscode.OutputChannel): Promise<void> {
  const scene = await savedScene();
  if (scene === undefined) {
    return;
  }
  const folder = await pictureFolder();
  await render(output, scene, path.join(folder, `${path.parse(scene).name}.png`));
}

/** To a file that the user names. */
async function renderTo(output: vscode.OutputChannel): Promise<void> {
  const scene = await savedScene();
  if (scene === undefined) {
    return;
  }
  const { dir, name } = path.parse(scene);
  const target = await vscode.window.showSaveDialog({
    defaultUri: vscode.Uri.file(path.join(dir, `${name}.png`)),
    filters: { Pictures: ["png", "exr", "ppm", "qoi", "tiff", "tga", "ff", "pfm"], "All files": ["*"] },
  });
  if (target !== undefined) {
    await render(output, scene, target.fsPath);
  }
}

/** The path of the scene in the active editor, once it is saved. */
async function savedScene(): Promise<string | undefined> {
  const document = vscode.window.activeTextEditor?.document;
  if (document === undefined || document.languageId !== "hry") {
    void vscode.window.showErrorMessage("There is no scene in the active editor.");
    return undefined;
  }
  if (!(await document.save()) || document.uri.scheme !== "file") {
    void vscode.window.showErrorMessage("Save the scene to a file first.");
    return undefined;
  }
  return document.uri.fsPath;
}

let folder: Promise<string> | undefined;

/** One folder of pictures for as long as the editor runs, so that a scene rendered again is shown in the same tab. */
function pictureFolder(): Promise<string> {
  folder ??= mkdtemp(path.join(tmpdir(), "hray-"));
  return folder;
}

async function render(output: vscode.OutputChannel, scene: string, picture: string): Promise<void> {
  const uri = vscode.Uri.file(scene);
  const settings = vscode.workspace.getConfiguration("hray", uri);
  const command = settings.get<string>("path", "hray");
  const more = settings.get<string[]>("render.arguments", []);
  // What the language server lets a scene import, rendering does, too.
  const folder = vscode.workspace.getWorkspaceFolder(uri);
  const root = folder === undefined ? [] : ["--root", folder.uri.fsPath];
  const args = ["render", scene, "-o", picture, "--quiet", ...root, ...more];
  const progress = {
    location: vscode.ProgressLocation.Notification,
    title: `Rendering ${path.basename(scene)}`,
    cancellable: true,
  };
  const failure = await vscode.window.withProgress(progress, (_, cancelled) =>
    run(command, args, path.dirname(scene), output, cancelled),
  );
  if (failure === undefined) {
    await vscode.commands.executeCommand("vscode.open", vscode.Uri.file(picture), {
      viewColumn: vscode.ViewColumn.Beside,
      preserveFocus: true,
    });
  } else if (failure !== "") {
    output.show(true);
    void vscode.window.showErrorMessage(failure);
  }
}

/** Nothing where all went well; else what to say, which is nothing where the user cancelled. */
function run(
  command: string,
  args: string[],
  cwd: string,
  output: vscode.OutputChannel,
  cancelled: vscode.CancellationToken,
): Promise<string | undefined> {
  return new Promise((resolve) => {
    output.clear();
    const child = execFile(command, args, { cwd, maxBuffer: MOST_OUTPUT }, (error, stdout, stderr) => {
      output.append(stdout);
      output.append(stderr);
      if (error === null) {
        resolve(undefined);
      } else if (cancelled.isCancellationRequested) {
        resolve("");
      } else if (typeof error.code === "number") {
        resolve("hray could not render the scene; the output says why.");
      } else {
        output.appendLine(error.message);
        resolve(`\`${command}\` did not run; the setting hray.path tells where it is.`);
      }
    });
    cancelled.onCancellationRequested(() => child.kill("SIGINT"));
  });
}
