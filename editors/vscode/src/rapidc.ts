// The rapidc executable: where it is, and running it.

import { execFile } from "node:child_process";
import * as vscode from "vscode";

export function rapidcPath(): string {
    const path = vscode.workspace.getConfiguration("rapidc").get<string>("path") ?? "";
    return path.trim() === "" ? "rapidc" : path.trim();
}

export interface Output {
    status: number;
    stdout: string;
    stderr: string;
}

/** Runs rapidc to its end. Rejects when it cannot be started; any exit status resolves. */
export function runRapidc(args: string[], cwd?: string, token?: vscode.CancellationToken): Promise<Output> {
    return new Promise((resolve, reject) => {
        const child = execFile(rapidcPath(), args, { cwd, maxBuffer: 256 << 20 }, (error, stdout, stderr) => {
            if (error && typeof error.code === "string") {
                reject(new Error(`${rapidcPath()} cannot be started (${error.code}): set "rapidc.path" in the settings`));
                return;
            }
            resolve({ status: error ? Number(error.code ?? 1) : 0, stdout, stderr });
        });
        token?.onCancellationRequested(() => child.kill("SIGTERM"));
    });
}

/** Shows why rapidc cannot be used, with a way to the setting. */
export async function showProblem(message: string): Promise<void> {
    const open = "Open Settings";
    if ((await vscode.window.showErrorMessage(`RAPID: ${message}`, open)) === open)
        await vscode.commands.executeCommand("workbench.action.openSettings", "rapidc.path");
}
