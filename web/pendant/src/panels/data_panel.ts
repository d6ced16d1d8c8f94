import type { Model } from "../api/model";
import type { DataItem, DataValue } from "../api/protocol";
import { RequestError } from "../api/connection";
import { button, emptyState, searchField, select, setOptions } from "../ui/controls";
import { debounced, h, replaceChildren, setClass, setText } from "../ui/dom";
import { icon } from "../ui/icons";
import { attempt, notice } from "../ui/notices";

const shownAtOnce = 300;

interface Row {
    item: DataItem;
    element: HTMLElement;
    input: HTMLInputElement;
}

/** Data of every task: watched while they are shown, changed by typing. */
export class DataPanel {
    readonly element: HTMLElement;
    private readonly list = h("div", { class: "list", attrs: { role: "list", "aria-label": "Data" } });
    private readonly taskChoice = select("Task", () => this.reload());
    private readonly typeChoice = select("Type", () => this.reload());
    private readonly count = h("span", { class: "muted" });
    private rows = new Map<string, Row>();
    private readonly pinned = new Map<string, DataItem>();
    private filter = "";
    private visible = false;
    private readonly refilter = debounced(200, () => this.reload());

    constructor(private readonly model: Model, private readonly onShow: (module: string, line: number, task: string) => void) {
        const find = searchField("Name", (text) => {
            this.filter = text;
            this.refilter();
        });
        const types = ["num", "bool", "string", "robtarget", "jointtarget", "tooldata", "wobjdata", "speeddata", "zonedata", "pos", "dnum"];
        setOptions(this.typeChoice, [{ value: "", label: "All types" }, ...types.map((value) => ({ value, label: value }))]);
        this.element = h(
            "section",
            { class: "panel" },
            h("div", { class: "panel-head" }, this.taskChoice, this.typeChoice, find),
            h("div", { class: "scroll" }, this.list),
            h("div", { class: "panel-foot" }, this.count, h("span", { class: "grow" }), h("span", { class: "muted", text: "Enter writes, Esc restores" })),
        );
        model.on("all", (state) => {
            setOptions(this.taskChoice, state.tasks.map(({ name }) => ({ value: name, label: name })));
            this.pinned.clear();
            this.reload();
        });
        model.on("data", (changes) => {
            for (const [path, value] of changes) this.showValue(path, value ?? "", value === null);
        });
    }

    shown(visible: boolean): void {
        this.visible = visible;
        if (visible) this.reload();
        else if (this.model.state) this.model.connection.request("data.watch", { paths: [] }).catch(() => {});
    }

    private reload(): void {
        if (this.visible && this.model.state) attempt(() => this.load());
    }

    private async load(): Promise<void> {
        const params = { task: this.taskChoice.value, filter: this.filter || undefined, type: this.typeChoice.value || undefined, count: shownAtOnce };
        const { connection } = this.model;
        const { data, total } = await connection.request<{ data: DataItem[]; total: number }>("data.list", params);
        const pinned = [...this.pinned.values()];
        const items = [...pinned, ...data.filter(({ path }) => !this.pinned.has(path))];
        this.rows = new Map(items.map((item) => [item.path, this.row(item)]));
        replaceChildren(this.list, ...(items.length > 0 ? [...this.rows.values()].map(({ element }) => element) : [emptyState("data", "No data", "No data of this task matches the filter.")]));
        setText(this.count, data.length < total ? `${data.length} of ${total}: narrow the filter` : `${total} data`);
        const { values } = await connection.request<{ values: DataValue[] }>("data.watch", { paths: [...this.rows.keys()] });
        for (const { path, value, error } of values) this.showValue(path, value ?? error ?? "", error !== undefined);
    }

    private row(item: DataItem): Row {
        const input = h("input", { class: "input value", attrs: { spellcheck: "false", autocomplete: "off", "aria-label": `Value of ${item.name}` } });
        input.readOnly = item.readOnly;
        input.addEventListener("keydown", (event) => {
            if (event.key === "Enter") attempt(() => this.write(item, input));
            if (event.key === "Escape") {
                input.value = input.dataset.value ?? "";
                input.blur();
            }
        });
        input.addEventListener("input", () => setClass(input, "changed", input.value !== input.dataset.value));
        const pin = button({ icon: "pin", label: `Keep ${item.name} on top`, iconOnly: true, class: "quiet", onClick: () => this.pin(item) });
        pin.setAttribute("aria-pressed", String(this.pinned.has(item.path)));
        const go = h(
            "button",
            { class: "row-main link", attrs: { type: "button", title: `Show ${item.module}, line ${item.line}` }, on: { click: () => this.onShow(item.module, item.line, item.path.split("/")[0] ?? "") } },
            h("span", { class: "row-name", text: item.name + (item.dims.length > 0 ? `{${item.dims.join(",")}}` : "") }),
            h("span", { class: "muted", text: `${item.local ? "local " : ""}${item.kind} ${item.type} · ${item.module}` }),
        );
        return { item, input, element: h("div", { class: "row data-row", attrs: { role: "listitem" } }, go, input, item.readOnly ? h("span", { class: "row-lock", attrs: { title: "Read only" } }, icon("unlock")) : null, pin) };
    }

    private showValue(path: string, value: string, failed: boolean): void {
        const row = this.rows.get(path);
        if (!row) return;
        const { input } = row;
        const differs = input.dataset.value !== undefined && input.dataset.value !== value;
        const edited = document.activeElement === input && input.value !== (input.dataset.value ?? "");
        input.dataset.value = value;
        if (!edited) input.value = value;
        input.title = value;
        setClass(input, "failed", failed);
        if (!differs) return;
        input.classList.remove("flash");
        requestAnimationFrame(() => input.classList.add("flash"));
    }

    private async write(item: DataItem, input: HTMLInputElement): Promise<void> {
        try {
            const { value } = await this.model.connection.request<{ value: string }>("data.write", { path: item.path, value: input.value });
            input.dataset.value = value;
            input.value = value;
            setClass(input, "changed", false);
            setClass(input, "failed", false);
        } catch (error) {
            setClass(input, "failed", true);
            if (error instanceof RequestError) notice("error", `${item.name} keeps its value: ${error.message}`, error.remedy);
            else throw error;
        }
    }

    private pin(item: DataItem): void {
        if (!this.pinned.delete(item.path)) this.pinned.set(item.path, item);
        this.reload();
    }
}
