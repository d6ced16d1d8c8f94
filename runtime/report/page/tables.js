// Everything that is text: tiles, values at the cursor, movements, comparison, events.

const mostRows = 1000;

function tile(value, name) {
  return element("div", { class: "tile" }, element("b", {}, value), element("span", {}, name));
}

function share(part, whole) {
  return whole > 0 ? " (" + (100 * part / whole).toFixed(0) + " %)" : "";
}

/** Rows of a name, a bar and a number. */
function bars(rows) {
  const most = largest(rows.map((row) => Math.abs(row.value)), 1e-9);
  const node = element("div", { class: "bars" });
  for (const row of rows) {
    const width = (Math.abs(row.value) / most * 100).toFixed(1) + "%";
    node.append(element("span", {}, row.name),
      element("div", { style: "width:" + width + (row.colour ? ";background:var(--" + row.colour + ")" : "") }),
      element("span", {}, row.text));
  }
  return node;
}

function showOverview() {
  document.getElementById("title").textContent = run.program;
  const names = arms.map((robot) => (several ? robot.unit + " " : "") + robot.model);
  const assumed = [...new Set(arms.flatMap((robot) => robot.limits.assumed))];
  document.getElementById("subtitle").textContent = "simulated on " + names.join(", ") +
    (assumed.length ? "; assumed, not published: " + assumed.join(", ") : "");
  const tiles = document.getElementById("tiles");
  tiles.append(tile(fixed(run.end, 3) + " s", "cycle time"));
  if (several) showRobots();
  else tiles.append(...robotTiles(robots[0]));
  for (const robot of robots) showLosses(robot);
}

function robotTiles(robot) {
  const totals = robot.totals, compared = robot.comparison;
  const tiles = [tile(fixed(totals.moving, 3) + " s", "moving" + share(totals.moving, totals.cycle)),
    tile(fixed(totals.waiting, 3) + " s", "waiting" + share(totals.waiting, totals.cycle)),
    tile(String(movesRun(robot)), "movements"), tile((totals.length / 1000).toFixed(3) + " m", "path of the TCP")];
  if (compared && !compared.problem)
    tiles.push(tile(signed(compared.here - compared.there) + " s", "against the recording"),
      tile(fixed(compared.worst, 3) + " mm", "largest path distance"));
  return tiles;
}

function movesRun(robot) {
  return robot.moves.filter((move) => move.from !== undefined).length;
}

/** A line for each robot. */
function showRobots() {
  const compares = robots.some((robot) => robot.comparison && !robot.comparison.problem);
  const heads = [["robot", "text"], ["model", "text"], ["moving s"], ["waiting s"], ["movements"], ["path m"], ["lost s"]];
  if (compares) heads.push(["against the recording s"], ["largest path distance mm"]);
  const lines = robots.map((robot) => {
    const totals = robot.totals, compared = robot.comparison;
    const lost = totals.losses.reduce((sum, loss) => sum + loss[1], 0);
    const cells = [[robot.unit, "text"], [robot.hasArm ? robot.model : "external axes", "text"],
      [fixed(totals.moving, 3) + share(totals.moving, totals.cycle)], [fixed(totals.waiting, 3)], [String(movesRun(robot))],
      [robot.hasArm ? (totals.length / 1000).toFixed(3) : ""], [fixed(lost, 3)]];
    const isCompared = compared && !compared.problem;
    if (compares) cells.push([isCompared ? signed(compared.here - compared.there) : ""], [isCompared ? fixed(compared.worst, 3) : ""]);
    const line = row(...cells);
    line.firstChild.prepend(swatch(robot));
    return line;
  });
  document.getElementById("robots").append(table(heads, lines, "list"));
}

/** The colour of a robot. */
function swatch(robot) {
  return element("i", { class: "swatch", style: "background:var(--" + robot.colour + ")" });
}

function showLosses(robot) {
  const losses = robot.totals.losses.filter((loss) => loss[1] >= 0.0005).slice(0, 8);
  if (!losses.length) return;
  const whose = several ? robot.unit + ": time lost" : "Time lost";
  document.getElementById("losses").append(element("p", {}, whose + " against the programmed speeds, by what the robot was slowed by:"),
    bars(losses.map(([name, seconds]) => ({ name, value: seconds, text: fixed(seconds, 3) + " s",
      colour: several ? robot.colour : undefined }))));
}

function signed(value) {
  return (value > -0.0005 ? "+" : "−") + Math.abs(value).toFixed(3);
}

function row(...cells) {
  const line = element("tr");
  for (const [text, kind] of cells) line.append(element("td", kind ? { class: kind } : {}, text));
  return line;
}

function table(heads, rows, kind) {
  const head = element("tr");
  for (const [text, style] of heads) head.append(element("th", style ? { class: style, scope: "col" } : { scope: "col" }, text));
  return element("table", { class: kind }, element("thead", {}, head), element("tbody", {}, ...rows));
}

/** A row that chooses something when it is clicked, or by the Enter key. */
function choosable(line, act) {
  line.tabIndex = 0;
  line.addEventListener("click", act);
  line.addEventListener("keydown", (event) => {
    if (event.key !== "Enter") return;
    act();
    event.preventDefault();
  });
  return line;
}

const moveLines = new Map();

function moveLine(move, choose) {
  const zone = move.stop ? "fine" : move.zone + " mm", ran = move.from !== undefined;
  const programmed = move.duration ? move.duration + " s" : fixed(move.speed, 0);
  const line = row(...robotCell(move.robot), [String(move.n)], [move.place, "text"], [move.what, "text"], [move.point, "text"], [zone], [programmed],
    [ran ? fixed(move.from, 3) : "did not run"], [ran ? fixed(move.to, 3) : ""], [ran ? fixed(move.to - move.from, 3) : ""],
    [fixed(move.reached, 0)], [ran ? move.verdict : "", "wide"]);
  if (ran && move.losses.length)
    line.title = "lost: " + move.losses.map(([name, seconds]) => name + " " + fixed(seconds, 3) + " s").join(", ");
  if (ran) choosable(line, () => choose(move));
  moveLines.set(move, line);
  return line;
}

/** The cell of a table that names the robot; none where there is one robot only. */
function robotCell(robot) {
  return several ? [[robot.unit, "text " + robot.colour]] : [];
}

/** The movements of all robots, those that ran in order of time. */
function allMoves() {
  if (!several) return robots[0].moves;
  const when = new Map(); // one that did not run comes after the one before it
  for (const robot of robots) {
    let last = 0;
    for (const move of robot.moves) when.set(move, last = move.from === undefined ? last : move.from);
  }
  return robots.flatMap((robot) => robot.moves).sort((a, b) => when.get(a) - when.get(b));
}

function showMoves(choose) {
  const box = document.getElementById("moves");
  const moves = allMoves();
  const heads = [...several ? [["robot", "text"]] : [], ["#"], ["place", "text"], ["movement", "text"], ["point", "text"], ["zone"], ["mm/s"], ["from s"], ["to s"], ["takes s"],
    ["reached mm/s"], ["limited by", "wide"]];
  const shown = table(heads, moves.slice(0, mostRows).map((move) => moveLine(move, choose)), "list");
  box.append(moves.length ? shown : "The program has ordered no movement.");
  if (moves.length <= mostRows) return;
  const more = element("button", { type: "button" }, "Show all " + moves.length + " movements");
  more.addEventListener("click", () => {
    shown.tBodies[0].append(...moves.slice(mostRows).map((move) => moveLine(move, choose)));
    more.remove();
  });
  box.append(more);
}

function selectLine(move) {
  for (const line of document.querySelectorAll("#moves tr.selected")) line.classList.remove("selected");
  const line = move && moveLines.get(move);
  if (line) line.classList.add("selected");
}

function showEvents(choose) {
  const box = document.getElementById("events");
  const lines = run.markers.slice(0, mostRows).map((marker) => {
    const line = row([fixed(marker.time, 3)], [marker.kind, "text"], [markerText(marker), "wide"]);
    line.classList.add(marker.kind);
    return choosable(line, () => choose(marker.time));
  });
  box.append(lines.length ? table([["s"], ["kind", "text"], ["text", "wide"]], lines, "list") : "Nothing was written.");
  if (run.markers.length > mostRows) box.append(element("p", {}, "The first " + mostRows + " of " + run.markers.length + "."));
}

function showComparison(choose) {
  for (const robot of robots) if (robot.comparison) showComparisonOf(robot, choose);
}

function showComparisonOf(robot, choose) {
  const compared = robot.comparison;
  document.getElementById("comparison").hidden = false;
  const body = document.getElementById("comparison-body");
  if (several) body.append(element("h3", {}, swatch(robot), robot.unit));
  body.append(element("p", {}, "with " + compared.file + ", " + compared.samples + " samples" +
    (compared.atFlange ? "; it has axis angles only, so positions are those of the flange" : "")));
  if (compared.problem) {
    body.append(element("p", {}, compared.problem));
    return;
  }
  const difference = compared.here - compared.there;
  body.append(element("p", {}, "From 1 mm after the start to 1 mm before the end: " + fixed(compared.here, 3) + " s here, " +
    fixed(compared.there, 3) + " s in the recording, " + signed(difference) + " s (" +
    (100 * difference / Math.max(1e-9, compared.there)).toFixed(1) + " %)."),
  element("p", {}, "Path distance: median " + fixed(compared.median, 3) + " mm, 95 % within " + fixed(compared.most, 3) +
    " mm, worst " + fixed(compared.worst, 3) + " mm at " + fixed(compared.worstTime, 3) + " s, x y z " +
    compared.worstPlace.map((v) => v.toFixed(1)).join(" ") + "."));
  const parts = compared.parts.map((part) => ({ ...part, difference: part.here - part.there }))
    .filter((part) => Math.abs(part.difference) >= 0.001).sort((a, b) => Math.abs(b.difference) - Math.abs(a.difference));
  if (!parts.length) {
    body.append(element("p", {}, "No movement differs by a millisecond or more."));
    return;
  }
  const most = Math.abs(parts[0].difference);
  const lines = parts.slice(0, 40).map((part) => comparisonLine(robot, part, most, choose));
  const which = parts.length > 40 ? ", the largest 40 of " + parts.length + ":" : ", the largest first:";
  body.append(element("p", {}, "Parts of the difference" + which),
    element("div", { class: "scroll" }, table([["#"], ["place", "text"], ["movement", "text"], ["", "text"], ["here s"],
      ["recording s"], ["difference s"], ["", "text"]], lines, "list")));
}

function comparisonLine(robot, part, most, choose) {
  const move = robot.moveByNumber.get(part.n), slower = part.difference > 0;
  const line = row([String(part.n)], [move.place, "text"], [move.what, "text"], [part.waiting ? "waiting at its end" : "moving", "text"],
    [fixed(part.here, 3)], [fixed(part.there, 3)], [signed(part.difference), slower ? "slower" : "faster"], ["", "text"]);
  const width = Math.abs(part.difference) / most * 120;
  line.lastChild.append(element("span", { class: "bar", style: "width:" + width.toFixed(0) + "px;background:var(--" +
    (slower ? "error" : "signal") + ")" }), slower ? " slower here" : " faster here");
  return choosable(line, () => choose(move));
}

function valueTable(rows) {
  const lines = rows.map((cells) => element("tr", {}, ...cells.map((text) => element("td", {}, text))));
  return element("table", {}, element("tbody", {}, ...lines));
}

/** Everything at one time. */
function showValues(t, held) {
  const shown = robots.filter((robot) => robot.shown && robot.count);
  const signals = run.signals.map((signal) => [signal.name, String(signalValueAt(signal, t))]);
  const parts = [element("h3", {}, fixed(t, 3) + " s" + (held ? ", held" : ""))];
  if (!shown.length) parts.push(element("p", {}, several ? "No robot is shown." : "The run has no samples."));
  for (const robot of shown) parts.push(...robotValues(robot, t));
  if (signals.length) parts.push(element("h3", {}, "Signals"), valueTable(signals));
  document.getElementById("values").replaceChildren(...parts);
}

function robotValues(robot, t) {
  const i = indexAt(robot.time, t), move = robot.moveAt(t), place = robot.placeAt(t);
  const parts = several ? [element("h3", { class: "robot" }, swatch(robot), robot.unit)] : [];
  parts.push(element("div", {}, move ? "movement " + move.n + ", " + move.place : "before the first movement"),
    element("div", {}, move ? move.what : ""));
  if (robot.hasArm) {
    const axes = robot.joints.map((angles, axis) => [String(axis + 1), fixed(angles[i], 2) + "°",
      fixed(robot.speedShare[axis][i], 0) + " %", fixed(robot.accelerationShare[axis][i], 0) + " %"]);
    parts.push(element("h3", {}, "TCP"),
      valueTable([["speed", fixed(robot.tcpSpeed[i], 1) + " mm/s"], ["programmed", move ? fixed(move.speed, 0) + " mm/s" : ""],
        ["x", fixed(place[0], 2)], ["y", fixed(place[1], 2)], ["z", fixed(place[2], 2)]]),
      element("h3", {}, "Axes: angle, speed, acceleration"), valueTable(axes));
  }
  if (robot.external.length)
    parts.push(element("h3", {}, "External axes"),
      valueTable(robot.external.map((axis) => [axis.label, fixed(axis.values[i], 2) + (axis.rotating ? "°" : " mm")])));
  return parts;
}
