import type { Model } from "../api/model";
import type { LogEvent, Task } from "../api/protocol";
import { h, setText } from "../ui/dom";

/** Tasks with their state, the position of the first robot, the last event. */
export class StatusBar {
    readonly element: HTMLElement;
    private readonly tasks = h("div", { class: "status-tasks" });
    private readonly position = h("div", { class: "status-position" });
    private readonly event: HTMLButtonElement;

    constructor(private readonly model: Model, onEvent: () => void) {
        this.event = h("button", { class: "status-event", attrs: { type: "button", title: "Show the event log" }, on: { click: onEvent } });
        this.element = h("footer", { class: "status-bar" }, this.tasks, this.position, this.event);
        model.on("all", () => this.showTasks());
        model.on("task", () => this.showTasks());
        model.on("event", (event) => this.showEvent(event));
        model.on("motion", () => this.showPosition());
    }

    private showTasks(): void {
        const tasks = this.model.state?.tasks ?? [];
        this.tasks.replaceChildren(...tasks.map(taskChip));
    }

    private showPosition(): void {
        const motion = this.model.positions[0];
        const unit = this.model.state?.units[0];
        if (!motion || !unit) return;
        const [x = 0, y = 0, z = 0] = motion[3];
        setText(this.position, `${unit.name}  X ${x.toFixed(1)}  Y ${y.toFixed(1)}  Z ${z.toFixed(1)} mm  ${motion[5].toFixed(0)} mm/s`);
    }

    private showEvent(event: LogEvent): void {
        this.event.replaceChildren(h("span", { class: `dot dot-${event.type}` }), h("span", { text: `${event.code}  ${event.title}` }));
    }
}

function taskChip(task: Task): HTMLElement {
    const state = task.error ? "error" : task.state === "running" ? "running" : "stopped";
    const title = task.error || `${task.type} task, ${task.state}${task.active ? "" : ", not active"}`;
    return h(
        "span",
        { class: `task-chip ${task.active ? "" : "task-inactive"}`, attrs: { title } },
        h("span", { class: `dot dot-${state}` }),
        h("span", { text: task.name }),
        h("span", { class: "visually-hidden", text: task.state }),
    );
}
