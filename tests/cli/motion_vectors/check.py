"""check.py RAPIDC [OPTION...]: runs the programs of this folder on an IRB 6640-180/2.55 and compares their motion between the
two WaitTime with expected.tsv: duration within 1 %, largest speed within 5 %, distance to the inner points within 0.3 mm,
smallest speed near them within 5 % (docs/motion.md). Durations count from 1 mm after the start to 1 mm before the end."""

import re
import tempfile
from pathlib import Path

from recorded import duration, motion, passage, samples

here = Path(__file__).resolve().parent
def inner_points(program):
    """Targets of the Cartesian movements but the last; circle points do not count."""
    points = []
    for line in program.read_text().splitlines():
        if "Move" not in line or "MoveAbsJ" in line:
            continue
        found = re.findall(r"\[\[([-\d.]+),([-\d.]+),([-\d.]+)\],\[", line)
        points.append(tuple(map(float, found[-1])))
    return points[:-1]


def check(name, expected, trace):
    program = here / f"{name}.modx"
    rows = motion(samples(program, trace))
    problems = []

    def compare(what, value, wanted, tolerance):
        if not abs(value - wanted) <= tolerance:
            problems.append(f"{name}: {what} {value:.3f}, expected {wanted:g} within {tolerance:.3g}")

    compare("duration", duration(rows), float(expected[0]), 0.01 * float(expected[0]))
    compare("largest speed", max(r[2] for r in rows), float(expected[1]), 0.05 * float(expected[1]))
    if not expected[2]:
        return problems
    distances, speeds = ([float(x) for x in text.split()] for text in expected[2:4])
    points = inner_points(program)
    if name == "circle_v300":
        points = points[:1]  # the middle of the full circle, where two instructions meet
    for point, distance, speed in zip(points, distances, speeds):
        nearest, slowest = passage(rows, point)
        compare("distance", nearest, distance, 0.3)
        if speed > 50:  # at stop points the smallest speed depends on the samples
            compare("smallest speed", slowest, speed, 0.05 * speed)
    return problems


with tempfile.TemporaryDirectory() as folder:
    table = [line.split("\t") for line in (here / "expected.tsv").read_text().splitlines()[1:]]
    found = [p for row in table for p in check(row[0], row[1:] + [""] * 4, f"{folder}/trace.csv")]
print(f"{len(table)} programs, {len(found)} differences")
print("\n".join(found), end="")
