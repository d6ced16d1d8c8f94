// Activation: language server, debugger, tasks, tests, commands.

import * as vscode from "vscode";
import { LanguageClient, LanguageClientOptions, ServerOptions, State } from "vscode-languageclient/node";
import { registerCommands } from "./commands";
import { registerDebugger } from "./debugger";
import { lensMiddleware, registerLenses } from "./lenses";
import { rapidcPath, showProblem } from "./rapidc";
import { registerTasks } from "./tasks";
import { registerTests } from "./testing";

let client: LanguageClient | undefined;

function settings(): { warnings: string[] } {
    return { warnings: vscode.workspace.getConfiguration("rapidc").get<string[]>("warnings") ?? [] };
}

function makeClient(context: vscode.ExtensionContext): LanguageClient {
    const server: ServerOptions = { command: rapidcPath(), args: ["lsp"] };
    const watcher = vscode.workspace.createFileSystemWatcher("**/*.{mod,modx,sys,sysx,prg,cfg,pgf,MOD,SYS,CFG,PGF}");
    context.subscriptions.push(watcher);
    const options: LanguageClientOptions = {
        documentSelector: [{ language: "rapid" }, { language: "abb-cfg" }, { pattern: "**/*.pgf" }],
        initializationOptions: settings(),
        // The owner of the problem matcher: VS Code keeps one list of an owner for each file, so that a task shows no mistake twice.
        diagnosticCollectionName: "rapidc",
        synchronize: { configurationSection: "rapidc", fileEvents: watcher },
        // The server publishes diagnostics as well as answering requests for them: the client would show both.
        middleware: { ...lensMiddleware, provideDiagnostics: () => undefined, provideWorkspaceDiagnostics: () => undefined },
    };
    return new LanguageClient("rapidc", "RAPID", server, options);
}

/** Puts back what a task with the problem matcher has replaced: the server knows all files of the workspace, and open ones as they are. */
function showDiagnosticsAgain(): void {
    const collection = client?.diagnostics;
    if (!collection) return;
    const all: [vscode.Uri, readonly vscode.Diagnostic[]][] = [];
    collection.forEach((uri, list) => all.push([uri, list]));
    collection.set(all);
}

async function startServer(context: vscode.ExtensionContext): Promise<void> {
    client = makeClient(context);
    try {
        await client.start();
    } catch (error) {
        client = undefined;
        await showProblem(`the language server "${rapidcPath()} lsp" cannot be started. ${String(error)}`);
    }
}

async function stopServer(): Promise<void> {
    const running = client;
    client = undefined;
    if (running && running.state !== State.Stopped) await running.stop();
}

export async function activate(context: vscode.ExtensionContext): Promise<void> {
    registerTasks(context, showDiagnosticsAgain);
    registerDebugger(context);
    registerTests(context);
    registerCommands(context);
    registerLenses(context);
    context.subscriptions.push(
        vscode.commands.registerCommand("rapidc.restartServer", async () => {
            await stopServer();
            await startServer(context);
        }),
        vscode.workspace.onDidChangeConfiguration(async (change) => {
            if (!change.affectsConfiguration("rapidc.path")) return;
            await stopServer();
            await startServer(context);
        }),
    );
    await startServer(context);
}

export async function deactivate(): Promise<void> {
    await stopServer();
}
