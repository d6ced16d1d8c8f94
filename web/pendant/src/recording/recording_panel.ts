import type { Model } from "../api/model";
import { onThemeChange } from "../shell/theme";
import { button, select, setOptions } from "../ui/controls";
import { h, oncePerFrame, setText } from "../ui/dom";
import type { ViewPanel } from "../view/view_panel";
import { attempt, notice } from "../ui/notices";
import { Chart, type Series } from "./chart";
import { Recorder, sampleAt, spanOf, type Run } from "./recorder";
import { csvOf, samplesFrom } from "./recording_file";

const drawEvery = 100; // ms while it records
const jointColours = ["series-1", "series-2", "series-3", "series-4", "series-5", "series-6"];

/** The recording with its time line: scrub, play, compare two runs, charts. */
export class RecordingPanel {
    readonly element: HTMLElement;
    private readonly recorder: Recorder;
    private readonly runChoice = select("Run", () => this.chooseRun());
    private readonly compareChoice = select("Compare with", () => this.redraw());
    private readonly unitChoice = select("Robot", () => this.redraw());
    private readonly signalChoice = select("Signal", () => this.redraw());
    private readonly line = h("input", { class: "slider time-line", attrs: { type: "range", min: 0, max: 1, step: "any", "aria-label": "Time" } });
    private readonly file = h("input", {
        attrs: { type: "file", accept: ".csv,text/csv", hidden: true, "aria-label": "File of a run" },
        on: { change: () => attempt(() => this.load()) },
    });
    private readonly place = h("output", { class: "clock" });
    private readonly liveButton: HTMLButtonElement;
    private readonly playButton: HTMLButtonElement;
    private readonly recordButton: HTMLButtonElement;
    private readonly joints = new Chart("Joint speed", "deg/s or mm/s", (t) => this.scrub(t));
    private readonly speed = new Chart("TCP speed", "mm/s", (t) => this.scrub(t));
    private readonly signals = new Chart("Signal", "", (t) => this.scrub(t));
    private cursor: number | null = null;
    private playing = false;
    private visible = false;
    private lastDraw = 0;
    private readonly redraw = oncePerFrame(() => this.draw());

    constructor(private readonly model: Model, private readonly view: ViewPanel) {
        this.recorder = new Recorder(model);
        this.liveButton = button({ icon: "live", label: "Live", onClick: () => this.goLive() });
        this.playButton = button({ icon: "play", label: "Play the recording", iconOnly: true, onClick: () => this.play(!this.playing) });
        this.recordButton = button({ label: "Record", class: "record", onClick: () => this.setRecording(!this.recorder.recording) });
        this.recordButton.setAttribute("aria-pressed", "true");
        this.element = this.layout();
        this.listen();
    }

    shown(visible: boolean): void {
        this.visible = visible;
        if (visible) this.redraw();
        else this.goLive();
    }

    private layout(): HTMLElement {
        const save = button({ icon: "save", label: "Save the run as CSV", iconOnly: true, onClick: () => this.save() });
        const load = button({ icon: "upload", label: "Load a run or a trace from CSV", iconOnly: true, onClick: () => this.file.click() });
        const clear = button({ icon: "trash", label: "Clear the recording", iconOnly: true, onClick: () => this.recorder.clear() });
        const labelled = (text: string, control: HTMLElement): HTMLElement => h("label", { class: "inline-label" }, h("span", { text }), control);
        return h(
            "section",
            { class: "panel recording" },
            h("div", { class: "panel-head" }, this.recordButton, labelled("Run", this.runChoice), labelled("Compare", this.compareChoice), h("span", { class: "grow" }), this.unitChoice, save, load, clear, this.file),
            h("div", { class: "time-row" }, this.playButton, this.line, this.place, this.liveButton),
            h("div", { class: "charts" }, this.speed.element, this.joints.element, h("div", { class: "chart-tools" }, labelled("Signal", this.signalChoice)), this.signals.element),
        );
    }

    private listen(): void {
        this.recorder.onRuns = () => this.showRuns();
        this.recorder.onSample = () => {
            if (!this.visible || performance.now() - this.lastDraw < drawEvery) return;
            this.redraw();
        };
        this.model.on("all", (state) => {
            setOptions(this.unitChoice, state.units.map(({ name }, index) => ({ value: String(index), label: name })));
            this.unitChoice.hidden = state.units.length < 2;
            this.goLive();
        });
        this.line.addEventListener("input", () => this.scrub(this.start() + Number(this.line.value)));
        onThemeChange(this.redraw);
    }

    private run(): Run | undefined {
        return this.recorder.runs.find(({ number }) => String(number) === this.runChoice.value) ?? this.recorder.current;
    }

    private compared(): Run | undefined {
        return this.recorder.runs.find(({ number }) => String(number) === this.compareChoice.value);
    }

    private start(): number {
        const run = this.run();
        return run ? spanOf(run)[0] : 0;
    }

    private showRuns(): void {
        const runs = this.recorder.runs.map(({ number, name }) => ({ value: String(number), label: name })).reverse();
        const wasLast = this.cursor === null;
        setOptions(this.runChoice, runs);
        if (wasLast && runs[0]) this.runChoice.value = runs[0].value;
        setOptions(this.compareChoice, [{ value: "", label: "none" }, ...runs]);
        this.redraw();
    }

    private chooseRun(): void {
        const run = this.run();
        if (run && run !== this.recorder.current) this.scrub(spanOf(run)[0]);
        else this.goLive();
    }

    /** Hands the chosen run to the browser as a file. */
    private save(): void {
        const run = this.run();
        const units = this.model.state?.units;
        if (!run || !units || run.samples.length === 0) return notice("warning", "The run has no samples yet");
        const address = URL.createObjectURL(new Blob([csvOf(run, units)], { type: "text/csv" }));
        h("a", { attrs: { href: address, download: `${run.name.replace(/[^\w.-]+/g, "_")}.csv` } }).click();
        setTimeout(() => URL.revokeObjectURL(address), 60_000);
    }

    /** Adds the run of the chosen file and compares the shown run with it. */
    private async load(): Promise<void> {
        const file = this.file.files?.[0];
        this.file.value = "";
        if (!file) return;
        const run = this.recorder.add(file.name.replace(/\.csv$/i, ""), samplesFrom(await file.text(), this.model.state?.units ?? []));
        this.compareChoice.value = String(run.number);
        notice("info", `${file.name} loaded`, "The charts show it beside the chosen run");
        this.redraw();
    }

    private setRecording(on: boolean): void {
        this.recorder.recording = on;
        this.recordButton.setAttribute("aria-pressed", String(on));
    }

    private goLive(): void {
        this.cursor = null;
        this.playing = false;
        this.view.robots.live = true;
        this.view.showBanner("");
        for (const motion of this.model.positions) {
            if (!motion) continue;
            this.view.robots.pose(motion[0], motion[1], motion[4]);
            this.view.robots.ghost(motion[0], null);
        }
        this.redraw();
    }

    /** `t`: seconds of virtual time in the chosen run. */
    private scrub(t: number): void {
        const run = this.run();
        if (!run || run.samples.length === 0) return;
        const [from, to] = spanOf(run);
        this.cursor = Math.min(to, Math.max(from, t));
        this.view.robots.live = false;
        this.pose(run, this.cursor, false);
        const other = this.compared();
        if (other && other !== run) this.pose(other, spanOf(other)[0] + this.cursor - from, true);
        this.view.showBanner(`Recording of ${run.name}${other && other !== run ? `, compared with ${other.name}` : ""}`);
        this.redraw();
    }

    private pose(run: Run, t: number, ghost: boolean): void {
        const sample = run.samples[sampleAt(run, t)];
        sample?.units.forEach((unit, index) => {
            if (!unit) return;
            if (ghost) this.view.robots.ghost(index, unit.joints, unit.flange);
            else this.view.robots.pose(index, unit.joints, unit.flange);
        });
    }

    private play(on: boolean): void {
        this.playing = on;
        if (!on) {
            this.redraw();
            return;
        }
        const run = this.run();
        if (!run) return;
        const [from, to] = spanOf(run);
        if (this.cursor === null || this.cursor >= to) this.scrub(from);
        let last = performance.now();
        const next = (now: number): void => {
            if (!this.playing || this.cursor === null) return;
            this.scrub(this.cursor + (now - last) / 1000);
            last = now;
            if (this.cursor >= spanOf(run)[1]) this.playing = false;
            else requestAnimationFrame(next);
        };
        requestAnimationFrame(next);
    }

    private draw(): void {
        const run = this.run();
        if (!run || !this.visible) return;
        this.lastDraw = performance.now();
        const [from, to] = spanOf(run);
        this.line.max = String(Math.max(0.01, to - from));
        if (this.cursor === null || document.activeElement !== this.line) this.line.value = String((this.cursor ?? to) - from);
        setText(this.place, `${((this.cursor ?? to) - from).toFixed(2)} s`);
        this.liveButton.setAttribute("aria-pressed", String(this.cursor === null));
        this.playButton.setAttribute("aria-pressed", String(this.playing));
        const other = this.compared();
        const both: [Run, number, boolean][] = [[run, 0, false]];
        if (other && other !== run) both.push([other, from - spanOf(other)[0], true]);
        const end = Math.max(...both.map(([each, shift]) => spanOf(each)[1] + shift));
        const unit = Number(this.unitChoice.value || 0);
        this.speed.show(both.map(([each, shift, dashed]) => speedSeries(each, unit, shift, dashed)), from, end, this.cursor);
        this.joints.show(jointSeries(run, unit), from, end, this.cursor);
        this.showSignalChoice(run);
        this.signals.show(both.map(([each, shift, dashed]) => signalSeries(each, this.signalChoice.value, shift, dashed)), from, end, this.cursor);
    }

    private showSignalChoice(run: Run): void {
        const names = [...run.signals.keys()].sort();
        this.signalChoice.hidden = names.length === 0;
        if (names.length === this.signalChoice.options.length) return;
        setOptions(this.signalChoice, names.map((value) => ({ value, label: value })));
    }
}

function speedSeries(run: Run, unit: number, shift: number, dashed: boolean): Series {
    const times = Float64Array.from(run.samples, ({ t }) => t + shift);
    const values = Float64Array.from(run.samples, ({ units }) => units[unit]?.speed ?? 0);
    return { label: run.name, colour: dashed ? "series-5" : "series-1", times, values, dashed };
}

/** Differences of positions over time. */
function jointSeries(run: Run, unit: number): Series[] {
    const { samples } = run;
    const count = samples[0]?.units[unit]?.joints.length ?? 0;
    const times = Float64Array.from(samples, ({ t }) => t);
    return Array.from({ length: count }, (_, joint) => {
        const values = new Float64Array(samples.length);
        for (let at = 1; at < samples.length; at++) {
            const now = samples[at];
            const before = samples[at - 1];
            const way = (now?.units[unit]?.joints[joint] ?? 0) - (before?.units[unit]?.joints[joint] ?? 0);
            const duration = (now?.t ?? 0) - (before?.t ?? 0);
            values[at] = duration > 1e-6 ? way / duration : 0;
        }
        values[0] = values[1] ?? 0;
        return { label: `${joint + 1}`, colour: jointColours[joint % jointColours.length] ?? "series-1", times, values };
    });
}

function signalSeries(run: Run, name: string, shift: number, dashed: boolean): Series {
    const changes = run.signals.get(name) ?? [];
    return {
        label: name ? `${name}, run ${run.number}` : "no signal has changed",
        colour: dashed ? "series-5" : "series-2",
        times: changes.map(({ t }) => t + shift),
        values: changes.map(({ value }) => value),
        stepped: true,
        dashed,
    };
}
