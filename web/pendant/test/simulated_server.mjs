// A stand-in for `rapidc serve`, to develop and test the page: serves a folder and answers docs/pendant.md with a small cell
// that moves. Never shipped. node test/simulated_server.mjs FOLDER PORT

import { readFileSync } from "node:fs";
import { createServer } from "node:http";
import { extname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";
import { accept } from "./websocket.mjs";
import * as cell from "./cell.mjs";
import { flangeOf, tcpOf } from "./kinematics.mjs";

const types = { ".html": "text/html", ".js": "text/javascript", ".css": "text/css", ".svg": "image/svg+xml", ".txt": "text/plain" };
export const policy = "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data:; connect-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

class Refusal extends Error {
    constructor(code, message, remedy) {
        super(message);
        this.code = code;
        this.remedy = remedy;
    }
}

/** What one page sees; `emit(event, data)` sends to all of them. */
class Cell {
    constructor() {
        this.panel = { motors: "on", mode: "auto", speed: 100, cycle: "forever", running: true, emergencyStop: false };
        this.t = 0;
        this.line = 20;
        this.joints = cell.units.map(() => [0, 10, 10, 0, 60, 0]);
        this.jogging = null;
        this.texts = structuredClone(cell.modules);
        this.signals = structuredClone(cell.signals);
        this.data = structuredClone(cell.data);
        this.events = structuredClone(cell.events);
        this.breakpoints = [{ task: "T_ROB1", module: "MainModule", line: 14, verified: true }];
        this.display = ["Cell ready, waiting for start", "Start", "Part 1 placed", "Part 2 placed", "Part 3 placed"];
        this.dialogs = [];
        this.changes = 3;
        this.requests = [];
        this.emit = () => {};
    }

    task(name) {
        const place = (line) => ({ module: "MainModule", routine: "pickPart", line, column: 7, endLine: line, endColumn: 40, level: "Normal" });
        const first = name === "T_ROB1";
        return { name, type: "normal", active: true, state: this.panel.running ? "running" : "stopped", unit: first ? "ROB_1" : "ROB_2", changes: this.changes, pointer: first ? place(this.line) : null, motion: first ? place(Math.max(26, this.line - 1)) : null, error: "" };
    }

    state() {
        return {
            panel: this.panel, tasks: ["T_ROB1", "T_ROB2"].map((name) => this.task(name)), units: cell.units, zones: cell.zones, dialogs: this.dialogs, display: { lines: [...this.display] },
            breakpoints: this.breakpoints, robotWare: "7.8.0", name: "pick_and_place", time: { t: this.t, pace: 100, running: true },
        };
    }

    motion(index, speed) {
        const unit = cell.units[index];
        return [index, this.joints[index], [], tcpOf(unit, this.joints[index]), flangeOf(unit, this.joints[index]), speed, 1];
    }

    /** Moves on by `dt` seconds: a curve that never closes, so that the path grows. */
    step(dt) {
        this.t += dt;
        const { t } = this;
        if (this.jogging) this.joints[0] = this.joints[0].map((joint, index) => joint + (this.jogging[index] ?? 0) * 30 * dt);
        else if (this.panel.running) {
            this.joints[0] = [40 * Math.sin(0.53 * t), 20 + 18 * Math.sin(0.91 * t), 12 * Math.cos(0.67 * t), 8 * Math.sin(1.1 * t), 48 + 12 * Math.sin(0.77 * t), 30 * Math.sin(0.41 * t)];
            this.joints[1] = [30 * Math.cos(0.47 * t), 15 + 12 * Math.cos(0.83 * t), 10 * Math.sin(0.61 * t), 0, 55, 20 * Math.cos(0.5 * t)];
        } else return;
        const units = this.panel.running ? [0, 1] : [0];
        this.emit("motion", { t, units: units.map((index) => this.motion(index, 280 + 240 * Math.sin(t * 1.3))) });
    }

    setSignal(name, value) {
        const signal = this.signals.find((each) => each.name === name);
        if (!signal) throw new Refusal("not_found", `There is no signal ${name}`);
        signal.value = value;
        this.emit("signal", [[name, value, signal.simulated ? 1 : 0]]);
    }

    changed() {
        this.emit("panel", this.panel);
        for (const name of ["T_ROB1", "T_ROB2"]) this.emit("task", this.task(name));
    }

    log(code, type, title) {
        const number = this.events.length + 1;
        const event = { number, code, type, time: "2026-11-25 T 14:05:00", task: "T_ROB1", title };
        this.events.push(event);
        this.emit("event", event);
    }
}

/** method -> answer */
const methods = {
    hello: () => ({ version: 1, product: "rapidc 0.1.0", robotWare: "7.8.0", loginNeeded: false }),
    state: (c) => c.state(),
    "units.positions": (c) => ({ units: cell.units.map((unit, index) => ({ unit: unit.name, joints: c.joints[index], external: [], world: tcpOf(unit, c.joints[index]), tcp: [], base: [], flange: flangeOf(unit, c.joints[index]), config: [0, 0, 0, 0] })) }),
    "units.frames": () => ({ tools: [{ name: "tVacuum", pose: cell.units[0].tool.pose, mass: 1, task: "T_ROB1", module: "MainModule" }], workObjects: [{ name: "wTray", pose: cell.units[0].workObject.pose, task: "T_ROB1", module: "CellData" }] }),
    "path.planned": (c, { unit }) => {
        if (unit !== "ROB_1" || !c.panel.running) return { points: [], moves: [] };
        const at = tcpOf(cell.units[0], c.joints[0]);
        return { points: Array.from({ length: 60 }, (_, i) => [at[0] + i * 1.5, at[1] + Math.sin(i / 12) * 60, at[2] - i * 1.2]), moves: [] };
    },
    "panel.motors": (c, { on }) => {
        if (c.panel.emergencyStop) throw new Refusal("refused", "The emergency stop is pressed", "Release it first");
        c.panel.motors = on ? "on" : "off";
        if (!on) c.panel.running = false;
        c.log(on ? 10011 : 10010, "state", on ? "Motors ON state" : "Motors OFF state");
        c.changed();
    },
    "panel.mode": (c, { mode }) => { Object.assign(c.panel, { mode, motors: "off", running: false }); c.changed(); },
    "panel.speed": (c, { percent }) => { c.panel.speed = percent; c.changed(); },
    "panel.cycle": (c, { cycle }) => { c.panel.cycle = cycle; c.changed(); },
    "panel.emergencyStop": (c, { pressed }) => {
        Object.assign(c.panel, { emergencyStop: pressed, running: false, motors: pressed ? "emergencyStop" : "emergencyStopReset" });
        c.log(pressed ? 10013 : 10014, pressed ? "error" : "state", pressed ? "Emergency stop state" : "Emergency stop released");
        c.changed();
    },
    "run.start": (c, { mode }) => {
        if (c.panel.motors !== "on") throw new Refusal("refused", "The motors are off", "Switch the motors on first");
        if (mode && mode !== "continue") c.line = Math.min(31, c.line + 1);
        else c.panel.running = true;
        c.changed();
    },
    "run.stop": (c) => { c.panel.running = false; c.changed(); },
    "run.pointerToMain": (c) => { c.line = 9; c.changed(); },
    "run.pointerToLine": (c, { line }) => { c.line = line; c.changed(); },
    "breakpoints.set": (c, { task, module, line }) => {
        const made = { task, module, line, verified: true };
        c.breakpoints.push(made);
        c.emit("breakpoints", { breakpoints: c.breakpoints });
        return made;
    },
    "breakpoints.clear": (c, { line }) => { c.breakpoints = c.breakpoints.filter((each) => each.line !== line); c.emit("breakpoints", { breakpoints: c.breakpoints }); },
    "modules.list": (c, { task }) => ({ modules: task === "T_ROB1" ? Object.keys(c.texts).map((name) => ({ name, kind: name === "CellData" ? "system" : "program", lines: c.texts[name].split("\n").length, readOnly: name === "CellData", path: "" })) : [] }),
    "modules.text": (c, { module }) => ({ text: c.texts[module], changes: c.changes }),
    "modules.setText": (c, { module, text }) => {
        if (!text.includes("ENDMODULE")) throw new Refusal("bad_request", "MainModule:5:1: error: expected 'ENDMODULE' before the end of the file\nMainModule:3:4: error: unknown name 'x'");
        c.texts[module] = text;
        c.changes += 1;
        c.changed();
        return { changes: c.changes };
    },
    "modules.routines": (c, { module }) => ({ routines: [...c.texts[module].split("\n").entries()].filter(([, text]) => /^\s*PROC/.test(text)).map(([at, text]) => ({ module, name: /PROC (\w+)/.exec(text)[1], kind: "proc", line: at + 1, parameters: 0 })) }),
    "signals.subscribe": (c) => ({ signals: c.signals }),
    "signals.set": (c, { name, value }) => c.setSignal(name, value),
    "signals.simulate": (c, { name, on }) => { const signal = c.signals.find((each) => each.name === name); signal.simulated = on; c.setSignal(name, signal.value); },
    "data.list": (c, { filter = "", type }) => { const found = c.data.map(({ item }) => item).filter((item) => item.name.toLowerCase().includes(filter.toLowerCase()) && (!type || item.type === type)); return { data: found, total: found.length }; },
    "data.watch": (c, { paths }) => ({ values: paths.map((path) => ({ path, value: c.data.find(({ item }) => item.path === path).value })) }),
    "data.write": (c, { path, value }) => {
        const found = c.data.find(({ item }) => item.path === path);
        if (found.item.type === "num" && !Number.isFinite(Number(value))) throw new Refusal("bad_request", `'${value}' is not a num`);
        found.value = value;
        c.emit("data", [[path, value]]);
        return { value };
    },
    "data.stack": () => ({ frames: [{ module: "MainModule", routine: "pickPart", line: 27 }, { module: "MainModule", routine: "main", line: 11 }], data: [{ name: "tries", type: "num", value: "2" }] }),
    "dialogs.answer": (c, { id }) => { c.dialogs = c.dialogs.filter((each) => each.id !== id); c.emit("dialog", { closed: id }); },
    "events.list": (c) => ({ events: [...c.events].reverse(), more: false }),
    "events.details": (c, { number }) => ({ ...c.events.find((each) => each.number === number), description: "Position for ROB_1 joint rob1_5 is out of working range.", consequences: "The program is stopped.", causes: "The joint has been moved too close to its limit.", actions: "1. Check the position in the program.\n2. Jog the joint back into its range.", arguments: ["ROB_1", "rob1_5"] }),
    "events.clear": (c) => { c.events = []; },
    "jog.start": (c, { values }) => {
        if (c.panel.mode === "auto") throw new Refusal("refused", "Jogging needs the manual mode");
        c.jogging = values;
        clearTimeout(c.guard);
        c.guard = setTimeout(() => { c.jogging = null; }, 300);
    },
    "jog.stop": (c) => { c.jogging = null; },
    "jog.tool": () => ({}),
    "teach.read": () => ({ value: "[[374.2,-181,240.5],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]]" }),
    "teach.modify": () => ({ name: "pPick", value: "[[374.2,-181,240.5],[0,0,1,0]]", inText: false }),
    "files.list": (c, { folder }) => ({ entries: folder === "" ? [{ name: "HOME:", folder: true, size: 0, modified: "" }, { name: "BACKUP:", folder: true, size: 0, modified: "" }] : [{ name: "recipes", folder: true, size: 0, modified: "2026-11-24 09:12" }, { name: "CellData.sysx", folder: false, size: 1840, modified: "2026-11-25 13:40" }, { name: "MainModule.modx", folder: false, size: 4211, modified: "2026-11-25 14:01" }, { name: "weights.csv", folder: false, size: 96110, modified: "2026-11-25 13:59" }] }),
    "modules.save": (c, { module }) => ({ path: `HOME:/${module}.mod` }),
    "modules.load": () => ({}),
    "modules.unload": () => ({}),
    "program.save": (c, { folder }) => ({ path: `${folder}/part.pgf` }),
    "backup.create": (c, { name }) => ({ path: `BACKUP:/${name}` }),
    restart: () => ({}),
};

/** Starts it; the result has `port`, `cell` and `close()`. `tick`: ms between motions, 0: none. */
export function start(folder, port = 0, tick = 16) {
    const model = new Cell();
    const pages = new Set();
    model.emit = (event, data) => { for (const send of pages) send(JSON.stringify({ event, data })); };
    const server = createServer((request, response) => {
        const path = new URL(request.url, "http://x").pathname;
        const name = path === "/" ? "/index.html" : path;
        try {
            const bytes = readFileSync(join(folder, name.replace(/\.\./g, "")));
            response.writeHead(200, { "Content-Type": types[extname(name)] ?? "application/octet-stream", "Content-Security-Policy": policy });
            response.end(bytes);
        } catch {
            response.writeHead(404).end();
        }
    });
    const sockets = new Set();
    server.on("upgrade", (request, socket) => {
        sockets.add(socket);
        let send;
        send = accept(request, socket, (text) => answer(model, JSON.parse(text), send, pages), () => pages.delete(send));
    });
    const timer = tick > 0 ? setInterval(() => model.step(tick / 1000), tick) : null;
    return new Promise((done) => {
        server.listen(port, "127.0.0.1", () => done({
            port: server.address().port,
            cell: model,
            drop: () => { for (const socket of sockets) socket.destroy(); },
            close: () => { clearInterval(timer); server.closeAllConnections(); server.close(); },
        }));
    });
}

function answer(model, { id, method, params = {} }, send, pages) {
    model.requests.push({ method, params });
    try {
        if (!methods[method]) throw new Refusal("unknown_method", `There is no method ${method}`);
        const result = methods[method](model, params) ?? {};
        send(JSON.stringify({ id, result }));
        if (method === "hello") pages.add(send);
    } catch (error) {
        send(JSON.stringify({ id, error: { code: error.code ?? "failed", message: error.message, remedy: error.remedy } }));
    }
}

if (process.argv[1] && resolve(process.argv[1]) === fileURLToPath(import.meta.url)) {
    const { port } = await start(resolve(process.argv[2] ?? "dist"), Number(process.argv[3] ?? 0));
    console.log(`http://127.0.0.1:${port}`);
}
