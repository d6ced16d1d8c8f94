"""corner_path.py RAPIDC SECONDS INPUT: runs a program in one process, then in pieces of so many seconds of virtual time with the
same --state. The TCP must have taken the same path: reports the greatest distance between the two, rounded up to 0.01 mm."""

import csv
import math
import pathlib
import subprocess
import sys
import tempfile

rapidc, seconds, program = sys.argv[1:]


def run(folder, *options):
    trace = pathlib.Path(folder) / "trace.csv"
    done = subprocess.run(
        [rapidc, "run", program, "--trace", trace, "--tick=1", *options], capture_output=True, text=True, timeout=120
    )
    with open(trace, encoding="utf-8") as lines:
        points = [tuple(float(row[k]) for k in "xyz") for row in csv.DictReader(lines)]
    return done.returncode, points, done.stderr


def distance(point, path):
    least = math.inf
    for a, b in zip(path, path[1:]):
        if math.dist(point, a) > least + 2:  # two points of a path are less than a millimetre apart
            continue
        way = [y - x for x, y in zip(a, b)]
        square = sum(w * w for w in way)
        share = sum((p - x) * w for p, x, w in zip(point, a, way)) / square if square > 0 else 0
        share = min(1, max(0, share))
        least = min(least, math.dist(point, [x + share * w for x, w in zip(a, way)]))
    return least


with tempfile.TemporaryDirectory() as folder:
    _, whole, _ = run(folder)
    parts, pieces, status, log = [], 0, 4, ""
    while status == 4 and pieces < 200:
        status, points, errors = run(folder, "--state=" + folder + "/state", "--max-time=" + seconds)
        if parts and math.dist(parts[-1], points[0]) > 0.3:
            print("begins elsewhere:", parts[-1], points[0])
        parts += points
        log += errors
        pieces += 1
most = max(max(distance(p, parts) for p in whole[::5]), max(distance(p, whole) for p in parts[::5]))
print(f"{'many' if pieces > 10 else pieces} pieces, status {status}, at most {math.ceil(100 * most) / 100:.2f} mm apart")
if "moved to main" in log:
    print(log)
