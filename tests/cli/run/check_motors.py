"""check_motors.py TRACE: motor = axis + kappa * acceleration / its greatest acceleration, kappa = 2.4 mrad for axis 1 of an
IRB 6640-180/2.55 (docs/motion.md): at rest none; a movement at full acceleration shows it one way and, braking, the other."""

import csv
import math
import sys

KAPPA = math.degrees(0.0024)
rows = list(csv.DictReader(open(sys.argv[1])))
axis = [float(r["j1"]) for r in rows]
gap = [float(r["m1"]) - float(r["j1"]) for r in rows]
speed = [b - a for a, b in zip(axis, axis[1:])] + [0]
problems = []
if not 0.98 * KAPPA <= max(gap) <= 1.02 * KAPPA: problems.append(f"accelerating {max(gap)}, expected {KAPPA}")
if not 0.98 * KAPPA <= -min(gap) <= 1.02 * KAPPA: problems.append(f"braking {min(gap)}, expected {-KAPPA}")
if gap.index(max(gap)) > gap.index(min(gap)): problems.append("braking before accelerating")
still = [g for g, v in zip(gap, speed) if v == 0]
if max(map(abs, still)) > 1e-4: problems.append(f"at rest {max(still, key=abs)}")
if any(abs(float(r["m4"]) - float(r["j4"])) > 0 for r in rows): problems.append("axis 4 differs, which has no such figure")
print("\n".join(problems) if problems else f"{len(rows)} samples agree")
