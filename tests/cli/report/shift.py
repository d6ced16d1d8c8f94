"""shift.py TRACE.csv OUT.csv: the trace as another controller might have recorded it: it begins 2 s later, lies 0.5 mm higher, and
waits 0.25 s longer after its second movement; other names, semicolons, decimal commas."""

import csv
import sys

with open(sys.argv[1], encoding="utf-8") as source, open(sys.argv[2], "w", encoding="utf-8") as out:
    out.write("Time [ms];TCP X;TCP Y;TCP Z;comment\n")
    rows = list(csv.DictReader(source))
    third = next(float(row["time_s"]) for row in rows if row["move"] == "3")
    for row in rows:
        time = float(row["time_s"]) + 2 + (0.25 if float(row["time_s"]) >= third - 0.1 else 0)
        fields = [f"{1000 * time:.1f}", row["x"], row["y"], f"{float(row['z']) + 0.5:.6f}"]
        out.write(";".join(fields).replace(".", ",") + ";\n")
