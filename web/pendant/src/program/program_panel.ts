import type { Model } from "../api/model";
import type { ModuleInfo, Routine } from "../api/protocol";
import { RequestError } from "../api/connection";
import { button, select, setOptions } from "../ui/controls";
import { h, replaceChildren, setClass, setText } from "../ui/dom";
import { icon } from "../ui/icons";
import { attempt, notice, showError } from "../ui/notices";
import { CodeView } from "./code_view";
import { StackView } from "./stack_view";

/** Modules of a task, the text of one of them with markers and breakpoints, editing, the call stack. */
export class ProgramPanel {
    readonly element: HTMLElement;
    private readonly code: CodeView;
    private readonly stack: StackView;
    private readonly taskChoice = select("Task", (name) => this.chooseTask(name));
    private readonly routineChoice = select("Routine", (line) => this.code.select(Number(line)));
    private readonly moduleList = h("div", { class: "module-list", attrs: { role: "listbox", "aria-label": "Modules" } });
    private readonly mistakes = h("div", { class: "mistakes", attrs: { hidden: true, role: "alert" } });
    private readonly caret = h("span", { class: "muted caret-place" });
    private readonly editButton: HTMLButtonElement;
    private readonly applyButton: HTMLButtonElement;
    private readonly revertButton: HTMLButtonElement;
    private readonly lineActions: HTMLButtonElement[];
    private readonly followPointer: HTMLButtonElement;
    private modules: ModuleInfo[] = [];
    private task = "";
    private module = "";
    private original = "";
    private changes = 0;
    private editing = false;
    private following = true;

    constructor(private readonly model: Model) {
        this.code = new CodeView({
            toggleBreakpoint: (line) => this.toggleBreakpoint(line),
            changed: () => this.updateActions(),
            caret: (line) => this.showCaret(line),
        });
        this.stack = new StackView(model, (module, line) => this.show(this.task, module, line));
        this.editButton = button({ icon: "edit", label: "Edit", onClick: () => this.setEditing(!this.editing) });
        this.applyButton = button({ icon: "check", label: "Apply", class: "primary", onClick: () => attempt(() => this.apply()) });
        this.revertButton = button({ icon: "undo", label: "Revert", onClick: () => this.revert() });
        this.followPointer = button({ icon: "eye", label: "Follow the program pointer", iconOnly: true, onClick: () => this.setFollowing(!this.following) });
        this.lineActions = [
            button({ icon: "target", label: "PP to line", onClick: () => this.pointerToLine() }),
            button({ icon: "pin", label: "ModPos", title: "The target of this movement becomes the present position", onClick: () => attempt(() => this.modifyPosition()) }),
        ];
        this.element = this.layout();
        this.setFollowing(true);
        this.listen();
    }

    shown(visible: boolean): void {
        if (visible) this.code.shown();
    }

    /** Shows a line of a module. */
    show(task: string, module: string, line: number): void {
        this.setFollowing(false);
        attempt(async () => {
            if (task !== this.task) await this.loadTask(task);
            await this.loadModule(module);
            this.code.select(line);
        });
    }

    private layout(): HTMLElement {
        return h(
            "section",
            { class: "panel program" },
            h("div", { class: "panel-head" }, this.taskChoice, this.routineChoice, h("span", { class: "grow" }), this.followPointer, this.editButton, this.revertButton, this.applyButton),
            h(
                "div",
                { class: "program-body" },
                h("div", { class: "program-side" }, this.moduleList, this.stack.element),
                h("div", { class: "program-main" }, this.code.element, this.mistakes, h("div", { class: "panel-foot" }, ...this.lineActions, h("span", { class: "grow" }), this.caret)),
            ),
        );
    }

    private listen(): void {
        this.model.on("all", (state) => {
            setOptions(this.taskChoice, state.tasks.map(({ name }) => ({ value: name, label: name })));
            const task = state.tasks.find(({ name }) => name === this.task) ?? state.tasks.find(({ type }) => type === "normal") ?? state.tasks[0];
            this.module = "";
            if (task) attempt(() => this.loadTask(task.name));
        });
        this.model.on("pointers", (task) => task.name === this.task && this.followTo());
        this.model.on("task", (task) => {
            if (task.name !== this.task) return;
            if (task.changes !== this.changes && !this.editing) attempt(() => this.reload());
            this.updateActions();
            this.followTo();
        });
        this.model.on("panel", () => this.updateActions());
        this.model.on("breakpoints", () => this.showMarkers());
    }

    private chooseTask(name: string): void {
        this.module = "";
        attempt(() => this.loadTask(name));
    }

    private async loadTask(name: string): Promise<void> {
        this.task = name;
        this.taskChoice.value = name;
        await this.readModules();
        const wanted = this.model.task(name)?.pointer?.module ?? this.modules.find(({ kind }) => kind === "program")?.name ?? this.modules[0]?.name;
        if (wanted) await this.loadModule(wanted);
        this.followTo();
    }

    private async reload(): Promise<void> {
        const { module } = this;
        await this.readModules();
        this.module = "";
        if (this.modules.some(({ name }) => name === module)) await this.loadModule(module);
    }

    private async readModules(): Promise<void> {
        const { modules } = await this.model.connection.request<{ modules: ModuleInfo[] }>("modules.list", { task: this.task });
        this.modules = modules;
        this.showModules();
    }

    private showModules(): void {
        const entries = this.modules.map((module) =>
            h(
                "button",
                {
                    class: `module-item ${module.name === this.module ? "chosen" : ""}`,
                    attrs: { type: "button", role: "option", "aria-selected": String(module.name === this.module) },
                    on: { click: () => this.show(this.task, module.name, 1) },
                },
                icon(module.kind === "system" ? "layers" : "file"),
                h("span", { class: "module-name", text: module.name }),
                h("span", { class: "muted", text: module.readOnly ? "read only" : String(module.lines) }),
            ),
        );
        replaceChildren(this.moduleList, ...entries);
    }

    private async loadModule(name: string): Promise<void> {
        if (name === this.module) return;
        if (this.editing && this.code.text !== this.original) {
            throw new RequestError("refused", "The module has changes that are not applied", "Apply or revert them first");
        }
        const { connection } = this.model;
        const [{ text, changes }, { routines }] = await Promise.all([
            connection.request<{ text: string; changes: number }>("modules.text", { task: this.task, module: name }),
            connection.request<{ routines: Routine[] }>("modules.routines", { task: this.task, module: name }),
        ]);
        this.module = name;
        this.original = text.replace(/\r\n/g, "\n");
        this.changes = changes;
        this.setEditing(false);
        this.code.setText(this.original);
        const options = routines.map((routine) => ({ value: String(routine.line), label: `${routine.kind} ${routine.name}` }));
        setOptions(this.routineChoice, [{ value: "1", label: name }, ...options]);
        this.showModules();
        this.showMarkers();
    }

    private showMarkers(): void {
        const task = this.model.task(this.task);
        const same = (name: string): boolean => name.toLowerCase() === this.module.toLowerCase();
        const breakpoints = new Map<number, boolean>();
        for (const each of this.model.state?.breakpoints ?? []) {
            if (each.task === this.task && same(each.module)) breakpoints.set(each.line, each.verified);
        }
        this.code.setMarkers({
            pointer: task?.pointer && same(task.pointer.module) ? task.pointer : null,
            motion: task?.motion && same(task.motion.module) ? task.motion : null,
            breakpoints,
        });
    }

    private followTo(): void {
        this.showMarkers();
        const task = this.model.task(this.task);
        this.stack.show(task);
        const pointer = task?.pointer;
        if (!pointer || !this.following || this.editing || this.element.hidden) return;
        if (pointer.module.toLowerCase() === this.module.toLowerCase()) {
            this.code.reveal(pointer.line);
            return;
        }
        const module = this.modules.find(({ name }) => name.toLowerCase() === pointer.module.toLowerCase());
        if (module) this.loadModule(module.name).then(() => this.code.reveal(pointer.line), showError);
    }

    private setFollowing(on: boolean): void {
        this.following = on;
        this.followPointer.setAttribute("aria-pressed", String(on));
        if (on && this.model.state) this.followTo();
    }

    private setEditing(on: boolean): void {
        const readOnly = this.modules.find(({ name }) => name === this.module)?.readOnly ?? false;
        this.editing = on && !readOnly;
        if (on && readOnly) notice("warning", `Module ${this.module} is read only`);
        this.code.setEditable(this.editing);
        this.mistakes.hidden = true;
        this.updateActions();
    }

    private updateActions(): void {
        const changed = this.editing && this.code.text !== this.original;
        const running = this.model.task(this.task)?.state === "running";
        this.editButton.hidden = changed;
        this.editButton.setAttribute("aria-pressed", String(this.editing));
        this.applyButton.hidden = !changed;
        this.applyButton.disabled = running;
        this.applyButton.title = running ? "Stop the program first" : "";
        this.revertButton.hidden = !changed;
        for (const each of this.lineActions) each.disabled = running || changed;
        setClass(this.element, "program-changed", changed);
    }

    private revert(): void {
        this.code.setText(this.original);
        this.setEditing(false);
    }

    private async apply(): Promise<void> {
        const text = this.code.text;
        const params = { task: this.task, module: this.module, text, changes: this.changes };
        try {
            const { changes } = await this.model.connection.request<{ changes: number }>("modules.setText", params);
            this.changes = changes;
            this.original = text;
            this.setEditing(false);
            await this.readModules();
        } catch (error) {
            if (!(error instanceof RequestError) || error.code !== "bad_request") throw error;
            this.showMistakes(error.message);
        }
    }

    /** A button per mistake, with the lines that explain it; it leads to the place. */
    private showMistakes(text: string): void {
        const place = /^(?:.*\/)?([^/:\s]+):(\d+):\d+: /;
        const found: { line: number; text: string }[] = [];
        for (const line of text.split("\n").filter(Boolean)) {
            const at = place.exec(line);
            const last = found[found.length - 1];
            if (at) found.push({ line: Number(at[2]), text: line.replace(/^.*\/(?=[^/:\s]+:\d+:\d+: )/, "") });
            else if (last) last.text += `\n${line}`;
        }
        if (found.length === 0) found.push({ line: 1, text });
        const entries = found.map((each) =>
            h("button", { class: "mistake", text: each.text, attrs: { type: "button" }, on: { click: () => this.code.select(each.line) } }),
        );
        replaceChildren(this.mistakes, h("strong", { text: "Nothing was changed: the text has mistakes" }), ...entries);
        this.mistakes.hidden = false;
    }

    private toggleBreakpoint(line: number): void {
        const { state, connection } = this.model;
        const known = state?.breakpoints.some((each) => each.task === this.task && each.module.toLowerCase() === this.module.toLowerCase() && each.line === line);
        attempt(() => connection.request(known ? "breakpoints.clear" : "breakpoints.set", { task: this.task, module: this.module, line }));
    }

    private pointerToLine(): void {
        attempt(() => this.model.connection.request("run.pointerToLine", { task: this.task, module: this.module, line: this.code.line }));
    }

    private async modifyPosition(): Promise<void> {
        const params = { task: this.task, module: this.module, line: this.code.line };
        const { inText } = await this.model.connection.request<{ inText: boolean }>("teach.modify", params);
        notice("info", `Position modified: ${params.module}, line ${params.line}`, inText ? "The text of the module has changed" : "");
    }

    private showCaret(line: number): void {
        setText(this.caret, `${this.module}, line ${line}`);
    }
}
