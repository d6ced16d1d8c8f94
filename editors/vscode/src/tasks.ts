// Tasks: check, run, build and test the folder.

import * as vscode from "vscode";
import { rapidcPath } from "./rapidc";

interface Definition extends vscode.TaskDefinition {
    command: string;
    input?: string;
    args?: string[];
}

const commands = ["check", "run", "build", "test"];

function makeTask(definition: Definition, scope: vscode.WorkspaceFolder | vscode.TaskScope): vscode.Task {
    const folder = typeof scope === "object" ? scope.uri.fsPath : undefined;
    const input = definition.input ?? folder ?? ".";
    const args = [definition.command, input, ...(definition.args ?? [])];
    const output = definition.command === "build" && !args.some((arg) => arg === "-o" || arg.startsWith("--output"));
    if (output) args.push("-o", "program");
    const task = new vscode.Task(definition, scope, definition.command, "rapidc",
        new vscode.ProcessExecution(rapidcPath(), args, folder ? { cwd: folder } : undefined), "$rapidc");
    if (definition.command === "check" || definition.command === "build") task.group = vscode.TaskGroup.Build;
    if (definition.command === "test") task.group = vscode.TaskGroup.Test;
    return task;
}

/** Time in ms in which VS Code reads the last lines of a task that has ended. */
const reading = 1000;

/** `matched` is called when the problem matcher has replaced problems of the same owner. */
export function registerTasks(context: vscode.ExtensionContext, matched: () => void): void {
    context.subscriptions.push(
        vscode.tasks.onDidEndTask((event) => {
            if (event.execution.task.problemMatchers.includes("$rapidc")) setTimeout(matched, reading);
        }),
        vscode.tasks.registerTaskProvider("rapidc", {
            provideTasks: () =>
                (vscode.workspace.workspaceFolders ?? []).flatMap((folder) =>
                    commands.map((command) => makeTask({ type: "rapidc", command }, folder))),
            resolveTask: (task) =>
                makeTask(task.definition as Definition, (task.scope as vscode.WorkspaceFolder) ?? vscode.TaskScope.Workspace),
        }),
    );
}
