import type { Model } from "../api/model";
import type { DataItem, Unit } from "../api/protocol";
import { button, field, Segmented, select, setOptions } from "../ui/controls";
import { h, setText } from "../ui/dom";
import { attempt, notice } from "../ui/notices";

type Kind = "robtarget" | "jointtarget";

/** The present position as a target: read it, or write it to one of the program. */
export class TeachSection {
    readonly element: HTMLElement;
    private readonly kind: Segmented<Kind>;
    private readonly targets = select("Target", () => {});
    private readonly teach: HTMLButtonElement;
    private readonly value = h("code", { class: "teach-value" });

    constructor(private readonly model: Model, private readonly unit: () => Unit | undefined) {
        const kinds = [{ value: "robtarget" as const, label: "robtarget" }, { value: "jointtarget" as const, label: "jointtarget" }];
        this.kind = new Segmented<Kind>("Kind of target", kinds, "robtarget", () => this.refresh());
        const copy = button({ icon: "file", label: "Copy position", onClick: () => attempt(() => this.copy()) });
        this.teach = button({ icon: "target", label: "Modify target", class: "primary", onClick: () => attempt(() => this.write()) });
        this.element = h(
            "section",
            { class: "teach" },
            h("h3", { class: "side-title", text: "Teaching" }),
            h("div", { class: "teach-row" }, field("Kind", this.kind.element), field("Target", this.targets), copy, this.teach),
            this.value,
        );
    }

    refresh(): void {
        attempt(() => this.readTargets());
    }

    private async readTargets(): Promise<void> {
        const task = this.unit()?.task;
        if (!task) return;
        const { data } = await this.model.connection.request<{ data: DataItem[] }>("data.list", { task, type: this.kind.value });
        const writable = data.filter(({ readOnly, dims }) => !readOnly && dims.length === 0);
        const options = writable.map(({ path, name, module }) => ({ value: path, label: `${name}  ${module}` }));
        setOptions(this.targets, options.length > 0 ? options : [{ value: "", label: "None can be changed" }]);
        this.targets.disabled = this.teach.disabled = options.length === 0;
        this.teach.title = options.length === 0 ? "ModPos in the program changes constants" : "";
    }

    private async read(): Promise<string> {
        const unit = this.unit();
        if (!unit) throw new Error("This controller has no robot");
        const { value } = await this.model.connection.request<{ value: string }>("teach.read", { unit: unit.name, kind: this.kind.value });
        setText(this.value, value);
        return value;
    }

    private async copy(): Promise<void> {
        const value = await this.read();
        await navigator.clipboard.writeText(value);
        notice("info", "Position copied", value);
    }

    private async write(): Promise<void> {
        const path = this.targets.value;
        if (!path) throw new Error("The program has no target of this kind that can be changed; use ModPos in the program for constants");
        const value = await this.read();
        await this.model.connection.request("data.write", { path, value });
        notice("info", `Target ${path.split("/").pop()} modified`, value);
    }
}
