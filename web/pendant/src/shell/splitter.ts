import { h } from "../ui/dom";

const key = "rapidc-split";
const smallest = 22; // per cent
const largest = 78;
const step = 4;

/** The movable edge between the 3D view and the panels; arrow keys move it too. */
export class Splitter {
    readonly element = h("div", {
        class: "splitter",
        attrs: { role: "separator", tabindex: 0, "aria-label": "Size of the 3D view", "aria-valuemin": smallest, "aria-valuemax": largest },
    });
    private share = Number(readShare() ?? 52);

    constructor(private readonly onMove: () => void) {
        this.element.addEventListener("pointerdown", (event) => this.drag(event));
        this.element.addEventListener("keydown", (event) => {
            const change = { ArrowLeft: -step, ArrowUp: -step, ArrowRight: step, ArrowDown: step }[event.key];
            if (change === undefined) return;
            event.preventDefault();
            this.set(this.share + change);
        });
        requestAnimationFrame(() => this.set(this.share));
    }

    private set(share: number): void {
        this.share = Math.min(largest, Math.max(smallest, share));
        this.element.parentElement?.style.setProperty("--view-share", `${this.share}%`);
        this.element.setAttribute("aria-valuenow", String(Math.round(this.share)));
        try {
            localStorage.setItem(key, String(this.share));
        } catch {
            // it holds until the page is closed
        }
        this.onMove();
    }

    private drag(event: PointerEvent): void {
        const area = this.element.parentElement;
        if (!area) return;
        this.element.setPointerCapture(event.pointerId);
        const move = (at: PointerEvent): void => {
            const frame = area.getBoundingClientRect();
            const upright = getComputedStyle(area).flexDirection === "column";
            const share = upright ? (at.clientY - frame.top) / frame.height : (at.clientX - frame.left) / frame.width;
            this.set(share * 100);
        };
        const end = (): void => {
            this.element.removeEventListener("pointermove", move);
            this.element.removeEventListener("pointerup", end);
            this.element.removeEventListener("pointercancel", end);
        };
        this.element.addEventListener("pointermove", move);
        this.element.addEventListener("pointerup", end);
        this.element.addEventListener("pointercancel", end);
    }
}

function readShare(): string | null {
    try {
        return localStorage.getItem(key);
    } catch {
        return null;
    }
}
