// Steps against `rapidc serve`: page and controller together. Each names the rule of docs/pendant.md or of issue 20.

import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { cpSync, mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";

const tab = (page, name) => page.click(`#tab-${name}`);

async function eventually(check, what) {
    for (let tries = 0; tries < 200; tries++) {
        if (await check()) return;
        await new Promise((done) => setTimeout(done, 50));
    }
    assert.fail(`did not happen within 10 s: ${what}`);
}

/** Starts it with a copy of the sample; the result has `addresses` and `stop()`. */
export function startServe(rapidc, options = []) {
    const scratch = mkdtempSync(join(tmpdir(), "rapidc-pendant-"));
    cpSync("samples/pick_and_place", join(scratch, "cell"), { recursive: true });
    const child = spawn(rapidc, ["serve", join(scratch, "cell"), ...options], { stdio: ["ignore", "pipe", "inherit"] });
    const ended = new Promise((done) => child.on("exit", done));
    return new Promise((done, fail) => {
        const late = setTimeout(() => fail(new Error("rapidc serve is not ready after 60 s")), 60000);
        let text = "";
        child.stdout.on("data", (bytes) => {
            text += bytes;
            if (!text.includes("\n")) return;
            clearTimeout(late);
            const stop = async () => {
                child.kill("SIGTERM");
                await ended;
                rmSync(scratch, { recursive: true, force: true });
            };
            done({ addresses: JSON.parse(text), stop });
        });
        child.on("exit", (status) => fail(new Error(`rapidc serve ended with status ${status}`)));
    });
}

export const servedSteps = {
    "a running program": {
        // serve-contract 5: motors on, running; the robot of the model is drawn
        async step(page) {
            await page.waitForSelector(".pill-running");
            await page.waitForSelector(".motors[aria-pressed='true']");
            await eventually(async () => (await page.evaluate(() => window.rapidcStatistics().frames)) > 3, "frames are drawn");
            await tab(page, "signals");
            await page.waitForSelector(".signal-row:has-text('diStart')");
            await tab(page, "events");
            await page.waitForSelector(".event");
        },
    },

    "simulate the start button, watch data, read the display": {
        async step(page) {
            await tab(page, "signals");
            const row = page.locator(".signal-row", { has: page.locator("text=/^diStart$/") });
            if ((await row.locator(".lamp").isDisabled())) await row.locator("button:has-text('Simulate')").click();
            await row.locator(".lamp:not(:disabled)").click();
            await row.locator(".lamp[aria-checked='true']").waitFor();
            await tab(page, "display");
            await page.waitForSelector(".display-line:has-text('Start')");
            await tab(page, "data");
            await page.fill("input[placeholder='Name']", "partsSeen");
            await page.waitForSelector("input[aria-label='Value of partsSeen']");
        },
    },

    "stopped at main: step, breakpoint, edit": {
        options: ["--no-program-start"],
        async step(page) {
            await page.waitForSelector(".pill-stopped");
            await page.waitForSelector(".has-pointer");
            await page.click(".motors");
            await page.waitForSelector(".motors[aria-pressed='true']");
            const before = await page.locator(".has-pointer .code-number").textContent();
            await page.keyboard.press("F11");
            await eventually(async () => (await page.locator(".has-pointer .code-number").textContent()) !== before, "the pointer moves");
            await page.click(".code-gutter[data-line='14']");
            await page.waitForSelector(".has-breakpoint");
            await page.click("button:has-text('Edit')");
            const text = await page.inputValue(".code-area");
            await page.fill(".code-area", text.replace("ENDMODULE", "ENDMODUL"));
            await page.click("button:has-text('Apply')");
            await page.waitForSelector(".mistake");
            await page.fill(".code-area", text.replace("! A pick-and-place cell", "! A changed cell"));
            await page.click("button:has-text('Apply')");
            await page.waitForSelector("button:has-text('Edit')");
        },
    },

    "jogging in manual mode": {
        options: ["--no-program-start"],
        async step(page) {
            await tab(page, "jog");
            for (const step of ["Manual mode", "Motors on"]) await page.click(`.guard button:has-text('${step}')`);
            await page.waitForSelector(".guard", { state: "hidden" });
            const value = page.locator(".jog-value").first();
            const before = await value.textContent();
            await page.locator("button[aria-label='Axis 1 positive']").hover();
            await page.mouse.down();
            await page.waitForTimeout(800);
            await page.mouse.up();
            await eventually(async () => (await value.textContent()) !== before, "axis 1 moves");
        },
    },

    backup: {
        async step(page) {
            await tab(page, "files");
            await page.click(".card:has-text('Backup') button");
            await page.waitForSelector("text=Backup created");
        },
    },
};
