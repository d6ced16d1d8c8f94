// Poses of the protocol as matrices of three.js, which works in metres here so that its camera and lights have usual sizes.

import { Euler, Matrix4, Quaternion, Vector3 } from "three";
import type { Point, Pose } from "../api/protocol";

export const metres = 0.001;

const one = new Vector3(1, 1, 1);

export function vectorOf(point: Point | undefined): Vector3 {
    const [x = 0, y = 0, z = 0] = point ?? [];
    return new Vector3(x * metres, y * metres, z * metres);
}

export function quaternionOf(pose: Pose): Quaternion {
    const [, , , q1 = 1, q2 = 0, q3 = 0, q4 = 0] = pose;
    return new Quaternion(q2, q3, q4, q1).normalize();
}

export function matrixOf(pose: Pose, into = new Matrix4()): Matrix4 {
    return into.compose(vectorOf(pose), quaternionOf(pose), one);
}

/** Angles about z, y, x in degrees, as controllers show an orientation: the result is [about x, about y, about z]. */
export function eulerAngles(pose: Pose): [number, number, number] {
    const angles = new Euler().setFromQuaternion(quaternionOf(pose), "ZYX");
    const degrees = 180 / Math.PI;
    return [angles.x * degrees, angles.y * degrees, angles.z * degrees];
}
