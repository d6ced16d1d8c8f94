// The extension in VS Code's workbench: code-server in Chromium, driven by playwright-core.
//
// node workbench.mjs --tools DIR --rapidc PROGRAM --vsix FILE --out DIR [--only STEP]

import assert from "node:assert/strict";
import { spawn, spawnSync } from "node:child_process";
import { cpSync, mkdirSync, mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { createServer } from "node:net";
import { tmpdir } from "node:os";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";

const here = dirname(fileURLToPath(import.meta.url));

function option(name) {
    const at = process.argv.indexOf(`--${name}`);
    return at < 0 ? undefined : process.argv[at + 1];
}

const tools = resolve(option("tools"));
const rapidc = resolve(option("rapidc"));
const vsix = resolve(option("vsix"));
const out = resolve(option("out"));
const only = option("only");
const { chromium } = createRequire(join(tools, "package.json"))("playwright-core");
const entry = join(tools, "node_modules/code-server/out/node/entry.js");

const scratch = mkdtempSync(join(tmpdir(), "rapidc-workbench-"));
const folder = join(scratch, "cell");
const patience = 120_000; // ms; a machine of CI with other work on it

function freePort() {
    return new Promise((done) => {
        const server = createServer();
        server.listen(0, "127.0.0.1", () => {
            const { port } = server.address();
            server.close(() => done(port));
        });
    });
}

function prepare() {
    rmSync(out, { recursive: true, force: true });
    mkdirSync(out, { recursive: true });
    cpSync(join(here, "folder"), folder, { recursive: true });
    const settings = JSON.stringify({
        "rapidc.path": rapidc,
        "workbench.startupEditor": "none",
        "security.workspace.trust.enabled": false,
        "telemetry.telemetryLevel": "off",
        "chat.commandCenter.enabled": false,
        "workbench.secondarySideBar.defaultVisibility": "hidden",
        "editor.hover.delay": 200,
        "testing.automaticallyOpenTestResults": "neverOpen",
        "files.autoSave": "off",
        "workbench.quickOpen.closeOnFocusLost": false,
    });
    for (const scope of ["User", "Machine"]) { // the path of a program belongs to the machine of the server
        mkdirSync(join(scratch, "user", scope), { recursive: true });
        writeFileSync(join(scratch, "user", scope, "settings.json"), settings);
    }
    const installed = spawnSync(process.execPath, [entry, "--user-data-dir", join(scratch, "user"), "--extensions-dir",
        join(scratch, "extensions"), "--install-extension", vsix], { encoding: "utf8" });
    assert.equal(installed.status, 0, installed.stdout + installed.stderr);
}

async function serve() {
    const port = await freePort();
    const server = spawn(process.execPath, [entry, "--user-data-dir", join(scratch, "user"), "--extensions-dir", join(scratch, "extensions"),
        "--bind-addr", `127.0.0.1:${port}`, "--auth", "none", "--disable-telemetry", "--disable-update-check", "--disable-workspace-trust"],
        { stdio: ["ignore", "pipe", "pipe"], detached: true });
    let log = "";
    for (const stream of [server.stdout, server.stderr]) stream.on("data", (bytes) => (log += bytes));
    for (let i = 0; i < 600 && !log.includes("HTTP server listening"); ++i) await new Promise((done) => setTimeout(done, 100));
    assert.match(log, /HTTP server listening/, log);
    return { port, stop: () => process.kill(-server.pid, "SIGKILL") };
}

class Workbench {
    constructor(page, port) {
        this.page = page;
        this.port = port;
        this.shots = 0;
    }
    async open(file) {
        const payload = [["openFile", `vscode-remote://127.0.0.1:${this.port}${join(folder, file)}`]];
        await this.page.goto(`http://127.0.0.1:${this.port}/?folder=${encodeURIComponent(folder)}&payload=${encodeURIComponent(JSON.stringify(payload))}`, { waitUntil: "commit" });
        await this.page.waitForSelector(".monaco-editor .view-line", { timeout: patience });
        await this.expectText(".statusbar", /RAPID/, "language in the status bar");
        await this.page.locator(".monaco-editor .view-lines").first().click();
    }
    async shot(name) {
        const path = join(out, `${String(++this.shots).padStart(2, "0")}-${name}.png`);
        await this.page.screenshot({ path });
    }
    async command(title) {
        await this.page.keyboard.press("F1");
        await this.page.waitForSelector(".quick-input-widget input", { state: "visible" });
        await this.page.keyboard.type(title, { delay: 10 });
        await this.page.waitForSelector(`.quick-input-list .monaco-list-row:has-text("${title}")`, { timeout: patience });
        await this.page.keyboard.press("Enter");
    }
    /** Puts the cursor at a line and column, both from 1. */
    async goTo(line, column) {
        await this.page.keyboard.press("Control+G");
        await this.page.waitForSelector(".quick-input-widget input", { state: "visible" });
        await this.page.keyboard.type(`:${line}:${column}`.slice(1));
        await this.page.keyboard.press("Enter");
        await this.page.waitForTimeout(300);
    }
    text(selector) {
        return this.page.locator(selector).allInnerTexts().then((texts) => texts.join("\n").replace(/\u00a0/g, " "));
    }
    /** Waits until the text of what the selector finds matches. */
    async expectText(selector, pattern, what) {
        const end = Date.now() + patience;
        let found = "";
        while (Date.now() < end) {
            found = await this.text(selector);
            if (pattern.test(found)) return found;
            await this.page.waitForTimeout(200);
        }
        throw new Error(`${what}: expected ${pattern}, found:\n${found.slice(0, 2000)}`);
    }
}

const steps = {
    /** A mistake: squiggle, row in Problems; corrected: both are gone. */
    async diagnostics(bench) {
        await bench.open("palletizer.modx");
        await bench.goTo(12, 1);
        await bench.page.keyboard.press("End");
        await bench.page.keyboard.type("\nn:=missing;");
        await bench.page.waitForSelector(".squiggly-error", { timeout: patience });
        await bench.command("Problems: Focus on Problems View");
        await bench.expectText(".markers-panel", /'missing' is not declared.*rapidc.*RAP2001/s, "row in Problems");
        await bench.shot("diagnostics");
        await bench.command("File: Revert File");
        await bench.expectText(".markers-panel", /No problems/, "Problems after the correction");
    },
    async completion(bench) {
        await bench.goTo(12, 1);
        await bench.page.keyboard.press("End");
        await bench.page.keyboard.type("\nMoveA", { delay: 30 });
        await bench.page.waitForSelector(".suggest-widget.visible", { timeout: patience });
        await bench.expectText(".suggest-widget", /MoveAbsJ/, "completion of MoveA");
        await bench.shot("completion");
        await bench.page.keyboard.press("Escape");
        await bench.command("File: Revert File");
    },
    async hover(bench) {
        await bench.goTo(10, 11);
        await bench.command("Show or Focus Hover");
        await bench.expectText(".monaco-hover", /PERS num placed.*Parts that lie on the pallet/s, "hover");
        await bench.shot("hover");
        await bench.page.keyboard.press("Escape");
    },
    /** A click on the lens of a routine shows its uses. */
    async lenses(bench) {
        await bench.expectText(".codelens-decoration", /0 references.*2 references/s, "lenses of main and slot");
        await bench.page.locator(".codelens-decoration a", { hasText: "2 references" }).click();
        await bench.expectText(".peekview-widget", /palletizer_test\.modx/, "references at a click on the lens");
        await bench.shot("references");
        await bench.page.keyboard.press("Escape");
    },
    /** F9 at line 9, F5: stops with call stack and locals; continues to the end. */
    async debug(bench) {
        await bench.goTo(9, 1);
        await bench.page.keyboard.press("F9");
        await bench.page.waitForSelector(".codicon-debug-breakpoint", { timeout: patience });
        await bench.page.keyboard.press("F5");
        await bench.page.waitForSelector(".debug-toolbar", { timeout: patience });
        await bench.expectText(".debug-call-stack", /main/, "call stack");
        await bench.expectText(".debug-variables", /Locals.*Persistents/s, "scopes");
        if (!/\bn\b/.test(await bench.text(".debug-variables")))
            await bench.page.locator('.debug-variables .monaco-list-row:has-text("Locals")').click();
        await bench.expectText(".debug-variables", /\bn\b.*0/s, "locals");
        await bench.shot("breakpoint");
        await bench.page.keyboard.press("F5");
        await bench.expectText(".debug-variables", /\bn\b.*1/s, "locals in the second round");
        await bench.goTo(9, 1);
        await bench.page.keyboard.press("F9"); // removes it
        await bench.page.keyboard.press("F5");
        await bench.page.waitForSelector(".debug-toolbar", { state: "hidden", timeout: patience });
        await bench.command("Debug Console: Focus on Debug Console View");
        await bench.expectText(".repl", /sum 6/, "output of TPWrite");
        await bench.shot("debug-console");
    },
    /** The task `check`: mistakes in an open file and in one that no editor has open are one row each, though the language server reports them as well. */
    async task(bench) {
        await bench.goTo(12, 1);
        await bench.page.keyboard.press("End");
        await bench.page.keyboard.type("\nn:=absent;");
        const wrong = join(folder, "wrong.modx");
        writeFileSync(wrong, "MODULE wrong\n  PROC broken()\n    missing := 1;\n  ENDPROC\nENDMODULE\n");
        await bench.command("Problems: Focus on Problems View");
        await bench.expectText(".markers-panel", /'absent' is not declared[^]*'missing' is not declared/, "mistakes, from the server");
        await bench.page.waitForTimeout(1000);
        await bench.command("Tasks: Run Build Task");
        await bench.page.waitForTimeout(3000);
        await bench.page.locator('.quick-input-list .monaco-list-row:has-text("check")').first().click();
        await bench.expectText(".part.panel", /check - Task/, "terminal of the task"); // its text is a picture
        await bench.page.waitForTimeout(3000);
        await bench.shot("task");
        await bench.command("Problems: Focus on Problems View");
        const found = await bench.expectText(".markers-panel", /'missing' is not declared/, "mistakes after the task");
        await bench.shot("task-problems");
        const rows = found.match(/'\w+' is not declared/g) ?? [];
        assert.deepEqual(rows, ["'absent' is not declared", "'missing' is not declared"], "rows after the task");
        rmSync(wrong);
        cpSync(join(here, "folder", "palletizer.modx"), join(folder, "palletizer.modx")); // the task has saved it
        await bench.expectText(".markers-panel", /No problems/, "Problems when the file is gone");
    },
    async tests(bench) {
        await bench.command("Testing: Focus on Test Explorer View");
        await bench.expectText(".test-explorer", /PalletizerTest/, "module in the Testing view");
        await bench.command("Test: Run All Tests");
        await bench.expectText(".test-explorer", /1\/2/, "results in the Testing view");
        await bench.shot("tests");
        await bench.command("Test: Run All Tests with Coverage");
        await bench.expectText(".part.sidebar", /palletizer\.modx[^]*\d+(\.\d+)?%/, "covered file in the Testing view");
        await bench.shot("coverage");
    },
    async ir(bench) {
        await bench.open("palletizer.modx");
        await bench.goTo(16, 10);
        await bench.command("RAPID: Show the IR of This Routine");
        await bench.expectText(".monaco-editor", /routine @"T_ROB1\/Palletizer\/slot"/, "IR of the routine");
        await bench.shot("ir");
    },
};

prepare();
const server = await serve();
let failed = 0;
try {
    const browser = await chromium.launch({ executablePath: process.env["CHROMIUM"] ?? "/usr/bin/chromium", headless: true });
    const page = await browser.newPage({ viewport: { width: 1400, height: 900 } });
    page.setDefaultTimeout(patience);
    const bench = new Workbench(page, server.port);
    if (only && only !== "diagnostics") await bench.open("palletizer.modx");
    for (const [name, step] of Object.entries(steps)) {
        if (only && name !== only) continue;
        const began = Date.now();
        try {
            await step(bench);
            console.log(`ok      ${name}  ${((Date.now() - began) / 1000).toFixed(1)} s`);
        } catch (error) {
            ++failed;
            await bench.shot(`failed-${name}`).catch(() => undefined);
            console.log(`FAILED  ${name}\n        ${String(error.message ?? error).replace(/\n/g, "\n        ")}`);
            await page.keyboard.press("Escape").catch(() => undefined);
        }
    }
    await browser.close();
} finally {
    server.stop();
    rmSync(scratch, { recursive: true, force: true });
}
console.log(`${failed === 0 ? "all steps passed" : `${failed} steps failed`}; screenshots: ${out}`);
process.exit(failed === 0 ? 0 : 1);
