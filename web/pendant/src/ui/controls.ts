import { h, setAttribute, uniqueId } from "./dom";
import { icon, type IconName } from "./icons";

interface ButtonOptions {
    icon?: IconName;
    label: string;
    /** the label is for screen readers and the tooltip only */
    iconOnly?: boolean;
    class?: string;
    title?: string;
    keys?: string;
    onClick?: () => void;
}

export function button(options: ButtonOptions): HTMLButtonElement {
    const title = (options.title ?? (options.iconOnly ? options.label : "")) + (options.keys ? ` (${options.keys})` : "");
    return h(
        "button",
        {
            class: `button ${options.iconOnly ? "button-icon" : ""} ${options.class ?? ""}`,
            attrs: {
                type: "button",
                title: title.trim() || undefined,
                "aria-label": options.iconOnly ? options.label : undefined,
                "aria-keyshortcuts": options.keys,
            },
            on: options.onClick ? { click: options.onClick } : {},
        },
        options.icon && icon(options.icon),
        !options.iconOnly && h("span", { text: options.label }),
    );
}

export interface Choice<T extends string> {
    value: T;
    label: string;
}

/** A row of buttons of which one is pressed. */
export class Segmented<T extends string> {
    readonly element: HTMLDivElement;
    private readonly buttons = new Map<T, HTMLButtonElement>();
    private chosen: T;

    constructor(label: string, choices: Choice<T>[], initial: T, onChange: (value: T) => void) {
        this.chosen = initial;
        this.element = h("div", { class: "segmented", attrs: { role: "radiogroup", "aria-label": label } });
        for (const { value, label: text } of choices) {
            const item = h("button", {
                class: "segment",
                text,
                attrs: { type: "button", role: "radio" },
                on: {
                    click: () => {
                        this.set(value);
                        onChange(value);
                    },
                },
            });
            this.buttons.set(value, item);
            this.element.append(item);
        }
        this.element.addEventListener("keydown", (event) => this.move(event));
        this.set(initial);
    }

    get value(): T {
        return this.chosen;
    }

    set(value: T): void {
        this.chosen = value;
        for (const [each, item] of this.buttons) {
            item.setAttribute("aria-checked", String(each === value));
            item.tabIndex = each === value ? 0 : -1;
        }
    }

    setDisabled(disabled: boolean): void {
        for (const item of this.buttons.values()) item.disabled = disabled;
    }

    private move(event: KeyboardEvent): void {
        const step = { ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1 }[event.key];
        if (step === undefined) return;
        event.preventDefault();
        const items = [...this.buttons.values()];
        const at = items.indexOf(document.activeElement as HTMLButtonElement);
        const next = items[(at + step + items.length) % items.length];
        next?.focus();
        next?.click();
    }
}

export function select(label: string, onChange: (value: string) => void): HTMLSelectElement {
    return h("select", {
        class: "select",
        attrs: { "aria-label": label },
        on: { change: (event: Event) => onChange((event.target as HTMLSelectElement).value) },
    });
}

/** Keeps the choice when it is still there. */
export function setOptions(element: HTMLSelectElement, options: { value: string; label: string }[]): void {
    const before = element.value;
    element.replaceChildren(...options.map(({ value, label }) => h("option", { text: label, attrs: { value } })));
    if (options.some(({ value }) => value === before)) element.value = before;
}

export function searchField(label: string, onInput: (text: string) => void): HTMLLabelElement {
    const input = h("input", {
        class: "input",
        attrs: { type: "search", placeholder: label, "aria-label": label, spellcheck: "false", autocomplete: "off" },
        on: { input: () => onInput(input.value) },
    });
    return h("label", { class: "search" }, icon("search"), input);
}

export function checkbox(label: string, checked: boolean, onChange: (on: boolean) => void): HTMLLabelElement {
    const box = h("input", { attrs: { type: "checkbox" }, on: { change: () => onChange(box.checked) } });
    box.checked = checked;
    return h("label", { class: "check" }, box, h("span", { text: label }));
}

/** Something with a visible label above it. */
export function field(label: string, control: HTMLElement): HTMLDivElement {
    const id = control.id || uniqueId("field");
    control.id = id;
    const caption = h("label", { class: "field-label", text: label });
    setAttribute(caption, "for", id);
    return h("div", { class: "field" }, caption, control);
}

export function emptyState(name: IconName, title: string, text: string): HTMLDivElement {
    return h("div", { class: "empty" }, icon(name), h("p", { class: "empty-title", text: title }), h("p", { text }));
}
