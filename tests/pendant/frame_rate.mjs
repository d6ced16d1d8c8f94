// Issue 20, section 4: at least 5 frames a second with 10,000 path points when software renders; 60 on a usual computer.

import { readdirSync, readFileSync } from "node:fs";
import { openPage } from "./browser.mjs";

const seconds = 5;
const least = 5; // frames a second

/** CPU time in s that the drawing processes of browsers have taken; on a machine that does other work, too, it says more than the clock. */
function drawingTime() {
    const ticksPerSecond = 100;
    let ticks = 0;
    for (const pid of readdirSync("/proc").filter((name) => /^\d+$/.test(name))) {
        try {
            if (!readFileSync(`/proc/${pid}/cmdline`, "utf8").includes("--type=gpu-process")) continue;
            const fields = readFileSync(`/proc/${pid}/stat`, "utf8").split(") ")[1].split(" ");
            ticks += Number(fields[11]) + Number(fields[12]);
        } catch {
            // it has ended meanwhile
        }
    }
    return ticks / ticksPerSecond;
}

export async function frameRate(browser, address, controller, report) {
    controller.reset();
    controller.units.length = 1;
    const { page, end } = await openPage(browser, address, controller, { panel: "display" });
    for (let sent = 0; sent < 11_000; sent += 500) {
        controller.flood(500);
        await page.waitForTimeout(50);
    }
    const before = drawingTime();
    // frames that were drawn, not callbacks: the page draws when something has changed, and the robots move
    const result = await page.evaluate(async (duration) => {
        const context = document.querySelector(".view canvas").getContext("webgl2");
        const probe = new Uint8Array(4);
        let frames = 0;
        const begun = performance.now();
        while (performance.now() - begun < duration * 1000) {
            await new Promise(requestAnimationFrame);
            context?.readPixels(0, 0, 1, 1, context.RGBA, context.UNSIGNED_BYTE, probe); // waits until the frame is complete
            ++frames;
        }
        const extension = context?.getExtension("WEBGL_debug_renderer_info");
        const renderer = context ? context.getParameter(extension?.UNMASKED_RENDERER_WEBGL ?? context.RENDERER) : "none";
        return { frames, rate: (frames * 1000) / (performance.now() - begun), renderer };
    }, seconds);
    const perFrame = ((drawingTime() - before) * 1000) / result.frames;
    console.log(`       ${result.rate.toFixed(1)} frames/s, ${perFrame.toFixed(0)} ms of CPU time a frame, ${result.renderer}`);
    report("frame rate with 10,000 path points", result.rate >= least ? [] : [`${result.rate.toFixed(1)} frames/s, at least ${least} expected`]);
    report("frame rate: no errors", await end());
}
