// Robots of the simulated controller: bodies as docs/pendant.md describes them, and the poses that follow from joints.

const quarterAboutY = [0, 0, 0, Math.SQRT1_2, 0, Math.SQRT1_2, 0];
const at = (x, y, z) => [x, y, z, 1, 0, 0, 0];

/** An arm of six axes; lengths in mm as in runtime/robot/robot_model.h. */
function sixAxisBodies({ a1, a2, c1, c2, c3, c4 }, thick) {
    const arm = (from, to, radius) => ({ kind: "capsule", role: "arm", from, to, radius });
    const joint = (from, to, radius) => ({ kind: "cylinder", role: "joint", from, to, radius });
    const body = (name, parent, origin, axis, index, solids) => ({
        name, parent, origin, axis, motion: index < 0 ? "fixed" : "rotary", constant: 0, terms: index < 0 ? [] : [[index, 1]], solids,
    });
    const y = [0, 1, 0];
    const x = [1, 0, 0];
    return [
        body("base", -1, at(0, 0, 0), [0, 0, 1], -1, [joint([0, 0, 0], [0, 0, c1 * 0.45], thick * 1.5)]),
        body("link1", 0, at(0, 0, 0), [0, 0, 1], 0, [
            arm([0, 0, c1 * 0.5], [a1, 0, c1], thick), joint([a1, -thick * 1.2, c1], [a1, thick * 1.2, c1], thick),
        ]),
        body("link2", 1, at(a1, 0, c1), y, 1, [arm([0, 0, 0], [0, 0, c2], thick * 0.85)]),
        body("link3", 2, at(0, 0, c2), y, 2, [
            joint([0, -thick, 0], [0, thick, 0], thick * 0.85), arm([0, 0, 0], [0, 0, -a2], thick * 0.8),
        ]),
        body("link4", 3, at(0, 0, -a2), x, 3, [arm([0, 0, 0], [c3, 0, 0], thick * 0.65)]),
        body("link5", 4, at(c3, 0, 0), y, 4, [joint([0, -thick * 0.7, 0], [0, thick * 0.7, 0], thick * 0.55)]),
        { ...body("flange", 5, [c4, 0, 0, ...quarterAboutY.slice(3)], [0, 0, 1], 5, [
            { kind: "cylinder", role: "flange", from: [0, 0, -12], to: [0, 0, 0], radius: thick * 0.5 },
        ]) },
    ];
}

const limits = [[-165, 165, 250], [-110, 110, 250], [-110, 70, 250], [-160, 160, 320], [-120, 120, 320], [-400, 400, 420]];
const small = { a1: 0, a2: -70, c1: 290, c2: 270, c3: 302, c4: 72 };

export function unitOf(name, task, base) {
    return {
        name, task, model: "IRB 120-3/0.58", base, reach: 580, toolMass: 1, external: [],
        tool: { name: "tGripper", pose: at(0, 0, 120) },
        workObject: { name: "wobjTable", pose: [base[0] + 380, base[1] + 120, base[2] + 50, 1, 0, 0, 0] },
        joints: limits.map(([lower, upper, maxSpeed], i) => ({ axis: i + 1, name: String(i + 1), kind: "rotary", lower, upper, maxSpeed })),
        bodies: sixAxisBodies(small, 55),
    };
}

function multiply([a, b, c, d], [e, f, g, h]) {
    return [a * e - b * f - c * g - d * h, a * f + b * e + c * h - d * g, a * g - b * h + c * e + d * f, a * h + b * g - c * f + d * e];
}

function turned([w, x, y, z], v) {
    const [, i, j, k] = multiply(multiply([w, x, y, z], [0, ...v]), [w, -x, -y, -z]);
    return [i, j, k];
}

export function compose(first, second) {
    const moved = turned(first.slice(3), second.slice(0, 3));
    return [...moved.map((value, i) => value + first[i]), ...multiply(first.slice(3), second.slice(3))];
}

/** The flange in the base frame. */
export function flangeOf(unit, joints) {
    const poses = [];
    for (const body of unit.bodies) {
        const value = body.terms.reduce((sum, [index, factor]) => sum + factor * joints[index], body.constant);
        const half = (value * Math.PI) / 360;
        const own = [0, 0, 0, Math.cos(half), ...body.axis.map((part) => part * Math.sin(half))];
        const inParent = compose(body.origin, body.motion === "rotary" ? own : at(0, 0, 0));
        poses.push(body.parent < 0 ? inParent : compose(poses[body.parent], inParent));
    }
    return poses.at(-1);
}

/** The TCP in world. */
export function tcpOf(unit, joints) {
    return compose(unit.base, compose(flangeOf(unit, joints), unit.tool.pose));
}

/** Joints of a movement that looks like work; `t` in s. */
export function jointsAt(t, phase = 0) {
    const wave = (period, shift = 0) => Math.sin((2 * Math.PI * (t + shift)) / period + phase);
    return [42 * wave(7), 18 + 22 * wave(3.7, 0.6), 12 + 20 * wave(5.1, 1.1), 35 * wave(6.3), 48 + 22 * wave(4.4), 90 * wave(9.1)];
}
