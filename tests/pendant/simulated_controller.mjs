// A controller that speaks docs/pendant.md, for tests of the page. It keeps what it is ordered and lets tests look at it.

import { dialogs, mainModule, makeData, makeEvents, makeSignals, systemModule, zones } from "./simulated_data.mjs";
import { flangeOf, jointsAt, tcpOf, unitOf } from "./robots.mjs";

const samplePeriod = 1000 / 60; // ms
const place = (routine, line) => ({ module: "PickAndPlace", routine, line, column: 9, endLine: line, endColumn: 60, level: "Normal" });
const rounded = (values) => values.map((value) => Math.round(value * 1e4) / 1e4);

class Refused extends Error {
    constructor(code, message, remedy) {
        super(message);
        this.code = code;
        this.remedy = remedy;
    }
}

export class SimulatedController {
    constructor() {
        this.calls = []; // [method, params] in order
        this.sockets = new Set();
        this.reset();
        this.timer = setInterval(() => this.tick(), samplePeriod);
    }

    reset() {
        this.calls.length = 0;
        this.t = 12.5;
        this.phase = 0; // s of movement
        this.panel = { motors: "on", mode: "auto", speed: 100, cycle: "forever", running: true, emergencyStop: false };
        this.units = [unitOf("ROB_1", "T_ROB1", [0, 0, 0, 1, 0, 0, 0]), unitOf("ROB_2", "T_ROB2", [0, -900, 0, 1, 0, 0, 0])];
        this.tasks = ["T_ROB1", "T_ROB2", "T_WATCH"].map((name, i) => ({
            name, type: i < 2 ? "normal" : "static", active: true, state: "running", unit: i < 2 ? `ROB_${i + 1}` : "", changes: 1,
            pointer: i < 2 ? place("Pick", 26) : null, motion: i < 2 ? place("Pick", 25) : null, error: "",
        }));
        this.texts = { PickAndPlace: mainModule, Cell: systemModule };
        this.signals = makeSignals();
        this.data = makeData();
        this.events = makeEvents();
        this.dialogs = [];
        this.lines = ["rapidc controller ready", "Parts: 11", "Parts: 12"];
        this.breakpoints = [{ task: "T_ROB1", module: "PickAndPlace", line: 15, verified: true }];
    }

    end() {
        clearInterval(this.timer);
    }

    /** Takes over the page's WebSocket (playwright's page.routeWebSocket). */
    connect(socket) {
        this.sockets.add(socket);
        socket.onClose(() => this.sockets.delete(socket));
        socket.onMessage((message) => socket.send(JSON.stringify(this.answer(JSON.parse(String(message))))));
    }

    send(event, data) {
        const text = JSON.stringify({ event, data });
        for (const socket of this.sockets) socket.send(text);
    }

    calledWith(method) {
        return this.calls.filter(([name]) => name === method).map(([, params]) => params);
    }

    answer({ id, method, params = {} }) {
        this.calls.push([method, params]);
        try {
            const handler = methods[method];
            if (!handler) throw new Refused("unknown_method", `There is no method '${method}'`);
            return { id, result: handler(this, params) ?? {} };
        } catch (error) {
            if (!(error instanceof Refused)) throw error;
            return { id, error: { code: error.code, message: error.message, ...(error.remedy ? { remedy: error.remedy } : {}) } };
        }
    }

    // ---- Movement
    tick() {
        if (this.panel.running) this.advance(samplePeriod / 1000);
    }

    advance(seconds) {
        this.t += seconds;
        this.phase += (seconds * this.panel.speed) / 100;
        this.send("motion", this.motion(1));
    }

    motion(moving) {
        const units = this.units.map((unit, i) => {
            const joints = jointsAt(this.phase, i * 1.3);
            const before = tcpOf(unit, jointsAt(this.phase - 0.01, i * 1.3));
            const tcp = tcpOf(unit, joints);
            const speed = Math.hypot(...[0, 1, 2].map((k) => tcp[k] - before[k])) / 0.01;
            return [i, rounded(joints), [], rounded(tcp), rounded(flangeOf(unit, joints)), moving ? rounded([speed])[0] : 0, moving];
        });
        return { t: this.t, units };
    }

    /** Many positions at once: what a page has after minutes of movement. */
    flood(count, period = 0.05) {
        for (let i = 0; i < count; ++i) this.advance(period);
    }

    setPanel(changes) {
        Object.assign(this.panel, changes);
        this.send("panel", this.panel);
    }

    setRunning(running) {
        this.setPanel({ running });
        for (const task of this.tasks.filter(({ type }) => type === "normal")) {
            task.state = running ? "running" : "stopped";
            this.send("task", task);
        }
        if (!running) this.send("motion", this.motion(0));
    }

    step(by) {
        const [task] = this.tasks;
        task.pointer = place("Pick", Math.min(30, Math.max(24, task.pointer.line + by)));
        this.send("pointers", { task: task.name, pointer: task.pointer, motion: task.motion });
    }

    openDialog(kind) {
        const dialog = structuredClone(dialogs[kind]);
        this.dialogs.push(dialog);
        this.send("dialog", { opened: dialog });
        return dialog.id;
    }

    find(list, name) {
        const found = list.find((each) => each.name.toLowerCase() === String(name).toLowerCase());
        if (!found) throw new Refused("not_found", `There is no '${name}'`);
        return found;
    }

    values(paths) {
        return paths.map((path) => {
            const item = this.data.find((each) => each.path === path);
            return item ? { path, value: item.value, type: item.type, dims: item.dims } : { path, error: "There is no such data" };
        });
    }
}

function needStopped(controller) {
    if (controller.panel.running) throw new Refused("refused", "The program is executing", "Stop the program first");
}

function start(controller, mode = "continue") {
    if (controller.panel.motors !== "on") throw new Refused("refused", "The motors are off", "Switch them on first");
    needStopped(controller);
    if (mode === "continue") controller.setRunning(true);
    else controller.step(mode === "stepBack" ? -1 : 1);
}

function jog(controller, { unit }) {
    const { panel } = controller;
    if (panel.mode === "auto") throw new Refused("refused", "The mode is automatic", "Choose manual mode");
    if (panel.motors !== "on") throw new Refused("refused", "The motors are off", "Switch them on first");
    needStopped(controller);
    controller.phase += 0.004;
    controller.send("motion", controller.motion(1));
    controller.send("jog", { unit, moving: true, limit: "" });
}

const paged = (list, { start: from = 0, count = 500 }) => list.slice(from, from + count);
const contains = (text, part = "") => text.toLowerCase().includes(part.toLowerCase());

const methods = {
    hello: () => ({ version: 1, product: "rapidc 0.1.0", robotWare: "7.8.0", loginNeeded: false }),
    state: (c) => ({
        panel: c.panel, tasks: c.tasks, units: c.units, zones, dialogs: c.dialogs, display: { lines: c.lines }, breakpoints: c.breakpoints,
        robotWare: "7.8.0", name: "Simulated cell", time: { t: c.t, pace: 100, running: true },
    }),
    "units.positions": (c) => ({
        units: c.motion(0).units.map(([i, joints, external, world, flange]) => ({
            unit: c.units[i].name, joints, external, tcp: world, base: world, world, flange, config: [0, 0, 0, 0],
        })),
    }),
    "units.frames": (c, { unit }) => ({
        tools: [{ ...c.find(c.units, unit).tool, mass: 1, task: "T_ROB1", module: "PickAndPlace" }],
        workObjects: [{ ...c.find(c.units, unit).workObject, task: "T_ROB1", module: "PickAndPlace" }],
    }),
    "zones.list": () => ({ zones }),
    "path.planned": (c, { unit }) => {
        const index = c.units.indexOf(c.find(c.units, unit));
        const points = Array.from({ length: 60 }, (_, i) => rounded(tcpOf(c.units[index], jointsAt(c.phase + i * 0.03, index * 1.3)).slice(0, 3)));
        return { points, moves: [] };
    },
    "panel.motors": (c, { on }) => {
        if (on && c.panel.emergencyStop) throw new Refused("refused", "The emergency stop is pressed", "Release it first");
        if (!on && c.panel.running) c.setRunning(false);
        c.setPanel({ motors: on ? "on" : "off" });
    },
    "panel.mode": (c, { mode }) => (c.setRunning(false), c.setPanel({ mode, motors: "off" })),
    "panel.speed": (c, { percent }) => c.setPanel({ speed: percent }),
    "panel.cycle": (c, { cycle }) => c.setPanel({ cycle }),
    "panel.emergencyStop": (c, { pressed }) => {
        if (pressed) c.setRunning(false);
        c.setPanel({ emergencyStop: pressed, motors: pressed ? "emergencyStop" : "emergencyStopReset" });
    },
    "run.start": (c, { mode }) => start(c, mode),
    "run.stop": (c) => c.setRunning(false),
    "run.pointerToMain": (c) => needStopped(c),
    "run.pointerToRoutine": (c) => needStopped(c),
    "run.pointerToLine": (c) => needStopped(c),
    "run.activate": (c, { task, active }) => (Object.assign(c.find(c.tasks, task), { active }), c.send("task", c.find(c.tasks, task))),
    "breakpoints.list": (c) => ({ breakpoints: c.breakpoints }),
    "breakpoints.set": (c, { task, module, line }) => {
        const breakpoint = { task, module, line, verified: true };
        c.breakpoints.push(breakpoint);
        c.send("breakpoints", { breakpoints: c.breakpoints });
        return breakpoint;
    },
    "breakpoints.clear": (c, { line }) => {
        c.breakpoints = line === undefined ? [] : c.breakpoints.filter((each) => each.line !== line);
        c.send("breakpoints", { breakpoints: c.breakpoints });
    },
    "time.set": () => ({}),
    restart: () => ({}),
    "modules.list": (c) => ({
        modules: Object.entries(c.texts).map(([name, text]) => ({
            name, kind: name === "Cell" ? "system" : "program", lines: text.split("\n").length - 1, readOnly: false, path: `HOME:/${name}.modx`,
        })),
    }),
    "modules.text": (c, { module }) => {
        if (!(module in c.texts)) throw new Refused("not_found", `There is no module '${module}'`);
        return { text: c.texts[module], changes: c.tasks[0].changes };
    },
    "modules.setText": (c, { module, text }) => {
        needStopped(c);
        if (text.includes("MISTAKE")) throw new Refused("bad_request", "line 3: unknown name 'MISTAKE'");
        c.texts[module] = text;
        return { changes: ++c.tasks[0].changes };
    },
    "modules.load": needStopped,
    "modules.unload": needStopped,
    "modules.save": (c, { module, path }) => ({ path: path ?? `HOME:/${module}.modx` }),
    "modules.routines": () => ({
        routines: [["main", 11], ["Pick", 22], ["Place", 30]].map(([name, line]) => ({ module: "PickAndPlace", name, kind: "proc", line, parameters: 0 })),
    }),
    "program.save": (c, { folder }) => ({ path: `${folder}/program.pgf` }),
    "program.load": needStopped,
    "files.list": (c, { folder }) => ({
        entries: folder === ""
            ? ["HOME", "BACKUP", "TEMP", "RAMDISK"].map((name) => ({ name, folder: true, size: 0, modified: "" }))
            : [
                { name: "programs", folder: true, size: 0, modified: "2026-11-25T14:00:00Z" },
                { name: "PickAndPlace.modx", folder: false, size: 2140, modified: "2026-11-25T14:03:59Z" },
                { name: "cell.pgf", folder: false, size: 212, modified: "2026-11-20T08:00:00Z" },
            ],
    }),
    "backup.create": (c, { name }) => ({ path: `BACKUP:/${name}` }),
    "signals.list": (c, params) => {
        const found = c.signals.filter(({ name, type }) => contains(name, params.filter) && (!params.type || params.type === type));
        return { signals: paged(found, params), total: found.length };
    },
    "signals.set": (c, { name, value }) => {
        const signal = c.find(c.signals, name);
        signal.value = value;
        c.send("signal", [[signal.name, value, signal.simulated ? 1 : 0]]);
    },
    "signals.simulate": (c, { name, on }) => {
        const signal = c.find(c.signals, name);
        signal.simulated = on;
        c.send("signal", [[signal.name, signal.value, on ? 1 : 0]]);
    },
    "signals.subscribe": (c, { names, all }) => ({ signals: all ? c.signals : c.signals.filter(({ name }) => names.includes(name)) }),
    "data.list": (c, params) => {
        const found = c.data.filter(({ name, type }) => contains(name, params.filter) && (!params.type || params.type === type));
        return { data: paged(found, params).map(({ value, ...item }) => item), total: found.length };
    },
    "data.read": (c, { paths }) => ({ values: c.values(paths) }),
    "data.watch": (c, { paths }) => ({ values: c.values(paths) }),
    "data.write": (c, { path, value }) => {
        const item = c.data.find((each) => each.path === path);
        if (item.type === "num" && Number.isNaN(Number(value))) throw new Refused("bad_request", `'${value}' is not a num`);
        item.value = value;
        c.send("data", [[path, value]]);
        return { value };
    },
    "data.stack": () => ({ frames: [{ module: "PickAndPlace", routine: "Pick", line: 26 }], data: [{ name: "nTry", type: "num", value: "2" }] }),
    "dialogs.list": (c) => ({ dialogs: c.dialogs }),
    "dialogs.answer": (c, { id }) => {
        c.dialogs = c.dialogs.filter((each) => each.id !== id);
        c.send("dialog", { closed: id });
    },
    "display.read": (c) => ({ lines: c.lines }),
    "events.list": (c, { before = Infinity, count = 50 }) => {
        const older = c.events.filter(({ number }) => number < before);
        return { events: older.slice(0, count), more: older.length > count };
    },
    "events.details": (c, { number }) => ({
        ...c.events.find((event) => event.number === number), arguments: ["T_ROB1"],
        description: "The task T_ROB1 has stopped in line 12.", consequences: "The program does not run.",
        causes: "A divisor was 0.", actions: "Check the divisor before the division.",
    }),
    "events.clear": (c) => void (c.events = []),
    "jog.start": jog,
    "jog.stop": (c, { unit = "ROB_1" }) => c.send("jog", { unit, moving: false, limit: "" }),
    "jog.tool": (c, { unit }) => ({ tool: c.find(c.units, unit).tool, workObject: c.find(c.units, unit).workObject }),
    "teach.modify": () => ({ inText: false }),
    "teach.read": () => ({ value: "[[0,40,20],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]]" }),
};
