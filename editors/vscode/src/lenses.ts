// The lens "references" of the language server names no command, since commands belong to editors: here a click shows the references.

import * as vscode from "vscode";
import { CodeLensMiddleware } from "vscode-languageclient/node";

const command = "rapidc.showReferences";
const documents = new WeakMap<vscode.CodeLens, vscode.Uri>();

export const lensMiddleware: CodeLensMiddleware = {
    provideCodeLenses: async (document, token, next) => {
        const lenses = await next(document, token);
        for (const lens of lenses ?? []) documents.set(lens, document.uri);
        return lenses;
    },
    resolveCodeLens: async (lens, token, next) => {
        const resolved = await next(lens, token);
        const title = resolved?.command?.command === "" ? resolved.command.title : undefined;
        const uri = documents.get(lens);
        if (resolved && uri && title && !title.startsWith("0 "))
            resolved.command = { title, command, arguments: [uri, lens.range.start] };
        return resolved;
    },
};

async function showReferences(uri: vscode.Uri, position: vscode.Position): Promise<void> {
    const found = (await vscode.commands.executeCommand<vscode.Location[]>("vscode.executeReferenceProvider", uri, position)) ?? [];
    const isDeclaration = (each: vscode.Location) => each.uri.toString() === uri.toString() && each.range.contains(position);
    await vscode.commands.executeCommand("editor.action.showReferences", uri, position, found.filter((each) => !isDeclaration(each)));
}

export function registerLenses(context: vscode.ExtensionContext): void {
    context.subscriptions.push(vscode.commands.registerCommand(command, showReferences));
}
