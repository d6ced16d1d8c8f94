const keys = [" ", "Enter"];

/** Calls `begin` when a button is pressed, with pointer or keyboard, and `end` as soon as it is not held any more: it is released, or the pointer or the focus leaves it. */
export function whileHeld(item: HTMLElement, begin: () => void, end: () => void): void {
    item.addEventListener("pointerdown", (event) => {
        if (event.button !== 0) return;
        // A touch is captured by itself, and would not leave the button then.
        if (item.hasPointerCapture(event.pointerId)) item.releasePointerCapture(event.pointerId);
        begin();
    });
    for (const type of ["pointerup", "pointercancel", "pointerleave", "blur"]) item.addEventListener(type, end);
    item.addEventListener("keydown", (event) => {
        if (!keys.includes(event.key)) return;
        event.preventDefault();
        if (!event.repeat) begin();
    });
    item.addEventListener("keyup", (event) => keys.includes(event.key) && end());
    item.addEventListener("contextmenu", (event) => event.preventDefault()); // a long touch must not open a menu
}

/** Calls `action` when the page is left: its window loses the focus, or it is hidden. */
export function whenPageIsLeft(action: () => void): void {
    window.addEventListener("blur", action);
    window.addEventListener("pagehide", action);
    document.addEventListener("visibilitychange", () => document.hidden && action());
}
