// The extension: starts the language server of `hray`, and renders the open file.

import * as vscode from "vscode";
import { LanguageClient, type LanguageClientOptions, type ServerOptions, State } from "vscode-languageclient/node";
import { registerRendering } from "./render";

let client: LanguageClient | undefined;

export async function activate(context: vscode.ExtensionContext): Promise<void> {
  if (!vscode.workspace.isTrusted) {
    context.subscriptions.push(vscode.workspace.onDidGrantWorkspaceTrust(() => launch(context)));
    return;
  }
  await launch(context);
}

async function launch(context: vscode.ExtensionContext): Promise<void> {
  registerRendering(context);
  context.subscriptions.push(
    vscode.commands.registerCommand("hray.restart", restart),
    vscode.workspace.onDidChangeConfiguration(async (change) => {
      if (change.affectsConfiguration("hray.path") || change.affectsConfiguration("hray.lsp.enabled")) {
        await restart();
      }
    }),
  );
  await start();
}

export async function deactivate(): Promise<void> {
  await stop();
}

async function restart(): Promise<void> {
  await stop();
  await start();
}

async function stop(): Promise<void> {
  const stopping = client;
  client = undefined;
  if (stopping !== undefined && stopping.state !== State.Stopped) {
    await stopping.stop().catch(() => undefined);
  }
  await stopping?.dispose();
}

async function start(): Promise<void> {
  const settings = vscode.workspace.getConfiguration("hray");
  if (!settings.get<boolean>("lsp.enabled", true)) {
    return;
  }
  const command = settings.get<string>("path", "hray");
  const server: ServerOptions = { command, args: ["lsp"] };
  const options: LanguageClientOptions = {
    documentSelector: [
      { scheme: "file", language: "hry" },
      { scheme: "untitled", language: "hry" },
    ],
    // Hovers over colours may show a swatch.
    initializationOptions: { images: true },
    synchronize: { fileEvents: vscode.workspace.createFileSystemWatcher("**/*.{hry,png,jpg,jpeg,exr,hdr}") },
  };
  client = new LanguageClient("hray", "hray", server, options);
  try {
    await client.start();
  } catch (error) {
    const reason = error instanceof Error ? error.message : String(error);
    const settingsAction = "Open the Settings";
    const chosen = await vscode.window.showErrorMessage(
      `hray's language server did not start: ${reason}. Is \`${command}\` installed? The setting hray.path tells where.`,
      settingsAction,
    );
    if (chosen === settingsAction) {
      await vscode.commands.executeCommand("workbench.action.openSettings", "hray.path");
    }
  }
}
