import type { Model } from "../api/model";
import type { Task } from "../api/protocol";
import { debounced, h, replaceChildren } from "../ui/dom";

interface Stack {
    frames: { module: string; routine: string; line: number }[];
    data: { name: string; type: string; value: string }[];
}

/** Routines in progress of a stopped task and the data of one of them. */
export class StackView {
    readonly element = h("div", { class: "stack" });
    private task: Task | undefined;
    private frame = 0;
    private readonly read = debounced(120, () => void this.load());

    constructor(private readonly model: Model, private readonly onShow: (module: string, line: number) => void) {}

    show(task: Task | undefined): void {
        this.task = task;
        this.frame = 0;
        this.element.hidden = !task || task.state === "running" || !task.pointer;
        if (!this.element.hidden) this.read();
    }

    private async load(): Promise<void> {
        const { task } = this;
        if (!task || task.state === "running") return;
        try {
            const stack = await this.model.connection.request<Stack>("data.stack", { task: task.name, frame: this.frame });
            this.render(stack);
        } catch {
            this.element.hidden = true; // it runs again
        }
    }

    private render(stack: Stack): void {
        const frames = stack.frames.map((frame, index) =>
            h(
                "button",
                {
                    class: `stack-frame ${index === this.frame ? "chosen" : ""}`,
                    attrs: { type: "button", title: `${frame.module}, line ${frame.line}` },
                    on: {
                        click: () => {
                            this.frame = index;
                            this.onShow(frame.module, frame.line);
                            this.read();
                        },
                    },
                },
                h("span", { text: frame.routine }),
                h("span", { class: "muted", text: String(frame.line) }),
            ),
        );
        const data = stack.data.map(({ name, type, value }) => h("div", { class: "stack-data", attrs: { title: type } }, h("span", { text: name }), h("code", { text: value })));
        replaceChildren(this.element, h("h3", { class: "side-title", text: "Call stack" }), ...frames, data.length > 0 && h("h3", { class: "side-title", text: "Local data" }), ...data);
    }
}
