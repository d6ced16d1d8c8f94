"use strict";
// The data of the run: series as arrays of numbers, and what follows from them.

const run = JSON.parse(document.getElementById("data").textContent);

/** A series holds differences in its unit. */
function decode(series) {
  const source = series ? series.d : [];
  const result = new Float64Array(source.length);
  let sum = 0;
  for (let i = 0; i < source.length; i++) {
    sum += source[i];
    result[i] = sum * series.unit;
  }
  return result;
}

/** What one robot did, or external axes alone: samples, movements, and what follows from them. */
class RobotRun {
  constructor(data, index) {
    Object.assign(this, { unit: data.unit, model: data.robot, hasArm: data.hasArm, limits: data.limits, totals: data.totals,
      moves: data.moves, comparison: data.comparison, index, shown: true, colour: "r" + (index % 6 + 1) });
    this.time = decode(data.time);
    this.count = this.time.length;
    this.joints = [];
    for (let axis = 1; data["j" + axis]; axis++) this.joints.push(decode(data["j" + axis]));
    this.external = data.external.map((axis) => ({ ...axis, label: axis.name + " (eax_" + "abcdef"[axis.number - 1] + ")",
      values: decode(data["e" + axis.number]) }));
    this.position = { x: decode(data.x), y: decode(data.y), z: decode(data.z) };
    this.tcpSpeed = decode(data.speed);
    this.moveNumber = decode(data.move);
    this.other = { time: decode(data.otherTime), x: decode(data.otherX), y: decode(data.otherY), z: decode(data.otherZ) };
    this.compared = { time: decode(data.pathTime), distance: decode(data.pathDistance), delay: decode(data.pathDelay) };
    for (const move of this.moves) move.robot = this;
    this.moveByNumber = new Map(this.moves.map((move) => [move.n, move]));
    // A run begins with tool0; the first movement brings its own tool.
    this.firstShown = this.count > 1 && this.toolChanged(1) ? 1 : 0;
    this.jointSpeed = this.joints.map((angles) => this.speedsOf(angles));
    this.speedShare = this.jointSpeed.map((speeds, axis) => shares(speeds, this.limits.speed[axis]));
    this.accelerationShare = this.jointSpeed.map((speeds, axis) =>
      this.accelerationsOf(speeds).map((value, i) => Math.abs(value) / this.accelerationLimit(axis, i) * 100));
    this.programmedSpeed = this.programmed();
    this.otherSpeed = speedOfOther(this.other);
  }

  /** Another tool: the TCP is elsewhere without having moved there. */
  toolChanged(i) {
    const { x, y, z } = this.position;
    const way = Math.hypot(x[i] - x[i - 1], y[i] - y[i - 1], z[i] - z[i - 1]);
    return way > 1 && way > 2 * Math.max(this.tcpSpeed[i], this.tcpSpeed[i - 1]) * (this.time[i] - this.time[i - 1]);
  }

  /** Speed of an axis up to each sample, deg/s. */
  speedsOf(angles) {
    const result = new Float64Array(this.count);
    for (let i = 1; i < this.count; i++) {
      const step = this.time[i] - this.time[i - 1];
      result[i] = step > 0 ? (angles[i] - angles[i - 1]) / step : 0;
    }
    return result;
  }

  /** Acceleration at each sample: the change of speed from the time before it to the time after it, deg/s^2. */
  accelerationsOf(speeds) {
    const result = new Float64Array(this.count);
    for (let i = 1; i + 1 < this.count; i++) {
      const step = (this.time[i + 1] - this.time[i - 1]) / 2;
      result[i] = step > 0 ? (speeds[i + 1] - speeds[i]) / step : 0;
    }
    return result;
  }

  /** The largest acceleration the controller plans for an axis in the posture of a sample, deg/s^2. */
  accelerationLimit(axis, i) {
    const { axes, a1, a2, c2, c3 } = this.limits.dynamics;
    const limit = axes[axis];
    const q2 = this.joints[1][i] * Math.PI / 180;
    const q23 = q2 + (this.joints.length > 2 ? this.joints[2][i] : 0) * Math.PI / 180;
    const elbow = a1 + c2 * Math.sin(q2);
    const wrist = elbow - a2 * Math.sin(q23) + c3 * Math.cos(q23);
    const height = c2 * Math.cos(q2) - a2 * Math.cos(q23) - c3 * Math.sin(q23);
    const inertia = limit.base + limit.elbow * elbow ** 2 + limit.wrist * wrist ** 2 +
      limit.reach * ((wrist - a1) ** 2 + height ** 2);
    const most = inertia > 0 ? Math.min(1 / inertia, limit.most) : limit.most;
    return limit.scale * most * 180 / Math.PI;
  }

  /** The programmed speed of the movement in progress; not a number where there is none. */
  programmed() {
    const result = new Float64Array(this.count), time = this.time;
    for (let i = 0; i < this.count; i++) {
      const move = this.moveByNumber.get(this.moveNumber[i]);
      const during = move && move.from !== undefined && move.duration === undefined && time[i] >= move.from && time[i] <= move.to;
      result[i] = during ? move.speed : NaN;
    }
    return result;
  }

  placeAt(t) {
    const i = indexAt(this.time, t), { x, y, z } = this.position, time = this.time;
    if (i + 1 >= this.count) return this.count ? [x[i], y[i], z[i]] : [0, 0, 0];
    const share = time[i + 1] > time[i] ? Math.min(1, Math.max(0, (t - time[i]) / (time[i + 1] - time[i]))) : 0;
    return [x, y, z].map((p) => p[i] + (p[i + 1] - p[i]) * share);
  }

  moveAt(t) {
    const move = this.moveByNumber.get(this.moveNumber[indexAt(this.time, t)]);
    return move && move.from !== undefined ? move : undefined;
  }
}

function shares(values, limit) {
  return values.map((value) => (limit > 0 ? Math.abs(value) / limit * 100 : 0));
}

/** Speed of a recording, over 20 ms so that trembling does not show. */
function speedOfOther(other) {
  const result = new Float64Array(other.time.length);
  for (let i = 0, from = 0; i < other.time.length; i++) {
    while (from + 1 < i && other.time[i] - other.time[from] > 0.02) from++;
    const step = other.time[i] - other.time[from];
    result[i] = step > 0
      ? Math.hypot(other.x[i] - other.x[from], other.y[i] - other.y[from], other.z[i] - other.z[from]) / step : 0;
  }
  return result;
}

/** Index of the last value that is not above `value`; 0 when all are. */
function indexAt(values, value) {
  let low = 0, high = values.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (values[middle] <= value) low = middle + 1;
    else high = middle;
  }
  return Math.max(0, low - 1);
}

function signalValueAt(signal, t) {
  let value = signal.initial;
  for (const [when, next] of signal.changes) {
    if (when > t) break;
    value = next;
  }
  return value;
}

/** The largest of many numbers; Math.max takes too few arguments. */
function largest(values, least) {
  let result = least;
  for (const value of values) if (value > result) result = value;
  return result;
}

const robots = run.robots.map((data, index) => new RobotRun(data, index));
const several = robots.length > 1;
const arms = robots.filter((robot) => robot.hasArm);
const lastTime = Math.max(run.end, ...robots.map((robot) => (robot.count ? robot.time[robot.count - 1] : 0)), 0.004);
const topSpeed = robots.reduce((most, robot) => largest(robot.tcpSpeed, most), 1);

/** The robots that are shown, of these with a path. */
function shownArms() {
  return arms.filter((robot) => robot.shown);
}

/** The robot whose samples arrow keys step through. */
function leadingRobot() {
  return robots.find((robot) => robot.shown && robot.count) || robots[0];
}

function fixed(value, digits) {
  return Number.isFinite(value) ? value.toFixed(digits).replace(/^-(0(?:\.0*)?)$/, "$1") : "";
}

function element(name, attributes, ...children) {
  const node = document.createElement(name);
  for (const [key, value] of Object.entries(attributes || {})) node.setAttribute(key, value);
  node.append(...children.filter((child) => child !== null && child !== undefined));
  return node;
}

/** Colours of the style sheet, read again when the scheme changes. */
const colours = {};
function readColours() {
  const style = getComputedStyle(document.documentElement);
  for (const name of ["back", "panel", "text", "quiet", "line", "grid", "accent", "zone", "signal", "error", "warning",
    "other", "j1", "j2", "j3", "j4", "j5", "j6", "limit",
    "r1", "r2", "r3", "r4", "r5", "r6"]) {
    colours[name] = style.getPropertyValue("--" + name).trim();
  }
}
readColours();

let printing = false;

/** Fits a canvas to its size on the page; returns what to draw with, in CSS pixels. */
function prepareCanvas(canvas) {
  const ratio = Math.min(3, Math.max(window.devicePixelRatio || 1, printing ? 2 : 1));
  const width = canvas.clientWidth, height = canvas.clientHeight;
  canvas.width = Math.max(1, Math.round(width * ratio));
  canvas.height = Math.max(1, Math.round(height * ratio));
  const context = canvas.getContext("2d");
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  context.clearRect(0, 0, width, height);
  return { context, width, height };
}
