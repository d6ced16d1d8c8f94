import { BufferGeometry, Float32BufferAttribute, Group, Line, LineDashedMaterial, Vector3 } from "three";
import type { Model } from "../api/model";
import type { Frame, Point, Pose, State, UnitMotion } from "../api/protocol";
import { matrixOf, metres, vectorOf } from "../math/pose";
import { Arm } from "./arm";
import { disposeTree, frameAxes } from "./frames";
import { PathLine } from "./path_line";
import type { Stage } from "./scene";
import { zoneObject } from "./zones";

export const pathPoints = 10000;
const fullColourSpeed = 1000; // mm/s

interface Robot {
    arm: Arm;
    path: PathLine;
    planned: Line;
    plannedShape: string;
    workObject: Group;
    ghost: Arm | null;
}

export interface Layers {
    past: boolean;
    planned: boolean;
    frames: boolean;
    zones: boolean;
}

/** The objects in the scene: robots with their paths and frames, zones. */
export class RobotView {
    readonly robots: Robot[] = [];
    readonly layers: Layers = { past: true, planned: true, frames: true, zones: true };
    private readonly zones = new Group();
    /** while a recording is scrubbed the robots do not follow the controller */
    live = true;

    constructor(private readonly stage: Stage, private readonly model: Model) {
        stage.content.add(this.zones);
        stage.onDrawn = () => this.robots.forEach((robot) => robot.path.drawn());
    }

    build(state: State): void {
        for (const robot of this.robots.splice(0)) this.remove(robot);
        const { colours } = this.stage;
        for (const unit of state.units) {
            const arm = new Arm(unit, colours);
            const path = new PathLine(pathPoints, colours.past, colours.fast);
            const material = new LineDashedMaterial({ color: colours.planned, dashSize: 0.02, gapSize: 0.012 });
            const planned = new Line(new BufferGeometry(), material);
            planned.frustumCulled = false;
            const workObject = frameAxes(Math.max(0.1, unit.reach * metres * 0.16));
            workObject.matrixAutoUpdate = false;
            this.robots.push({ arm, path, planned, plannedShape: "[]", workObject, ghost: null });
            this.stage.content.add(arm.group, path.line, planned, workObject);
            this.setFrames(this.robots.length - 1, unit.tool, unit.workObject);
        }
        this.showZones();
        this.applyLayers();
        this.frameAll();
    }

    recolour(): void {
        const { colours } = this.stage;
        for (const robot of this.robots) {
            robot.arm.setColours(colours);
            robot.path.setColours(colours.past, colours.fast);
            (robot.planned.material as LineDashedMaterial).color.copy(colours.planned);
        }
        this.showZones();
    }

    move(motion: UnitMotion): void {
        const [index, joints, , tcp, flange, speed] = motion;
        const robot = this.robots[index];
        if (!robot) return;
        robot.path.add(tcp, speed / fullColourSpeed);
        if (this.live) robot.arm.setPose(joints, flange);
        this.stage.draw();
    }

    /** Poses of a recording. */
    pose(index: number, joints: number[], flange: Pose): void {
        this.robots[index]?.arm.setPose(joints, flange);
        this.stage.draw();
    }

    /** The second run of a comparison; null: none. */
    ghost(index: number, joints: number[] | null, flange: Pose = []): void {
        const robot = this.robots[index];
        const unit = this.model.state?.units[index];
        if (!robot || !unit) return;
        if (!joints) {
            robot.ghost?.dispose();
            robot.ghost = null;
        } else {
            if (!robot.ghost) {
                robot.ghost = new Arm(unit, this.stage.colours, true);
                this.stage.content.add(robot.ghost.group);
            }
            robot.ghost.setPose(joints, flange);
        }
        this.stage.draw();
    }

    setFrames(index: number, tool: Frame, workObject: Frame): void {
        const robot = this.robots[index];
        if (!robot) return;
        robot.arm.setTool(tool.pose);
        matrixOf(workObject.pose, robot.workObject.matrix);
        robot.workObject.matrixWorldNeedsUpdate = true;
        robot.workObject.visible = this.layers.frames && workObject.name !== "wobj0";
        this.stage.draw();
    }

    setPlanned(index: number, points: Point[]): void {
        const robot = this.robots[index];
        if (!robot) return;
        const shape = JSON.stringify(points);
        if (shape === robot.plannedShape) return; // an arm at rest costs no frames
        robot.plannedShape = shape;
        const values = points.flatMap((point) => point.slice(0, 3).map((value) => value * metres));
        robot.planned.geometry.dispose();
        robot.planned.geometry = new BufferGeometry().setAttribute("position", new Float32BufferAttribute(values, 3));
        if (points.length > 1) robot.planned.computeLineDistances();
        robot.planned.visible = this.layers.planned && points.length > 1;
        this.stage.draw();
    }

    showZones(): void {
        for (const child of [...this.zones.children]) disposeTree(child as Group);
        for (const zone of this.model.state?.zones ?? []) {
            const object = zoneObject(zone, this.stage.colours);
            if (object) this.zones.add(object);
        }
        this.zones.visible = this.layers.zones;
        this.stage.draw();
    }

    applyLayers(): void {
        this.robots.forEach((robot, index) => {
            const unit = this.model.state?.units[index];
            robot.path.line.visible = this.layers.past;
            robot.planned.visible = this.layers.planned && robot.planned.geometry.hasAttribute("position");
            robot.workObject.visible = this.layers.frames && unit?.workObject.name !== "wobj0";
        });
        this.zones.visible = this.layers.zones;
        this.stage.draw();
    }

    clearPaths(): void {
        for (const robot of this.robots) robot.path.clear();
        this.stage.draw();
    }

    /** All robots fill the picture. */
    frameAll(direction?: Vector3): void {
        const units = this.model.state?.units ?? [];
        const centre = new Vector3();
        let reach = 0.6;
        for (const unit of units) {
            centre.addScaledVector(vectorOf(unit.base), 1 / units.length);
            reach = Math.max(reach, unit.reach * metres);
        }
        const spread = Math.max(0, ...units.map((unit) => vectorOf(unit.base).distanceTo(centre)));
        centre.z += reach * 0.42;
        this.stage.lookAt(centre, reach * 1.5 + spread * 1.6, direction);
    }

    private remove(robot: Robot): void {
        robot.arm.dispose();
        robot.ghost?.dispose();
        robot.path.dispose();
        robot.planned.geometry.dispose();
        robot.planned.removeFromParent();
        disposeTree(robot.workObject);
    }
}
