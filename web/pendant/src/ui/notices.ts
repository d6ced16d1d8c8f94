import { RequestError } from "../api/connection";
import { button } from "./controls";
import { h } from "./dom";

const shown = 6000; // ms
const region = h("div", { class: "notices", attrs: { role: "status", "aria-live": "polite" } });

export function noticeRegion(): HTMLElement {
    return region;
}

/** A short message at the lower edge that goes away by itself. */
export function notice(kind: "info" | "warning" | "error", title: string, text = ""): void {
    const card = h(
        "div",
        { class: `notice notice-${kind}` },
        h("div", { class: "notice-text" }, h("strong", { text: title }), text && h("span", { text })),
        button({ icon: "close", label: "Dismiss", iconOnly: true, class: "quiet", onClick: () => card.remove() }),
    );
    region.append(card);
    while (region.children.length > 3) region.firstElementChild?.remove();
    setTimeout(() => card.remove(), shown);
}

/** Shows what the controller refused; others are errors of the page. */
export function showError(error: unknown): void {
    if (error instanceof RequestError) {
        notice("error", error.message, error.remedy);
        return;
    }
    notice("error", error instanceof Error ? error.message : String(error));
}

/** Runs an action of the user; errors become notices. */
export function attempt(action: () => Promise<unknown>): void {
    action().catch(showError);
}
