import {
    DirectionalLight, GridHelper, Group, HemisphereLight, LineBasicMaterial, PerspectiveCamera, Scene, Vector3, WebGLRenderer,
} from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import { frameAxes } from "./frames";
import { palette, type Palette } from "./palette";
import { drawsInSoftware } from "./software";

const slowFrame = 55; // ms from one picture to the next; above it the picture gets coarser
const fastFrame = 20; // ms; below it finer again
const coarsest = 0.6;
const stillAfter = 500; // ms without a change
const stillRatio = 2; // pixels drawn for each shown in a picture at rest: smooth edges in software, too

/**
 * Renderer, camera, lights and floor. Draws only when something has changed, at most once per frame of the screen, and
 * adapts the resolution to the machine: software rendering stays usable.
 */
export class Stage {
    readonly scene = new Scene();
    readonly camera = new PerspectiveCamera(38, 1, 0.02, 200);
    readonly content = new Group();
    readonly controls: OrbitControls;
    /** time from one picture to the next in ms while there is movement, smoothed */
    frameTime = 16;
    frames = 0;
    /** before each frame */
    onFrame: () => void = () => {};
    /** after each frame */
    onDrawn: () => void = () => {};
    private readonly renderer: WebGLRenderer;
    private readonly floor = new Group();
    private asked = false;
    private ratio = Math.min(window.devicePixelRatio, 2);
    private readonly finest = Math.min(window.devicePixelRatio, 2);
    private sinceChange = 0;
    private stillTimer = 0;
    private isStill = false;
    colours: Palette = palette();

    constructor(readonly canvas: HTMLCanvasElement) {
        this.renderer = new WebGLRenderer({ canvas, antialias: !drawsInSoftware, powerPreference: "high-performance" });
        this.camera.up.set(0, 0, 1);
        this.controls = new OrbitControls(this.camera, canvas);
        this.controls.screenSpacePanning = true;
        this.controls.minDistance = 0.15;
        this.controls.maxDistance = 60;
        this.controls.addEventListener("change", () => this.draw());
        const sun = new DirectionalLight("#ffffff", 2.1);
        sun.position.set(3, -4, 6);
        const fill = new DirectionalLight("#cfe3ff", 0.7);
        fill.position.set(-4, 3, 2);
        this.scene.add(new HemisphereLight("#ffffff", "#66707c", 1.5), sun, fill, this.floor, this.content);
        this.setColours();
        this.lookAt(new Vector3(0, 0, 0.5), 2);
    }

    setColours(): void {
        this.colours = palette();
        this.scene.background = this.colours.background;
        this.floor.clear();
        const grid = new GridHelper(8, 32, this.colours.gridMain, this.colours.grid);
        grid.rotation.x = Math.PI / 2;
        const material = grid.material as LineBasicMaterial;
        material.transparent = true;
        material.opacity = 0.7;
        this.floor.add(grid, frameAxes(0.2));
        this.draw();
    }

    /** Looks at `centre` from the front right, so far away that `size` (metres) fills the picture. */
    lookAt(centre: Vector3, size: number, direction = new Vector3(1, -1.15, 0.62)): void {
        this.controls.target.copy(centre);
        const aspect = Math.min(1, this.camera.aspect);
        const distance = (size / Math.tan((this.camera.fov * Math.PI) / 360) / aspect) * 0.68;
        this.camera.position.copy(direction).normalize().multiplyScalar(distance).add(centre);
        this.controls.update();
        this.draw();
    }

    /** Moves camera and target together. */
    shift(by: Vector3): void {
        this.camera.position.add(by);
        this.controls.target.add(by);
    }

    resize(): void {
        const { clientWidth: width, clientHeight: height } = this.canvas;
        if (width === 0 || height === 0) return;
        this.isStill = false;
        this.setSize(this.ratio);
        this.camera.aspect = width / height;
        this.camera.updateProjectionMatrix();
        this.draw();
    }

    draw(): void {
        if (this.asked) return;
        this.asked = true;
        requestAnimationFrame((time) => {
            this.asked = false;
            if (this.isStill) this.resize();
            this.render();
            // the graphics processor works on its own: the time until the browser offers the next frame shows how long it takes
            requestAnimationFrame((next) => this.measure(next - time));
            if (!drawsInSoftware) return;
            clearTimeout(this.stillTimer);
            this.stillTimer = window.setTimeout(() => this.drawStill(), stillAfter);
        });
    }

    private setSize(ratio: number): void {
        this.renderer.setPixelRatio(ratio);
        this.renderer.setSize(this.canvas.clientWidth, this.canvas.clientHeight, false);
    }

    /** Nothing moves: one fine picture. */
    private drawStill(): void {
        if (this.asked || this.isStill || this.canvas.clientWidth === 0) return;
        this.isStill = true;
        this.setSize(stillRatio);
        this.render();
    }

    private render(): void {
        this.onFrame();
        this.renderer.render(this.scene, this.camera);
        this.onDrawn();
    }

    private measure(duration: number): void {
        this.frames += 1;
        this.frameTime += (duration - this.frameTime) * 0.2;
        this.sinceChange += 1;
        const slow = this.frameTime > 2 * slowFrame;
        if (this.sinceChange < (slow ? 5 : 25)) return;
        this.sinceChange = 0;
        let wanted = this.ratio;
        if (this.frameTime > slowFrame) wanted = Math.max(coarsest, this.ratio * (slow ? 0.7 : 0.85));
        else if (this.frameTime < fastFrame) wanted = Math.min(this.finest, this.ratio * 1.1);
        if (Math.abs(wanted - this.ratio) < 0.05) return;
        this.ratio = wanted;
        this.resize();
    }
}
