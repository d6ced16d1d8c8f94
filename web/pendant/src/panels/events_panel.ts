import type { Model } from "../api/model";
import type { LogDetails, LogEvent } from "../api/protocol";
import { button, emptyState, Segmented } from "../ui/controls";
import { h, replaceChildren } from "../ui/dom";
import { attempt } from "../ui/notices";

type Filter = "all" | "warning" | "error";

const pageSize = 100;
const kept = 1000;

/** The event log, newest first, with description, causes and actions of each. */
export class EventsPanel {
    readonly element: HTMLElement;
    private readonly list = h("div", { class: "list events", attrs: { role: "list" } });
    private readonly more = button({ label: "Older events", class: "wide", onClick: () => attempt(() => this.load(false)) });
    private events: LogEvent[] = [];
    private open: number | null = null;
    private filter: Filter = "all";
    private visible = false;

    constructor(private readonly model: Model) {
        const filters = [
            { value: "all" as const, label: "All" },
            { value: "warning" as const, label: "Warnings" },
            { value: "error" as const, label: "Errors" },
        ];
        const choose = new Segmented<Filter>("Kind of events", filters, "all", (filter) => {
            this.filter = filter;
            this.render();
        });
        const clear = button({ icon: "trash", label: "Clear", onClick: () => attempt(() => this.clear()) });
        this.element = h(
            "section",
            { class: "panel" },
            h("div", { class: "panel-head" }, h("h2", { text: "Event log" }), h("span", { class: "grow" }), choose.element, clear),
            h("div", { class: "scroll" }, this.list, this.more),
        );
        model.on("all", () => attempt(() => this.load(true)));
        model.on("event", (event) => {
            this.events.unshift(event);
            this.events.length = Math.min(this.events.length, kept);
            if (this.visible) this.render();
        });
    }

    shown(visible: boolean): void {
        this.visible = visible;
        if (visible) this.render();
    }

    private async load(fresh: boolean): Promise<void> {
        const before = fresh ? undefined : this.events[this.events.length - 1]?.number;
        const { events, more } = await this.model.connection.request<{ events: LogEvent[]; more: boolean }>("events.list", { before, count: pageSize });
        this.events = fresh ? events : [...this.events, ...events];
        this.more.hidden = !more;
        this.render();
    }

    private async clear(): Promise<void> {
        await this.model.connection.request("events.clear");
        await this.load(true);
    }

    private render(): void {
        const chosen = this.events.filter(({ type }) => this.filter === "all" || type === this.filter);
        if (chosen.length === 0) {
            replaceChildren(this.list, emptyState("check", "No events", "Messages, warnings and errors of the controller are listed here."));
            return;
        }
        replaceChildren(this.list, ...chosen.map((event) => this.row(event)));
    }

    private row(event: LogEvent): HTMLElement {
        const details = h("div", { class: "event-details", attrs: { hidden: true } });
        const head = h(
            "button",
            { class: "event-head", attrs: { type: "button", "aria-expanded": "false" } },
            h("span", { class: `dot dot-${event.type}`, attrs: { title: event.type } }),
            h("span", { class: "visually-hidden", text: event.type }),
            h("span", { class: "event-code", text: String(event.code) }),
            h("span", { class: "event-title", text: event.title }),
            h("span", { class: "event-task", text: event.task }),
            h("time", { class: "event-time", text: event.time.replace(/^.*T\s*/, ""), attrs: { title: event.time } }),
        );
        const show = (): void => {
            const opens = details.hidden;
            details.hidden = !opens;
            head.setAttribute("aria-expanded", String(opens));
            this.open = opens ? event.number : null;
            if (opens && details.childElementCount === 0) attempt(() => this.showDetails(event, details));
        };
        head.addEventListener("click", show);
        if (this.open === event.number) show();
        return h("div", { class: "event", attrs: { role: "listitem" } }, head, details);
    }

    private async showDetails(event: LogEvent, into: HTMLElement): Promise<void> {
        const details = await this.model.connection.request<LogDetails>("events.details", { number: event.number });
        const parts: [string, string][] = [
            ["Description", details.description],
            ["Consequences", details.consequences],
            ["Probable causes", details.causes],
            ["Actions", details.actions],
            ["Arguments", details.arguments.join(", ")],
        ];
        const shown = parts.filter(([, text]) => text !== "");
        replaceChildren(into, h("dl", { class: "event-parts" }, ...shown.flatMap(([name, text]) => [h("dt", { text: name }), h("dd", { text })])));
        if (shown.length === 0) replaceChildren(into, h("p", { class: "muted", text: "This event has no further text." }));
    }
}
