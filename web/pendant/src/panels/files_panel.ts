import type { Model } from "../api/model";
import type { ModuleInfo } from "../api/protocol";
import { button, emptyState, select, setOptions } from "../ui/controls";
import { h, replaceChildren, setText } from "../ui/dom";
import { icon } from "../ui/icons";
import { attempt, notice } from "../ui/notices";

interface Entry {
    name: string;
    folder: boolean;
    size: number;
    modified: string;
}

/** Backups, loading and saving of programs and modules, the volumes of the controller. */
export class FilesPanel {
    readonly element: HTMLElement;
    private readonly list = h("div", { class: "list", attrs: { role: "list", "aria-label": "Files" } });
    private readonly path = h("span", { class: "path" });
    private readonly taskChoice = select("Task", () => attempt(() => this.readModules()));
    private readonly moduleChoice = select("Module", () => {});
    private readonly backupName = h("input", { class: "input", attrs: { "aria-label": "Name of the backup", maxlength: 60 } });
    private readonly programFolder = h("input", { class: "input", attrs: { "aria-label": "Folder of the program", spellcheck: "false" } });
    private folder = "HOME:/";

    constructor(private readonly model: Model) {
        this.backupName.value = `backup_${new Date().toISOString().slice(0, 10).replace(/-/g, "")}`;
        this.programFolder.value = "HOME:/program";
        this.element = this.layout();
        model.on("all", (state) => setOptions(this.taskChoice, state.tasks.map(({ name }) => ({ value: name, label: name }))));
    }

    shown(visible: boolean): void {
        if (!visible || !this.model.state) return;
        attempt(() => this.readFolder());
        attempt(() => this.readModules());
    }

    private layout(): HTMLElement {
        const act = (action: () => Promise<unknown>) => () => attempt(action);
        const card = (title: string, ...children: (Node | string)[]): HTMLElement => h("div", { class: "card" }, h("h3", { class: "side-title", text: title }), h("div", { class: "card-row" }, ...children));
        return h(
            "section",
            { class: "panel" },
            h("div", { class: "panel-head" }, h("h2", { text: "Files and backup" }), h("span", { class: "grow" }), this.taskChoice),
            h(
                "div",
                { class: "scroll padded" },
                h(
                    "div",
                    { class: "cards" },
                    card("Backup", this.backupName, button({ icon: "archive", label: "Create", class: "primary", onClick: act(() => this.backup()) })),
                    card(
                        "Module",
                        this.moduleChoice,
                        button({ icon: "save", label: "Save", onClick: act(() => this.saveModule()) }),
                        button({ icon: "trash", label: "Unload", onClick: act(() => this.unloadModule()) }),
                    ),
                    card("Program", this.programFolder, button({ icon: "save", label: "Save", onClick: act(() => this.saveProgram()) })),
                    card(
                        "Controller",
                        button({ icon: "refresh", label: "Warm restart", onClick: () => this.restart("warm") }),
                        button({ icon: "refresh", label: "Cold restart", onClick: () => this.restart("cold") }),
                    ),
                ),
                h("div", { class: "file-head" }, button({ icon: "undo", label: "Folder above", iconOnly: true, class: "quiet", onClick: () => this.open(parentOf(this.folder)) }), this.path),
                this.list,
            ),
        );
    }

    private open(folder: string): void {
        this.folder = folder;
        attempt(() => this.readFolder());
    }

    private async readFolder(): Promise<void> {
        const { entries } = await this.model.connection.request<{ entries: Entry[] }>("files.list", { folder: this.folder });
        setText(this.path, this.folder || "Volumes");
        const sorted = [...entries].sort((a, b) => Number(b.folder) - Number(a.folder) || a.name.localeCompare(b.name));
        const empty = emptyState("folder", "Empty folder", "Modules and programs that are saved here can be loaded again.");
        replaceChildren(this.list, ...(sorted.length > 0 ? sorted.map((entry) => this.row(entry)) : [empty]));
    }

    private row(entry: Entry): HTMLElement {
        const path = this.folder === "" ? `${entry.name.replace(/[:/]*$/, "")}:/` : `${this.folder.replace(/\/?$/, "/")}${entry.name}`;
        const name = h("span", { class: "row-name", text: entry.name });
        const main = entry.folder ? h("button", { class: "row-main link", attrs: { type: "button" }, on: { click: () => this.open(path) } }, name) : h("span", { class: "row-main" }, name);
        const loads = /\.(modx?|sysx?|pgf)$/i.test(entry.name) && !entry.folder;
        return h(
            "div",
            { class: "row file-row", attrs: { role: "listitem" } },
            icon(entry.folder ? "folder" : "file"),
            main,
            h("span", { class: "muted number", text: entry.folder ? "" : sizeText(entry.size) }),
            h("span", { class: "muted file-time", text: entry.modified }),
            loads && button({ icon: "upload", label: "Load", class: "small", onClick: () => attempt(() => this.load(path)) }),
        );
    }

    private async load(path: string): Promise<void> {
        const task = this.taskChoice.value;
        const program = /\.pgf$/i.test(path);
        await this.model.connection.request(program ? "program.load" : "modules.load", program ? { task, path } : { task, path, replace: true });
        notice("info", `${program ? "Program" : "Module"} loaded into ${task}`, path);
        await this.readModules();
    }

    private async readModules(): Promise<void> {
        if (!this.taskChoice.value) return;
        const { modules } = await this.model.connection.request<{ modules: ModuleInfo[] }>("modules.list", { task: this.taskChoice.value });
        setOptions(this.moduleChoice, modules.map(({ name }) => ({ value: name, label: name })));
    }

    private async saveModule(): Promise<void> {
        const { path } = await this.model.connection.request<{ path: string }>("modules.save", { task: this.taskChoice.value, module: this.moduleChoice.value });
        notice("info", `Module ${this.moduleChoice.value} saved`, path);
        await this.readFolder();
    }

    private async unloadModule(): Promise<void> {
        const module = this.moduleChoice.value;
        if (!confirm(`Unload module ${module}? What is not saved is lost.`)) return;
        await this.model.connection.request("modules.unload", { task: this.taskChoice.value, module });
        notice("info", `Module ${module} unloaded`);
        await this.readModules();
    }

    private async saveProgram(): Promise<void> {
        const { path } = await this.model.connection.request<{ path: string }>("program.save", { task: this.taskChoice.value, folder: this.programFolder.value });
        notice("info", "Program saved", path);
        await this.readFolder();
    }

    private async backup(): Promise<void> {
        const { path } = await this.model.connection.request<{ path: string }>("backup.create", { name: this.backupName.value });
        notice("info", "Backup created", path);
        await this.readFolder();
    }

    private restart(mode: "warm" | "cold"): void {
        const text = mode === "cold" ? "Restart the controller and begin with the program as it was loaded?" : "Restart the controller?";
        if (confirm(text)) attempt(() => this.model.connection.request("restart", { mode }));
    }
}

function parentOf(folder: string): string {
    const parts = folder.replace(/\/$/, "").split("/");
    if (parts.length <= 1) return "";
    const above = parts.slice(0, -1).join("/");
    return above.endsWith(":") ? `${above}/` : above;
}

function sizeText(bytes: number): string {
    return bytes < 1024 ? `${bytes} B` : bytes < 1024 * 1024 ? `${(bytes / 1024).toFixed(1)} KiB` : `${(bytes / 1024 / 1024).toFixed(1)} MiB`;
}
