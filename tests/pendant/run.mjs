// node run.mjs --tools FOLDER --page DIST --rapidc EXE --out SCREENSHOTS [--only NAME] [--panel NAME]

import { mkdirSync } from "node:fs";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";
import { launch, openPage, servePage, sizes } from "./browser.mjs";
import { frameRate } from "./frame_rate.mjs";
import { panelChecks } from "./panel_checks.mjs";
import * as rules from "./page_checks.mjs";
import { realController } from "./real_controller.mjs";
import { SimulatedController } from "./simulated_controller.mjs";

const root = resolve(dirname(fileURLToPath(import.meta.url)), "../..");
const options = { tools: "build/pendant", page: "build/pendant_page/dist", rapidc: "build/rapidc", out: "build/pendant/screenshots", only: "", panel: "" };
for (let i = 2; i < process.argv.length; i += 2) options[process.argv[i].replace(/^--/, "")] = process.argv[i + 1];
const panels = ["program", "events", "signals", "data", "display", "jog", "recording", "files"].filter((name) => !options.panel || name === options.panel);
let failures = 0;

function report(name, problems) {
    failures += problems.length > 0 ? 1 : 0;
    console.log(`${problems.length > 0 ? "FAILED" : "ok    "} ${name}${problems.map((problem) => `\n         ${problem}`).join("")}`);
}

/** Each panel in each scheme and size: a screenshot, and the rules that hold everywhere. */
async function looks(browser, address, controller) {
    for (const scheme of ["dark", "light"]) {
        for (const size of Object.keys(sizes)) {
            controller.reset();
            const { page, end } = await openPage(browser, address, controller, { size, scheme });
            controller.flood(300);
            controller.setRunning(false);
            await page.waitForTimeout(1500); // the fine picture of a robot at rest
            for (const panel of panels) {
                await page.locator(`#tab-${panel}`).click();
                await page.waitForTimeout(250);
                await page.screenshot({ path: join(options.out, `${panel}-${scheme}-${size}.png`) });
                for (const rule of [rules.lowContrast, rules.coveredControls, rules.namelessControls, rules.tinyControls])
                    report(`${panel}, ${scheme}, ${size}: ${rule.name}`, await page.evaluate(rule));
            }
            report(`${scheme}, ${size}: no errors, no other host, content security policy`, await end());
        }
    }
}

/** Tab reaches the controls, and each shows the focus. */
async function keyboard(browser, address, controller) {
    controller.reset();
    const { page, end } = await openPage(browser, address, controller);
    controller.setRunning(false);
    for (const panel of panels) {
        await page.locator(`#tab-${panel}`).click();
        const seen = new Map();
        for (let i = 0; i < 60; ++i) {
            await page.keyboard.press("Tab");
            const focused = await page.evaluate(rules.focusedElement);
            if (focused) seen.set(focused.key, focused);
        }
        const hidden = [...seen.values()].filter(({ isVisible }) => !isVisible).map(({ name }) => `the focus is not visible: ${name}`);
        report(`${panel}: the keyboard reaches ${seen.size} controls, focus visible`, seen.size < 10 ? ["too few"] : hidden);
    }
    report("keyboard: no errors", await end());
}

mkdirSync(options.out, { recursive: true });
const browser = await launch(options.tools);
const server = await servePage(resolve(options.page), root);
const controller = new SimulatedController();
const groups = {
    panels: () => panelChecks(browser, server.address, controller, report),
    looks: () => looks(browser, server.address, controller),
    keyboard: () => keyboard(browser, server.address, controller),
    frames: () => frameRate(browser, server.address, controller, report),
    real: () => realController(browser, options, root, report),
};
try {
    for (const [name, group] of Object.entries(groups)) if (!options.only || options.only === name) await group();
} finally {
    controller.end();
    server.end();
    await browser.close();
}
console.log(failures > 0 ? `${failures} checks failed` : "all checks passed");
process.exitCode = failures > 0 ? 1 : 0;
