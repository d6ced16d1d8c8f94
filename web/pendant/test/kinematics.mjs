// Forward kinematics of the simulated arm from its bodies, in mm and degrees.

const multiply = (a, b) => {
    const [, , , aw, ax, ay, az] = a;
    const [, , , bw, bx, by, bz] = b;
    const p = rotate(a, b);
    return [
        a[0] + p[0], a[1] + p[1], a[2] + p[2],
        aw * bw - ax * bx - ay * by - az * bz, aw * bx + ax * bw + ay * bz - az * by,
        aw * by - ax * bz + ay * bw + az * bx, aw * bz + ax * by - ay * bx + az * bw,
    ];
};

function rotate([, , , w, x, y, z], [px, py, pz]) {
    const tx = 2 * (y * pz - z * py);
    const ty = 2 * (z * px - x * pz);
    const tz = 2 * (x * py - y * px);
    return [px + w * tx + y * tz - z * ty, py + w * ty + z * tx - x * tz, pz + w * tz + x * ty - y * tx];
}

export function flangeOf(unit, joints) {
    const poses = [];
    for (const body of unit.bodies) {
        const angle = ((body.constant + body.terms.reduce((sum, [joint, factor]) => sum + factor * joints[joint], 0)) * Math.PI) / 360;
        const turn = [0, 0, 0, Math.cos(angle), ...body.axis.map((each) => each * Math.sin(angle))];
        const here = multiply(body.origin, body.motion === "fixed" ? [0, 0, 0, 1, 0, 0, 0] : turn);
        poses.push(body.parent < 0 ? here : multiply(poses[body.parent], here));
    }
    return poses[poses.length - 1];
}

export function tcpOf(unit, joints) {
    return multiply(multiply(unit.base, flangeOf(unit, joints)), unit.tool.pose);
}
