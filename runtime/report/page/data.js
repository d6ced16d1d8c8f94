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

const time = decode(run.time);
const joints = [1, 2, 3, 4, 5, 6].map((axis) => decode(run["j" + axis]));
const position = { x: decode(run.x), y: decode(run.y), z: decode(run.z) };
const tcpSpeed = decode(run.speed);
const moveNumber = decode(run.move);
const count = time.length;
const lastTime = Math.max(run.end, count ? time[count - 1] : 0, 0.004);
const other = { time: decode(run.otherTime), x: decode(run.otherX), y: decode(run.otherY), z: decode(run.otherZ) };
const moveByNumber = new Map(run.moves.map((move) => [move.n, move]));

/** Another tool: the TCP is elsewhere without having moved there. */
function toolChanged(i) {
  const way = Math.hypot(position.x[i] - position.x[i - 1], position.y[i] - position.y[i - 1],
    position.z[i] - position.z[i - 1]);
  return way > 1 && way > 2 * Math.max(tcpSpeed[i], tcpSpeed[i - 1]) * (time[i] - time[i - 1]);
}

/** A run begins with tool0; the first movement brings its own tool. */
const firstShown = count > 1 && toolChanged(1) ? 1 : 0;

/** Speed of an axis up to each sample, deg/s. */
function speedsOf(angles) {
  const result = new Float64Array(count);
  for (let i = 1; i < count; i++) {
    const step = time[i] - time[i - 1];
    result[i] = step > 0 ? (angles[i] - angles[i - 1]) / step : 0;
  }
  return result;
}

/** Acceleration at each sample: the change of speed from the time before it to the time after it, deg/s^2. */
function accelerationsOf(speeds) {
  const result = new Float64Array(count);
  for (let i = 1; i + 1 < count; i++) {
    const step = (time[i + 1] - time[i - 1]) / 2;
    result[i] = step > 0 ? (speeds[i + 1] - speeds[i]) / step : 0;
  }
  return result;
}

function shares(values, limit) {
  return values.map((value) => (limit > 0 ? Math.abs(value) / limit * 100 : 0));
}

const jointSpeed = joints.map(speedsOf);
const speedShare = jointSpeed.map((speeds, axis) => shares(speeds, run.limits.speed[axis]));
/** The largest acceleration the controller plans for an axis in the posture of a sample, deg/s^2. */
function accelerationLimit(axis, i) {
  const { axes, a1, a2, c2, c3 } = run.limits.dynamics;
  const limit = axes[axis];
  const q2 = joints[1][i] * Math.PI / 180;
  const q23 = q2 + (joints.length > 2 ? joints[2][i] : 0) * Math.PI / 180;
  const elbow = a1 + c2 * Math.sin(q2);
  const wrist = elbow - a2 * Math.sin(q23) + c3 * Math.cos(q23);
  const height = c2 * Math.cos(q2) - a2 * Math.cos(q23) - c3 * Math.sin(q23);
  const inertia = limit.base + limit.elbow * elbow ** 2 + limit.wrist * wrist ** 2 +
    limit.reach * ((wrist - a1) ** 2 + height ** 2);
  const most = inertia > 0 ? Math.min(1 / inertia, limit.most) : limit.most;
  return limit.scale * most * 180 / Math.PI;
}

const accelerationShare = jointSpeed.map((speeds, axis) =>
  accelerationsOf(speeds).map((value, i) => Math.abs(value) / accelerationLimit(axis, i) * 100));

/** The programmed speed of the movement in progress; not a number where there is none. */
const programmedSpeed = new Float64Array(count);
for (let i = 0; i < count; i++) {
  const move = moveByNumber.get(moveNumber[i]);
  const during = move && move.from !== undefined && move.duration === undefined && time[i] >= move.from && time[i] <= move.to;
  programmedSpeed[i] = during ? move.speed : NaN;
}

/** Speed of the recording, over 20 ms so that trembling does not show. */
const otherSpeed = new Float64Array(other.time.length);
for (let i = 0, from = 0; i < other.time.length; i++) {
  while (from + 1 < i && other.time[i] - other.time[from] > 0.02) from++;
  const step = other.time[i] - other.time[from];
  otherSpeed[i] = step > 0
    ? Math.hypot(other.x[i] - other.x[from], other.y[i] - other.y[from], other.z[i] - other.z[from]) / step : 0;
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

function placeAt(t) {
  const i = indexAt(time, t);
  if (i + 1 >= count) return count ? [position.x[i], position.y[i], position.z[i]] : [0, 0, 0];
  const share = time[i + 1] > time[i] ? Math.min(1, Math.max(0, (t - time[i]) / (time[i + 1] - time[i]))) : 0;
  return [position.x, position.y, position.z].map((p) => p[i] + (p[i + 1] - p[i]) * share);
}

function moveAt(t) {
  const move = moveByNumber.get(moveNumber[indexAt(time, t)]);
  return move && move.from !== undefined ? move : undefined;
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
const topSpeed = largest(tcpSpeed, 1);

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
    "other", "j1", "j2", "j3", "j4", "j5", "j6", "limit"]) {
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
