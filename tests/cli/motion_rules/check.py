"""check.py RAPIDC: runs the random programs of this folder on an IRB 6640-180/2.55 and compares their motion between the two
WaitTime with expected.tsv: duration within 0.3 %, points of the path within 0.3 mm. The figures were computed from the rules
in docs/motion.md by another implementation: positions on a fine grid of the path, axes by a geometric inverse, the fastest
speed by one pass backward and one forward, the two moving averages in time, stop points that overlap by a millimetre."""

import sys
import tempfile
from pathlib import Path

here = Path(__file__).resolve().parent
sys.path.insert(0, str(here.parent / "motion_vectors"))
from recorded import duration, motion, passage, samples  # noqa: E402


def check(name, seconds, points, trace):
    rows = motion(samples(here / f"{name}.modx", trace))
    problems = []
    wanted, needed = float(seconds), duration(rows)
    if abs(needed - wanted) > 0.003 * wanted:
        problems.append(f"{name}: duration {needed:.3f} s, expected {wanted:g}")
    for point in points.split():
        distance = passage(rows, [float(x) for x in point.split(",")])[0]
        if distance > 0.3:
            problems.append(f"{name}: the path passes {point} at {distance:.2f} mm")
    return problems


with tempfile.TemporaryDirectory() as folder:
    table = [line.split("\t") for line in (here / "expected.tsv").read_text().splitlines()[1:]]
    found = [p for row in table for p in check(*row, f"{folder}/trace.csv")]
print(f"{len(table)} programs, {len(found)} differences")
print("\n".join(found), end="")
