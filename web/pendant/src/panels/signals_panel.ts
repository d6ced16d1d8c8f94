import type { Model } from "../api/model";
import type { Signal } from "../api/protocol";
import { button, emptyState, searchField, Segmented } from "../ui/controls";
import { debounced, h, replaceChildren, setClass, setText } from "../ui/dom";
import { attempt } from "../ui/notices";

type Kind = "all" | "inputs" | "outputs" | "simulated";

interface Row {
    signal: Signal;
    element: HTMLElement;
    value: HTMLElement;
    toggle: HTMLButtonElement | null;
    input: HTMLInputElement | null;
    simulate: HTMLButtonElement;
}

const rowsShown = 400;

/** Signals with their values; set and simulate. */
export class SignalsPanel {
    readonly element: HTMLElement;
    private readonly list = h("div", { class: "list", attrs: { role: "table", "aria-label": "Signals" } });
    private readonly count = h("span", { class: "muted" });
    private readonly signals = new Map<string, Signal>();
    private rows = new Map<string, Row>();
    private text = "";
    private kind: Kind = "all";
    private readonly refilter = debounced(120, () => this.render());

    constructor(private readonly model: Model) {
        const kinds = [
            { value: "all" as const, label: "All" },
            { value: "inputs" as const, label: "Inputs" },
            { value: "outputs" as const, label: "Outputs" },
            { value: "simulated" as const, label: "Simulated" },
        ];
        const choose = new Segmented<Kind>("Kind of signals", kinds, "all", (kind) => {
            this.kind = kind;
            this.render();
        });
        const find = searchField("Name, label, device", (text) => {
            this.text = text.toLowerCase();
            this.refilter();
        });
        this.element = h(
            "section",
            { class: "panel" },
            h("div", { class: "panel-head" }, find, h("span", { class: "grow" }), choose.element),
            h("div", { class: "scroll" }, this.list),
            h("div", { class: "panel-foot" }, this.count),
        );
        model.on("signals", (signals) => this.load(signals));
        model.on("signal", (changes) => this.update(changes));
    }

    shown(visible: boolean): void {
        if (visible) this.render();
    }

    private load(signals: Signal[]): void {
        this.signals.clear();
        for (const signal of signals) this.signals.set(signal.name, signal);
        this.render();
    }

    private update(changes: [string, number, 0 | 1][]): void {
        for (const [name, value, simulated] of changes) {
            const signal = this.signals.get(name);
            if (!signal) continue;
            signal.value = value;
            signal.simulated = simulated === 1;
            const row = this.rows.get(name);
            if (row) this.showValue(row);
        }
    }

    private matches(signal: Signal): boolean {
        const kinds: Record<Kind, boolean> = {
            all: true,
            inputs: signal.type.endsWith("I"),
            outputs: signal.type.endsWith("O"),
            simulated: signal.simulated,
        };
        return kinds[this.kind] && `${signal.name} ${signal.label} ${signal.device}`.toLowerCase().includes(this.text);
    }

    private render(): void {
        if (this.element.hidden) return;
        const found = [...this.signals.values()].filter((signal) => this.matches(signal));
        const shown = found.slice(0, rowsShown);
        this.rows = new Map(shown.map((signal) => [signal.name, this.row(signal)]));
        const empty = emptyState("signals", "No signals", this.signals.size > 0 ? "No signal matches the filter." : "The configuration of this controller defines no signals.");
        replaceChildren(this.list, ...(shown.length > 0 ? [...this.rows.values()].map((row) => row.element) : [empty]));
        setText(this.count, shown.length < found.length ? `${shown.length} of ${found.length} signals: narrow the filter` : `${found.length} signals`);
    }

    private row(signal: Signal): Row {
        const digital = signal.type.startsWith("D");
        const value = h("span", { class: "signal-value" });
        const set = (number: number): void => attempt(() => this.model.connection.request("signals.set", { name: signal.name, value: number }));
        const toggle = digital ? h("button", { class: "lamp", attrs: { type: "button", role: "switch", "aria-label": signal.name }, on: { click: () => set(signal.value === 0 ? 1 : 0) } }) : null;
        const input = digital ? null : h("input", { class: "input number", attrs: { type: "number", step: "any", "aria-label": `Value of ${signal.name}` } });
        input?.addEventListener("change", () => set(Number(input.value)));
        const simulate = button({ label: "Simulate", class: "small", onClick: () => this.simulate(signal) });
        const note = [signal.label, signal.device, signal.category].filter(Boolean).join(" · ");
        const element = h(
            "div",
            { class: "row signal-row", attrs: { role: "row" } },
            h("span", { class: `badge badge-${signal.type.toLowerCase()}`, text: signal.type, attrs: { role: "cell" } }),
            h("span", { class: "row-main", attrs: { role: "cell" } }, h("span", { class: "row-name", text: signal.name }), note && h("span", { class: "muted", text: note })),
            h("span", { class: "row-value", attrs: { role: "cell" } }, digital ? value : input, digital && toggle),
            h("span", { attrs: { role: "cell" } }, simulate),
        );
        const row = { signal, element, value, toggle, input, simulate };
        this.showValue(row);
        return row;
    }

    private showValue({ signal, element, value, toggle, input, simulate }: Row): void {
        const on = signal.value !== 0;
        setText(value, String(signal.value));
        if (toggle) {
            toggle.setAttribute("aria-checked", String(on));
            toggle.disabled = !signal.writable && !signal.simulated;
        }
        if (input) {
            input.disabled = !signal.writable && !signal.simulated;
            if (document.activeElement !== input) input.value = String(Math.round(signal.value * 1e4) / 1e4);
        }
        simulate.setAttribute("aria-pressed", String(signal.simulated));
        setClass(element, "simulated", signal.simulated);
    }

    private simulate(signal: Signal): void {
        attempt(() => this.model.connection.request("signals.simulate", { name: signal.name, on: !signal.simulated }));
    }
}
