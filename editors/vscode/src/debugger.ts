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
        return config;
    }
}

class Adapters implements vscode.DebugAdapterDescriptorFactory {
    createDebugAdapterDescriptor(session: vscode.DebugSession): vscode.DebugAdapterDescriptor {
        const cwd = session.workspaceFolder?.uri.fsPath;
        return new vscode.DebugAdapterExecutable(rapidcPath(), ["dap"], cwd ? { cwd } : undefined);
    }
}

/** What the code lens "Run" of the language server names. */
interface RoutineToRun {
    program: string;
    task: string;
    routine: string;
}

/** Runs a routine without parameters as the entry of its task, which a configuration of its own says. */
async function runRoutine(target: RoutineToRun): Promise<void> {
    const config: vscode.DebugConfiguration = {
        type: "rapidc", request: "launch", name: `Run ${target.routine}`, program: target.program, noDebug: true,
    };
    if (target.routine.toLowerCase() === "main") {
        await vscode.debug.startDebugging(undefined, config);
        return;
    }
    const folder = await mkdtemp(join(tmpdir(), "rapidc-"));
    const file = join(folder, "SYS.cfg");
    const entry = `      -Name "${target.task}" -Type "NORMAL" -MotionTask \\\n      -Entry "${target.routine}"\n`;
    await writeFile(file, `SYS:CFG_1.0:6:0::\n#\nCAB_TASKS:\n\n${entry}`);
    config["config"] = [file];
    const ended = vscode.debug.onDidTerminateDebugSession((session) => {
        if (session.name !== config.name) return;
        ended.dispose();
        void rm(folder, { recursive: true, force: true });
    });
    await vscode.debug.startDebugging(undefined, config);
}

export function registerDebugger(context: vscode.ExtensionContext): void {
    const configurations = new Configurations();
    context.subscriptions.push(
        vscode.debug.registerDebugConfigurationProvider("rapidc", configurations),
        vscode.debug.registerDebugConfigurationProvider(
            "rapidc", configurations, vscode.DebugConfigurationProviderTriggerKind.Dynamic),
        vscode.debug.registerDebugAdapterDescriptorFactory("rapidc", new Adapters()),
        vscode.commands.registerCommand("rapidc.runRoutine", runRoutine),
    );
}
