import type { Unit } from "../api/protocol";
import type { Run, Sample, UnitSample } from "./recorder";

// The columns of `rapidc run --trace`, so that either is compared with the other, and those of the flange, which place the tool.
const axisColumns = ["j1", "j2", "j3", "j4", "j5", "j6", "e1"];
const poseColumns = ["x", "y", "z", "q1", "q2", "q3", "q4"];
const flangeColumns = poseColumns.map((name) => `flange_${name}`);
const columns = ["time_s", "unit", ...axisColumns, ...poseColumns, "speed_mm_s", ...flangeColumns];
const unused = "9E+09"; // an axis that the robot does not have

/** The samples of a run as comma-separated values: mm, degrees, seconds of virtual time. */
export function csvOf(run: Run, units: readonly Unit[]): string {
    const lines = [columns.join(",")];
    for (const { t, units: states } of run.samples) {
        states.forEach((state, index) => {
            const name = units[index]?.name;
            if (!state || name === undefined) return;
            const axes = axisColumns.map((_, axis) => state.joints[axis]?.toFixed(6) ?? unused);
            lines.push([t.toFixed(3), name, ...axes, ...poseText(state.tcp), state.speed.toFixed(4), ...poseText(state.flange)].join(","));
        });
    }
    return `${lines.join("\n")}\n`;
}

function poseText(pose: readonly number[]): string[] {
    return poseColumns.map((_, at) => (pose[at] ?? 0).toFixed(at < 3 ? 6 : 9));
}

/** The samples of a file of csvOf or of `--trace`. Throws an Error with the line when something cannot be read. */
export function samplesFrom(text: string, units: readonly Unit[]): Sample[] {
    const [head = "", ...lines] = text.split(/\r?\n/);
    const place = new Map(head.split(",").map((name, at) => [name.trim().toLowerCase(), at]));
    for (const name of ["time_s", "j1"])
        if (!place.has(name)) throw new Error(`Line 1 names no column ${name}; choose a recording of this page or a trace of rapidc run --trace`);
    const samples: Sample[] = [];
    lines.forEach((line, at) => {
        if (line.trim() === "") return;
        const cells = line.split(",");
        const cell = (name: string): string => cells[place.get(name) ?? -1] ?? "";
        const number = (name: string): number => {
            const value = Number(cell(name));
            if (cell(name).trim() === "" || !Number.isFinite(value)) throw new Error(`Line ${at + 2}: '${cell(name)}' is not a number for ${name}`);
            return value;
        };
        const unit = place.has("unit") ? units.findIndex(({ name }) => name === cell("unit")) : 0;
        if (unit < 0) return; // a robot that this controller does not have
        const pose = (names: string[]): number[] => (names.every((name) => place.has(name)) ? names.map(number) : []);
        const joints = (units[unit]?.joints ?? []).map((_, axis) => number(axisColumns[axis] ?? ""));
        add(samples, number("time_s"), unit, {
            joints,
            tcp: pose(poseColumns),
            flange: pose(flangeColumns),
            speed: place.has("speed_mm_s") ? number("speed_mm_s") : 0,
        });
    });
    if (samples.length === 0) throw new Error("The file has no sample of a robot of this controller");
    return samples;
}

/** Lines of one time are one sample; robots without a line keep theirs. */
function add(samples: Sample[], t: number, unit: number, state: UnitSample): void {
    const last = samples[samples.length - 1];
    if (last && last.t === t) {
        last.units[unit] = state;
        return;
    }
    const units = last ? [...last.units] : [];
    units[unit] = state;
    samples.push({ t, units });
}
