import type { Model } from "../api/model";
import { emptyState } from "../ui/controls";
import { h, oncePerFrame, replaceChildren } from "../ui/dom";

/** The operator display: what the program wrote with TPWrite. */
export class DisplayPanel {
    readonly element: HTMLElement;
    private readonly lines = h("div", { class: "display-lines", attrs: { role: "log", "aria-label": "Operator display", tabindex: 0 } });
    private readonly refresh = oncePerFrame(() => this.render());

    constructor(private readonly model: Model) {
        this.element = h("section", { class: "panel" }, h("div", { class: "panel-head" }, h("h2", { text: "Operator display" })), this.lines);
        model.on("all", this.refresh);
        model.on("display", this.refresh);
    }

    shown(visible: boolean): void {
        if (visible) this.render();
    }

    private render(): void {
        if (this.element.hidden) return;
        const lines = this.model.state?.display.lines ?? [];
        if (lines.length === 0) {
            replaceChildren(this.lines, emptyState("display", "Nothing written", "Lines that the program writes with TPWrite appear here."));
            return;
        }
        const atEnd = this.lines.scrollHeight - this.lines.scrollTop - this.lines.clientHeight < 40;
        replaceChildren(this.lines, ...lines.map((text) => h("div", { class: "display-line", text })));
        if (atEnd) this.lines.scrollTop = this.lines.scrollHeight;
    }
}
