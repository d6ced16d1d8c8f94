"""check_weaving.py TRACE.csv: the TCP follows the pattern of each seam of weaving.modx.

A pattern is a list of corners (mm along the seam in a cycle, mm to the left, mm up, mm forward), worked out by hand from the rule:
what dwells leave of a cycle is shared among its sides in proportion to their length across the seam. At its corners the TCP turns
with at most 10 m/s^2: the pattern is its mean over the mm on which the largest turn, at 40 mm/s along the seam, takes that long.
"""

import csv
import math
import sys

ZIGZAG = [(0, 0, 0), (2, 3, 0), (4, 0, 0), (6, -3, 0), (8, 0, 0)]
VEE = [(0, 0, 0), (2, 3, 3), (4, 0, 0), (6, -3, 3), (8, 0, 0)]
COS30, SIN30 = math.cos(math.radians(30)), 0.5

# name: x offset, numbers of the movement instructions, corners
PATTERNS = {
    # 10 mm, of which 1 + 2 * 0.5 + 2 are dwells: 6 mm for four sides of 3 mm; height has no meaning
    "zigzag": (0, (2,), [(0, 0, 0), (0.5, 0, 0), (2, 3, 0), (3, 3, 0), (4.5, 0, 0), (5, 0, 0), (6.5, -3, 0), (8.5, -3, 0), (10, 0, 0)]),
    "vee": (10, (4,), VEE),
    # sides 5, 6 and 5 mm long in 16 mm
    "triangle": (20, (6,), [(0, 0, 0), (5, 3, 4), (11, -3, 4), (16, 0, 0)]),
    "circle": (30, (8,), None),
    "biased": (40, (10,), [(d, left + 2, up) for d, left, up in ZIGZAG]),
    # weave_ori 90: turned about the seam, the left becomes up
    "turned": (50, (12,), [(d, 0, left) for d, left, up in ZIGZAG]),
    # weave_dir 30: the left turns backwards
    "skew": (60, (14,), [(d, left * COS30, up, -left * SIN30) for d, left, up in ZIGZAG]),
    # weave_tilt 90: up, here 1 mm, becomes forward
    "leaning": (70, (16,), [(d, left, 0, up / 3) for d, left, up in VEE]),
    # weave_type 2: 5 cycles a second at 40 mm/s are 8 mm
    "byTime": (80, (18,), ZIGZAG),
    "none": (100, (22,), [(0, 0, 0), (8, 0, 0)]),
    "corner": (110, (24, 25), VEE),
}


def pattern(corners, along):
    if corners is None:
        angle = 2 * math.pi * (along % 8) / 8
        return 3 * math.sin(angle), 2 * (1 - math.cos(angle)), 0
    inside = along % corners[-1][0]
    for a, b in zip(corners, corners[1:]):
        if inside <= b[0]:
            share = (inside - a[0]) / (b[0] - a[0])
            values = [p + share * (q - p) for p, q in zip(a[1:], b[1:])]
            return tuple(values + [0])[:3]
    raise ValueError(along)


def rounded(corners, along):
    if corners is None or len(corners) == 2:
        return pattern(corners, along)
    sides = [(math.dist(a[1:], b[1:]), b[0] - a[0]) for a, b in zip(corners, corners[1:])]
    steepest = sum(across for across, _ in sides) / sum(way for across, way in sides if across > 0)
    width = 40**2 * 2 * steepest / 10_000
    parts = 16
    places = [pattern(corners, along + width * ((k + 0.5) / parts - 0.5)) for k in range(parts)]
    return tuple(sum(values) / parts for values in zip(*places))


def along(row, corners):
    """mm along the seam: where the pattern, which may lead forward, is at this y."""
    guess = row["y"] + 30
    if corners is None or not any(corner[3:] for corner in corners):
        return guess
    for _ in range(60):
        guess += 0.5 * (row["y"] + 30 - rounded(corners, guess)[2] - guess)
    return guess


def main():
    with open(sys.argv[1], encoding="utf-8") as file:
        rows = [{k: float(row[k]) for k in ("x", "y", "z", "move")} for row in csv.DictReader(file)]
    for name, (offset, moves, corners) in PATTERNS.items():
        quarter = 2 if corners is None else corners[-1][0] / 4
        worst = count = 0
        for row in rows:
            place = row["move"] in moves and along(row, corners)
            # The last quarter of a cycle leads to the end of the seam, the first one to the bias.
            if not place or not quarter < place < 60 - quarter - 1:
                continue
            left, up, forward = rounded(corners, place)
            wanted = (340 + offset - left, place - 30 + forward, 450 + up)
            worst = max(worst, math.dist((row["x"], row["y"], row["z"]), wanted))
            count += 1
        # mm of path and mm of the corner's curve differ a little
        good = count > 200 and worst < (0.15 if len(moves) > 1 else 0.02)
        print(name, "ok" if good else f"{count} samples, off by {worst:.3f} mm")
    steps = [math.dist([a[k] for k in "xyz"], [b[k] for k in "xyz"]) for a, b in zip(rows, rows[1:])]
    print("longest step", "ok" if max(steps) < 0.81 else max(steps))  # 200 mm/s between the seams
    # Across the seams, where the speed along them is even: second differences of samples 4 ms apart. On the way back at the end
    # the pattern and its end together may take twice as much.
    sharpest = 0
    for a, b, c in zip(rows, rows[1:], rows[2:]):
        if a["move"] == c["move"] and a["move"] in (2, 4, 6, 8, 10, 12) and -28 < a["y"] < 30:
            bend = [a[k] - 2 * b[k] + c[k] for k in "xz"]
            share = 1 if c["y"] < 26 else 0.5
            sharpest = max(sharpest, share * math.hypot(*bend) / 0.004**2)
    print("acceleration", "ok" if sharpest < 10_500 else sharpest)
    wide = [(r["y"], abs(r["x"] - 430)) for r in rows if r["move"] == 20]
    before, after = (max(w for y, w in wide if low < y < high) for low, high in ((-25, -5), (10, 25)))
    print("refreshed", "ok" if abs(before - 2.82) < 0.03 and abs(after - 4.5) < 0.03 else (before, after))
    for first in (2, 4):
        end = [r for r in rows if r["move"] == first][-1]
        print(f"end {end['y']:.2f} {end['z']:.2f}")


main()
