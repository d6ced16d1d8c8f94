"""Times of the rows of a trace: 4 ms apart, but for one gap that ends with the wait of so many seconds; a short wait has all its rows."""
import csv
import sys

rows = list(csv.DictReader(open(sys.argv[1], encoding="utf-8")))
long_wait = float(sys.argv[2])
gaps = []
for before, after in zip(rows, rows[1:]):
    step = float(after["time_s"]) - float(before["time_s"])
    if abs(step - 0.004) > 1e-6:
        gaps.append(step)
        place = [name for name in before if name != "time_s"]
        assert [before[name] for name in place] == [after[name] for name in place], (before, after)
        assert abs(step / 0.004 - round(step / 0.004)) < 1e-6, step
assert len(gaps) == 1 and long_wait - 5 < gaps[0] <= long_wait, gaps
if len(sys.argv) > 3:
    assert len(rows) > float(sys.argv[3]) / 0.004, len(rows)
