// Charts over time. They share the time axis, its zoom and the cursor.

const gutter = { left: 92, right: 14 };

class TimeAxis {
  constructor() {
    this.from = 0;
    this.to = lastTime;
  }

  set(from, to) {
    const span = Math.min(lastTime, Math.max(0.02, to - from));
    this.from = Math.min(Math.max(0, from), lastTime - span);
    this.to = this.from + span;
  }

  zoom(factor, around) {
    this.set(around - (around - this.from) * factor, around + (this.to - around) * factor);
  }

  x(t, width) {
    return gutter.left + (t - this.from) / (this.to - this.from) * (width - gutter.left - gutter.right);
  }

  timeAt(x, width) {
    return this.from + (x - gutter.left) / (width - gutter.left - gutter.right) * (this.to - this.from);
  }
}

/** Round numbers between two values, about `most` of them. */
function ticks(from, to, most) {
  const rough = (to - from) / Math.max(1, most), power = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 5, 10].map((f) => f * power).find((s) => s >= rough) || rough;
  const result = [];
  for (let k = Math.ceil(from / step - 1e-9); k * step <= to + step * 1e-6; k++) result.push(k * step);
  return { values: result, digits: Math.max(0, -Math.floor(Math.log10(step) + 1e-9)) };
}

/** One row of the stack: a name with a legend above a canvas. */
class Chart {
  constructor(name, unit, height, legend) {
    this.unit = unit;
    this.canvas = element("canvas", { style: "height:" + height + "px", role: "img", "aria-label": name });
    const line = element("div", { class: "name" }, name + (unit ? " (" + unit + ")" : ""));
    for (const [text, colour] of (legend || []).filter((entry) => entry[0]))
      line.append(element("span", {}, element("i", { style: "background:var(--" + colour + ")" }), text));
    this.node = element("div", { class: "chart" }, line, this.canvas);
  }

  /** Lines of the axes; `low` and `high` are the ends of the vertical one. */
  frame(axis, low, high, withTimes) {
    const drawing = prepareCanvas(this.canvas), { context, width, height } = drawing;
    const top = 6, bottom = height - (withTimes ? 20 : 6);
    const y = (value) => bottom - (value - low) / (high - low) * (bottom - top);
    context.font = "11px system-ui, sans-serif";
    context.lineWidth = 1;
    context.strokeStyle = colours.grid;
    context.fillStyle = colours.quiet;
    context.textAlign = "right";
    const rows = ticks(low, high, (bottom - top) / (height < 80 ? 14 : 26));
    for (const value of rows.values) {
      const at = Math.round(y(value)) + 0.5;
      context.beginPath();
      context.moveTo(gutter.left, at);
      context.lineTo(width - gutter.right, at);
      context.stroke();
      context.fillText(value.toFixed(rows.digits), gutter.left - 6, at + 4);
    }
    this.timeLines(axis, drawing, top, bottom, withTimes);
    return Object.assign(drawing, { y, top, bottom });
  }

  timeLines(axis, { context, width }, top, bottom, withTimes) {
    const columns = ticks(axis.from, axis.to, (width - gutter.left) / 90);
    context.textAlign = "center";
    context.strokeStyle = colours.grid;
    context.fillStyle = colours.quiet;
    for (const value of columns.values) {
      const at = Math.round(axis.x(value, width)) + 0.5;
      context.beginPath();
      context.moveTo(at, top);
      context.lineTo(at, bottom);
      context.stroke();
      if (withTimes) context.fillText(value.toFixed(columns.digits) + " s", at, bottom + 15);
    }
    context.strokeStyle = colours.line;
    context.strokeRect(gutter.left + 0.5, top + 0.5, width - gutter.left - gutter.right - 1, bottom - top - 1);
    context.textAlign = "left";
  }

  /** All drawing up to restore() stays between the axes. */
  clip({ context, width, top, bottom }) {
    context.save();
    context.beginPath();
    context.rect(gutter.left, top - 1, width - gutter.left - gutter.right, bottom - top + 2);
    context.clip();
  }
}

/** Draws a series; where many samples fall on one column of pixels, from the least to the largest of them. */
function drawSeries(axis, { context, width, y }, times, values, colour, options = {}) {
  const from = Math.max(0, indexAt(times, axis.from) - 1), to = Math.min(times.length - 1, indexAt(times, axis.to) + 1);
  context.strokeStyle = colour;
  context.lineWidth = options.width || 1.4;
  context.setLineDash(options.dash || []);
  context.beginPath();
  let open = false;
  for (let i = from; i <= to;) {
    const column = Math.floor(axis.x(times[i], width));
    let low = Infinity, high = -Infinity, first = NaN, last = NaN, next = i;
    for (; next <= to && Math.floor(axis.x(times[next], width)) === column; next++) {
      const value = values[next];
      if (Number.isNaN(value)) continue;
      if (Number.isNaN(first)) first = value;
      last = value;
      if (value < low) low = value;
      if (value > high) high = value;
    }
    if (Number.isNaN(first)) open = false;
    else {
      const x = next - i > 1 ? column + 0.5 : axis.x(times[i], width);
      if (open && options.steps) context.lineTo(x, y(options.before));
      if (open) context.lineTo(x, y(first));
      else context.moveTo(x, y(first));
      if (next - i > 2) {
        context.lineTo(x, y(low));
        context.lineTo(x, y(high));
      }
      context.lineTo(x, y(last));
      options.before = last;
      open = true;
    }
    i = next;
  }
  context.stroke();
  context.setLineDash([]);
}

/** Lines of several series over one vertical axis, perhaps with a limit. */
class LineChart extends Chart {
  constructor(name, unit, height, series, range, legend) {
    super(name, unit, height, legend || series.map((s) => [s.name, s.colour]));
    this.series = series;
    this.range = range;
  }

  draw(axis) {
    const drawing = this.frame(axis, this.range.low, this.range.high, this.withTimes);
    this.clip(drawing);
    if (this.range.limit !== undefined) {
      const { context, width } = drawing, at = drawing.y(this.range.limit);
      context.strokeStyle = colours.limit;
      context.setLineDash([6, 4]);
      context.lineWidth = 1;
      context.beginPath();
      context.moveTo(gutter.left, at);
      context.lineTo(width - gutter.right, at);
      context.stroke();
      context.setLineDash([]);
    }
    for (const s of this.series.filter((one) => !one.robot || one.robot.shown)) {
      drawSeries(axis, drawing, s.time, s.values, colours[s.colour], { dash: s.dash, steps: s.steps, width: s.width });
    }
    drawing.context.restore();
  }
}

/** Rows of bars: movements, digital signals. Each row: name and spans with from, to, colour, text. */
class BarChart extends Chart {
  constructor(name, rows, rowHeight) {
    super(name, "", rows.length * rowHeight + 8);
    this.rows = rows;
    this.rowHeight = rowHeight;
  }

  draw(axis) {
    const extra = this.withTimes ? 20 : 0;
    this.canvas.style.height = this.rows.length * this.rowHeight + 8 + extra + "px";
    const drawing = prepareCanvas(this.canvas), { context, width, height } = drawing;
    Object.assign(drawing, { top: 2, bottom: height - extra - 2 });
    context.font = "11px system-ui, sans-serif";
    this.timeLines(axis, drawing, drawing.top, drawing.bottom, this.withTimes);
    context.fillStyle = colours.text;
    context.textAlign = "right";
    this.rows.forEach((row, k) => {
      if (row.name) context.fillText(shortText(context, row.name, gutter.left - 8), gutter.left - 5, this.middle(k) + 4);
    });
    context.textAlign = "left";
    this.clip(drawing);
    this.rows.forEach((row, k) => this.drawRow(axis, drawing, row, k));
    context.restore();
  }

  middle(row) {
    return 4 + (row + 0.5) * this.rowHeight;
  }

  drawRow(axis, { context, width }, row, k) {
    const height = this.rowHeight - 5, top = this.middle(k) - height / 2;
    context.strokeStyle = colours.line;
    context.beginPath();
    context.moveTo(gutter.left, top + height);
    context.lineTo(width - gutter.right, top + height);
    context.stroke();
    let lastPixel = -1;
    for (const span of row.spans) {
      if (span.to < axis.from || span.from > axis.to) continue;
      const left = axis.x(span.from, width), right = axis.x(span.to, width);
      if (right < lastPixel + 0.5) continue; // many short spans in one pixel
      lastPixel = right;
      context.globalAlpha = span.faint ? 0.25 : 0.75;
      context.fillStyle = colours[span.colour];
      context.fillRect(left, top, Math.max(1, right - left - (span.text ? 1 : 0)), height);
      context.globalAlpha = 1;
      const room = Math.min(right, width - gutter.right) - Math.max(left, gutter.left) - 8;
      if (!span.text || room < 14) continue;
      const text = shortText(context, span.text, room);
      context.fillStyle = colours.text;
      if (text.length > 1) context.fillText(text, Math.max(left, gutter.left) + 4, top + height / 2 + 4);
    }
  }
}

/** Events and lines for the operator. */
class MarkerChart extends Chart {
  constructor(markers) {
    super("Events", "", 34, [["line for the operator", "accent"], ["information", "quiet"], ["warning", "warning"], ["error", "error"]]);
    this.markers = markers;
  }

  draw(axis) {
    const drawing = prepareCanvas(this.canvas), { context, width, height } = drawing;
    Object.assign(drawing, { top: 2, bottom: height - 2 });
    this.timeLines(axis, drawing, drawing.top, drawing.bottom, false);
    this.clip(drawing);
    let lastX = -10;
    for (const marker of this.markers) {
      const x = axis.x(marker.time, width), important = marker.kind === "error" || marker.kind === "warning";
      if (x < gutter.left - 8 || x > width || (x - lastX < 1 && !important)) continue;
      lastX = x;
      context.fillStyle = colours[markerColour(marker)];
      context.beginPath();
      context.moveTo(x, 6);
      context.lineTo(x + 5, 16);
      context.lineTo(x - 5, 16);
      context.fill();
      context.fillRect(x - 0.5, 16, 1, height - 20);
    }
    context.restore();
  }

  near(axis, x, width) {
    return this.markers.filter((marker) => Math.abs(axis.x(marker.time, width) - x) < 5).slice(0, 8);
  }
}

function markerColour(marker) {
  return { error: "error", warning: "warning", line: "accent" }[marker.kind] || "quiet";
}

function markerText(marker) {
  const title = marker.number ? marker.number + " " + (marker.title || "") : "";
  return [title, marker.text].filter(Boolean).join(": ");
}

function shortText(context, text, room) {
  if (context.measureText(text).width <= room) return text;
  let length = text.length;
  while (length > 0 && context.measureText(text.slice(0, length) + "…").width > room) length--;
  return length > 0 ? text.slice(0, length) + "…" : "";
}

/** Spans in which a digital signal is 1. */
function highSpans(signal) {
  const spans = [];
  let since = signal.initial ? 0 : null;
  for (const [t, value] of signal.changes) {
    if (value && since === null) since = t;
    if (!value && since !== null) {
      spans.push({ from: since, to: t, colour: "signal" });
      since = null;
    }
  }
  if (since !== null) spans.push({ from: since, to: lastTime, colour: "signal" });
  return spans;
}

function stepChart(signal) {
  const times = [0, ...signal.changes.map((c) => c[0]), lastTime];
  const values = [signal.initial, ...signal.changes.map((c) => c[1])];
  values.push(values[values.length - 1]);
  const low = Math.min(0, ...values.slice(0, 5000)), high = largest(values, low + 1e-3);
  return new LineChart(signal.name, signal.type, 56,
    [{ name: "", colour: "signal", time: times, values, steps: true }], { low, high: high + (high - low) * 0.1 });
}

/** A row for each robot. */
function moveRows() {
  return robots.map((robot) => {
    const moves = robot.moves.filter((move) => move.from !== undefined);
    const colour = several ? robot.colour : "accent";
    return { name: several ? robot.unit : "", spans: moves.map((move, k) => (
      { from: move.from, to: move.to, colour, faint: k % 2 === 1, text: move.point, move })) };
  });
}

function highest(values, least) {
  return values.reduce((most, series) => largest(series, most), least) * 1.08;
}

/** "ROB_2: axis speed". */
function titleOf(robot, title) {
  return several ? robot.unit + ": " + title[0].toLowerCase() + title.slice(1) : title;
}

function speedChart() {
  const series = [];
  for (const robot of arms) {
    const { time, tcpSpeed, programmedSpeed, other, otherSpeed } = robot;
    series.push({ name: several ? robot.unit : "TCP", colour: several ? robot.colour : "accent", time, values: tcpSpeed, width: 1.8, robot });
    if (other.time.length)
      series.push({ name: several ? "" : "recording", colour: "other", time: other.time, values: otherSpeed, dash: [4, 3], robot });
    series.push({ name: several ? "" : "programmed", colour: several ? robot.colour : "limit", time, values: programmedSpeed,
      dash: [5, 4], steps: true, robot });
  }
  const moves = arms.flatMap((robot) => robot.moves);
  const top = largest(moves.map((move) => move.speed).filter((v) => v <= 3 * topSpeed), topSpeed);
  const legend = several ? arms.map((robot) => [robot.unit, robot.colour]).concat([["dashed: programmed", "quiet"]]) : undefined;
  return new LineChart("TCP speed", "mm/s", 150, series, { low: 0, high: top * 1.08 }, legend);
}

/** Speeds and accelerations of the axes of one robot. */
function jointCharts(robot) {
  const joint = (values) => values.map((series, axis) => (
    { name: "axis " + (axis + 1), colour: "j" + (axis % 6 + 1), time: robot.time, values: series }));
  return [["Axis speed", robot.speedShare], ["Axis acceleration", robot.accelerationShare]].map(([title, values]) =>
    new LineChart(titleOf(robot, title), "% of the limit", 130, joint(values), { low: 0, high: highest(values, 100), limit: 100 }));
}

/** Positions of external axes: those that turn, and those that are linear. */
function externalCharts(robot) {
  return [[true, "°"], [false, "mm"]].map(([rotating, unit]) => {
    const axes = robot.external.filter((axis) => axis.rotating === rotating);
    if (!axes.length) return null;
    const low = -highest(axes.map((axis) => axis.values.map((v) => -v)), 0) / 1.08;
    const high = highest(axes.map((axis) => axis.values), 0) / 1.08, room = Math.max(1, high - low) * 0.06;
    const series = axes.map((axis, k) => ({ name: axis.label, colour: "j" + (k % 6 + 1), time: robot.time, values: axis.values }));
    return new LineChart(titleOf(robot, "External axes"), unit, 100, series, { low: low - room, high: high + room });
  }).filter(Boolean);
}

/** All charts, in the order in which they are shown. Those of one robot name it in `robot`. */
function makeCharts() {
  const charts = [new BarChart("Movements", moveRows(), 24)];
  if (arms.length) charts.push(speedChart());
  for (const robot of robots) {
    const own = [...robot.hasArm ? jointCharts(robot) : [], ...externalCharts(robot), ...comparisonCharts(robot)];
    for (const chart of own) chart.robot = robot;
    charts.push(...own);
  }
  charts.push(new MarkerChart(run.markers));
  const digital = run.signals.filter((s) => s.type === "DI" || s.type === "DO");
  if (digital.length) charts.push(new BarChart("Digital signals", digital.map((s) => ({ name: s.name, spans: highSpans(s) })), 20));
  for (const signal of run.signals) if (!digital.includes(signal)) charts.push(stepChart(signal));
  charts[charts.length - 1].withTimes = true;
  return charts;
}

function comparisonCharts(robot) {
  const { time, distance, delay } = robot.compared;
  if (!time.length) return [];
  const low = -largest(delay.map((v) => -v), 0), high = largest(delay, 0), room = Math.max(0.01, high - low) * 0.1;
  return [
    new LineChart(titleOf(robot, "Distance from the recording"), "mm", 90, [{ name: "", colour: "other", time, values: distance }],
      { low: 0, high: largest(distance, 0.1) * 1.1 }),
    new LineChart(titleOf(robot, "Later than the recording"), "s", 90,
      [{ name: "rising: slower here; falling: faster here", colour: "other", time, values: delay }],
      { low: low - room, high: high + room }),
  ];
}
