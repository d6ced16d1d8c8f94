// What the panels do, with the simulated controller: a click becomes the request of docs/pendant.md, a notification becomes visible.

import { openPage } from "./browser.mjs";

/** Asks again until it holds. */
async function until(condition, what) {
    for (let i = 0; i < 200; ++i) {
        if (await condition()) return [];
        await new Promise((done) => setTimeout(done, 50));
    }
    return [what];
}

const requested = (controller, method, expected = {}) =>
    until(
        () => controller.calledWith(method).some((params) => Object.entries(expected).every(([name, value]) => params[name] === value)),
        `no request ${method} ${JSON.stringify(expected)}; there were ${JSON.stringify(controller.calls.slice(-5))}`,
    );

const checks = {
    async "top bar: stop, step, start, speed, motors"({ page, controller }) {
        await page.getByRole("button", { name: "Stop", exact: true }).click();
        const problems = await requested(controller, "run.stop");
        await page.keyboard.press("F10");
        problems.push(...(await requested(controller, "run.start", { mode: "stepOver" })));
        await page.keyboard.press("F8");
        problems.push(...(await requested(controller, "run.start", { mode: "stepBack" })));
        await page.keyboard.press("F5");
        problems.push(...(await requested(controller, "run.start", { mode: "continue" })));
        await page.getByRole("slider", { name: /Speed/ }).fill("40");
        problems.push(...(await requested(controller, "panel.speed", { percent: 40 })));
        await page.locator("button.motors").click();
        return [...problems, ...(await requested(controller, "panel.motors", { on: false }))];
    },
    async "top bar: emergency stop and its release"({ page, controller }) {
        await page.locator("button.emergency").click();
        const problems = await requested(controller, "panel.emergencyStop", { pressed: true });
        await page.locator("button.emergency").click();
        return [...problems, ...(await requested(controller, "panel.emergencyStop", { pressed: false }))];
    },
    async "top bar: one button is named after the emergency stop, also while it is pressed"({ page, controller }) {
        const count = () => page.getByRole("button", { name: /emergency stop/i }).count();
        const before = await count();
        controller.setPanel({ motors: "emergencyStop", emergencyStop: true, running: false });
        const problems = await until(async () => (await page.locator("button.motors").textContent()).includes("E-stop"), "motors: no E-stop");
        const [pressed, reset] = [await count(), await page.getByRole("button", { name: /reset/i }).count()]; // the visible word is in the name
        controller.setPanel({ motors: "on", emergencyStop: false });
        return [...problems, ...(before === 1 && pressed === 1 && reset === 1 ? [] : [`buttons: ${before}, pressed ${pressed}, reset ${reset}`])];
    },
    async "refusals are shown with their remedy"({ page, controller }) {
        controller.setPanel({ motors: "off", running: false });
        await page.getByRole("button", { name: "Start", exact: true }).click();
        return until(async () => (await page.locator("body").textContent()).includes("Switch them on first"), "the remedy is not shown");
    },
    async "program: text and both pointers are shown"({ page }) {
        await page.locator("#tab-program").click();
        return until(async () => (await page.locator("#panel-program").textContent()).includes("PickAndPlace"), "the module is not shown");
    },
    async "signals: a change is shown; the filter asks the controller or hides rows"({ page, controller }) {
        await page.locator("#tab-signals").click();
        const panel = page.locator("#panel-signals");
        await panel.getByText("aiPressure").first().waitFor();
        controller.answer({ id: 0, method: "signals.set", params: { name: "aiPressure", value: 8.25 } });
        return until(async () => (await panel.innerHTML()).includes("8.25") || (await panel.locator("input").evaluateAll((all) => all.some(({ value }) => value === "8.25"))), "8.25 is not shown");
    },
    async "display: lines of TPWrite appear"({ page, controller }) {
        await page.locator("#tab-display").click();
        controller.send("display", { line: "Parts: 4711" });
        return until(async () => (await page.locator("#panel-display").textContent()).includes("Parts: 4711"), "the line is not shown");
    },
    async "events: causes and actions of a message"({ page }) {
        await page.locator("#tab-events").click();
        const panel = page.locator("#panel-events");
        await panel.getByText("division by zero").first().click();
        return until(async () => (await panel.textContent()).includes("Check the divisor"), "causes and actions are not shown");
    },
    async "dialogs: a choice is answered with the number of its button"({ page, controller }) {
        const id = controller.openDialog("choice");
        await page.getByRole("button", { name: "No", exact: true }).click();
        const problems = await requested(controller, "dialogs.answer", { id, choice: 3 });
        return [...problems, ...(await until(() => page.getByText("The gripper is empty.").isHidden(), "the dialog stays"))];
    },
    async "dialogs: a number and a text"({ page, controller }) {
        const number = controller.openDialog("number");
        await page.getByRole("dialog").locator("input").fill("17");
        await page.getByRole("dialog").locator("input").press("Enter");
        const problems = await requested(controller, "dialogs.answer", { id: number, number: 17 });
        const text = controller.openDialog("text");
        await page.getByRole("dialog").locator("input").fill("B-18");
        await page.getByRole("dialog").locator("input").press("Enter");
        return [...problems, ...(await requested(controller, "dialogs.answer", { id: text, text: "B-18" }))];
    },
    async "dialogs: with buttons, an item of a list is only chosen; a button answers with it"({ page, controller }) {
        // RAPID manual, UIListView: the result is the item, the btnres the button that was pressed
        const id = controller.openDialog("list");
        await page.getByRole("dialog").getByText("Plate").click();
        await page.getByRole("dialog").getByRole("button", { name: "Cancel" }).click();
        return requested(controller, "dialogs.answer", { id, item: 3, choice: 2 });
    },
    async "program: ModPos says which line it changed"({ page, controller }) {
        controller.setRunning(false);
        await page.locator("#tab-program").click();
        await page.getByRole("button", { name: "ModPos", exact: true }).click();
        const problems = await until(() => controller.calledWith("teach.modify").length > 0, "teach.modify was not asked");
        const notices = page.locator(".notices");
        problems.push(...(await until(async () => /Position modified: \w+, line \d+/.test(await notices.textContent()), "the line is not named")));
        return problems;
    },
    async "a restart of the controller: the page reads everything again"({ page, controller }) {
        const before = controller.calledWith("state").length;
        controller.send("generation", {});
        return until(() => controller.calledWith("state").length > before, `state was not asked again on ${page.url()}`);
    },
};

export async function panelChecks(browser, address, controller, report) {
    for (const [name, check] of Object.entries(checks)) {
        controller.reset();
        const { page, end } = await openPage(browser, address, controller);
        page.setDefaultTimeout(20_000);
        let problems;
        try {
            problems = await check({ page, controller });
        } catch (error) {
            problems = [String(error.message).split("\n").slice(0, 4).join(" ")];
        }
        report(name, [...problems, ...(await end())]);
    }
}
