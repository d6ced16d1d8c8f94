// Brings the parts together: one cursor, one time axis.

const axis = new TimeAxis();
const charts = makeCharts();
const stack = document.getElementById("charts");
const cursorLine = element("div", { class: "cursor" });
const rangeBox = element("div", { class: "range", hidden: "" });
const tip = document.getElementById("tip");
const state = { cursor: 0, held: false, selected: null };

stack.append(...charts.map((chart) => chart.node), cursorLine, rangeBox);
const view = new PathView(document.getElementById("view"), (t) => holdCursor(t));

function drawCharts() {
  for (const chart of charts) if (!chart.node.hidden) chart.draw(axis);
  placeCursor();
}

let chartsWaiting = false;
function drawChartsSoon() {
  if (chartsWaiting) return;
  chartsWaiting = true;
  requestAnimationFrame(() => {
    chartsWaiting = false;
    drawCharts();
  });
}

function placeCursor() {
  const x = axis.x(state.cursor, stack.clientWidth);
  cursorLine.hidden = x < gutter.left - 1 || x > stack.clientWidth - gutter.right + 1;
  cursorLine.style.left = x + "px";
  cursorLine.classList.toggle("held", state.held);
}

function setCursor(t) {
  state.cursor = Math.min(lastTime, Math.max(0, t));
  placeCursor();
  showValues(state.cursor, state.held);
  view.cursor = state.cursor;
  view.drawSoon();
}

function holdCursor(t) {
  state.held = true;
  if (t < axis.from || t > axis.to) {
    axis.set(t - (axis.to - axis.from) / 2, t + (axis.to - axis.from) / 2);
    drawChartsSoon();
  }
  setCursor(t);
}

/** From a row of a table: what it means is shown further up. */
function showPath() {
  document.getElementById("view").scrollIntoView({ block: "nearest", behavior: "smooth" });
}

function chooseMove(move) {
  showPath();
  state.selected = move;
  view.selected = move;
  selectLine(move);
  holdCursor(move.from);
}

function zoomToMove() {
  const move = state.selected || leadingRobot().moveAt(state.cursor);
  if (!move) return;
  const room = 0.1 * (move.to - move.from) + 0.02;
  axis.set(move.from - room, move.to + room);
  drawChartsSoon();
}

function zoomBy(factor) {
  const inside = state.cursor >= axis.from && state.cursor <= axis.to;
  axis.zoom(factor, inside ? state.cursor : (axis.from + axis.to) / 2);
  drawChartsSoon();
}

// ---- Mouse and keyboard on the charts

function stackX(event) {
  return event.clientX - stack.getBoundingClientRect().left;
}

function showTip(event) {
  const chart = charts.find((c) => c.canvas === event.target);
  const near = chart instanceof MarkerChart ? chart.near(axis, stackX(event), stack.clientWidth) : [];
  tip.hidden = near.length === 0;
  if (!near.length) return;
  tip.textContent = near.map((marker) => fixed(marker.time, 3) + " s  " + markerText(marker)).join("\n");
  tip.style.left = Math.min(event.clientX + 14, window.innerWidth - tip.offsetWidth - 8) + "px";
  tip.style.top = event.clientY + 16 + "px";
}

let drag = null;
stack.addEventListener("pointerdown", (event) => {
  if (event.button !== 0) return;
  drag = { x: stackX(event), pan: event.shiftKey, from: axis.from, to: axis.to, moved: false };
  stack.setPointerCapture(event.pointerId);
  stack.focus({ preventScroll: true });
});
stack.addEventListener("pointermove", (event) => {
  const x = stackX(event), width = stack.clientWidth;
  if (!drag) {
    if (!state.held) setCursor(axis.timeAt(x, width));
    showTip(event);
    return;
  }
  if (Math.abs(x - drag.x) > 4) drag.moved = true;
  if (!drag.moved) return;
  if (drag.pan) {
    const shift = (drag.x - x) / (width - gutter.left - gutter.right) * (drag.to - drag.from);
    axis.set(drag.from + shift, drag.to + shift);
    drawChartsSoon();
    return;
  }
  rangeBox.hidden = false;
  rangeBox.style.left = Math.min(x, drag.x) + "px";
  rangeBox.style.width = Math.abs(x - drag.x) + "px";
});
stack.addEventListener("pointerup", (event) => {
  if (!drag) return;
  const x = stackX(event), width = stack.clientWidth;
  rangeBox.hidden = true;
  if (drag.moved && !drag.pan) {
    axis.set(axis.timeAt(Math.min(x, drag.x), width), axis.timeAt(Math.max(x, drag.x), width));
    drawChartsSoon();
  } else if (!drag.moved) {
    state.held = !state.held;
    setCursor(axis.timeAt(x, width));
  }
  drag = null;
});
stack.addEventListener("pointercancel", () => { drag = null; rangeBox.hidden = true; });
stack.addEventListener("pointerleave", () => { tip.hidden = true; });
stack.addEventListener("dblclick", () => { axis.set(0, lastTime); drawChartsSoon(); });
stack.addEventListener("wheel", (event) => {
  if (!event.ctrlKey && !event.altKey) return;
  event.preventDefault();
  axis.zoom(Math.exp(event.deltaY * 0.0015), axis.timeAt(stackX(event), stack.clientWidth));
  drawChartsSoon();
}, { passive: false });
stack.addEventListener("keydown", (event) => {
  const { time, count } = leadingRobot(), i = indexAt(time, state.cursor), step = event.shiftKey ? 25 : 1;
  if (event.key === "ArrowRight") holdCursor(time[Math.min(count - 1, i + step)] || 0);
  else if (event.key === "ArrowLeft") holdCursor(time[Math.max(0, i - step)] || 0);
  else if (event.key === "Home") holdCursor(0);
  else if (event.key === "End") holdCursor(lastTime);
  else if (event.key === "+" || event.key === "=") zoomBy(0.5);
  else if (event.key === "-") zoomBy(2);
  else if (event.key === "0") { axis.set(0, lastTime); drawChartsSoon(); }
  else if (event.key === "Escape") { state.held = false; setCursor(state.cursor); }
  else return;
  event.preventDefault();
});

// ---- Buttons

document.getElementById("zoom-in").addEventListener("click", () => zoomBy(0.5));
document.getElementById("zoom-out").addEventListener("click", () => zoomBy(2));
document.getElementById("zoom-all").addEventListener("click", () => { axis.set(0, lastTime); drawChartsSoon(); });
document.getElementById("zoom-move").addEventListener("click", zoomToMove);
for (const button of document.querySelectorAll("[data-view]"))
  button.addEventListener("click", () => view.look(button.dataset.view));
for (const name of ["zones", "names", "signals", "other"])
  document.getElementById("show-" + name).addEventListener("change", (event) => {
    view.shown[name] = event.target.checked;
    view.drawSoon();
  });

document.getElementById("colour").addEventListener("change", (event) => {
  view.byRobot = event.target.value === "robot";
  document.getElementById("scale").hidden = view.byRobot;
  view.drawSoon();
});

/** Boxes that show and hide robots. */
function addRobotBoxes() {
  const bar = document.getElementById("robot-boxes");
  bar.hidden = false;
  document.getElementById("colour-label").hidden = arms.length < 2;
  for (const robot of robots) {
    const box = element("input", { type: "checkbox", checked: "" });
    box.addEventListener("change", () => showRobot(robot, box.checked));
    bar.append(element("label", {}, box, " ", swatch(robot), robot.unit));
  }
}

function showRobot(robot, shown) {
  robot.shown = shown;
  for (const chart of charts) if (chart.robot === robot) chart.node.hidden = !shown;
  view.collect();
  view.drawSoon();
  drawChartsSoon();
  setCursor(state.cursor);
}

// ---- The page as a whole

function drawAll() {
  readColours();
  view.draw();
  drawCharts();
}

/** Paper is white, whatever the screen is. */
function print(on) {
  printing = on;
  document.documentElement.classList.toggle("print", on);
  drawAll();
}

document.getElementById("scale").append("0", element("i"), topSpeed.toFixed(0) + " mm/s");
showOverview();
showMoves(chooseMove);
showEvents((t) => {
  showPath();
  holdCursor(t);
});
showComparison(chooseMove);
if (several) addRobotBoxes();
document.getElementById("other-label").hidden = robots.every((robot) => robot.other.time.length === 0);
drawAll();
setCursor(leadingRobot().time[leadingRobot().firstShown] || 0);
new ResizeObserver(() => { view.drawSoon(); drawChartsSoon(); }).observe(document.querySelector("main"));
matchMedia("(prefers-color-scheme: dark)").addEventListener("change", drawAll);
window.addEventListener("beforeprint", () => print(true));
window.addEventListener("afterprint", () => print(false));
