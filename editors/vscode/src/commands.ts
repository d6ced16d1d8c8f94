// Commands: what the compiler makes of a routine, the path of a program, predefined names.

import { mkdtemp, readFile, rm } from "node:fs/promises";
import { tmpdir } from "node:os";
import { join } from "node:path";
import * as vscode from "vscode";
import { routineAt, sectionOf } from "./routines";
import { Output, runRapidc, showProblem } from "./rapidc";

const scheme = "rapidc-output";

/** Texts that rapidc writes, as documents that cannot be edited. */
class Texts implements vscode.TextDocumentContentProvider {
    private readonly texts = new Map<string, string>();
    private readonly changed = new vscode.EventEmitter<vscode.Uri>();
    readonly onDidChange = this.changed.event;

    provideTextDocumentContent(uri: vscode.Uri): string {
        return this.texts.get(uri.path) ?? "";
    }
    async show(name: string, text: string, language: string): Promise<void> {
        const uri = vscode.Uri.from({ scheme, path: `/${name}` });
        this.texts.set(uri.path, text);
        this.changed.fire(uri);
        const document = await vscode.workspace.openTextDocument(uri);
        await vscode.languages.setTextDocumentLanguage(document, language).then(undefined, () => undefined);
        await vscode.window.showTextDocument(document, { viewColumn: vscode.ViewColumn.Beside, preserveFocus: true, preview: true });
    }
}

async function savedModule(): Promise<vscode.TextEditor | undefined> {
    const editor = vscode.window.activeTextEditor;
    if (!editor || editor.document.languageId !== "rapid") {
        await vscode.window.showInformationMessage("RAPID: open a module first.");
        return undefined;
    }
    if (editor.document.isDirty) await editor.document.save();
    return editor;
}

function firstLine(output: Output): string {
    return output.stderr.split("\n").find((line) => line.trim() !== "") ?? `exit status ${output.status}`;
}

async function showStage(texts: Texts, stage: "ir" | "asm"): Promise<void> {
    const editor = await savedModule();
    if (!editor) return;
    const routine = routineAt(editor.document.getText(), editor.selection.active.line);
    const output = await runRapidc(["emit", `--as=${stage}`, editor.document.uri.fsPath]);
    if (output.status !== 0) return showProblem(`the module does not compile. ${firstLine(output)}`);
    const section = routine ? sectionOf(output.stdout, stage, routine) : undefined;
    await texts.show(`${routine ?? "module"}.${stage === "ir" ? "ir" : "s"}`, section ?? output.stdout, "plaintext");
}

async function showRun(option: "picture" | "report", title: string): Promise<void> {
    const editor = await savedModule();
    if (!editor) return;
    const path = editor.document.uri.fsPath;
    const scratch = await mkdtemp(join(tmpdir(), "rapidc-view-"));
    try {
        const file = join(scratch, option === "picture" ? "path.svg" : "report.html");
        const output = await vscode.window.withProgress(
            { location: vscode.ProgressLocation.Notification, title: "RAPID: running the program", cancellable: true },
            (_progress, token) => runRapidc(["run", path, `--${option}=${file}`, "--max-time=3600"], undefined, token));
        const content = await readFile(file, "utf8").catch(() => undefined);
        if (content === undefined) return showProblem(`the program cannot be run. ${firstLine(output)}`);
        const panel = vscode.window.createWebviewPanel(
            `rapidc.${option}`, title, vscode.ViewColumn.Beside, { enableScripts: option === "report" });
        panel.webview.html = option === "picture"
            ? `<!DOCTYPE html><html><body style="background:#fff;margin:0">${content.replace(/^<\?xml[^>]*>/, "")}</body></html>`
            : content;
    } finally {
        await rm(scratch, { recursive: true, force: true });
    }
}

async function showBuiltins(texts: Texts): Promise<void> {
    const output = await runRapidc(["builtins", "--format=tsv"]);
    const rows = output.stdout.split("\n").slice(1).map((line) => line.split("\t")).filter((row) => row.length === 4);
    const items = rows.map(([label, kind, chapter, status]) => ({
        label: label ?? "",
        description: kind,
        detail: status === "implemented" ? undefined : "declared only: a call stops the program",
        chapter,
    }));
    const choice = await vscode.window.showQuickPick(items, { placeHolder: "Predefined name", matchOnDescription: true });
    if (!choice) return;
    const described = await runRapidc(["builtins", choice.label]);
    await texts.show(`${choice.label}.txt`, described.stdout, "plaintext");
}

export function registerCommands(context: vscode.ExtensionContext): void {
    const texts = new Texts();
    const add = (name: string, body: () => Promise<void>): void => {
        context.subscriptions.push(vscode.commands.registerCommand(`rapidc.${name}`, async () => {
            try {
                await body();
            } catch (error) {
                await showProblem(error instanceof Error ? error.message : String(error));
            }
        }));
    };
    context.subscriptions.push(vscode.workspace.registerTextDocumentContentProvider(scheme, texts));
    add("showIr", () => showStage(texts, "ir"));
    add("showAssembly", () => showStage(texts, "asm"));
    add("openPicture", () => showRun("picture", "Path of the TCP"));
    add("openReport", () => showRun("report", "Report of the run"));
    add("builtins", () => showBuiltins(texts));
}
