import type { Status } from "../api/connection";
import type { Model } from "../api/model";
import { button } from "../ui/controls";
import { h } from "../ui/dom";
import { icon, type IconName } from "../ui/icons";
import { attempt, noticeRegion } from "../ui/notices";
import { DataPanel } from "../panels/data_panel";
import { DialogLayer } from "../panels/dialogs";
import { DisplayPanel } from "../panels/display_panel";
import { EventsPanel } from "../panels/events_panel";
import { FilesPanel } from "../panels/files_panel";
import { JogPanel } from "../panels/jog_panel";
import { SignalsPanel } from "../panels/signals_panel";
import { ProgramPanel } from "../program/program_panel";
import { RecordingPanel } from "../recording/recording_panel";
import { ViewPanel } from "../view/view_panel";
import { Splitter } from "./splitter";
import { StatusBar } from "./status_bar";
import { TopBar } from "./top_bar";

export interface Panel {
    readonly element: HTMLElement;
    /** The panel has become visible or hidden. */
    shown?(visible: boolean): void;
}

interface Tab {
    name: string;
    label: string;
    icon: IconName;
    panel: Panel;
    button: HTMLButtonElement;
}

/** The frame of the page: top bar, 3D view, tabs with panels, status bar. */
export class Shell {
    private readonly tabs: Tab[] = [];
    private readonly tabList = h("div", { class: "tabs", attrs: { role: "tablist", "aria-label": "Panels", "aria-orientation": "vertical" } });
    private readonly panels = h("main", { class: "panels" });
    private readonly cover = h("div", { class: "cover", attrs: { role: "alert" } });
    private readonly topBar: TopBar;
    private readonly view: ViewPanel;
    private current = "";

    constructor(root: HTMLElement, private readonly model: Model) {
        this.topBar = new TopBar(model);
        const view = new ViewPanel(model);
        this.view = view;
        const program = new ProgramPanel(model);
        const show = (module: string, line: number, task: string): void => {
            this.select("program");
            program.show(task, module, line);
        };
        this.add("program", "Program", "program", program);
        this.add("events", "Events", "events", new EventsPanel(model));
        this.add("signals", "Signals", "signals", new SignalsPanel(model));
        this.add("data", "Data", "data", new DataPanel(model, show));
        this.add("display", "Display", "display", new DisplayPanel(model));
        this.add("jog", "Jog", "jog", new JogPanel(model));
        this.add("recording", "Recording", "recording", new RecordingPanel(model, view));
        this.add("files", "Files", "files", new FilesPanel(model));
        const work = h("div", { class: "work" }, view.element, new Splitter(() => view.resized()).element, this.panels);
        root.append(
            this.topBar.element,
            h("div", { class: "middle" }, this.tabList, work),
            new StatusBar(model, () => this.select("events")).element,
            new DialogLayer(model).element,
            noticeRegion(),
            this.cover,
        );
        this.tabList.addEventListener("keydown", (event) => this.moveFocus(event));
        this.select(location.hash.slice(1) || "program");
    }

    /** Of the 3D view: frame time in ms, frames, points of all paths. */
    get statistics(): ViewPanel["statistics"] {
        return this.view.statistics;
    }

    showProduct(product: string): void {
        this.topBar.showProduct(product);
    }

    showStatus(status: Status): void {
        const shown = this.cover.dataset.status;
        if (status === "connecting" && (shown === "closed" || shown === "restarting")) return; // the text stays
        this.cover.dataset.status = status;
        this.cover.hidden = status === "open";
        if (status === "login") this.askPassword();
        else if (status !== "open") this.showWaiting(status);
    }

    select(name: string): void {
        const tab = this.tabs.find((each) => each.name === name) ?? this.tabs[0];
        if (!tab || tab.name === this.current) return;
        for (const each of this.tabs) {
            const chosen = each === tab;
            each.button.setAttribute("aria-selected", String(chosen));
            each.button.tabIndex = chosen ? 0 : -1;
            each.panel.element.hidden = !chosen;
            if (!chosen && each.name === this.current) each.panel.shown?.(false);
        }
        this.current = tab.name;
        history.replaceState(null, "", `#${tab.name}`);
        tab.panel.shown?.(true);
    }

    private add(name: string, label: string, iconName: IconName, panel: Panel): void {
        const tab = h(
            "button",
            {
                class: "tab",
                attrs: { type: "button", role: "tab", id: `tab-${name}`, "aria-controls": `panel-${name}`, "aria-selected": "false" },
                on: { click: () => this.select(name) },
            },
            icon(iconName),
            h("span", { text: label }),
        );
        panel.element.id = `panel-${name}`;
        panel.element.setAttribute("role", "tabpanel");
        panel.element.setAttribute("aria-labelledby", `tab-${name}`);
        panel.element.hidden = true;
        this.tabs.push({ name, label, icon: iconName, panel, button: tab });
        this.tabList.append(tab);
        this.panels.append(panel.element);
    }

    private moveFocus(event: KeyboardEvent): void {
        const step = { ArrowDown: 1, ArrowRight: 1, ArrowUp: -1, ArrowLeft: -1 }[event.key];
        if (step === undefined) return;
        event.preventDefault();
        const at = this.tabs.findIndex((each) => each.name === this.current);
        const next = this.tabs[(at + step + this.tabs.length) % this.tabs.length];
        if (!next) return;
        this.select(next.name);
        next.button.focus();
    }

    private showWaiting(status: "connecting" | "closed" | "restarting"): void {
        const title = { connecting: "Connecting", closed: "Connection lost", restarting: "The controller restarts" }[status];
        const text = status === "connecting" ? "" : "The page connects again as soon as the controller answers.";
        this.cover.replaceChildren(h("div", { class: "cover-card" }, icon("wifi"), h("h2", { text: title }), h("p", { text })));
    }

    private askPassword(): void {
        const password = h("input", { class: "input", attrs: { type: "password", "aria-label": "Password", autocomplete: "current-password" } });
        const form = h(
            "form",
            { class: "cover-card" },
            icon("unlock"),
            h("h2", { text: "Password" }),
            h("p", { text: "This controller is reached over the network." }),
            password,
            button({ label: "Log on", class: "primary" }),
        );
        const submit = (event: Event): void => {
            event.preventDefault();
            attempt(() => this.model.connection.login(password.value));
        };
        form.addEventListener("submit", submit);
        form.querySelector("button")?.setAttribute("type", "submit");
        this.cover.replaceChildren(form);
        password.focus();
    }
}
