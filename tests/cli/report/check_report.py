"""check_report.py REPORT.html [TRACE.csv]: the page is well-formed and needs no other file; its data are those of the trace."""

import csv
import html.parser
import json
import sys

VOID = {"meta", "input", "br", "link", "img", "hr", "col", "base", "source"}
LOADING = {"src", "href", "srcset", "action", "poster"}
TOLERANCE = {"time": 1e-4, "speed": 0.01, "x": 1e-3, "y": 1e-3, "z": 1e-3, "move": 0.1}


class Page(html.parser.HTMLParser):
    """Every element is closed in order, and none loads anything."""

    def __init__(self):
        super().__init__()
        self.open, self.problems, self.texts, self.ids = [], [], {}, set()

    def handle_starttag(self, tag, attributes):
        for name, value in attributes:
            if name in LOADING:
                self.problems.append(f"<{tag}> loads {value}")
            if name == "id":
                if value in self.ids:
                    self.problems.append(f"two elements with the id {value}")
                self.ids.add(value)
        if tag not in VOID:
            self.open.append((tag, dict(attributes).get("id")))

    def handle_endtag(self, tag):
        if not self.open or self.open[-1][0] != tag:
            self.problems.append(f"</{tag}> closes {self.open[-1:]}")
        else:
            self.open.pop()

    def handle_data(self, data):
        if self.open:
            self.texts[self.open[-1]] = self.texts.get(self.open[-1], "") + data


def decode(series):
    total, result = 0, []
    for step in series["d"]:
        total += step
        result.append(total * series["unit"])
    return result


def compare_with_trace(data, path):
    """Each sample of a robot is a row of the trace; rows left out lie between two samples that are alike."""
    unit = data["unit"] if data["hasArm"] else ""
    with open(path, encoding="utf-8") as file:
        rows = {round(float(row["time_s"]), 3): row for row in csv.DictReader(file) if row["unit"] == unit}
    times = decode(data["time"])
    names = {"x": "x", "y": "y", "z": "z", "speed": "speed_mm_s", "move": "move",
             **{f"j{i}": f"j{i}" for i in range(1, 7) if f"j{i}" in data},
             **{f"e{axis['number']}": f"e{axis['number']}" for axis in data["external"]}}
    assert times, "the page has no samples"
    assert abs(times[-1] - max(rows)) < 1e-3, f"the last sample is at {times[-1]}, that of the trace at {max(rows)}"
    for name, column in names.items():
        for time, value in zip(times, decode(data[name]), strict=True):
            expected = float(rows[round(time, 3)][column])
            assert abs(value - expected) <= TOLERANCE.get(name, 1e-5), f"{name} at {time}: {value}, in the trace {expected}"
    for before, after in zip(times, times[1:]):
        if after - before > 0.005:
            first, last = rows[round(before, 3)], rows[round(after, 3)]
            assert all(first[column] == last[column] for column in names.values()), f"samples between {before} and {after} are missing"


def main():
    with open(sys.argv[1], encoding="utf-8") as file:
        text = file.read()
    page = Page()
    page.feed(text)
    page.close()
    assert not page.problems, page.problems
    assert not page.open, f"not closed: {page.open}"
    assert text.startswith("<!DOCTYPE html>")
    for word in ("http://", "https://", "@import", "fetch(", "XMLHttpRequest", "{{"):
        assert word not in text, f"the page has {word}"
    data = json.loads(page.texts[("script", "data")])
    for robot in data["robots"]:
        if len(sys.argv) > 2:
            compare_with_trace(robot, sys.argv[2])
        if len(data["robots"]) > 1:
            print("robot", robot["unit"], *[axis["name"] for axis in robot["external"]])
        print("points", *[move["point"] for move in robot["moves"]])
    losses = [name for robot in data["robots"] for move in robot["moves"] for name, _ in move.get("losses", [])]
    print("signals", *[f"{s['name']}:{len(s['changes'])}" for s in data["signals"]])
    print("markers", *[marker["kind"] for marker in data["markers"]])
    print("losses", *sorted(set(losses)), sep=" / ")


main()
