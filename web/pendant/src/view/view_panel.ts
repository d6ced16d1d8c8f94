import { Vector3 } from "three";
import type { Model } from "../api/model";
import type { Point, Pose, Unit } from "../api/protocol";
import { eulerAngles, metres } from "../math/pose";
import { onThemeChange } from "../shell/theme";
import { button, checkbox, select, setOptions } from "../ui/controls";
import { h, oncePerFrame, replaceChildren, setText } from "../ui/dom";
import { RobotView, type Layers } from "./robot_view";
import { Stage } from "./scene";

const plannedEvery = 400; // ms

/** The 3D view with its tools and the read-out of the chosen robot. */
export class ViewPanel {
    readonly element: HTMLElement;
    readonly robots: RobotView;
    private readonly canvas = h("canvas", { attrs: { tabindex: 0, role: "img", "aria-label": "3D view of the robots; arrow keys turn it, + and - zoom" } });
    private readonly stage: Stage;
    private readonly unitChoice = select("Robot", () => this.showReadout());
    private readonly readout = h("dl", { class: "readout" });
    private readonly label = h("div", { class: "view-banner", attrs: { hidden: true } });
    private readonly followButton: HTMLButtonElement;
    private readonly lastTcp = new Vector3();
    private following = false;
    private readonly refreshReadout = oncePerFrame(() => this.showReadout());

    constructor(private readonly model: Model) {
        this.stage = new Stage(this.canvas);
        this.robots = new RobotView(this.stage, model);
        this.followButton = button({ icon: "follow", label: "Follow the TCP", iconOnly: true, class: "tool", onClick: () => this.setFollowing(!this.following) });
        this.followButton.setAttribute("aria-pressed", "false");
        this.element = h(
            "section",
            { class: "view", attrs: { "aria-label": "3D view" } },
            this.canvas,
            h("div", { class: "view-head" }, this.unitChoice, this.readout),
            this.tools(),
            this.label,
        );
        this.listen();
        new ResizeObserver(() => this.resized()).observe(this.element);
        onThemeChange(() => {
            this.stage.setColours();
            this.robots.recolour();
        });
        setInterval(() => this.readPlanned(), plannedEvery);
    }

    /** Frame time in ms and number of frames, for measurements. */
    get statistics(): { frameTime: number; frames: number; points: number } {
        const points = this.robots.robots.reduce((sum, robot) => sum + robot.path.points, 0);
        return { frameTime: this.stage.frameTime, frames: this.stage.frames, points };
    }

    resized(): void {
        this.stage.resize();
    }

    /** A line over the picture, such as that a recording is shown; "" hides it. */
    showBanner(text: string): void {
        setText(this.label, text);
        this.label.hidden = text === "";
    }

    private tools(): HTMLElement {
        const looks: [string, Vector3][] = [
            ["Front", new Vector3(1, 0, 0.001)],
            ["Side", new Vector3(0, -1, 0.001)],
            ["Top", new Vector3(0.001, 0, 1)],
        ];
        const layers: [keyof Layers, string][] = [["past", "Past path"], ["planned", "Planned path"], ["frames", "Work object"], ["zones", "Zones"]];
        const menu = h(
            "div",
            { class: "popover", attrs: { hidden: true } },
            ...layers.map(([name, label]) =>
                checkbox(label, true, (on) => {
                    this.robots.layers[name] = on;
                    this.robots.applyLayers();
                }),
            ),
            h("div", { class: "popover-row" }, ...looks.map(([label, from]) => button({ label, class: "small", onClick: () => this.robots.frameAll(from) }))),
            button({ icon: "trash", label: "Clear the path", class: "small", onClick: () => this.robots.clearPaths() }),
        );
        const open = button({ icon: "layers", label: "Layers and views", iconOnly: true, class: "tool", onClick: () => toggle() });
        open.setAttribute("aria-expanded", "false");
        const toggle = (): void => {
            menu.hidden = !menu.hidden;
            open.setAttribute("aria-expanded", String(!menu.hidden));
        };
        menu.addEventListener("keydown", (event) => {
            if (event.key !== "Escape") return;
            toggle();
            open.focus();
        });
        return h(
            "div",
            { class: "view-tools", attrs: { role: "toolbar", "aria-label": "View" } },
            button({ icon: "home", label: "Show all", iconOnly: true, class: "tool", onClick: () => this.robots.frameAll() }),
            this.followButton,
            open,
            menu,
        );
    }

    private listen(): void {
        this.model.on("all", (state) => {
            setOptions(this.unitChoice, state.units.map(({ name, model }) => ({ value: name, label: `${name}  ${model}` })));
            this.unitChoice.hidden = state.units.length === 0;
            this.robots.build(state);
            this.resized();
        });
        this.model.on("motion", ({ units }) => {
            for (const unit of units) this.robots.move(unit);
            this.refreshReadout();
            if (this.following) this.follow();
        });
        this.model.on("frames", (unit) => {
            const index = this.model.state?.units.indexOf(unit) ?? -1;
            this.robots.setFrames(index, unit.tool, unit.workObject);
            this.showReadout();
        });
        this.model.on("zones", () => this.robots.showZones());
        this.canvas.addEventListener("keydown", (event) => this.key(event));
    }

    private setFollowing(on: boolean): void {
        this.following = on;
        this.followButton.setAttribute("aria-pressed", String(on));
        if (!on) return;
        const tcp = this.tcp();
        if (!tcp) return;
        this.lastTcp.copy(tcp);
        this.stage.lookAt(tcp, Math.max(0.6, (this.unit()?.reach ?? 600) * metres * 0.8));
    }

    private follow(): void {
        const tcp = this.tcp();
        if (!tcp) return;
        this.stage.shift(new Vector3().subVectors(tcp, this.lastTcp));
        this.lastTcp.copy(tcp);
        this.stage.controls.update();
    }

    private key(event: KeyboardEvent): void {
        const turn = 0.08;
        const turns: Record<string, [number, number]> = { ArrowLeft: [-turn, 0], ArrowRight: [turn, 0], ArrowUp: [0, turn], ArrowDown: [0, -turn] };
        const zooms: Record<string, number> = { "+": 0.9, "=": 0.9, "-": 1.1 };
        const by = turns[event.key];
        const zoom = zooms[event.key];
        if (!by && zoom === undefined) return;
        event.preventDefault();
        const arm = new Vector3().subVectors(this.stage.camera.position, this.stage.controls.target);
        if (zoom !== undefined) arm.multiplyScalar(zoom);
        if (by) {
            arm.applyAxisAngle(new Vector3(0, 0, 1), by[0]);
            arm.z += by[1] * arm.length();
        }
        this.stage.camera.position.addVectors(this.stage.controls.target, arm);
        this.stage.controls.update();
        this.stage.draw();
    }

    private index(): number {
        return Math.max(0, this.model.state?.units.findIndex(({ name }) => name === this.unitChoice.value) ?? 0);
    }

    private unit(): Unit | undefined {
        return this.model.state?.units[this.index()];
    }

    private tcp(): Vector3 | null {
        const pose = this.model.positions[this.index()]?.[3];
        return pose ? new Vector3((pose[0] ?? 0) * metres, (pose[1] ?? 0) * metres, (pose[2] ?? 0) * metres) : null;
    }

    private showReadout(): void {
        const unit = this.unit();
        const motion = this.model.positions[this.index()];
        this.readout.hidden = !unit || !motion;
        if (!unit || !motion) return;
        const tcp: Pose = motion[3];
        const angles = eulerAngles(tcp);
        const numbers = (values: number[], digits: number): string[] => values.map((value) => value.toFixed(digits).replace(/^-(0\.?0*)$/, "$1"));
        const rows: [string, string[]][] = [
            ["mm", numbers(tcp.slice(0, 3), 1)],
            ["deg", numbers(angles, 1)],
            ["axes", numbers(motion[1], 1)],
            ["tool", [unit.tool.name, unit.workObject.name]],
        ];
        const known = [...this.readout.querySelectorAll("dd span")];
        const texts = rows.flatMap(([, values]) => values);
        if (known.length === texts.length) {
            texts.forEach((text, at) => setText(known[at] as Element, text));
            return;
        }
        const entries = rows.flatMap(([name, values]) => [h("dt", { text: name }), h("dd", {}, ...values.map((text) => h("span", { text })))]);
        replaceChildren(this.readout, ...entries);
    }

    private readPlanned(): void {
        const { state } = this.model;
        if (!state || document.hidden || !this.robots.layers.planned) return;
        state.units.forEach((unit, index) => {
            if (!state.panel.running && index > 0) return;
            this.model.connection
                .request<{ points: Point[] }>("path.planned", { unit: unit.name, count: 200 })
                .then(({ points }) => this.robots.setPlanned(index, points))
                .catch(() => {}); // the next one may succeed
        });
    }
}
