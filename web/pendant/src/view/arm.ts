import {
    BoxGeometry, BufferGeometry, CapsuleGeometry, Color, CylinderGeometry, Group, Matrix4, Mesh, MeshLambertMaterial, MeshStandardMaterial, Quaternion, Vector3,
} from "three";
import type { Body, Pose, Solid, Unit } from "../api/protocol";
import { matrixOf, metres, quaternionOf, vectorOf } from "../math/pose";
import { frameAxes } from "./frames";
import type { Palette } from "./palette";
import { drawsInSoftware } from "./software";

const upward = new Vector3(0, 1, 0); // three.js builds capsules and cylinders along y
const degree = Math.PI / 180;

type BodyMaterial = MeshStandardMaterial | MeshLambertMaterial;

interface Rod {
    mesh: Mesh;
    from: Vector3;
    parent: number;
    to: Vector3;
    body: number;
}

/** One robot: its bodies, moved by the values of its joints. */
export class Arm {
    readonly group = new Group();
    /** frame of the flange (tool0), in the tree of the bodies */
    readonly flange: Group;
    /** the TCP in the world */
    readonly tcp = new Vector3();
    private readonly bodies: Group[] = [];
    private readonly rods: Rod[] = [];
    private readonly materials: Record<string, BodyMaterial>;
    private tool: Group | null = null;
    private readonly motion = new Matrix4();
    private readonly origins: Matrix4[] = [];

    constructor(private readonly unit: Unit, colours: Palette, private readonly ghost = false) {
        this.materials = this.makeMaterials(colours);
        matrixOf(unit.base, this.group.matrix);
        this.group.matrixAutoUpdate = false;
        unit.bodies.forEach((body, index) => this.addBody(body, index));
        this.flange = this.bodies[this.bodies.length - 1] ?? this.group;
        this.setTool(unit.tool.pose);
    }

    setColours(colours: Palette): void {
        const next = this.makeMaterials(colours);
        for (const [role, material] of Object.entries(this.materials)) material.color.copy((next[role] as BodyMaterial).color);
    }

    setTool(pose: Pose): void {
        if (this.tool) this.flange.remove(this.tool);
        const tool = new Group();
        const tip = vectorOf(pose);
        const length = tip.length();
        if (length > 0.005) tool.add(this.between(new Vector3(), tip, Math.min(0.022, length / 5), "tool"));
        if (!this.ghost) {
            const axes = frameAxes(Math.max(0.08, this.unit.reach * metres * 0.11));
            axes.matrixAutoUpdate = false;
            matrixOf(pose, axes.matrix);
            tool.add(axes);
        }
        this.flange.add(tool);
        this.tool = tool;
    }

    setPose(joints: number[], flange: Pose): void {
        this.unit.bodies.forEach((body, index) => {
            const group = this.bodies[index];
            const origin = this.origins[index];
            if (!group || !origin) return;
            if (body.motion === "flange") {
                group.visible = flange.length > 0; // a trace does not tell where it was
                if (group.visible) matrixOf(flange, group.matrix);
            } else {
                group.matrix.copy(origin);
                if (body.motion !== "fixed") group.matrix.multiply(this.motionOf(body, joints));
            }
            group.matrixWorldNeedsUpdate = true;
        });
        if (this.rods.length > 0) this.group.updateMatrixWorld(true);
        for (const rod of this.rods) this.placeRod(rod);
    }

    dispose(): void {
        this.group.traverse((object) => {
            if (object instanceof Mesh) (object.geometry as BufferGeometry).dispose();
        });
        for (const material of Object.values(this.materials)) material.dispose();
        this.group.removeFromParent();
    }

    private motionOf(body: Body, joints: number[]): Matrix4 {
        const value = body.terms.reduce((sum, [joint, factor]) => sum + factor * (joints[joint] ?? 0), body.constant);
        const [x = 0, y = 0, z = 1] = body.axis;
        if (body.motion === "rotary") return this.motion.makeRotationAxis(new Vector3(x, y, z).normalize(), value * degree);
        return this.motion.makeTranslation(x * value * metres, y * value * metres, z * value * metres);
    }

    private makeMaterials(colours: Palette): Record<string, BodyMaterial> {
        const roles: Record<string, Color> = { arm: colours.arm, joint: colours.joint, flange: colours.flange, tool: colours.tool };
        const made: Record<string, BodyMaterial> = {};
        for (const [role, colour] of Object.entries(roles)) {
            const common = {
                color: this.ghost ? colours.ghost : colour,
                transparent: this.ghost,
                opacity: this.ghost ? 0.35 : 1,
                depthWrite: !this.ghost,
            };
            const shine = { roughness: role === "arm" ? 0.5 : 0.4, metalness: role === "flange" ? 0.5 : 0.05 };
            made[role] = drawsInSoftware ? new MeshLambertMaterial(common) : new MeshStandardMaterial({ ...common, ...shine });
        }
        return made;
    }

    private addBody(body: Body, index: number): void {
        const group = new Group();
        group.matrixAutoUpdate = false;
        const origin = matrixOf(body.origin);
        group.matrix.copy(origin);
        this.origins[index] = origin;
        this.bodies[index] = group;
        (this.bodies[body.parent] ?? this.group).add(group);
        for (const solid of body.solids) this.addSolid(group, index, solid);
    }

    private addSolid(group: Group, index: number, solid: Solid): void {
        const role = solid.role ?? "arm";
        if (solid.kind === "box") {
            const [x = 0, y = 0, z = 0] = solid.size ?? [];
            const box = new Mesh(new BoxGeometry(x * metres, y * metres, z * metres), this.material(role));
            box.position.copy(vectorOf(solid.pose));
            box.quaternion.copy(quaternionOf(solid.pose ?? []));
            group.add(box);
            return;
        }
        const from = vectorOf(solid.from);
        const radius = (solid.radius ?? 20) * metres;
        if (solid.kind === "rod") {
            const mesh = new Mesh(new CylinderGeometry(radius, radius, 1, 12), this.material(role));
            this.group.add(mesh);
            this.rods.push({ mesh, from, parent: index, to: vectorOf(solid.to), body: solid.toBody ?? index });
            return;
        }
        group.add(this.between(from, vectorOf(solid.to), radius, role, solid.kind === "capsule"));
    }

    private material(role: string): BodyMaterial {
        return this.materials[role] ?? (this.materials.arm as BodyMaterial);
    }

    private between(from: Vector3, to: Vector3, radius: number, role: string, round = false): Mesh {
        const way = new Vector3().subVectors(to, from);
        const length = way.length();
        const geometry = round ? new CapsuleGeometry(radius, length, 8, 24) : new CylinderGeometry(radius, radius, Math.max(length, 1e-4), 28);
        const mesh = new Mesh(geometry, this.material(role));
        mesh.position.addVectors(from, to).multiplyScalar(0.5);
        if (length > 1e-9) mesh.quaternion.setFromUnitVectors(upward, way.divideScalar(length));
        return mesh;
    }

    private placeRod(rod: Rod): void {
        const inverse = new Matrix4().copy(this.group.matrixWorld).invert();
        const from = rod.from.clone().applyMatrix4((this.bodies[rod.parent] ?? this.group).matrixWorld).applyMatrix4(inverse);
        const to = rod.to.clone().applyMatrix4((this.bodies[rod.body] ?? this.group).matrixWorld).applyMatrix4(inverse);
        const way = new Vector3().subVectors(to, from);
        const length = way.length();
        rod.mesh.position.addVectors(from, to).multiplyScalar(0.5);
        rod.mesh.quaternion.copy(new Quaternion().setFromUnitVectors(upward, way.divideScalar(length || 1)));
        rod.mesh.scale.set(1, length, 1);
    }
}
