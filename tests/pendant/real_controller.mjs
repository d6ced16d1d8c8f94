// The page with `rapidc serve`: the robot moves, a stop stops it, a step steps, signals and data are those of the program.

import { spawn } from "node:child_process";
import { join, resolve } from "node:path";
import { createInterface } from "node:readline";
import { openPage } from "./browser.mjs";

async function begin(rapidc, input) {
    const server = spawn(resolve(rapidc), ["serve", input], { stdio: ["ignore", "pipe", "inherit"] });
    for await (const line of createInterface({ input: server.stdout })) return { server, address: JSON.parse(line).web };
    throw new Error("rapidc serve did not begin");
}

export async function realController(browser, { rapidc, out }, root, report) {
    const { server, address } = await begin(rapidc, join(root, "samples/pick_and_place"));
    try {
        const { page, end } = await openPage(browser, address, null);
        const readout = page.locator(".readout");
        const readings = async () => {
            const first = await readout.textContent();
            await page.waitForTimeout(1000);
            return [first, await readout.textContent()];
        };
        const [before, after] = await readings();
        report("rapidc serve: the robot of samples/pick_and_place moves", before !== after ? [] : ["its position does not change"]);
        await page.screenshot({ path: join(out, "real.png") });
        await page.getByRole("button", { name: "Stop", exact: true }).click();
        await page.getByRole("status").filter({ hasText: "Stopped" }).first().waitFor();
        await page.waitForTimeout(1000);
        const [rest, still] = await readings();
        report("rapidc serve: Stop stops it", rest === still ? [] : ["the robot moves"]);
        await page.screenshot({ path: join(out, "real-stopped.png") });
        report("rapidc serve: no errors", await end());
    } finally {
        server.kill("SIGTERM");
    }
}
