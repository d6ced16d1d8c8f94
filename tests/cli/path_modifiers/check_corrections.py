"""check_corrections.py TRACE.csv: offsets of the TCP from the programmed path in corrections.modx."""

import csv
import math
import sys


def main():
    with open(sys.argv[1], encoding="utf-8") as file:
        rows = [{k: float(row[k]) for k in ("time_s", "x", "y", "z", "move", "speed_mm_s")} for row in csv.DictReader(file)]
    line = [(r["x"] - 380, r["z"] - 450) for r in rows if r["move"] == 2]
    settled = [i for i, (x, z) in enumerate(line) if math.dist((x, z), (3, 3)) < 1e-3]
    # The corrections come 0.5 s after the movement and take 5.2 mm at 100 mm/s on average 1.875 times slower, or 2000 mm/s^2.
    until = settled[0] * 0.004
    print("before", "ok" if all(math.dist(p, (0, 0)) < 1e-3 for p in line[:100]) else "no")
    print("blend", "ok" if 0.55 < until < 0.75 else until)
    print("line", "ok" if settled == list(range(settled[0], len(line))) else "no")
    radii = [math.dist((r["x"], r["y"]), (420, 0)) for r in rows if r["move"] == 5]
    away = [i for i, radius in enumerate(radii) if abs(radius - 42) < 2e-3]
    # CorrClear follows when 0.5 mm are left.
    print("circle", "ok" if len(away) > 295 and away == list(range(away[0], away[-1] + 1)) else (len(away), len(radii)))
    steps = [math.dist([a[k] for k in "xyz"], [b[k] for k in "xyz"]) for a, b in zip(rows, rows[1:])]
    print("longest step", "ok" if max(steps) < 500 * 0.004 and max(steps[len(steps) // 3:]) < 0.81 else max(steps))


main()
