import { BufferAttribute, BufferGeometry, Color, DynamicDrawUsage, Line, LineBasicMaterial } from "three";
import type { Point } from "../api/protocol";
import { metres } from "../math/pose";

/**
 * The last points of a TCP as one line. Points lie in a ring that is stored twice: whatever the oldest point is, the whole
 * path is one range without a seam, so a new point costs two small uploads and no copy.
 */
export class PathLine {
    readonly line: Line;
    private readonly positions: BufferAttribute;
    private readonly colours: BufferAttribute;
    private next = 0;
    private count = 0;
    /** points came while the line was hidden: all of it is uploaded next time */
    private stale = false;
    private readonly last = [NaN, NaN, NaN];
    private readonly shade = new Color();

    /** @param capacity number of points that are kept */
    constructor(readonly capacity: number, private slow: Color, private fast: Color) {
        this.positions = new BufferAttribute(new Float32Array(capacity * 6), 3).setUsage(DynamicDrawUsage);
        this.colours = new BufferAttribute(new Float32Array(capacity * 6), 3).setUsage(DynamicDrawUsage);
        const geometry = new BufferGeometry();
        geometry.setAttribute("position", this.positions);
        geometry.setAttribute("color", this.colours);
        geometry.setDrawRange(0, 0);
        this.line = new Line(geometry, new LineBasicMaterial({ vertexColors: true }));
        this.line.frustumCulled = false; // its bounds change with each point
    }

    get points(): number {
        return this.count;
    }

    setColours(slow: Color, fast: Color): void {
        this.slow = slow;
        this.fast = fast;
    }

    clear(): void {
        this.next = 0;
        this.count = 0;
        this.last.fill(NaN);
        this.line.geometry.setDrawRange(0, 0);
    }

    /** Points closer than 0.5 mm to the last one are left out. `share`: the speed, 0 to 1, as a colour. */
    add(point: Point, share: number): void {
        const [x = 0, y = 0, z = 0] = point;
        const [lastX = NaN, lastY = NaN, lastZ = NaN] = this.last;
        if (Math.hypot(x - lastX, y - lastY, z - lastZ) < 0.5) return;
        this.last[0] = x;
        this.last[1] = y;
        this.last[2] = z;
        if (!this.line.visible) this.stale = true;
        this.shade.lerpColors(this.slow, this.fast, Math.min(1, Math.max(0, share)));
        for (const at of [this.next, this.next + this.capacity]) {
            this.positions.setXYZ(at, x * metres, y * metres, z * metres);
            this.colours.setXYZ(at, this.shade.r, this.shade.g, this.shade.b);
            for (const attribute of [this.positions, this.colours]) {
                if (this.stale) attribute.clearUpdateRanges();
                else attribute.addUpdateRange(at * 3, 3);
                attribute.needsUpdate = true;
            }
        }
        this.next = (this.next + 1) % this.capacity;
        this.count = Math.min(this.count + 1, this.capacity);
        const first = this.count < this.capacity ? 0 : this.next;
        this.line.geometry.setDrawRange(first, this.count);
    }

    /** After a frame. */
    drawn(): void {
        if (this.line.visible) this.stale = false;
    }

    dispose(): void {
        this.line.geometry.dispose();
        (this.line.material as LineBasicMaterial).dispose();
        this.line.removeFromParent();
    }
}
