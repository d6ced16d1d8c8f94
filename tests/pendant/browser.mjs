// Debian's Chromium with the bundled page, which is served as rapidc serves it; no network but this computer's.

import { readFileSync } from "node:fs";
import { createServer } from "node:http";
import { createRequire } from "node:module";
import { join, resolve } from "node:path";

const types = { html: "text/html;charset=utf-8", js: "text/javascript;charset=utf-8", css: "text/css;charset=utf-8", svg: "image/svg+xml", txt: "text/plain" };

/** The policy that the server sends, from its source: the page must work under that one. */
function contentPolicy(root) {
    const source = readFileSync(join(root, "tools/pendant/pendant_service.cpp"), "utf8");
    const value = /kContentPolicy =\s*((?:"[^"]*"\s*)+);/.exec(source)?.[1];
    if (!value) throw new Error("tools/pendant/pendant_service.cpp has no kContentPolicy");
    return [...value.matchAll(/"([^"]*)"/g)].map(([, part]) => part).join("");
}

export function servePage(folder, root) {
    const policy = contentPolicy(root);
    const server = createServer((request, response) => {
        const name = request.url === "/" ? "index.html" : request.url.slice(1);
        const type = types[name.split(".").at(-1)];
        try {
            if (!type || name.includes("/")) throw new Error("unknown");
            response.writeHead(200, { "Content-Type": type, "Content-Security-Policy": policy, "X-Content-Type-Options": "nosniff" });
            response.end(readFileSync(join(folder, name)));
        } catch {
            response.writeHead(404).end();
        }
    });
    return new Promise((done) => {
        server.listen(0, "127.0.0.1", () => done({ address: `http://127.0.0.1:${server.address().port}`, end: () => server.close() }));
    });
}

export async function launch(tools) {
    const { chromium } = createRequire(resolve(tools, "package.json"))("playwright-core");
    return chromium.launch({ executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium", headless: true });
}

export const sizes = { laptop: [1280, 800], small: [1024, 768], tablet: [820, 1180] };

/**
 * A page with the simulated controller (null: with whatever answers at the address). `problems` collects what must not happen on any page:
 * errors, violations of the policy, requests to other hosts.
 */
export async function openPage(browser, address, controller, { size = "laptop", scheme = "dark", panel = "" } = {}) {
    const [width, height] = sizes[size];
    const context = await browser.newContext({ viewport: { width, height }, colorScheme: scheme, reducedMotion: "reduce" });
    const page = await context.newPage();
    const problems = [];
    page.on("console", (message) => message.type() === "error" && problems.push(`console: ${message.text()}`));
    page.on("pageerror", (error) => problems.push(`error: ${error.message}`));
    page.on("request", (request) => {
        const url = request.url();
        if (!url.startsWith(`${address}/`) && !/^(data|blob):/.test(url)) problems.push(`request to another host: ${url}`);
    });
    await page.addInitScript(() => {
        globalThis.violations = [];
        addEventListener("securitypolicyviolation", (event) => globalThis.violations.push(`${event.violatedDirective} ${event.blockedURI}`));
    });
    if (controller) await page.routeWebSocket(/\/api$/, (socket) => controller.connect(socket));
    await page.goto(`${address}/${panel ? `#${panel}` : ""}`);
    await page.getByRole("tab").first().waitFor();
    await page.locator(".cover").waitFor({ state: "hidden" });
    await page.waitForTimeout(300); // the first picture of the robots
    const end = async () => {
        problems.push(...(await page.evaluate(() => globalThis.violations)).map((text) => `content security policy: ${text}`));
        await context.close();
        return problems;
    };
    return { page, end };
}
