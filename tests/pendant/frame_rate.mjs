// Issue 20, section 4: at least 5 frames a second with 10,000 path points when software renders; 60 on a usual computer.

import { openPage } from "./browser.mjs";

const seconds = 5;
const least = 5; // frames a second

export async function frameRate(browser, address, controller, report) {
    controller.reset();
    const { page, end } = await openPage(browser, address, controller, { panel: "display" });
    for (let sent = 0; sent < 11_000; sent += 500) {
        controller.flood(500);
        await page.waitForTimeout(50);
    }
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
        return { rate: (frames * 1000) / (performance.now() - begun), renderer };
    }, seconds);
    const points = await page.evaluate(() => globalThis.pendantStatistics?.().points ?? -1);
    console.log(`       ${result.rate.toFixed(1)} frames/s, ${points} path points, ${result.renderer}`);
    report("frame rate with 10,000 path points", result.rate >= least ? [] : [`${result.rate.toFixed(1)} frames/s, at least ${least} expected`]);
    report("frame rate: no errors", await end());
}
