import { h, oncePerFrame, setClass } from "../ui/dom";
import { tokensOf } from "./rapid_tokens";

export interface Markers {
    pointer: { line: number; endLine: number } | null;
    motion: { line: number; endLine: number } | null;
    breakpoints: Map<number, boolean>;
}

interface CodeActions {
    toggleBreakpoint(line: number): void;
    changed(): void;
    caret(line: number): void;
}

const gap = 200; // lines that are coloured above and below what is visible

/**
 * Text with line numbers, colours and markers. A transparent text area over the coloured lines gives caret, selection and
 * keyboard; only the lines near the visible ones are elements.
 */
export class CodeView {
    readonly element: HTMLElement;
    private readonly area = h("textarea", {
        class: "code-area",
        attrs: { spellcheck: "false", autocapitalize: "off", autocomplete: "off", wrap: "off", readonly: true, "aria-label": "Text of the module" },
    });
    private readonly lines = h("div", { class: "code-lines", attrs: { "aria-hidden": "true" } });
    private readonly sheet: HTMLElement;
    private readonly drawn = new Map<number, HTMLElement>();
    private texts: string[] = [""];
    private markers: Markers = { pointer: null, motion: null, breakpoints: new Map() };
    private lineHeight = 20;
    private readonly refresh = oncePerFrame(() => this.draw());

    constructor(private readonly actions: CodeActions) {
        this.sheet = h("div", { class: "code-sheet" }, this.lines, this.area);
        this.element = h("div", { class: "code" }, this.sheet);
        this.element.addEventListener("scroll", this.refresh);
        new ResizeObserver(this.refresh).observe(this.element);
        this.area.addEventListener("input", () => this.edited());
        for (const name of ["keyup", "click", "focus"]) this.area.addEventListener(name, () => this.reportCaret());
        this.area.addEventListener("keydown", (event) => this.key(event));
        this.lines.addEventListener("click", (event) => this.clickGutter(event));
    }

    get text(): string {
        return this.area.value;
    }

    /** Line of the caret, from 1. */
    get line(): number {
        return this.area.value.slice(0, this.area.selectionStart).split("\n").length;
    }

    setText(text: string): void {
        this.area.value = text;
        this.edited(false);
    }

    setEditable(on: boolean): void {
        this.area.readOnly = !on;
        setClass(this.element, "code-editable", on);
        if (on) this.area.focus({ preventScroll: true });
    }

    setMarkers(markers: Markers): void {
        this.markers = markers;
        for (const [line, element] of this.drawn) this.mark(line, element);
    }

    /** Scrolls only when the line is not well visible. */
    reveal(line: number): void {
        const top = (line - 1) * this.lineHeight;
        const { scrollTop, clientHeight } = this.element;
        if (top > scrollTop + this.lineHeight * 2 && top < scrollTop + clientHeight - this.lineHeight * 4) return;
        this.element.scrollTop = Math.max(0, top - clientHeight / 3);
    }

    /** Moves the caret. */
    select(line: number): void {
        const at = this.texts.slice(0, line - 1).reduce((sum, text) => sum + text.length + 1, 0);
        this.area.setSelectionRange(at, at);
        this.reveal(line);
        this.reportCaret();
    }

    /** The element became visible: sizes are known only now. */
    shown(): void {
        this.refresh();
    }

    private edited(report = true): void {
        this.texts = this.area.value.split("\n");
        const longest = this.texts.reduce((most, text) => Math.max(most, text.length), 0);
        this.sheet.style.setProperty("--lines", String(this.texts.length));
        this.sheet.style.setProperty("--columns", String(longest + 8));
        for (const [line, element] of this.drawn) {
            if (element.dataset.text === this.texts[line - 1]) continue;
            element.remove();
            this.drawn.delete(line);
        }
        this.draw();
        if (report) this.actions.changed();
    }

    private draw(): void {
        if (this.element.clientHeight === 0) return;
        this.lineHeight = parseFloat(getComputedStyle(this.sheet).lineHeight) || 20;
        const first = Math.max(1, Math.floor(this.element.scrollTop / this.lineHeight) - gap);
        const last = Math.min(this.texts.length, Math.ceil((this.element.scrollTop + this.element.clientHeight) / this.lineHeight) + gap);
        for (const [line, element] of this.drawn) {
            if (line >= first && line <= last) continue;
            element.remove();
            this.drawn.delete(line);
        }
        for (let line = first; line <= last; line++) {
            if (this.drawn.has(line)) continue;
            const element = this.makeLine(line);
            this.drawn.set(line, element);
            this.lines.append(element);
        }
    }

    private makeLine(line: number): HTMLElement {
        const text = this.texts[line - 1] ?? "";
        const gutter = h("span", { class: "code-gutter", attrs: { "data-line": line, title: "Breakpoint (F9)" } }, h("span", { class: "code-number", text: String(line) }));
        const content = h("span", { class: "code-text" }, ...tokensOf(text).map((token) => (token.kind === "plain" ? token.text : h("span", { class: `token-${token.kind}`, text: token.text }))));
        const element = h("div", { class: "code-line" }, gutter, content);
        element.dataset.text = text;
        element.style.setProperty("--line", String(line - 1));
        this.mark(line, element);
        return element;
    }

    private mark(line: number, element: HTMLElement): void {
        const within = (place: { line: number; endLine: number } | null): boolean => place !== null && line >= place.line && line <= Math.max(place.line, place.endLine);
        const { pointer, motion, breakpoints } = this.markers;
        setClass(element, "at-pointer", within(pointer));
        setClass(element, "has-pointer", pointer?.line === line);
        setClass(element, "at-motion", within(motion));
        setClass(element, "has-motion", motion?.line === line);
        setClass(element, "has-breakpoint", breakpoints.has(line));
        setClass(element, "breakpoint-unverified", breakpoints.get(line) === false);
    }

    private clickGutter(event: MouseEvent): void {
        const gutter = (event.target as Element).closest<HTMLElement>(".code-gutter");
        if (gutter) this.actions.toggleBreakpoint(Number(gutter.dataset.line));
    }

    private reportCaret(): void {
        this.actions.caret(this.line);
    }

    private key(event: KeyboardEvent): void {
        if (event.key === "F9") {
            event.preventDefault();
            this.actions.toggleBreakpoint(this.line);
        }
        // Tab leaves the text, as everywhere on the page; Ctrl+] indents
        if (event.key === "]" && event.ctrlKey && !this.area.readOnly) {
            event.preventDefault();
            this.area.setRangeText("   ", this.area.selectionStart, this.area.selectionEnd, "end");
            this.edited();
        }
    }
}
