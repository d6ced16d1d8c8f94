// Steps against the simulated controller of web/pendant/test. Each names the rule of docs/pendant.md or issue 20 that it checks.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";

const tab = (page, name) => page.click(`#tab-${name}`);
const last = (server, method) => server.cell.requests.filter((request) => request.method === method).pop()?.params;
const eventually = async (check, what) => {
    for (let tries = 0; tries < 100; tries++) {
        if (await check()) return;
        await new Promise((done) => setTimeout(done, 50));
    }
    assert.fail(`did not happen within 5 s: ${what}`);
};

export const simulatedSteps = {
    // run.start, run.stop and steps only while they are possible
    async "start, stop and steps"(page, server) {
        await page.click("text=Stop >> visible=true");
        await eventually(() => !server.cell.panel.running, "the program stops");
        await page.waitForSelector(".pill-stopped");
        await page.keyboard.press("F10");
        await eventually(() => last(server, "run.start")?.mode === "stepOver", "F10 steps");
        await page.click("button[aria-label='Step backward']");
        await eventually(() => last(server, "run.start")?.mode === "stepBack", "step backward");
        await page.click("button[aria-label='Program pointer to main']");
        await eventually(() => last(server, "run.pointerToMain") !== undefined, "PP to main");
        await page.keyboard.press("F5");
        await page.waitForSelector(".pill-running");
    },

    // the emergency stop works from every panel, and motors need its release
    async "emergency stop"(page, server) {
        await page.click(".emergency");
        await eventually(() => server.cell.panel.emergencyStop, "pressed");
        await page.waitForSelector(".emergency[aria-pressed='true']");
        await page.click(".motors");
        await page.waitForSelector("text=Release it first");
        await page.click(".emergency");
        await eventually(() => !server.cell.panel.emergencyStop, "released");
    },

    // the emergency stop lies within the picture in every size the page is made for
    async "emergency stop is visible in every size"(page) {
        for (const [width, height] of [[1280, 800], [1024, 768], [820, 1180], [768, 1024], [1920, 1080]]) {
            await page.setViewportSize({ width, height });
            const box = await page.locator(".emergency").boundingBox();
            assert.ok(box && box.x >= 0 && box.x + box.width <= width && box.y >= 0, `at ${width}x${height}: ${JSON.stringify(box)}`);
            const widest = await page.evaluate(() => document.documentElement.scrollWidth);
            assert.ok(widest <= width, `the page is ${widest} wide at ${width}`);
        }
    },

    async "program, breakpoints, edit with mistakes"(page, server) {
        assert.match(await page.locator(".has-pointer .code-number").textContent(), /20/);
        await page.click(".code-gutter[data-line='9']");
        await eventually(() => server.cell.breakpoints.some(({ line }) => line === 9), "breakpoint set");
        await page.waitForSelector(".has-breakpoint .code-gutter[data-line='9']");
        await page.click(".code-gutter[data-line='9']");
        await eventually(() => !server.cell.breakpoints.some(({ line }) => line === 9), "breakpoint cleared");
        await page.click("text=Stop >> visible=true");
        await page.waitForSelector(".pill-stopped");
        await page.click("button:has-text('Edit')");
        await page.fill(".code-area", "MODULE MainModule\n");
        await page.click("button:has-text('Apply')");
        await page.waitForSelector(".mistake >> nth=1");
        await page.fill(".code-area", "MODULE MainModule\n   PROC main()\n   ENDPROC\nENDMODULE\n");
        await page.click("button:has-text('Apply')");
        await eventually(() => server.cell.texts.MainModule.length < 70, "text applied");
        await page.waitForSelector("button:has-text('Edit')");
    },

    async "events with details"(page, server) {
        await tab(page, "events");
        await page.click(".event-head:has-text('Joint Out of Range')");
        await page.waitForSelector("text=Probable causes");
        await page.click("text=Warnings");
        await eventually(async () => (await page.locator(".event").count()) === 1, "one warning");
        await page.click(".segment:has-text('All') >> visible=true");
        server.cell.log(10099, "error", "<img src=x onerror=alert(1)>");
        await page.waitForSelector(".event-title:has-text('<img src=x')"); // text, never markup
    },

    async "signals: filter, set, simulate"(page, server) {
        await tab(page, "signals");
        await page.fill("input[placeholder='Name, label, device']", "vacuum v");
        await eventually(async () => (await page.locator(".signal-row").count()) === 1, "one signal matches");
        await page.click(".lamp");
        await eventually(() => server.cell.signals.find(({ name }) => name === "doVacuum").value === 1, "set");
        await page.fill("input[placeholder='Name, label, device']", "distart");
        await page.waitForSelector(".lamp:disabled"); // an input that is not simulated belongs to its device
        await page.click(".signal-row button:has-text('Simulate')");
        await page.waitForSelector(".signal-row.simulated");
        server.cell.setSignal("diStart", 1);
        await page.waitForSelector(".lamp[aria-checked='true']");
    },

    async "data: watch and write"(page, server) {
        await tab(page, "data");
        const input = page.locator("input[aria-label='Value of partsPlaced']");
        await eventually(async () => (await input.inputValue()) === "3", "value shown");
        server.cell.emit("data", [["T_ROB1/MainModule/partsPlaced", "4"]]);
        await eventually(async () => (await input.inputValue()) === "4", "value follows");
        await input.fill("many");
        await input.press("Enter");
        await page.waitForSelector("text='many' is not a num");
        await input.press("Escape");
        assert.equal(await input.inputValue(), "4");
        await input.fill("5");
        await input.press("Enter");
        await eventually(() => last(server, "data.write")?.value === "5", "written");
        assert.equal(await page.locator("input[aria-label='Value of nRows']").getAttribute("readonly"), "");
    },

    async "dialogs and display"(page, server) {
        const dialog = { id: 7, task: "T_ROB1", instruction: "UIMsgBox", kind: "choice", header: "Tray full", lines: ["Take the tray out"], icon: "Warning", choices: ["Done", "", "Cancel"], items: [], initial: "" };
        server.cell.dialogs = [dialog];
        server.cell.emit("dialog", { opened: dialog });
        await page.waitForSelector("[role=dialog] >> text=Take the tray out");
        await page.click("[role=dialog] button:has-text('Cancel')");
        await eventually(() => last(server, "dialogs.answer")?.choice === 3, "the third button");
        await page.waitForSelector("[role=dialog]", { state: "detached" });
        const number = { ...dialog, id: 8, kind: "number", choices: [], minimum: 1, maximum: 9, wholeNumbers: true, initial: "3" };
        server.cell.emit("dialog", { opened: number });
        assert.equal(await page.inputValue("[role=dialog] input"), "3"); // the initial value of the program
        await page.waitForSelector("[role=dialog] >> text=1 to 9, whole numbers");
        await page.fill("[role=dialog] input", "12");
        await page.press("[role=dialog] input", "Enter");
        await page.waitForSelector("[role=dialog] [role=alert] >> text=The largest value is 9."); // beyond the maximum: not sent
        assert.notEqual(last(server, "dialogs.answer")?.id, 8);
        await page.fill("[role=dialog] input", "5");
        await page.press("[role=dialog] input", "Enter");
        await eventually(() => last(server, "dialogs.answer")?.number === 5, "number sent");
        await tab(page, "display");
        server.cell.emit("display", { line: "written last" });
        await page.waitForSelector(".display-line:last-child:has-text('written last')");
    },

    // jog.start is repeated every 100 ms while the button is held, and stops with it
    async "jogging while a button is held"(page, server) {
        await tab(page, "jog");
        for (const step of ["Stop", "Manual mode", "Motors on"]) await page.click(`.guard button:has-text('${step}')`);
        await page.waitForSelector(".guard", { state: "hidden" });
        const key = page.locator("button[aria-label='Axis 1 positive']");
        await key.hover();
        await page.mouse.down();
        await page.waitForTimeout(700);
        await page.mouse.up();
        const starts = server.cell.requests.filter(({ method }) => method === "jog.start");
        assert.ok(starts.length >= 4, `${starts.length} repetitions in 0.7 s`);
        assert.deepEqual(starts[0].params.values.map(Math.sign), [1, 0, 0, 0, 0, 0]);
        await eventually(() => last(server, "jog.stop") !== undefined, "jog.stop");
        // and when the pointer leaves the button, or the window loses the focus
        const stops = () => server.cell.requests.filter(({ method }) => method === "jog.stop").length;
        for (const leave of [() => page.mouse.move(1, 1), () => page.evaluate(() => window.dispatchEvent(new Event("blur")))]) {
            const before = stops();
            await key.hover();
            await page.mouse.down();
            await page.waitForSelector(".jog-key.held");
            await leave();
            await page.waitForSelector(".jog-key.held", { state: "detached" });
            await eventually(() => stops() > before, "jog.stop");
            await page.mouse.up();
        }
        await page.click(".segment:has-text('0.1')");
        await key.focus();
        await page.keyboard.press("Enter");
        await eventually(() => last(server, "jog.start")?.increment === 0.1, "an increment, by keyboard");
    },

    async "recording: scrub and compare two runs"(page, server) {
        await page.waitForTimeout(600);
        await page.click(".stop");
        await page.waitForSelector(".pill-stopped");
        await page.click(".start");
        await page.waitForTimeout(800);
        await tab(page, "recording");
        await page.selectOption("select[aria-label='Run']", { label: "Run 1" });
        await page.selectOption("select[aria-label='Compare with']", { label: "Run 2" });
        await page.locator(".time-line").focus();
        await page.keyboard.press("ArrowRight");
        await page.waitForSelector("text=compared with Run 2");
        server.cell.setSignal("doVacuum", 1);
        await page.selectOption("select[aria-label='Run']", { label: "Run 2" });
        await page.click("button:has-text('Live')");
        await page.waitForSelector(".view-banner", { state: "hidden" });
        await eventually(async () => (await page.locator("select[aria-label='Signal'] option").count()) > 0, "the signal can be chosen");
        const [saved] = await Promise.all([page.waitForEvent("download"), page.click("button[aria-label='Save the run as CSV']")]);
        assert.equal(saved.suggestedFilename(), "Run_2.csv");
        await page.setInputFiles("input[type=file]", await saved.path().then((path) => ({ name: "first cell.csv", mimeType: "text/csv", buffer: readFileSync(path) })));
        await page.waitForSelector("text=first cell.csv loaded");
        assert.equal(await page.locator("select[aria-label='Compare with'] option:checked").textContent(), "first cell");
        await page.setInputFiles("input[type=file]", { name: "wrong.csv", mimeType: "text/csv", buffer: Buffer.from("time_s,j1\n0,x\n") });
        await page.waitForSelector("text=Line 2: 'x' is not a number for j1");
    },

    async "files, backup"(page, server) {
        await tab(page, "files");
        await page.waitForSelector("text=CellData.sysx");
        await page.click(".card:has-text('Backup') button");
        await page.waitForSelector("text=Backup created");
        await page.click(".file-row:has-text('MainModule.modx') button:has-text('Load')");
        await eventually(() => last(server, "modules.load")?.path === "HOME:/MainModule.modx", "loaded");
    },

    async "tabs by keyboard, theme"(page) {
        await page.focus("#tab-program");
        await page.keyboard.press("ArrowDown");
        await page.waitForSelector("#panel-events:visible");
        assert.equal(await page.getAttribute("#tab-events", "aria-selected"), "true");
        assert.equal(await page.getAttribute("html", "data-theme"), "dark");
        await page.click(".theme-switch button");
        assert.equal(await page.getAttribute("html", "data-theme"), "light");
    },

    // a lost connection is shown, and everything is read again
    async "connection lost and found"(page, server) {
        await page.evaluate(() => {}); // the page is idle
        server.drop();
        await page.waitForSelector("text=Connection lost");
        await page.waitForSelector(".cover", { state: "hidden" });
        await eventually(() => server.cell.requests.filter(({ method }) => method === "state").length >= 2, "state again");
    },

    // issue 20, 4: 10,000 path points, at least 5 frames/s in software rendering
    async "10,000 path points"(page, server) {
        for (let at = 0; at < 10500; at++) server.cell.step(0.012);
        await eventually(async () => (await page.evaluate(() => window.rapidcStatistics().points)) >= 10000, "10,000 points");
        const before = await page.evaluate(() => window.rapidcStatistics());
        await page.waitForTimeout(4000);
        const after = await page.evaluate(() => window.rapidcStatistics());
        const rate = (after.frames - before.frames) / 4;
        console.log(`  ${after.points} points: ${rate.toFixed(1)} frames/s, ${after.frameTime.toFixed(1)} ms of the page's thread per frame`);
        assert.ok(rate >= 5, `${rate} frames/s`);
    },
};
