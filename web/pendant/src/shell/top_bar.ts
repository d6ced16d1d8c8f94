import type { Model } from "../api/model";
import type { State } from "../api/protocol";
import { button, Segmented } from "../ui/controls";
import { h, setClass, setText } from "../ui/dom";
import { attempt, notice } from "../ui/notices";
import { currentTheme, setTheme } from "./theme";

const motorTexts: Record<string, string> = {
    on: "Motors on",
    off: "Motors off",
    guardStop: "Guard stop",
    emergencyStop: "E-stop", // the name of the button that presses and releases it is another
    emergencyStopReset: "E-stop released",
    init: "Starting",
    failure: "System failure",
};

const clockPeriod = 200; // ms

/** State of the controller and what an operator does most: motors, mode, start, stop, steps, speed, emergency stop. */
export class TopBar {
    readonly element: HTMLElement;
    private readonly controller = h("span", { class: "brand-name", text: "rapidc" });
    private readonly version = h("span", { class: "brand-version" });
    private readonly run = h("span", { class: "pill", attrs: { role: "status" } });
    private readonly clock = h("output", { class: "clock", attrs: { title: "Virtual time", "aria-label": "Virtual time" } });
    private readonly motors: HTMLButtonElement;
    private readonly start: HTMLButtonElement;
    private readonly stop: HTMLButtonElement;
    private readonly whenStopped: HTMLButtonElement[];
    private readonly emergency: HTMLButtonElement;
    /** The time that was reported last, and when, in ms of this computer: between reports the clock is advanced here. */
    private reported = { t: 0, at: 0 };
    private readonly speed = h("input", { class: "slider", attrs: { type: "range", min: 1, max: 100, "aria-label": "Speed in per cent" } });
    private readonly speedText = h("output", { class: "speed-text" });
    private readonly mode: Segmented<"auto" | "manual">;
    private readonly cycle: Segmented<"forever" | "once">;

    constructor(private readonly model: Model) {
        const run = (mode: string) => () => this.send("run.start", { mode });
        this.motors = button({ icon: "motors", label: "Motors", class: "motors", onClick: () => this.toggleMotors() });
        this.start = button({ icon: "play", label: "Start", class: "start", keys: "F5", onClick: run("continue") });
        this.stop = button({ icon: "stop", label: "Stop", class: "stop", keys: "Shift+F5", onClick: () => this.send("run.stop") });
        this.whenStopped = [
            button({ icon: "stepBack", label: "Step backward", iconOnly: true, keys: "F8", onClick: run("stepBack") }),
            button({ icon: "stepForward", label: "Step forward", iconOnly: true, keys: "F10", onClick: run("stepOver") }),
            button({ icon: "stepInto", label: "Step into", iconOnly: true, keys: "F11", onClick: run("stepIn") }),
            button({ icon: "toMain", label: "PP to Main", onClick: () => this.send("run.pointerToMain") }),
        ];
        this.whenStopped[3]?.setAttribute("aria-label", "Program pointer to main"); // its text is hidden on narrow screens
        this.emergency = button({ label: "STOP", class: "emergency", title: "Emergency stop", onClick: () => this.toggleEmergency() });
        this.emergency.setAttribute("aria-label", "Emergency stop");
        const modes = [{ value: "auto" as const, label: "Auto" }, { value: "manual" as const, label: "Manual" }];
        this.mode = new Segmented("Operating mode", modes, "auto", (mode) => this.send("panel.mode", { mode }));
        const cycles = [{ value: "forever" as const, label: "Forever" }, { value: "once" as const, label: "Once" }];
        this.cycle = new Segmented("Cycle", cycles, "forever", (cycle) => this.send("panel.cycle", { cycle }));
        this.element = this.layout();
        this.listen();
        this.shortcuts();
    }

    showProduct(product: string): void {
        this.version.title = product;
    }

    private layout(): HTMLElement {
        return h(
            "header",
            { class: "top-bar" },
            h("div", { class: "brand" }, h("span", { class: "brand-mark" }), h("div", {}, this.controller, this.version)),
            h("div", { class: "bar-group bar-state" }, this.run, this.clock),
            h("div", { class: "bar-group bar-setup" }, this.mode.element, this.motors),
            h("div", { class: "bar-group bar-run", attrs: { role: "toolbar", "aria-label": "Execution" } }, this.start, this.stop, ...this.whenStopped),
            h("div", { class: "bar-group bar-speed" }, h("span", { class: "bar-label", text: "Speed" }), this.speed, this.speedText),
            h("div", { class: "bar-group bar-cycle" }, this.cycle.element),
            h("div", { class: "bar-group bar-end" }, themeButton(), this.emergency),
        );
    }

    private listen(): void {
        this.model.on("all", (state) => {
            setText(this.controller, state.name);
            setText(this.version, `RobotWare ${state.robotWare}`);
            this.showPanel(state.panel);
            this.takeTime(state.time.t);
        });
        this.model.on("panel", (panel) => this.showPanel(panel));
        this.model.on("task", () => this.model.state && this.showPanel(this.model.state.panel));
        this.model.on("time", (time) => this.takeTime(time.t));
        this.model.on("motion", (motion) => this.takeTime(motion.t));
        setInterval(() => this.showTime(), clockPeriod);
        this.speed.addEventListener("input", () => setText(this.speedText, `${this.speed.value} %`));
        this.speed.addEventListener("change", () => this.send("panel.speed", { percent: Number(this.speed.value) }));
    }

    private takeTime(t: number): void {
        this.reported = { t, at: performance.now() };
        this.showTime();
    }

    /** Nothing is reported while nothing moves, but virtual time continues; at full speed it is known only when it is reported. */
    private showTime(): void {
        const time = this.model.state?.time;
        const passed = time?.running ? ((performance.now() - this.reported.at) / 1000) * (time.pace / 100) : 0;
        const t = this.reported.t + passed;
        const minutes = Math.floor(t / 60);
        setText(this.clock, `${String(minutes).padStart(2, "0")}:${(t - minutes * 60).toFixed(1).padStart(4, "0")}`);
    }

    private showPanel(panel: State["panel"]): void {
        const ready = panel.motors === "on";
        const failed = this.model.state?.tasks.some((task) => task.error !== "") ?? false;
        const run = panel.running ? "running" : failed ? "error" : "stopped";
        this.run.className = `pill pill-${run}`;
        setText(this.run, panel.running ? "Running" : failed ? "Stopped by error" : "Stopped");
        setText(this.motors.lastElementChild as Element, motorTexts[panel.motors] ?? panel.motors);
        this.motors.setAttribute("aria-pressed", String(ready));
        setClass(this.motors, "motors-fault", !ready && panel.motors !== "off");
        this.start.disabled = panel.running;
        this.stop.disabled = !panel.running;
        for (const each of this.whenStopped) each.disabled = panel.running;
        this.mode.set(panel.mode === "auto" ? "auto" : "manual");
        this.cycle.set(panel.cycle);
        this.emergency.setAttribute("aria-pressed", String(panel.emergencyStop));
        setText(this.emergency.lastElementChild as Element, panel.emergencyStop ? "RESET" : "STOP");
        this.emergency.setAttribute("aria-label", panel.emergencyStop ? "Emergency stop, reset" : "Emergency stop");
        if (document.activeElement !== this.speed) this.speed.value = String(panel.speed);
        setText(this.speedText, `${Math.round(panel.speed)} %`);
    }

    private toggleMotors(): void {
        this.send("panel.motors", { on: this.model.state?.panel.motors !== "on" });
    }

    private toggleEmergency(): void {
        const pressed = !(this.model.state?.panel.emergencyStop ?? false);
        this.send("panel.emergencyStop", { pressed });
        if (pressed) notice("error", "Emergency stop", "Press RESET, then switch the motors on");
    }

    private send(method: string, params: object = {}): void {
        attempt(() => this.model.connection.request(method, params));
    }

    private shortcuts(): void {
        document.addEventListener("keydown", (event) => {
            const [back, forward, into] = this.whenStopped;
            const keys: Record<string, HTMLButtonElement | undefined> = {
                F5: event.shiftKey ? this.stop : this.start,
                F8: back,
                F10: forward,
                F11: into,
            };
            const target = keys[event.key];
            if (!target || event.ctrlKey || event.metaKey || event.altKey) return;
            event.preventDefault();
            if (!target.disabled) target.click();
        });
    }
}

function themeButton(): HTMLElement {
    const names = { system: "Theme of the system", light: "Light theme", dark: "Dark theme" };
    const next = { system: "light", light: "dark", dark: "system" } as const;
    const icons = { system: "auto", light: "sun", dark: "moon" } as const;
    const holder = h("span", { class: "theme-switch" });
    const show = (focus: boolean): void => {
        const theme = currentTheme();
        const item = button({
            icon: icons[theme],
            label: `${names[theme]}: switch`,
            iconOnly: true,
            class: "quiet",
            onClick: () => {
                setTheme(next[theme]);
                show(true);
            },
        });
        holder.replaceChildren(item);
        if (focus) item.focus();
    };
    show(false);
    return holder;
}
