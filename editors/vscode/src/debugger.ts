// The debugger: `rapidc dap`.

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

export function registerDebugger(context: vscode.ExtensionContext): void {
    const configurations = new Configurations();
    context.subscriptions.push(
        vscode.debug.registerDebugConfigurationProvider("rapidc", configurations),
        vscode.debug.registerDebugConfigurationProvider(
            "rapidc", configurations, vscode.DebugConfigurationProviderTriggerKind.Dynamic),
        vscode.debug.registerDebugAdapterDescriptorFactory("rapidc", new Adapters()),
    );
}
