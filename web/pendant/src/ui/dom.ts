// Elements without markup in strings: nothing that comes from the controller is ever parsed as HTML.

type Child = Node | string | number | null | undefined | false;
type Listener = (event: never) => void;

interface Properties {
    class?: string;
    /** attributes of any name; true: present without a value, false or undefined: absent */
    attrs?: Record<string, string | number | boolean | undefined>;
    on?: Record<string, Listener>;
    text?: string;
}

/** h("button", {class: "primary", on: {click}}, icon, "Start") */
export function h<K extends keyof HTMLElementTagNameMap>(
    tag: K,
    properties: Properties = {},
    ...children: Child[]
): HTMLElementTagNameMap[K] {
    const element = document.createElement(tag);
    if (properties.class) element.className = properties.class;
    if (properties.text !== undefined) element.textContent = properties.text;
    for (const [name, value] of Object.entries(properties.attrs ?? {})) setAttribute(element, name, value);
    for (const [name, listener] of Object.entries(properties.on ?? {})) {
        element.addEventListener(name, listener as EventListener);
    }
    for (const child of children) append(element, child);
    return element;
}

export function setAttribute(element: Element, name: string, value: string | number | boolean | undefined): void {
    if (value === undefined || value === false) element.removeAttribute(name);
    else element.setAttribute(name, value === true ? "" : String(value));
}

function append(element: Element, child: Child): void {
    if (child === null || child === undefined || child === false) return;
    element.append(child instanceof Node ? child : String(child));
}

export function replaceChildren(element: Element, ...children: Child[]): void {
    element.replaceChildren();
    for (const child of children) append(element, child);
}

/** Writes only what is different: the text is set many times a second. */
export function setText(element: Element, text: string): void {
    if (element.textContent !== text) element.textContent = text;
}

export function setClass(element: Element, name: string, on: boolean): void {
    if (element.classList.contains(name) !== on) element.classList.toggle(name, on);
}

let lastId = 0;

/** For labels and ARIA. */
export function uniqueId(prefix: string): string {
    return `${prefix}-${++lastId}`;
}

/** Calls `action` once per frame at most, however often it is asked for. */
export function oncePerFrame(action: () => void): () => void {
    let asked = false;
    return () => {
        if (asked) return;
        asked = true;
        requestAnimationFrame(() => {
            asked = false;
            action();
        });
    };
}

/** Calls `action` when nothing has been asked for `delay` ms. */
export function debounced(delay: number, action: () => void): () => void {
    let timer = 0;
    return () => {
        clearTimeout(timer);
        timer = window.setTimeout(action, delay);
    };
}
