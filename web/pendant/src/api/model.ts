import type { Connection } from "./connection";
import type { Dialog, LogEvent, Motion, Notifications, Signal, State, Task, Unit, UnitPosition, Zone } from "./protocol";

/** What changed in the model. "all": everything is new. */
interface Changes {
    all: State;
    panel: State["panel"];
    task: Task;
    pointers: Task;
    motion: Motion;
    event: LogEvent;
    display: string[];
    dialogs: Dialog[];
    /** all signals, after "all" */
    signals: Signal[];
    signal: Notifications["signal"];
    data: Notifications["data"];
    frames: Unit;
    breakpoints: State["breakpoints"];
    zones: Zone[];
    jog: Notifications["jog"];
    time: State["time"];
}

const displayLines = 500;

/** The controller as the page knows it. Panels read `state` and listen to what they show. */
export class Model {
    state: State | null = null;
    /** the last motion of each unit, by its index */
    readonly positions: Motion["units"] = [];
    lastTime = 0;
    private readonly listeners = new Map<string, Set<(data: never) => void>>();

    constructor(readonly connection: Connection) {
        this.follow();
    }

    on<K extends keyof Changes>(name: K, listener: (data: Changes[K]) => void): void {
        const known = this.listeners.get(name) ?? new Set();
        known.add(listener as (data: never) => void);
        this.listeners.set(name, known);
    }

    /** Reads everything anew. */
    async load(): Promise<void> {
        const state = await this.connection.request<State>("state");
        this.state = state;
        this.positions.length = 0;
        this.lastTime = state.time.t;
        this.emit("all", state);
        const { units } = await this.connection.request<{ units: UnitPosition[] }>("units.positions");
        const moved: Motion["units"] = [];
        for (const position of units) {
            const index = state.units.findIndex((unit) => unit.name === position.unit);
            if (index >= 0 && !this.positions[index]) moved.push([index, position.joints, position.external, position.world, position.flange, 0, 0]);
        }
        this.takeMotion({ t: Math.max(state.time.t, this.lastTime), units: moved });
        const { signals } = await this.connection.request<{ signals: Signal[] }>("signals.subscribe", { all: true });
        this.emit("signals", signals);
    }

    task(name: string): Task | undefined {
        return this.state?.tasks.find((task) => task.name === name);
    }

    private emit<K extends keyof Changes>(name: K, data: Changes[K]): void {
        for (const listener of this.listeners.get(name) ?? []) listener(data as never);
    }

    private takeMotion(motion: Motion): void {
        for (const unit of motion.units) this.positions[unit[0]] = unit;
        this.lastTime = motion.t;
        this.emit("motion", motion);
    }

    private follow(): void {
        const { connection } = this;
        connection.on("generation", () => void this.load().catch(() => {})); // a close in between starts again anyway
        connection.on("motion", (motion) => this.state && this.takeMotion(motion));
        connection.on("event", (event) => this.emit("event", event));
        connection.on("signal", (changes) => this.emit("signal", changes));
        connection.on("data", (changes) => this.emit("data", changes));
        connection.on("jog", (jog) => this.emit("jog", jog));
        this.followState();
        this.followTasks();
    }

    private followState(): void {
        const { connection } = this;
        const update = <K extends "panel" | "time" | "zones" | "breakpoints">(name: K, value: State[K]): void => {
            if (!this.state) return;
            this.state[name] = value;
            this.emit(name, value as never);
        };
        connection.on("panel", (panel) => update("panel", panel));
        connection.on("time", (time) => update("time", time));
        connection.on("zones", ({ zones }) => update("zones", zones));
        connection.on("breakpoints", ({ breakpoints }) => update("breakpoints", breakpoints));
        connection.on("display", ({ line, clear }) => {
            if (!this.state) return;
            const { lines } = this.state.display;
            if (clear) lines.length = 0;
            if (line !== undefined) lines.push(line);
            if (lines.length > displayLines) lines.splice(0, lines.length - displayLines);
            this.emit("display", lines);
        });
        connection.on("dialog", ({ opened, closed }) => {
            if (!this.state) return;
            this.state.dialogs = this.state.dialogs.filter(({ id }) => id !== closed && id !== opened?.id);
            if (opened) this.state.dialogs.push(opened);
            this.emit("dialogs", this.state.dialogs);
        });
    }

    private followTasks(): void {
        const { connection } = this;
        connection.on("task", (task) => {
            const tasks = this.state?.tasks;
            const at = tasks?.findIndex(({ name }) => name === task.name) ?? -1;
            if (!tasks || at < 0) return;
            tasks[at] = task;
            this.emit("task", task);
        });
        connection.on("pointers", ({ task: name, pointer, motion }) => {
            const task = this.task(name);
            if (!task) return;
            task.pointer = pointer;
            task.motion = motion;
            this.emit("pointers", task);
        });
        connection.on("frames", ({ unit: name, tool, workObject }) => {
            const unit = this.state?.units.find((each) => each.name === name);
            if (!unit) return;
            unit.tool = tool;
            unit.workObject = workObject;
            this.emit("frames", unit);
        });
    }
}
