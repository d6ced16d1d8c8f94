// The web page in Chromium. The steps of simulated.mjs drive it against a simulated controller, those of served.mjs against
// `rapidc serve`. Usage: see README.md.

import { mkdirSync, rmSync } from "node:fs";
import { createRequire } from "node:module";
import { join, resolve } from "node:path";
import { start } from "../../web/pendant/test/simulated_server.mjs";
import { servedSteps, startServe } from "./served.mjs";
import { takeScreenshots } from "./screenshots.mjs";
import { simulatedSteps } from "./simulated.mjs";

function option(name, fallback) {
    const at = process.argv.indexOf(`--${name}`);
    return at < 0 ? fallback : process.argv[at + 1];
}

const tools = resolve(option("tools", "build/pendant"));
const folder = resolve(option("page", "build/page/dist"));
const out = resolve(option("out", "build/pendant/screenshots"));
const rapidc = option("rapidc", "build/rapidc");
const only = option("only", "");
const { chromium } = createRequire(join(tools, "package.json"))("playwright-core");

rmSync(out, { recursive: true, force: true });
mkdirSync(out, { recursive: true });
const browser = await chromium.launch({ executablePath: "/usr/bin/chromium", headless: true });
let passed = 0;
let failed = 0;

/** Runs one step on a page of its own; any message of the page's console that is an error fails it. */
async function run(name, address, step, context) {
    if (only && !name.includes(only)) return;
    const page = await browser.newPage({ viewport: { width: 1280, height: 800 }, colorScheme: "dark" });
    const problems = [];
    const hosts = new Set();
    page.on("console", (message) => message.type() === "error" && problems.push(message.text()));
    page.on("pageerror", (error) => problems.push(String(error)));
    page.on("request", (request) => hosts.add(new URL(request.url()).host));
    try {
        await page.goto(address);
        await page.waitForSelector(".cover", { state: "hidden" });
        await page.waitForSelector(".code-line");
        await step(page, context);
        if (problems.length > 0) throw new Error(`the page reported: ${problems.join("; ")}`);
        const foreign = [...hosts].filter((host) => host !== new URL(address).host);
        if (foreign.length > 0) throw new Error(`the page asked other hosts: ${foreign.join(", ")}`);
        passed += 1;
        console.log(`ok ${name}`);
    } catch (error) {
        failed += 1;
        console.log(`FAILED ${name}\n  ${String(error.stack ?? error).replace(/\n/g, "\n  ")}`);
        await page.screenshot({ path: join(out, `failed-${name.replace(/\W+/g, "_")}.png`) }).catch(() => {});
    }
    await page.close();
}

for (const [name, step] of Object.entries(simulatedSteps)) {
    const server = await start(folder);
    await run(`simulated: ${name}`, `http://127.0.0.1:${server.port}`, step, server);
    server.close();
}

if (!only || "served:".includes(only.slice(0, 6))) {
    for (const [name, { step, options }] of Object.entries(servedSteps)) {
        const serving = await startServe(rapidc, options);
        await run(`served: ${name}`, serving.addresses.web, step, serving);
        await serving.stop();
    }
}

if (option("pictures", "yes") === "yes" && (!only || only === "screenshots")) {
    const server = await start(folder);
    await takeScreenshots(browser, `http://127.0.0.1:${server.port}`, out);
    server.close();
    console.log(`screenshots: ${out}`);
}

await browser.close();
console.log(`${passed} passed, ${failed} failed`);
process.exit(failed > 0 ? 1 : 0);
