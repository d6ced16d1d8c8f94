// The debugger: `rapidc dap`.

import { mkdtemp, rm, writeFile } from "node:fs/promises";
import { tmpdir } from "node:os";
import { join } from "node:path";
import * as vscode from "vscode";
import { rapidcPath } from "./rapidc";

class Configurations implements vscode.DebugConfigurationProvider {
    provideDebugConfigurations(): vscode.DebugConfiguration[] {
        return [{ type: "rapidc", request: "launch", name: "Run this module", program: "${file}" }];
    }

    /** F5 without launch.json: the open module. */
    resolveDebugConfiguration(
        _folder: vscode.WorkspaceFolder | undefined,
        config: vscode.DebugConfiguration,
    ): vscode.DebugConfiguration | undefined {
        if (!config.type && !config.request && !config.name) {
            if (vscode.window.activeTextEditor?.document.languageId !== "rapid") return undefined;
            return { type: "rapidc", request: "launch", name: "Run this module", program: "${file}" };
        }
        if (config.request === "launch" && !config["program"]) config["program"] = "${file}";
        // A stimulus answers dialogs itself.
        config["operatorDialogs"] ??= !config["stimulus"];
        return config;
    }
}

class Adapters implements vscode.DebugAdapterDescriptorFactory {
    createDebugAdapterDescriptor(session: vscode.DebugSession): vscode.DebugAdapterDescriptor {
        const cwd = session.workspaceFolder?.uri.fsPath;
        return new vscode.DebugAdapterExecutable(rapidcPath(), ["dap"], cwd ? { cwd } : undefined);
    }
}

/** What the code lens "Run" of the language server gives. */
interface Routine {
    uri: string;
    program: string;
    task: string;
    module: string;
    routine: string;
}

/** Runs a procedure without parameters in place of main: as the entry of its task in a configuration of its own. */
async function runRoutine(routine: Routine): Promise<void> {
    const uri = vscode.Uri.parse(routine.uri);
    const config: vscode.DebugConfiguration = {
        type: "rapidc", request: "launch", name: routine.routine, program: routine.program || uri.fsPath,
    };
    const folder = vscode.workspace.getWorkspaceFolder(uri);
    if (routine.routine.toLowerCase() === "main") {
        await vscode.debug.startDebugging(folder, config);
        return;
    }
    const scratch = await mkdtemp(join(tmpdir(), "rapidc-entry-"));
    const file = join(scratch, "SYS.cfg");
    await writeFile(file, `SYS:CFG_1.0:7:0::\n#\nCAB_TASKS:\n\n      -Name "${routine.task}" -Type "NORMAL" -Entry "${routine.routine}" -MotionTask \n`);
    config["config"] = [file];
    const ended = vscode.debug.onDidTerminateDebugSession((session) => {
        if (session.configuration["config"]?.[0] !== file) return;
        ended.dispose();
        void rm(scratch, { recursive: true, force: true });
    });
    if (!(await vscode.debug.startDebugging(folder, config))) ended.dispose();
}

/** Where the robot is, in the status bar, as the adapter reports it at each stop. */
class RobotPosition implements vscode.Disposable {
    private readonly item = vscode.window.createStatusBarItem("rapidc.robot", vscode.StatusBarAlignment.Left, 10);
    private readonly subscriptions = [
        vscode.debug.onDidReceiveDebugSessionCustomEvent((event) => {
            if (event.event !== "rapidcRobot" || !Array.isArray(event.body?.tcp)) return;
            const numbers = (list: number[]): string => list.map((value) => value.toFixed(1)).join(", ");
            this.item.name = "Position of the robot";
            this.item.text = `$(target) [${numbers(event.body.tcp)}]`;
            this.item.tooltip = `TCP in mm at ${Number(event.body.time).toFixed(3)} s; axes ${numbers(event.body.joints ?? [])}`;
            this.item.show();
        }),
        vscode.debug.onDidTerminateDebugSession(() => this.item.hide()),
    ];
    dispose(): void {
        this.item.dispose();
        this.subscriptions.forEach((one) => one.dispose());
    }
}

/** A question of the program to the operator, as the adapter describes it. */
interface Dialog {
    id: number;
    instruction: string;
    kind: "choice" | "list" | "number" | "text";
    header: string;
    lines: string[];
    choices: string[];
    hint: string;
}

/** Asks the user what the program asks the operator; a box that is closed without an answer is shown again. */
class OperatorDialogs implements vscode.Disposable {
    private readonly open = new Map<string, vscode.CancellationTokenSource>();
    private readonly subscriptions = [
        vscode.debug.onDidReceiveDebugSessionCustomEvent((event) => {
            if (event.event !== "rapidcDialog") return;
            if (event.body?.opened) void this.ask(event.session, event.body.opened as Dialog);
            else this.close(`${event.session.id} ${event.body?.closed}`);
        }),
        vscode.debug.onDidTerminateDebugSession((session) => {
            for (const key of [...this.open.keys()]) if (key.startsWith(`${session.id} `)) this.close(key);
        }),
    ];

    private async ask(session: vscode.DebugSession, dialog: Dialog): Promise<void> {
        const key = `${session.id} ${dialog.id}`;
        const source = new vscode.CancellationTokenSource();
        this.open.set(key, source);
        let refusal = "";
        while (!source.token.isCancellationRequested) {
            const answer = await this.input(dialog, refusal, source.token);
            if (answer === undefined) {
                if (source.token.isCancellationRequested) break;
                const again = await vscode.window.showInformationMessage(
                    `The program waits for an answer: ${dialog.lines.join(" ")}`, "Answer");
                if (again !== "Answer") break;
                continue;
            }
            try {
                await session.customRequest("rapidcAnswerDialog", { id: dialog.id, answer });
                break;
            } catch (problem) {
                refusal = problem instanceof Error ? problem.message : String(problem);
            }
        }
        this.close(key);
    }

    private async input(
        dialog: Dialog, refusal: string, token: vscode.CancellationToken,
    ): Promise<string | undefined> {
        const title = dialog.header || dialog.instruction;
        const text = [...dialog.lines, refusal].filter((line) => line !== "").join("\n");
        if (dialog.choices.length === 0)
            return vscode.window.showInputBox({ title, prompt: text || dialog.hint, ignoreFocusOut: true }, token);
        const items = dialog.choices
            .map((label, index) => ({ label, answer: String(index + 1) }))
            .filter((item) => item.label !== "");
        const picked = await vscode.window.showQuickPick(items, { title, placeHolder: text, ignoreFocusOut: true }, token);
        return picked?.answer;
    }

    private close(key: string): void {
        this.open.get(key)?.cancel();
        this.open.get(key)?.dispose();
        this.open.delete(key);
    }

    dispose(): void {
        for (const key of [...this.open.keys()]) this.close(key);
        this.subscriptions.forEach((one) => one.dispose());
    }
}

export function registerDebugger(context: vscode.ExtensionContext): void {
    const configurations = new Configurations();
    context.subscriptions.push(
        new RobotPosition(),
        new OperatorDialogs(),
        vscode.commands.registerCommand("rapidc.runRoutine", runRoutine),
        vscode.debug.registerDebugConfigurationProvider("rapidc", configurations),
        vscode.debug.registerDebugConfigurationProvider(
            "rapidc", configurations, vscode.DebugConfigurationProviderTriggerKind.Dynamic),
        vscode.debug.registerDebugAdapterDescriptorFactory("rapidc", new Adapters()),
    );
}
