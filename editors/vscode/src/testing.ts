// The Testing view: `rapidc test`.

import { mkdtemp, readFile, rm } from "node:fs/promises";
import { tmpdir } from "node:os";
import { dirname, isAbsolute, join } from "node:path";
import * as vscode from "vscode";
import { runRapidc } from "./rapidc";

interface ListedTest {
    id: string;
    module: string;
    name: string;
    file: string;
    line: number;
    column: number;
    endLine: number;
}

interface FinishedTest extends ListedTest {
    outcome: "passed" | "failed" | "error" | "timeout" | "skipped";
    message?: string;
    at?: { file: string; line: number; column: number };
    expected?: string;
    actual?: string;
    wallTime: number;
    output?: string;
    events?: string;
}

/** A program that has tests: a folder, or one of its folders when it is not a program as a whole. */
interface Root {
    folder: vscode.WorkspaceFolder;
    input: string;
}

const modulePattern = "**/*.{modx,sysx,mod,MOD,MODX}";

function inFolder(folder: vscode.WorkspaceFolder, path: string): vscode.Uri {
    return vscode.Uri.file(isAbsolute(path) ? path : join(folder.uri.fsPath, path));
}

class Tests {
    private readonly controller = vscode.tests.createTestController("rapidc", "RAPID");
    private readonly roots = new Map<string, Root>(); // by the id of the item of a module
    private readonly ids = new WeakMap<vscode.TestItem, string>(); // of tests
    private refreshing: Promise<void> | undefined;
    private timer: NodeJS.Timeout | undefined;

    constructor(context: vscode.ExtensionContext) {
        const watcher = vscode.workspace.createFileSystemWatcher(modulePattern);
        this.controller.refreshHandler = () => this.refresh();
        this.controller.resolveHandler = (item) => (item ? undefined : this.refresh());
        this.controller.createRunProfile("Run", vscode.TestRunProfileKind.Run, (request, token) => this.run(request, token, false), true);
        this.controller.createRunProfile(
            "Run with Coverage", vscode.TestRunProfileKind.Coverage, (request, token) => this.run(request, token, true), true);
        context.subscriptions.push(this.controller, watcher, watcher.onDidChange(() => this.refreshSoon()),
            watcher.onDidCreate(() => this.refreshSoon()), watcher.onDidDelete(() => this.refreshSoon()));
        void this.refresh();
    }

    private refreshSoon(): void {
        clearTimeout(this.timer);
        this.timer = setTimeout(() => void this.refresh(), 500);
    }

    private refresh(): Promise<void> {
        this.refreshing ??= this.findTests().finally(() => (this.refreshing = undefined));
        return this.refreshing;
    }

    private arguments(folder: vscode.WorkspaceFolder): string[] {
        return vscode.workspace.getConfiguration("rapidc", folder.uri).get<string[]>("testArguments") ?? [];
    }

    private async list(root: Root): Promise<ListedTest[] | undefined> {
        const result = await runRapidc(
            ["test", root.input, "--list", "--format=json", ...this.arguments(root.folder)], root.folder.uri.fsPath);
        if (result.status !== 0) return undefined;
        return JSON.parse(result.stdout) as ListedTest[];
    }

    private async findTests(): Promise<void> {
        const found = new Map<string, vscode.TestItem>();
        this.roots.clear();
        for (const folder of vscode.workspace.workspaceFolders ?? []) {
            try {
                const whole: Root = { folder, input: folder.uri.fsPath };
                const tests = await this.list(whole);
                if (tests) this.add(found, whole, tests);
                else await this.findInFolders(found, folder);
            } catch {
                return; // without rapidc there is nothing to show; the language server has said so
            }
        }
        this.controller.items.replace([...found.values()]);
    }

    private async findInFolders(found: Map<string, vscode.TestItem>, folder: vscode.WorkspaceFolder): Promise<void> {
        const files = await vscode.workspace.findFiles(new vscode.RelativePattern(folder, modulePattern));
        const inputs = new Set(files.map((file) => dirname(file.fsPath)));
        for (const input of [...inputs].sort()) {
            const root: Root = { folder, input };
            this.add(found, root, (await this.list(root)) ?? []);
        }
    }

    private add(found: Map<string, vscode.TestItem>, root: Root, tests: ListedTest[]): void {
        for (const test of tests) {
            const uri = inFolder(root.folder, test.file);
            const moduleId = `${root.input}|${uri.fsPath}|${test.module}`;
            let module = found.get(moduleId);
            if (!module) {
                module = this.controller.createTestItem(moduleId, test.module, uri);
                found.set(moduleId, module);
                this.roots.set(moduleId, root);
            }
            const item = this.controller.createTestItem(`${moduleId}|${test.id}`, test.name, uri);
            item.range = new vscode.Range(test.line - 1, test.column - 1, Math.max(test.endLine, test.line) - 1, 1000);
            this.ids.set(item, test.id);
            module.children.add(item);
        }
    }

    /** The tests that are asked for, by program. */
    private chosen(request: vscode.TestRunRequest): Map<string, { root: Root; items: Map<string, vscode.TestItem> }> {
        const result = new Map<string, { root: Root; items: Map<string, vscode.TestItem> }>();
        const visit = (item: vscode.TestItem): void => {
            if (request.exclude?.includes(item)) return;
            item.children.forEach(visit);
            const id = this.ids.get(item);
            const root = item.parent && this.roots.get(item.parent.id);
            if (!id || !root) return;
            const entry = result.get(root.input) ?? { root, items: new Map<string, vscode.TestItem>() };
            entry.items.set(id, item);
            result.set(root.input, entry);
        };
        if (request.include) request.include.forEach(visit);
        else this.controller.items.forEach(visit);
        return result;
    }

    private async run(request: vscode.TestRunRequest, token: vscode.CancellationToken, coverage: boolean): Promise<void> {
        const run = this.controller.createTestRun(request);
        try {
            for (const { root, items } of this.chosen(request).values()) {
                items.forEach((item) => run.started(item));
                if (!token.isCancellationRequested) await this.runIn(run, root, items, token, coverage);
            }
        } finally {
            run.end();
        }
    }

    private async runIn(run: vscode.TestRun, root: Root, items: Map<string, vscode.TestItem>, token: vscode.CancellationToken,
        coverage: boolean): Promise<void> {
        const scratch = await mkdtemp(join(tmpdir(), "rapidc-coverage-"));
        const info = join(scratch, "coverage.info");
        const args = ["test", root.input, "--format=json", ...this.arguments(root.folder)];
        for (const id of items.keys()) args.push(`--filter=${id}`);
        if (coverage) args.push(`--lcov=${info}`);
        try {
            const result = await runRapidc(args, root.folder.uri.fsPath, token);
            const report = result.stdout.startsWith("{") ? (JSON.parse(result.stdout) as { tests: FinishedTest[] }) : undefined;
            if (!report) throw new Error(result.stderr || `rapidc test ended with status ${result.status}`);
            for (const test of report.tests) this.show(run, root, items.get(test.id), test);
            if (coverage) addCoverage(run, root.folder, await readFile(info, "utf8"));
        } catch (error) {
            const message = new vscode.TestMessage(String(error instanceof Error ? error.message : error));
            items.forEach((item) => run.errored(item, message));
        } finally {
            await rm(scratch, { recursive: true, force: true });
        }
    }

    private show(run: vscode.TestRun, root: Root, item: vscode.TestItem | undefined, test: FinishedTest): void {
        if (!item) return; // the name of another test contains that of a chosen one
        const text = [test.output, test.events].filter(Boolean).join("");
        if (text) run.appendOutput(text.replace(/\r?\n/g, "\r\n"), undefined, item);
        const duration = test.wallTime * 1000;
        if (test.outcome === "passed") return run.passed(item, duration);
        if (test.outcome === "skipped") return run.skipped(item);
        const message = test.expected !== undefined
            ? vscode.TestMessage.diff(test.message ?? "", test.expected, test.actual ?? "")
            : new vscode.TestMessage(test.message ?? test.outcome);
        if (test.at)
            message.location = new vscode.Location(
                inFolder(root.folder, test.at.file), new vscode.Position(test.at.line - 1, Math.max(test.at.column - 1, 0)));
        if (test.outcome === "failed") run.failed(item, message, duration);
        else run.errored(item, message, duration);
    }
}

/** The lines of a trace file of lcov. */
function addCoverage(run: vscode.TestRun, folder: vscode.WorkspaceFolder, info: string): void {
    let path = "";
    let lines: vscode.StatementCoverage[] = [];
    for (const line of info.split("\n")) {
        if (line.startsWith("SF:")) {
            path = line.slice(3);
            lines = [];
        } else if (line.startsWith("DA:")) {
            const [number, count] = line.slice(3).split(",").map(Number);
            lines.push(new vscode.StatementCoverage(count ?? 0, new vscode.Position((number ?? 1) - 1, 0)));
        } else if (line === "end_of_record") {
            run.addCoverage(vscode.FileCoverage.fromDetails(inFolder(folder, path), lines));
        }
    }
}

export function registerTests(context: vscode.ExtensionContext): void {
    new Tests(context);
}
