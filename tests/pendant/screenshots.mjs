// Pictures of each panel, dark and light, in the sizes that the page is made for. See README.md.

import { mkdirSync } from "node:fs";
import { join } from "node:path";

const sizes = { wide: [1280, 800], small: [1024, 768], upright: [820, 1180] };
const panels = ["program", "events", "signals", "data", "display", "jog", "recording", "files"];

/** One picture per panel, theme and size in `folder`. */
export async function takeScreenshots(browser, address, folder, onlySizes = Object.keys(sizes), onlyPanels = panels) {
    mkdirSync(folder, { recursive: true });
    for (const theme of ["dark", "light"]) {
        for (const size of onlySizes) {
            const [width, height] = sizes[size];
            const page = await browser.newPage({ viewport: { width, height }, colorScheme: theme });
            await page.goto(address);
            await page.waitForSelector(".cover", { state: "hidden" });
            await page.waitForTimeout(1500);
            for (const panel of onlyPanels) {
                await page.click(`#tab-${panel}`);
                await page.waitForTimeout(500);
                await page.screenshot({ path: join(folder, `${panel}-${theme}-${size}.png`), timeout: 60000 });
            }
            await page.close();
        }
    }
}
