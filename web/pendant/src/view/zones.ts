import {
    BoxGeometry, BufferGeometry, CylinderGeometry, DoubleSide, EdgesGeometry, Group, LineBasicMaterial, LineSegments, Mesh, MeshBasicMaterial, SphereGeometry, Vector3,
} from "three";
import type { Zone } from "../api/protocol";
import { metres, vectorOf } from "../math/pose";
import type { Palette } from "./palette";

/** World zones as transparent solids with edges; null for zones of joint values, which have no shape. */
export function zoneObject(zone: Zone, colours: Palette): Group | null {
    const shape = shapeOf(zone);
    if (!shape) return null;
    const colour = zone.stops ? colours.zoneInside : colours.zoneOutside;
    const strength = zone.active ? 1 : 0.35;
    const group = new Group();
    const solid = new Mesh(
        shape.geometry,
        new MeshBasicMaterial({ color: colour, transparent: true, opacity: 0.12 * strength, depthWrite: false, side: DoubleSide }),
    );
    const edges = new LineSegments(
        new EdgesGeometry(shape.geometry, 30),
        new LineBasicMaterial({ color: colour, transparent: true, opacity: 0.8 * strength }),
    );
    group.add(solid, edges);
    group.position.copy(shape.centre);
    if (shape.upright) group.rotation.x = Math.PI / 2;
    return group;
}

interface Shape {
    geometry: BufferGeometry;
    centre: Vector3;
    /** three.js builds it along y */
    upright: boolean;
}

function shapeOf(zone: Zone): Shape | null {
    if (zone.kind === "box" && zone.box) {
        const from = vectorOf(zone.box.from);
        const to = vectorOf(zone.box.to);
        const size = new Vector3().subVectors(to, from);
        const geometry = new BoxGeometry(Math.abs(size.x), Math.abs(size.y), Math.abs(size.z));
        return { geometry, centre: from.add(to).multiplyScalar(0.5), upright: false };
    }
    if (zone.kind === "cylinder" && zone.cylinder) {
        const { centre, radius, height } = zone.cylinder;
        const middle = vectorOf(centre);
        middle.z += (height * metres) / 2;
        return { geometry: new CylinderGeometry(radius * metres, radius * metres, Math.abs(height * metres), 48, 1), centre: middle, upright: true };
    }
    if (zone.kind === "sphere" && zone.sphere) {
        const { centre, radius } = zone.sphere;
        return { geometry: new SphereGeometry(radius * metres, 24, 16), centre: vectorOf(centre), upright: true };
    }
    return null;
}
