import type { Model } from "../api/model";
import type { Motion, Pose, UnitMotion } from "../api/protocol";

/** A file may lack poses: they are empty then. */
export interface UnitSample {
    joints: number[];
    tcp: Pose;
    flange: Pose;
    speed: number;
}

export interface Sample {
    t: number;
    /** by the index of the unit; those that were at rest share the object of the sample before; none where a robot has no line in a file */
    units: UnitSample[];
}

export interface SignalChange {
    t: number;
    value: number;
}

/** What happened between two starts from main, or what a file holds. */
export interface Run {
    number: number;
    name: string;
    samples: Sample[];
    signals: Map<string, SignalChange[]>;
}

const samplesKept = 120_000; // half an hour and more at 60 a second
const signalChangesKept = 20_000;
const runsKept = 20;

/** Keeps motion and signals of the last runs in the memory of the page. */
export class Recorder {
    readonly runs: Run[] = [];
    recording = true;
    onRuns: () => void = () => {};
    onSample: () => void = () => {};
    private count = 0;
    private changes = 0;
    private wasRunning = false;
    private readonly lastValues = new Map<string, number>();

    constructor(model: Model) {
        model.on("all", (state) => {
            this.clear();
            this.wasRunning = state.panel.running;
        });
        model.on("panel", ({ running }) => {
            if (running && !this.wasRunning) this.begin();
            this.wasRunning = running;
        });
        model.on("motion", (motion) => this.addMotion(motion));
        model.on("signals", (signals) => {
            for (const { name, value } of signals) this.lastValues.set(name, value);
        });
        model.on("signal", (changes) => {
            for (const [name, value] of changes) this.addSignal(name, model.lastTime, value);
        });
    }

    get current(): Run {
        return this.runs[this.runs.length - 1] ?? this.begin();
    }

    clear(): void {
        this.runs.length = 0;
        this.count = 0;
        this.changes = 0;
        this.begin();
    }

    /** Adds the run of a file; the current run stays the last. */
    add(name: string, samples: Sample[]): Run {
        const run = this.makeRun(name);
        run.samples = samples;
        this.count += samples.length;
        this.runs.splice(this.runs.length - 1, 0, run);
        this.trim();
        this.onRuns();
        return run;
    }

    private makeRun(name = ""): Run {
        const number = this.runs.reduce((most, run) => Math.max(most, run.number), 0) + 1;
        return { number, name: name || `Run ${number}`, samples: [], signals: new Map() };
    }

    private begin(): Run {
        const last = this.runs[this.runs.length - 1];
        if (last && last.samples.length === 0) return last;
        const run = this.makeRun();
        this.runs.push(run);
        this.trim();
        this.onRuns();
        return run;
    }

    private addMotion(motion: Motion): void {
        if (!this.recording || motion.units.length === 0) return;
        const { samples } = this.current;
        const before = samples[samples.length - 1];
        if (before && motion.t < before.t) return; // the clock of a controller never runs backwards within a run
        const units = before ? [...before.units] : [];
        for (const unit of motion.units) units[unit[0]] = sampleOf(unit);
        samples.push({ t: motion.t, units });
        this.count += 1;
        this.trim();
        this.onSample();
    }

    private addSignal(name: string, t: number, value: number): void {
        if (!this.recording || this.changes >= signalChangesKept) return;
        const { signals, samples } = this.current;
        const before = this.lastValues.get(name) ?? 0;
        this.lastValues.set(name, value);
        const known = signals.get(name) ?? [{ t: samples[0]?.t ?? t, value: before }];
        known.push({ t, value });
        signals.set(name, known);
        this.changes += 1;
    }

    /** The oldest runs go first; of a single long run, its first half. */
    private trim(): void {
        while (this.runs.length > 1 && (this.count > samplesKept || this.runs.length > runsKept)) {
            this.count -= this.runs.shift()?.samples.length ?? 0;
            this.changes = this.runs.reduce((sum, run) => sum + [...run.signals.values()].reduce((part, each) => part + each.length, 0), 0);
        }
        const only = this.runs[0];
        if (!only || this.count <= samplesKept) return;
        const gone = only.samples.splice(0, Math.floor(only.samples.length / 2));
        this.count -= gone.length;
        const start = only.samples[0]?.t ?? 0;
        for (const [name, changes] of only.signals) only.signals.set(name, changes.filter(({ t }) => t >= start));
        this.changes = [...only.signals.values()].reduce((sum, each) => sum + each.length, 0);
    }
}

function sampleOf([, joints, , tcp, flange, speed]: UnitMotion): UnitSample {
    return { joints, tcp, flange, speed };
}

/** Time of the first and of the last sample. */
export function spanOf(run: Run): [number, number] {
    return [run.samples[0]?.t ?? 0, run.samples[run.samples.length - 1]?.t ?? 0];
}

/** Index of the last sample at or before `t`. */
export function sampleAt(run: Run, t: number): number {
    let low = 0;
    let high = run.samples.length - 1;
    while (low < high) {
        const middle = (low + high + 1) >> 1;
        if ((run.samples[middle]?.t ?? 0) <= t) low = middle;
        else high = middle - 1;
    }
    return low;
}
