import type { Model } from "../api/model";
import type { Frame, Unit } from "../api/protocol";
import { button, field, Segmented, select, setOptions } from "../ui/controls";
import { h, replaceChildren, setText } from "../ui/dom";
import { whenPageIsLeft, whileHeld } from "../ui/hold";
import { attempt, notice } from "../ui/notices";
import { TeachSection } from "./teach_section";

type Kind = "joint" | "linear" | "reorient" | "external";
type JogFrame = "world" | "base" | "tool" | "workObject";

interface NamedFrame extends Frame {
    module: string;
    task: string;
}

const repeatEvery = 100; // ms; the controller stops the arm 300 ms after the last one
const increments = { none: 0, small: 0.1, medium: 1, large: 5 } as const;
const linearAxes = ["X", "Y", "Z"];

/** Jogging with buttons that move the arm as long as they are pressed, and teaching. */
export class JogPanel {
    readonly element: HTMLElement;
    private readonly unitChoice = select("Mechanical unit", () => this.rebuild());
    private readonly toolChoice = select("Tool", () => this.chooseFrames());
    private readonly objectChoice = select("Work object", () => this.chooseFrames());
    private readonly kind: Segmented<Kind>;
    private readonly frame: Segmented<JogFrame>;
    private readonly increment: Segmented<keyof typeof increments>;
    private readonly keys = h("div", { class: "jog-keys" });
    private readonly guard = h("div", { class: "guard" });
    private readonly speed = h("input", { class: "slider", attrs: { type: "range", min: 1, max: 100, value: 30, "aria-label": "Jog speed in per cent" } });
    private readonly teach: TeachSection;
    private values: HTMLElement[] = [];
    private timer = 0;
    private held: HTMLElement | null = null; // the button that jogs

    constructor(private readonly model: Model) {
        const kinds = [
            { value: "joint" as const, label: "Joint" },
            { value: "linear" as const, label: "Linear" },
            { value: "reorient" as const, label: "Reorient" },
            { value: "external" as const, label: "External" },
        ];
        const frames = [
            { value: "world" as const, label: "World" },
            { value: "base" as const, label: "Base" },
            { value: "tool" as const, label: "Tool" },
            { value: "workObject" as const, label: "Wobj" },
        ];
        const steps = [
            { value: "none" as const, label: "Continuous" },
            { value: "small" as const, label: "0.1" },
            { value: "medium" as const, label: "1" },
            { value: "large" as const, label: "5" },
        ];
        this.kind = new Segmented<Kind>("Motion mode", kinds, "joint", () => this.rebuild());
        this.frame = new Segmented<JogFrame>("Coordinate system", frames, "base", () => {});
        this.increment = new Segmented("Increment in mm or degrees", steps, "none", () => {});
        this.teach = new TeachSection(model, () => this.unit());
        this.element = this.layout();
        this.listen();
    }

    shown(visible: boolean): void {
        if (!visible) this.stop();
        else if (this.model.state) {
            this.rebuild();
            this.teach.refresh();
        }
    }

    private layout(): HTMLElement {
        return h(
            "section",
            { class: "panel jog" },
            h("div", { class: "panel-head" }, h("h2", { text: "Jogging" }), h("span", { class: "grow" }), this.unitChoice),
            h(
                "div",
                { class: "scroll padded" },
                this.guard,
                h(
                    "div",
                    { class: "jog-setup" },
                    field("Motion mode", this.kind.element),
                    field("Coordinate system", this.frame.element),
                    field("Increment, mm or deg", this.increment.element),
                    field("Speed", this.speed),
                    field("Tool", this.toolChoice),
                    field("Work object", this.objectChoice),
                ),
                this.keys,
                this.teach.element,
            ),
        );
    }

    private listen(): void {
        this.model.on("all", (state) => {
            setOptions(this.unitChoice, state.units.map(({ name, model }) => ({ value: name, label: `${name}  ${model}` })));
            attempt(() => this.readFrames());
            this.rebuild();
        });
        this.model.on("panel", () => this.showGuard());
        this.model.on("motion", () => this.showValues());
        this.model.on("jog", ({ limit }) => {
            if (limit) notice("warning", "Jogging ended", limit);
        });
        whenPageIsLeft(() => this.stop());
    }

    private unit(): Unit | undefined {
        const { state } = this.model;
        return state?.units.find(({ name }) => name === this.unitChoice.value) ?? state?.units[0];
    }

    private async readFrames(): Promise<void> {
        const unit = this.unit();
        if (!unit) return;
        const { tools, workObjects } = await this.model.connection.request<{ tools: NamedFrame[]; workObjects: NamedFrame[] }>("units.frames", { unit: unit.name });
        const options = (frames: NamedFrame[]) => frames.map(({ name, module, task }) => ({ value: module ? `${task}/${module}/${name}` : name, label: name }));
        const withDefault = (options: { value: string; label: string }[], name: string) => (options.some(({ label }) => label === name) ? options : [{ value: name, label: name }, ...options]);
        setOptions(this.toolChoice, withDefault(options(tools), "tool0"));
        setOptions(this.objectChoice, withDefault(options(workObjects), "wobj0"));
    }

    private chooseFrames(): void {
        const unit = this.unit();
        if (!unit) return;
        attempt(() => this.model.connection.request("jog.tool", { unit: unit.name, tool: this.toolChoice.value, workObject: this.objectChoice.value }));
    }

    private axisNames(unit: Unit): string[] {
        if (this.kind.value === "joint") return unit.joints.map(({ axis }) => `Axis ${axis}`);
        if (this.kind.value === "external") return unit.external.map(({ number, unit: name }) => name || `External ${number}`);
        return linearAxes.map((axis) => (this.kind.value === "linear" ? axis : `About ${axis}`));
    }

    private rebuild(): void {
        this.stop();
        const unit = this.unit();
        this.showGuard();
        this.frame.setDisabled(this.kind.value === "joint" || this.kind.value === "external");
        const names = unit ? this.axisNames(unit) : [];
        this.values = names.map(() => h("output", { class: "jog-value" }));
        const rows = names.map((name, index) =>
            h("div", { class: "jog-row" }, this.key(name, index, names.length, -1), h("div", { class: "jog-axis" }, h("span", { text: name }), this.values[index]), this.key(name, index, names.length, 1)),
        );
        replaceChildren(this.keys, ...(rows.length > 0 ? rows : [h("p", { class: "muted", text: "This unit has no external axes." })]));
        this.showValues();
    }

    /** A button that jogs while it is held, with pointer or keyboard. */
    private key(name: string, index: number, count: number, sign: number): HTMLButtonElement {
        const item = button({ icon: sign > 0 ? "plus" : "minus", label: `${name} ${sign > 0 ? "positive" : "negative"}`, iconOnly: true, class: "jog-key" });
        const begin = (): void => {
            const values = Array.from({ length: count }, (_, at) => (at === index ? sign : 0));
            this.held?.classList.remove("held");
            this.held = item;
            item.classList.add("held");
            this.start(values);
        };
        whileHeld(item, begin, () => this.held === item && this.stop());
        return item;
    }

    private start(direction: number[]): void {
        const unit = this.unit();
        if (!unit) return;
        const increment = increments[this.increment.value];
        const share = increment > 0 ? 1 : Number(this.speed.value) / 100;
        const params = { unit: unit.name, kind: this.kind.value, frame: this.frame.value, values: direction.map((each) => each * share), increment: increment || undefined };
        const send = (): Promise<unknown> => this.model.connection.request("jog.start", params);
        clearInterval(this.timer);
        attempt(async () => {
            try {
                await send();
            } catch (error) {
                clearInterval(this.timer);
                throw error;
            }
        });
        if (increment === 0) this.timer = window.setInterval(() => send().catch(() => clearInterval(this.timer)), repeatEvery);
        else this.timer = -1;
    }

    private stop(): void {
        this.held?.classList.remove("held");
        this.held = null;
        if (this.timer === 0) return;
        const incremental = this.timer === -1; // that arm stops by itself
        clearInterval(this.timer);
        this.timer = 0;
        if (!incremental) this.model.connection.request("jog.stop", {}).catch(() => {});
    }

    private showValues(): void {
        const { state } = this.model;
        const unit = this.unit();
        const motion = unit && this.model.positions[state?.units.indexOf(unit) ?? -1];
        if (!motion || this.element.hidden) return;
        const values = { joint: motion[1], external: motion[2], linear: motion[3].slice(0, 3), reorient: [] as number[] }[this.kind.value];
        const suffix = this.kind.value === "linear" ? " mm" : "°";
        this.values.forEach((output, index) => {
            const value = values[index];
            setText(output, value === undefined ? "" : value.toFixed(2) + suffix);
        });
    }

    /** Says what is missing before the arm may be jogged, with a button for it. */
    private showGuard(): void {
        const panel = this.model.state?.panel;
        if (!panel) return;
        const request = (method: string, params: object) => () => attempt(() => this.model.connection.request(method, params));
        const steps: [boolean, string, string, () => void][] = [
            [panel.emergencyStop, "The emergency stop is pressed", "Release", request("panel.emergencyStop", { pressed: false })],
            [panel.running, "The program is running", "Stop", request("run.stop", {})],
            [panel.mode === "auto", "Jogging needs the manual mode", "Manual mode", request("panel.mode", { mode: "manual" })],
            [panel.motors !== "on", "The motors are off", "Motors on", request("panel.motors", { on: true })],
        ];
        const missing = steps.find(([applies]) => applies);
        if (missing) this.stop(); // a disabled button has no events
        this.guard.hidden = !missing;
        this.element.classList.toggle("jog-blocked", missing !== undefined);
        for (const key of this.keys.querySelectorAll("button")) key.disabled = missing !== undefined;
        if (missing) replaceChildren(this.guard, h("span", { text: missing[1] }), button({ label: missing[2], class: "primary small", onClick: missing[3] }));
    }
}
