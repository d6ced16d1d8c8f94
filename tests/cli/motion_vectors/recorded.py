"""The motion of a program between its last two rests, and figures of it, for the checks in motion_vectors and motion_rules."""

import csv
import math
import subprocess
import sys

NEAR = 0.06  # s around the moment nearest to a point, in which the smallest speed counts
STANDING = 0.8  # s; shorter rests belong to the motion


def samples(program, trace):
    """Time, place and speed at each sample of one run."""
    done = subprocess.run(
        [*sys.argv[1:2], "run", "--robot", "IRB 6640-180/2.55", "--trace", trace, *sys.argv[2:], str(program)],
        capture_output=True, text=True, timeout=120)
    if done.returncode != 0:
        sys.exit(f"{program.name}: {done.stdout}{done.stderr}")
    rows = list(csv.DictReader(open(trace)))
    return [(float(r["time_s"]), tuple(float(r[k]) for k in "xyz"), float(r["speed_mm_s"])) for r in rows]


def motion(rows):
    """The samples between the last two long rests."""
    rests, i = [], 0
    while i < len(rows):
        j = i
        while j + 1 < len(rows) and math.dist(rows[j + 1][1], rows[i][1]) < 1e-3:
            j += 1
        if rows[j][0] - rows[i][0] > STANDING:
            rests.append((i, j))
        i = j + 1
    return rows[rests[-2][1]:rests[-1][0] + 1]


def duration(rows):
    def crossing(a, b, target):
        da, db = math.dist(a[1], target), math.dist(b[1], target)
        return a[0] + (b[0] - a[0]) * (1 - da) / (db - da)

    first, last = rows[0][1], rows[-1][1]
    i = next(k for k, r in enumerate(rows) if math.dist(r[1], first) >= 1)
    j = max(k for k, r in enumerate(rows) if math.dist(r[1], last) >= 1)
    return crossing(rows[j], rows[j + 1], last) - crossing(rows[i - 1], rows[i], first)


def speed_at(rows, time):
    for a, b in zip(rows, rows[1:]):
        if a[0] <= time <= b[0]:
            return a[2] + (b[2] - a[2]) * (time - a[0]) / (b[0] - a[0])
    return math.inf


def passage(rows, point):
    """Nearest distance of the path to a point, and the smallest speed around that moment."""
    nearest, moment = math.inf, 0
    for a, b in zip(rows, rows[1:]):
        way = [y - x for x, y in zip(a[1], b[1])]
        square = sum(w * w for w in way)
        share = 0 if square == 0 else sum((p - x) * w for p, x, w in zip(point, a[1], way)) / square
        share = min(1, max(0, share))
        distance = math.dist(point, [x + share * w for x, w in zip(a[1], way)])
        if distance < nearest:
            nearest, moment = distance, a[0] + share * (b[0] - a[0])
    around = [r[2] for r in rows if abs(r[0] - moment) <= NEAR]
    return nearest, min(around + [speed_at(rows, moment - NEAR), speed_at(rows, moment + NEAR)])
