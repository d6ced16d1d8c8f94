// The path of the TCP in 3D, drawn without perspective.

const mostLabels = 400;

class PathView {
  constructor(canvas, choose) {
    this.canvas = canvas;
    this.choose = choose; // called with the time of the place that was clicked
    this.shown = { zones: true, names: true, signals: false, other: true };
    this.byRobot = false; // the colour of the path; else by speed
    this.cursor = 0;
    this.selected = null;
    this.collect();
    this.look("iso");
    this.listen();
  }

  /** What does not change: the middle, the points, the zones, the places at which signals change. */
  collect() {
    const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
    const take = (p, radius) => {
      for (let k = 0; k < 3; k++) {
        low[k] = Math.min(low[k], p[k] - radius);
        high[k] = Math.max(high[k], p[k] + radius);
      }
    };
    const points = new Map(), zones = new Map();
    for (const robot of shownArms()) {
      const { position, other } = robot;
      for (let i = robot.firstShown; i < robot.count; i++) take([position.x[i], position.y[i], position.z[i]], 0);
      for (let i = 0; i < other.time.length; i++) take([other.x[i], other.y[i], other.z[i]], 0);
      for (const move of robot.moves) {
        const key = move.end.map((v) => v.toFixed(0)).join(" ");
        if (!points.has(key + move.point)) points.set(key + move.point, { place: move.end, text: move.point });
        if (!move.stop && move.zone > 0) zones.set(key + " " + move.zone, { place: move.end, radius: move.zone });
        take(move.end, move.stop ? 0 : move.zone);
      }
    }
    if (!(low[0] <= high[0])) take([0, 0, 0], 50);
    this.points = [...points.values()];
    this.zones = [...zones.values()];
    this.low = low;
    this.middle = low.map((v, k) => (v + high[k]) / 2);
    this.size = Math.max(20, Math.hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]));
    this.high = high;
    const changes = new Map(), at = shownArms()[0]; // a signal belongs to no robot
    for (const signal of at ? run.signals : [])
      for (const [t, value] of signal.changes) {
        const place = at.placeAt(t), text = signal.name + " = " + value;
        changes.set(place.map((v) => v.toFixed(0)).join(" ") + text, { place, text });
      }
    this.changes = [...changes.values()];
  }

  look(view) {
    const views = { iso: [-0.65, 0.6], top: [0, Math.PI / 2], front: [-Math.PI / 2, 0], side: [0, 0] };
    if (views[view]) [this.yaw, this.pitch] = views[view];
    this.target = this.middle.slice();
    this.zoom = 0; // fitted when drawn
    this.draw();
  }

  /** Axes of the screen in world: to the right, and up. */
  axes() {
    const cy = Math.cos(this.yaw), sy = Math.sin(this.yaw), cp = Math.cos(this.pitch), sp = Math.sin(this.pitch);
    return { right: [cy, -sy, 0], up: [sy * sp, cy * sp, cp] };
  }

  prepare(width, height) {
    const { right, up } = this.axes();
    if (this.zoom === 0) this.fit(right, up, width, height);
    const scale = this.zoom, t = this.target;
    this.project = (x, y, z) => {
      const dx = x - t[0], dy = y - t[1], dz = z - t[2];
      return [width / 2 + scale * (dx * right[0] + dy * right[1] + dz * right[2]),
        height / 2 - scale * (dx * up[0] + dy * up[1] + dz * up[2])];
    };
  }

  /** Everything is seen, as large as it can be. */
  fit(right, up, width, height) {
    const low = [Infinity, Infinity], high = [-Infinity, -Infinity];
    const take = (x, y, z, radius) => {
      [right, up].forEach((way, k) => {
        const at = x * way[0] + y * way[1] + z * way[2];
        low[k] = Math.min(low[k], at - radius);
        high[k] = Math.max(high[k], at + radius);
      });
    };
    for (const { position, other, firstShown, count } of shownArms()) {
      for (let i = firstShown; i < count; i++) take(position.x[i], position.y[i], position.z[i], 0);
      for (let i = 0; i < other.time.length; i++) take(other.x[i], other.y[i], other.z[i], 0);
    }
    for (const zone of this.zones) take(...zone.place, zone.radius);
    if (!(low[0] <= high[0])) take(0, 0, 0, 50);
    const spans = [0, 1].map((k) => Math.max(high[k] - low[k], this.size * 0.1));
    this.zoom = Math.min((width - 140) / spans[0], (height - 70) / spans[1]);
    // The middle of what is seen; its depth does not matter.
    const shift = [right, up].map((way, k) => (low[k] + high[k]) / 2 - this.middle.reduce((sum, v, n) => sum + v * way[n], 0));
    this.target = this.middle.map((v, n) => v + shift[0] * right[n] + shift[1] * up[n]);
  }

  draw() {
    const { context, width, height } = prepareCanvas(this.canvas);
    this.prepare(width, height);
    context.font = "11px system-ui, sans-serif";
    context.lineJoin = "round";
    this.drawGrid(context);
    if (this.shown.zones) this.drawZones(context);
    for (const robot of shownArms()) {
      if (this.shown.other) this.drawOther(context, robot.other);
      if (arms.length > 1 && !this.byRobot) this.drawLine(context, robot, 8, 0.22);
      if (this.byRobot) this.drawLine(context, robot, 2, 1);
      else this.drawPath(context, robot);
    }
    if (this.selected && this.selected.robot.shown) this.drawSelected(context, this.selected.robot);
    const labels = new Labels(width, height);
    this.drawPoints(context, labels);
    if (this.shown.signals) this.drawSignals(context, labels);
    this.drawTriad(context, height);
    this.drawCursor(context);
  }

  drawGrid(context) {
    let step = 10 ** Math.floor(Math.log10(this.size / 4));
    if (this.size / step > 24) step *= 2.5;
    const floor = this.low[2];
    const from = [0, 1].map((k) => Math.floor(this.low[k] / step) * step);
    const to = [0, 1].map((k) => Math.ceil(this.high[k] / step) * step);
    context.strokeStyle = colours.grid;
    context.lineWidth = 1;
    context.beginPath();
    for (let x = from[0]; x <= to[0] + step / 2; x += step) {
      context.moveTo(...this.project(x, from[1], floor));
      context.lineTo(...this.project(x, to[1], floor));
    }
    for (let y = from[1]; y <= to[1] + step / 2; y += step) {
      context.moveTo(...this.project(from[0], y, floor));
      context.lineTo(...this.project(to[0], y, floor));
    }
    context.stroke();
    context.fillStyle = colours.quiet;
    context.fillText("grid " + step + " mm, at z " + floor.toFixed(0), 12, 20);
  }

  drawZones(context) {
    context.lineWidth = 1;
    for (const zone of this.zones) {
      const [x, y] = this.project(...zone.place);
      context.beginPath();
      context.arc(x, y, zone.radius * this.zoom, 0, 2 * Math.PI);
      context.globalAlpha = 0.12;
      context.fillStyle = colours.zone;
      context.fill();
      context.globalAlpha = 0.8;
      context.strokeStyle = colours.zone;
      context.stroke();
      context.globalAlpha = 1;
    }
  }

  /** The whole path in the colour of its robot. */
  drawLine(context, robot, width, alpha) {
    const { position, count } = robot, stride = this.stride(count);
    context.strokeStyle = colours[robot.colour];
    context.lineWidth = width;
    context.globalAlpha = alpha;
    context.lineCap = "round";
    context.beginPath();
    let lastX = -1e9, lastY = -1e9;
    for (let i = robot.firstShown; i < count; i += stride) {
      const [x, y] = this.project(position.x[i], position.y[i], position.z[i]);
      if (i === robot.firstShown || (stride === 1 && robot.toolChanged(i))) context.moveTo(x, y);
      else if (Math.abs(x - lastX) + Math.abs(y - lastY) < 0.7 && i + stride < count) continue;
      else context.lineTo(x, y);
      lastX = x;
      lastY = y;
    }
    context.stroke();
    context.globalAlpha = 1;
    context.lineCap = "butt";
  }

  /** The pieces of one shade in one stroke; points that fall on the pixel before are left out. */
  drawPath(context, robot) {
    const { position, tcpSpeed, count } = robot;
    const shades = 24;
    context.lineWidth = 2;
    let shade = -1, lastX = 0, lastY = 0, open = false;
    const stroke = () => {
      if (open) context.stroke();
      open = false;
    };
    const stride = this.stride(count);
    for (let i = 0; i < count; i += stride) {
      const [x, y] = this.project(position.x[i], position.y[i], position.z[i]);
      if (i > 0 && stride === 1 && robot.toolChanged(i)) {
        stroke();
        shade = -1;
      } else if (i > 0) {
        const next = Math.min(shades, Math.round(tcpSpeed[i] / topSpeed * shades));
        if (open && next === shade && Math.abs(x - lastX) + Math.abs(y - lastY) < 0.7 && i + stride < count) continue;
        if (next !== shade || !open) {
          if (open) context.lineTo(x, y);
          stroke();
          context.beginPath();
          context.strokeStyle = "hsl(" + (220 - 220 * next / shades).toFixed(0) + ",80%,48%)";
          context.moveTo(lastX, lastY);
          shade = next;
          open = true;
        }
        context.lineTo(x, y);
      }
      lastX = x;
      lastY = y;
    }
    stroke();
  }

  /** While the picture turns, 20,000 samples will do. */
  stride(samples) {
    return this.turning ? Math.ceil(samples / 20000) : 1;
  }

  drawSelected(context, { time, position }) {
    const from = indexAt(time, this.selected.from), to = indexAt(time, this.selected.to);
    context.strokeStyle = colours.accent;
    context.globalAlpha = 0.35;
    context.lineWidth = 9;
    context.beginPath();
    for (let i = from; i <= to; i++) context.lineTo(...this.project(position.x[i], position.y[i], position.z[i]));
    context.stroke();
    context.globalAlpha = 1;
  }

  drawOther(context, other) {
    context.strokeStyle = colours.other;
    context.lineWidth = 1.4;
    if (other.time.length < 20000) context.setLineDash([5, 4]); // dashes of long lines take long to draw
    context.beginPath();
    let lastX = -1e9, lastY = -1e9;
    for (let i = 0; i < other.time.length; i += this.stride(other.time.length)) {
      const [x, y] = this.project(other.x[i], other.y[i], other.z[i]);
      if (Math.abs(x - lastX) + Math.abs(y - lastY) < 0.7) continue;
      context.lineTo(x, y);
      lastX = x;
      lastY = y;
    }
    context.stroke();
    context.setLineDash([]);
  }

  drawPoints(context, labels) {
    const places = this.points.map((point) => this.project(...point.place));
    context.fillStyle = colours.text;
    places.forEach(([x, y]) => {
      context.beginPath();
      context.arc(x, y, 2.6, 0, 2 * Math.PI);
      context.fill();
      labels.keepFree(x, y, 4);
    });
    if (!this.shown.names) return;
    const entries = this.points.map((point, i) => ({ x: places[i][0], y: places[i][1], text: point.text })).slice(0, mostLabels);
    entries.sort((a, b) => /^line \d/.test(a.text) - /^line \d/.test(b.text)); // names say more than lines
    for (const { x, y, text } of groupLabels(entries)) labels.draw(context, x, y, text, colours.text);
  }

  drawSignals(context, labels) {
    const entries = [];
    for (const change of this.changes) {
      const [x, y] = this.project(...change.place);
      context.fillStyle = colours.signal;
      context.beginPath();
      context.moveTo(x, y - 5);
      context.lineTo(x + 5, y);
      context.lineTo(x, y + 5);
      context.lineTo(x - 5, y);
      context.fill();
      entries.push({ x, y, text: change.text });
    }
    for (const { x, y, text } of groupLabels(entries.slice(0, mostLabels))) labels.draw(context, x, y, text, colours.signal);
  }

  /** Directions of the world's axes, in the upper right corner of the picture. */
  drawTriad(context, height) {
    const { right, up } = this.axes(), x = this.canvas.clientWidth - 50, y = Math.min(60, height / 4), length = 30;
    [["x", colours.error], ["y", colours.signal], ["z", colours.accent]].forEach(([name, colour], k) => {
      const endX = x + right[k] * length, endY = y - up[k] * length;
      context.strokeStyle = context.fillStyle = colour;
      context.lineWidth = 2;
      context.beginPath();
      context.moveTo(x, y);
      context.lineTo(endX, endY);
      context.stroke();
      if (Math.hypot(right[k], up[k]) > 0.15) context.fillText(name, endX + 4 * Math.sign(right[k]) - 2, endY - 3);
    });
  }

  drawCursor(context) {
    for (const robot of shownArms()) {
      if (!robot.count) continue;
      const [x, y] = this.project(...robot.placeAt(this.cursor));
      context.lineWidth = 2;
      context.strokeStyle = several ? colours[robot.colour] : colours.text;
      context.fillStyle = colours.back;
      context.beginPath();
      context.arc(x, y, 5, 0, 2 * Math.PI);
      context.fill();
      context.stroke();
    }
  }

  listen() {
    let drag = null;
    this.canvas.addEventListener("pointerdown", (event) => {
      drag = { x: event.clientX, y: event.clientY, moved: false, pan: event.shiftKey || event.button !== 0 };
      this.canvas.setPointerCapture(event.pointerId);
    });
    this.canvas.addEventListener("pointermove", (event) => {
      if (!drag) return;
      const dx = event.clientX - drag.x, dy = event.clientY - drag.y;
      if (!drag.moved && Math.hypot(dx, dy) < 4) return;
      drag.moved = true;
      drag.x = event.clientX;
      drag.y = event.clientY;
      if (drag.pan) this.pan(dx, dy);
      else this.turn(dx * 0.008, dy * 0.008);
    });
    this.canvas.addEventListener("pointerup", (event) => {
      if (drag && !drag.moved && !drag.pan) this.pick(event);
      drag = null;
    });
    this.canvas.addEventListener("pointercancel", () => { drag = null; });
    this.canvas.addEventListener("contextmenu", (event) => event.preventDefault());
    this.canvas.addEventListener("wheel", (event) => {
      event.preventDefault();
      const box = this.canvas.getBoundingClientRect();
      this.zoomBy(Math.exp(-event.deltaY * 0.0015), event.clientX - box.left, event.clientY - box.top);
    }, { passive: false });
    this.canvas.addEventListener("keydown", (event) => this.key(event));
  }

  key(event) {
    const step = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[event.key];
    const middle = [this.canvas.clientWidth / 2, this.canvas.clientHeight / 2];
    if (step && event.shiftKey) this.pan(-30 * step[0], -30 * step[1]);
    else if (step) this.turn(0.1 * step[0], 0.1 * step[1]);
    else if (event.key === "+" || event.key === "=") this.zoomBy(1.2, ...middle);
    else if (event.key === "-") this.zoomBy(1 / 1.2, ...middle);
    else if (event.key === "0" || event.key === "Home") this.look("fit");
    else return;
    event.preventDefault();
  }

  turn(yaw, pitch) {
    this.yaw += yaw;
    this.pitch = Math.min(Math.PI / 2, Math.max(-Math.PI / 2, this.pitch + pitch));
    this.drawSoon();
  }

  pan(dx, dy) {
    const { right, up } = this.axes();
    this.target = this.target.map((v, k) => v + (-dx * right[k] + dy * up[k]) / this.zoom);
    this.drawSoon();
  }

  /** The place below the pointer stays there. */
  zoomBy(factor, x, y) {
    const dx = x - this.canvas.clientWidth / 2, dy = y - this.canvas.clientHeight / 2, { right, up } = this.axes();
    const shift = (1 - 1 / factor) / this.zoom;
    this.target = this.target.map((v, k) => v + (dx * right[k] - dy * up[k]) * shift);
    this.zoom *= factor;
    this.drawSoon();
  }

  drawSoon() {
    if (this.waiting) return;
    this.waiting = true;
    requestAnimationFrame(() => {
      this.waiting = false;
      this.turning = shownArms().reduce((sum, robot) => sum + robot.count + robot.other.time.length, 0) > 20000;
      this.draw();
      clearTimeout(this.rest);
      if (!this.turning) return;
      this.turning = false;
      this.rest = setTimeout(() => this.draw(), 200); // in full when it rests
    });
  }

  pick(event) {
    const box = this.canvas.getBoundingClientRect();
    const px = event.clientX - box.left, py = event.clientY - box.top;
    let nearest = 20 * 20, at = -1;
    for (const { position, time, count } of shownArms())
      for (let i = 0; i < count; i++) {
        const [x, y] = this.project(position.x[i], position.y[i], position.z[i]);
        const distance = (x - px) ** 2 + (y - py) ** 2;
        if (distance < nearest) {
          nearest = distance;
          at = time[i];
        }
      }
    if (at >= 0) this.choose(at);
  }
}
