import { colour } from "../shell/theme";
import { h } from "../ui/dom";

export interface Series {
    label: string;
    /** name of a colour of the design system */
    colour: string;
    times: Float64Array | number[];
    values: Float64Array | number[];
    /** value holds until the next point */
    stepped?: boolean;
    dashed?: boolean;
}

const padding = { left: 52, right: 12, top: 22, bottom: 20 };

/** Curves over time on a canvas, with a cursor. */
export class Chart {
    readonly element: HTMLElement;
    private readonly canvas = h("canvas", { class: "chart-canvas", attrs: { role: "img" } });
    private series: Series[] = [];
    private from = 0;
    private to = 1;
    private cursor: number | null = null;

    constructor(private readonly title: string, private readonly unit: string, onPick: (t: number) => void) {
        this.canvas.setAttribute("aria-label", `Chart: ${title}`);
        this.element = h("div", { class: "chart" }, this.canvas);
        const pick = (event: PointerEvent): void => {
            const { left, width } = this.canvas.getBoundingClientRect();
            const share = (event.clientX - left - padding.left) / (width - padding.left - padding.right);
            onPick(this.from + Math.min(1, Math.max(0, share)) * (this.to - this.from));
        };
        this.canvas.addEventListener("pointerdown", (event) => {
            this.canvas.setPointerCapture(event.pointerId);
            pick(event);
        });
        this.canvas.addEventListener("pointermove", (event) => event.buttons > 0 && pick(event));
        new ResizeObserver(() => this.draw()).observe(this.element);
    }

    show(series: Series[], from: number, to: number, cursor: number | null): void {
        this.series = series;
        this.from = from;
        this.to = Math.max(to, from + 0.1);
        this.cursor = cursor;
        this.draw();
    }

    draw(): void {
        const { clientWidth: width, clientHeight: height } = this.canvas;
        const pen = this.canvas.getContext("2d");
        if (!pen || width === 0) return;
        const ratio = window.devicePixelRatio;
        this.canvas.width = Math.round(width * ratio);
        this.canvas.height = Math.round(height * ratio);
        pen.scale(ratio, ratio);
        pen.font = `11px ${colour("font")}`;
        const [least, most] = this.range();
        const x = (t: number): number => padding.left + ((t - this.from) / (this.to - this.from)) * (width - padding.left - padding.right);
        const y = (value: number): number => height - padding.bottom - ((value - least) / (most - least)) * (height - padding.top - padding.bottom);
        this.drawGrid(pen, width, height, x, y, least, most);
        pen.save();
        pen.beginPath();
        pen.rect(padding.left, padding.top - 2, width - padding.left - padding.right, height - padding.top - padding.bottom + 4);
        pen.clip();
        for (const each of this.series) this.drawSeries(pen, each, x, y, width);
        pen.restore();
        this.drawLegend(pen, width);
        if (this.cursor !== null && this.cursor >= this.from && this.cursor <= this.to) {
            pen.strokeStyle = colour("text");
            pen.lineWidth = 1;
            line(pen, x(this.cursor), padding.top, x(this.cursor), height - padding.bottom);
        }
    }

    private range(): [number, number] {
        let least = 0;
        let most = 0;
        for (const { values } of this.series) {
            for (const value of values) {
                if (value < least) least = value;
                if (value > most) most = value;
            }
        }
        return most - least < 1e-6 ? [least, least + 1] : [least < 0 ? least * 1.08 : least, most * 1.08];
    }

    private drawGrid(pen: CanvasRenderingContext2D, width: number, height: number, x: (t: number) => number, y: (value: number) => number, least: number, most: number): void {
        pen.strokeStyle = colour("line");
        pen.fillStyle = colour("muted");
        pen.lineWidth = 1;
        pen.textBaseline = "middle";
        pen.textAlign = "right";
        for (const value of ticks(least, most, Math.max(3, Math.floor(height / 34)))) {
            line(pen, padding.left, Math.round(y(value)) + 0.5, width - padding.right, Math.round(y(value)) + 0.5);
            pen.fillText(short(value), padding.left - 6, y(value));
        }
        pen.textAlign = "center";
        for (const t of ticks(0, this.to - this.from, Math.max(2, Math.floor(width / 90)))) pen.fillText(`${short(t)} s`, x(this.from + t), height - 8);
    }

    /** At most two points per pixel: the least and the most between its edges. */
    private drawSeries(pen: CanvasRenderingContext2D, series: Series, x: (t: number) => number, y: (value: number) => number, width: number): void {
        const { times, values } = series;
        pen.strokeStyle = colour(series.colour);
        pen.lineWidth = 1.6;
        pen.setLineDash(series.dashed ? [5, 4] : []);
        pen.beginPath();
        const stride = Math.max(1, Math.floor(times.length / (width * 2)));
        let last = NaN;
        for (let at = 0; at < times.length; at += stride) {
            const px = x(times[at] ?? 0);
            const py = y(values[at] ?? 0);
            if (at === 0) pen.moveTo(px, py);
            else if (series.stepped) {
                pen.lineTo(px, last);
                pen.lineTo(px, py);
            } else pen.lineTo(px, py);
            last = py;
        }
        if (series.stepped && !Number.isNaN(last)) pen.lineTo(x(this.to), last);
        pen.stroke();
        pen.setLineDash([]);
    }

    private drawLegend(pen: CanvasRenderingContext2D, width: number): void {
        pen.textAlign = "left";
        pen.textBaseline = "middle";
        pen.fillStyle = colour("text");
        const title = `${this.title}${this.unit ? `, ${this.unit}` : ""}`;
        pen.fillText(title, 8, 9);
        let at = 20 + pen.measureText(title).width;
        for (const { label, colour: name } of this.series) {
            if (at > width - 40) return;
            pen.fillStyle = colour(name);
            pen.fillRect(at, 7, 10, 3);
            pen.fillStyle = colour("muted");
            pen.fillText(label, at + 14, 9);
            at += 26 + pen.measureText(label).width;
        }
    }
}

function line(pen: CanvasRenderingContext2D, x1: number, y1: number, x2: number, y2: number): void {
    pen.beginPath();
    pen.moveTo(x1, y1);
    pen.lineTo(x2, y2);
    pen.stroke();
}

/** Round numbers between two values. */
function ticks(from: number, to: number, count: number): number[] {
    const rough = (to - from) / count;
    const power = 10 ** Math.floor(Math.log10(rough));
    const step = power * ([1, 2, 5, 10].find((each) => each * power >= rough) ?? 10);
    const found: number[] = [];
    for (let value = Math.ceil(from / step) * step; value <= to + step * 1e-6; value += step) found.push(Math.abs(value) < step * 1e-6 ? 0 : value);
    return found;
}

function short(value: number): string {
    return Math.abs(value) >= 10000 ? `${(value / 1000).toFixed(0)}k` : String(Math.round(value * 100) / 100);
}
