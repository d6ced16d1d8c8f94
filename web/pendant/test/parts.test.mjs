// Tests of parts that need no browser. node --test test/parts.test.mjs

import assert from "node:assert/strict";
import { dirname, join } from "node:path";
import { test } from "node:test";
import { fileURLToPath } from "node:url";
import { build } from "esbuild";

const here = dirname(fileURLToPath(import.meta.url));

async function load(path) {
    const { outputFiles } = await build({ entryPoints: [join(here, "../src", path)], bundle: true, format: "esm", write: false, platform: "neutral", mainFields: ["module", "main"] });
    return import(`data:text/javascript;base64,${Buffer.from(outputFiles[0].text).toString("base64")}`);
}

const { tokensOf } = await load("program/rapid_tokens.ts");
const { Recorder, sampleAt, spanOf } = await load("recording/recorder.ts");
const { csvOf, samplesFrom } = await load("recording/recording_file.ts");
const { eulerAngles } = await load("math/pose.ts");
const { whenPageIsLeft, whileHeld } = await load("ui/hold.ts");

const kinds = (line) => tokensOf(line).filter(({ text }) => text.trim() !== "").map(({ kind, text }) => [kind, text.trim()]);

test("a comment ends with its line, an exclamation mark in a string is no comment", () => {
    assert.deepEqual(kinds('TPWrite "Done!"; ! well'), [["call", "TPWrite"], ["string", '"Done!"'], ["plain", ";"], ["comment", "! well"]]);
});

test("a doubled quote is part of the string (language: string literals)", () => {
    assert.equal(tokensOf('s:="a""b";').find(({ kind }) => kind === "string").text, '"a""b"');
});

test("keywords and types in any case, tokens give the line back", () => {
    assert.equal(kinds("endproc")[0][0], "keyword");
    assert.equal(kinds("VAR NUM x")[1][0], "type");
    for (const line of ["  MoveL Offs(p1,0,0,-1.5E-3),v100\\T:=2,fine,tool0;", "x{3}.trans.x:=@;", ""]) assert.equal(tokensOf(line).map(({ text }) => text).join(""), line);
});

/** A model that hands its events to the recorder. */
function fakeModel() {
    const listeners = {};
    return { lastTime: 0, on: (name, listener) => { listeners[name] = listener; }, emit: (name, data) => listeners[name](data) };
}

const move = (t, index, joint) => ({ t, units: [[index, [joint], [], [0, 0, 0, 1, 0, 0, 0], [0, 0, 0, 1, 0, 0, 0], 10, 1]] });

test("a start after a stop begins a new run; units at rest keep their sample", () => {
    const model = fakeModel();
    const recorder = new Recorder(model);
    model.emit("all", { panel: { running: true } });
    model.emit("motion", move(1, 0, 5));
    model.emit("motion", move(2, 1, 7));
    model.emit("panel", { running: false });
    model.emit("panel", { running: true });
    model.emit("motion", move(3, 0, 6));
    assert.equal(recorder.runs.length, 2);
    assert.deepEqual(recorder.runs[0].samples[1].units.map(({ joints }) => joints[0]), [5, 7]);
    assert.deepEqual(spanOf(recorder.runs[0]), [1, 2]);
    assert.equal(sampleAt(recorder.runs[0], 1.9), 0);
    assert.equal(sampleAt(recorder.runs[0], 2), 1);
});

test("a signal begins with the value it had before its first change", () => {
    const model = fakeModel();
    const recorder = new Recorder(model);
    model.emit("all", { panel: { running: true } });
    model.emit("signals", [{ name: "do1", value: 1 }]);
    model.emit("motion", move(1, 0, 0));
    model.lastTime = 4;
    model.emit("signal", [["do1", 0, 0]]);
    assert.deepEqual(recorder.current.signals.get("do1"), [{ t: 1, value: 1 }, { t: 4, value: 0 }]);
});

test("angles of a pose: a quarter turn about z", () => {
    const half = Math.SQRT1_2;
    const [x, y, z] = eulerAngles([0, 0, 0, half, 0, 0, half]);
    assert.ok(Math.abs(x) < 1e-9 && Math.abs(y) < 1e-9 && Math.abs(z - 90) < 1e-9);
});

const twoUnits = [{ name: "ROB_1", joints: [{}, {}] }, { name: "ROB_2", joints: [{}] }];

test("a run that is saved and loaded again is the same (docs/pendant.md: files of runs)", () => {
    const first = { joints: [1.5, -2], tcp: [1, 2, 3, 1, 0, 0, 0], flange: [4, 5, 6, 0, 1, 0, 0], speed: 12.5 };
    const second = { joints: [90], tcp: [0, 0, 9, 1, 0, 0, 0], flange: [0, 0, 8, 1, 0, 0, 0], speed: 0 };
    const samples = [{ t: 1, units: [first, second] }, { t: 1.004, units: [{ ...first, speed: 0 }, second] }];
    assert.deepEqual(samplesFrom(csvOf({ samples }, twoUnits), twoUnits), samples);
});

test("a trace of rapidc run --trace can be loaded, without poses of the flange (docs/reports.md: columns)", () => {
    const trace =
        "time_s,unit,j1,j2,j3,j4,j5,j6,e1,x,y,z,q1,q2,q3,q4,speed_mm_s,move\n" +
        "0.000,ROB_1,1,2,0,0,0,0,9E+09,364.5,0,594,1,0,0,0,250,7\n" +
        "0.000,ROB_9,1,2,0,0,0,0,9E+09,0,0,0,1,0,0,0,0,0\n";
    assert.deepEqual(samplesFrom(trace, twoUnits), [{ t: 0, units: [{ joints: [1, 2], tcp: [364.5, 0, 594, 1, 0, 0, 0], flange: [], speed: 250 }] }]);
});

test("a file that is not a run is refused with its line", () => {
    assert.throws(() => samplesFrom("PROC main()\nENDPROC\n", twoUnits), /Line 1 names no column time_s/);
    assert.throws(() => samplesFrom("time_s,j1,j2\n0,1,2\n1,x,3\n", twoUnits), /Line 3: 'x' is not a number for j1/);
    assert.throws(() => samplesFrom("time_s,unit,j1\n0,ROB_7,1\n", twoUnits), /no sample of a robot/);
});

/** A button that is held, and how often it began and ended. */
function fakeButton() {
    const item = new EventTarget();
    const captured = new Set();
    item.hasPointerCapture = (id) => captured.has(id);
    item.releasePointerCapture = (id) => captured.delete(id);
    const counts = { begun: 0, ended: 0 };
    whileHeld(item, () => counts.begun++, () => counts.ended++);
    const fire = (type, fields = {}) => item.dispatchEvent(Object.assign(new Event(type, { cancelable: true }), { pointerId: 1, button: 0, ...fields }));
    return { captured, counts, fire };
}

test("a held button ends when it is released, left or loses the focus (docs/serve.md, Jogging)", () => {
    for (const type of ["pointerup", "pointercancel", "pointerleave", "blur"]) {
        const { counts, fire } = fakeButton();
        fire("pointerdown");
        assert.deepEqual(counts, { begun: 1, ended: 0 }, type);
        fire(type);
        assert.deepEqual(counts, { begun: 1, ended: 1 }, type);
    }
});

test("a touch may leave a held button; other buttons of the mouse do not hold it", () => {
    const { captured, counts, fire } = fakeButton();
    captured.add(1);
    fire("pointerdown");
    assert.equal(captured.size, 0);
    fire("pointerdown", { button: 2 });
    assert.equal(counts.begun, 1);
});

test("a key holds a button once, until it is released", () => {
    const { counts, fire } = fakeButton();
    for (const key of [" ", "Enter"]) {
        fire("keydown", { key });
        fire("keydown", { key, repeat: true });
        fire("keyup", { key });
    }
    fire("keydown", { key: "a" });
    assert.deepEqual(counts, { begun: 2, ended: 2 });
});

test("the page is left when its window loses the focus or it is hidden", () => {
    globalThis.window = new EventTarget();
    globalThis.document = Object.assign(new EventTarget(), { hidden: false });
    let left = 0;
    whenPageIsLeft(() => left++);
    document.dispatchEvent(new Event("visibilitychange"));
    assert.equal(left, 0);
    document.hidden = true;
    document.dispatchEvent(new Event("visibilitychange"));
    window.dispatchEvent(new Event("blur"));
    window.dispatchEvent(new Event("pagehide"));
    assert.equal(left, 3);
    delete globalThis.window;
    delete globalThis.document;
});
