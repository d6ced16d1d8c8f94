"""corner_path.py RAPIDC SECONDS INPUT [HEIGHT] [OPTION]: runs a program in one process, then in pieces of so many seconds of virtual
time with the same --state. The TCP of each robot must have taken the same path: reports the greatest distance between the two, rounded up
to 0.01 mm. HEIGHT: only places at this z count."""

import csv
import itertools
import math
import pathlib
import subprocess
import sys
import tempfile

rapidc, seconds, program, *rest = sys.argv[1:]
height = float(rest.pop(0)) if rest and not rest[0].startswith("-") else None


def run(folder, *options):
    trace = pathlib.Path(folder) / "trace.csv"
    done = subprocess.run(
        [rapidc, "run", program, "--trace", trace, "--tick=1", *rest, *options],
        capture_output=True,
        text=True,
        timeout=120,
    )
    paths = {}
    with open(trace, encoding="utf-8") as lines:
        for row in csv.DictReader(lines):
            paths.setdefault(row.get("unit", ""), []).append(tuple(float(row[k]) for k in "xyz"))
    return done.returncode, paths, done.stderr


def pieces_of(path):
    """The chords of the path by the places of their beginnings in mm."""
    chords = {}
    for a, b in zip(path, path[1:]):
        if a != b:
            chords.setdefault(tuple(round(x / 2) for x in a), []).append((a, b))
    return chords


def distance(point, chords):
    least = math.inf
    near = [range(round(x / 2) - 1, round(x / 2) + 2) for x in point]
    for a, b in (chord for place in itertools.product(*near) for chord in chords.get(place, [])):
        way = [y - x for x, y in zip(a, b)]
        square = sum(w * w for w in way)
        share = sum((p - x) * w for p, x, w in zip(point, a, way)) / square if square > 0 else 0
        share = min(1, max(0, share))
        least = min(least, math.dist(point, [x + share * w for x, w in zip(a, way)]))
    return least


def counts(point):
    return height is None or abs(point[2] - height) < 1e-3


with tempfile.TemporaryDirectory() as folder:
    _, whole, _ = run(folder)
    parts, pieces, status, log = {}, 0, 4, ""
    while status == 4 and pieces < 300:
        status, paths, errors = run(folder, "--state=" + folder + "/state", "--max-time=" + seconds)
        for unit, points in paths.items():
            path = parts.setdefault(unit, [])
            if path and math.dist(path[-1], points[0]) > 0.3:
                print("begins elsewhere:", path[-1], points[0])
            path += points
        log += errors
        pieces += 1
most = 0
for unit, path in whole.items():
    for one, other in ((path, parts[unit]), (parts[unit], path)):
        chords = pieces_of(other)
        most = max(most, max(distance(p, chords) for p in one[::5] if counts(p)))
print(f"{'many' if pieces > 10 else pieces} pieces, status {status}, at most {math.ceil(100 * min(most, 1e3)) / 100:.2f} mm apart")
if "moved to main" in log:
    print(log)
