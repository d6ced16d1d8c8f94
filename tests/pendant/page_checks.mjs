// Rules that hold in every panel (issue 20, section 4: usable on a tablet, keyboard operable, dark and light). Executed in the page; each
// answers a list of what breaks the rule.

/** WCAG 2.1, 1.4.3: text has a contrast of 4.5 to 1; large text of 3 to 1. Disabled controls are left out, as there. */
export function lowContrast() {
    const canvas = document.createElement("canvas").getContext("2d", { willReadFrequently: true });
    const parts = (colour) => {
        canvas.clearRect(0, 0, 1, 1);
        canvas.fillStyle = colour;
        canvas.fillRect(0, 0, 1, 1);
        const [r, g, b, a] = canvas.getImageData(0, 0, 1, 1).data;
        return [r, g, b, a / 255];
    };
    const over = ([r, g, b, a], [R, G, B]) => [r * a + R * (1 - a), g * a + G * (1 - a), b * a + B * (1 - a), 1];
    const background = (element) => {
        const layers = [];
        for (let at = element; at; at = at.parentElement) {
            const layer = parts(getComputedStyle(at).backgroundColor);
            if (layer[3] > 0) layers.push(layer);
            if (layer[3] === 1) break;
        }
        return layers.reverse().reduce((below, layer) => over(layer, below), [255, 255, 255, 1]);
    };
    const luminance = (colour) => {
        const [r, g, b] = colour.slice(0, 3).map((value) => {
            const share = value / 255;
            return share <= 0.04045 ? share / 12.92 : ((share + 0.055) / 1.055) ** 2.4;
        });
        return 0.2126 * r + 0.7152 * g + 0.0722 * b;
    };
    const found = new Map();
    for (const element of document.querySelectorAll("body *")) {
        const text = [...element.childNodes].filter((node) => node.nodeType === Node.TEXT_NODE).map((node) => node.textContent.trim()).join("");
        if (!text || !element.checkVisibility({ opacityProperty: true, visibilityProperty: true })) continue;
        if (element.closest("[disabled], [aria-disabled=true], svg, noscript")) continue;
        const style = getComputedStyle(element);
        const below = background(element);
        const lights = [luminance(over(parts(style.color), below)), luminance(below)].sort((a, b) => b - a);
        const contrast = (lights[0] + 0.05) / (lights[1] + 0.05);
        const size = parseFloat(style.fontSize);
        const isLarge = size >= 24 || (size >= 18.66 && Number(style.fontWeight) >= 700);
        if (contrast >= (isLarge ? 3 : 4.5)) continue;
        found.set(`${element.tagName.toLowerCase()}.${element.className}`, `${contrast.toFixed(2)}: '${text.slice(0, 30)}' (${element.className || element.tagName})`);
    }
    return [...found.values()];
}

/** Every control that is in the picture can be hit at its middle, and nothing makes the page scroll sideways. */
export function coveredControls() {
    const found = [];
    if (document.scrollingElement.scrollWidth > innerWidth) found.push(`the page is ${document.scrollingElement.scrollWidth} wide, the window ${innerWidth}`);
    const clippedBy = (element, x, y) => {
        for (let at = element.parentElement; at; at = at.parentElement) {
            const box = at.getBoundingClientRect();
            const style = getComputedStyle(at);
            const clips = style.overflowX !== "visible" || style.overflowY !== "visible";
            if (clips && (x < box.left || x > box.right || y < box.top || y > box.bottom)) return true; // it can be scrolled to
        }
        return false;
    };
    for (const control of document.querySelectorAll("button, select, input, [role=tab]")) {
        if (!control.checkVisibility({ visibilityProperty: true })) continue;
        const box = control.getBoundingClientRect();
        const x = box.left + box.width / 2;
        const y = box.top + box.height / 2;
        if (clippedBy(control, x, y)) continue;
        const name = control.getAttribute("aria-label") ?? control.textContent.trim();
        if (x < 0 || y < 0 || x > innerWidth || y > innerHeight) {
            found.push(`outside the window: '${name}'`);
            continue;
        }
        const hit = document.elementFromPoint(x, y);
        const label = control.closest("label");
        if (hit && (control.contains(hit) || hit.contains(control) || label?.contains(hit))) continue;
        found.push(`'${name}' is covered by ${hit?.tagName.toLowerCase()}.${hit?.className}`);
    }
    return found;
}

/** WCAG 4.1.2: each control has a name. */
export function namelessControls() {
    const found = [];
    for (const control of document.querySelectorAll("button, select, input, textarea, canvas, [role=tab], [role=slider]")) {
        if (!control.checkVisibility()) continue;
        const labels = [...(control.labels ?? [])].map((label) => label.textContent.trim()).join("");
        const named = (control.getAttribute("aria-labelledby") ?? "").split(" ").map((id) => document.getElementById(id)?.textContent.trim() ?? "").join("");
        const name = control.getAttribute("aria-label") || named || labels || control.textContent.trim() || control.title;
        if (!name) found.push(control.outerHTML.slice(0, 120));
    }
    return found;
}

/** WCAG 2.5.8: a control is at least 24 pixels wide and high. */
export function tinyControls() {
    const found = new Set();
    for (const control of document.querySelectorAll("button, select, input:not([type=range]), [role=tab]")) {
        if (!control.checkVisibility()) continue;
        const box = (control.closest("label") ?? control).getBoundingClientRect();
        if (box.width >= 23.5 && box.height >= 23.5) continue;
        found.add(`'${control.getAttribute("aria-label") ?? control.textContent.trim()}' is ${box.width.toFixed(0)} x ${box.height.toFixed(0)}`);
    }
    return [...found];
}

/** WCAG 2.4.7: what has the focus shows it. To be called after each Tab; answers the element's description. */
export function focusedElement() {
    const element = document.activeElement;
    if (!element || element === document.body) return null;
    const looks = (target) => {
        const style = getComputedStyle(target);
        return `${style.outlineStyle} ${style.outlineWidth} ${style.boxShadow} ${style.borderColor}`;
    };
    const shown = [element, element.closest("label"), element.parentElement, element.nextElementSibling].filter(Boolean);
    const withFocus = shown.map(looks).join();
    const [, width] = looks(element).split(" ");
    element.blur();
    const without = shown.map(looks).join();
    element.focus({ focusVisible: true });
    const name = element.getAttribute("aria-label") ?? element.textContent.trim().slice(0, 30);
    return { name: name || element.tagName, isVisible: withFocus !== without || parseFloat(width) > 0, key: element.outerHTML.slice(0, 200) };
}
