#!/usr/bin/env python3
"""Checks the declarations of everything predefined (stdlib/data, stdlib/decl) against the list of names.

Usage: check_stdlib.py [--stdlib DIR] [--builtins BUILTINS.json] [--names NAMES.tsv] [--rapidc PROGRAM]

The generator (stdlib_gen) refuses bad declarations when the project is built; this script compares what it has read
(builtins.json) with the list.
Always: form of the files (tabs, length of lines and files).
With names (columns name, kind, option, confidence, result, errors, parameters; default tests/stdlib): every
instruction, function, data type, constant and system datum named there is declared, as the right kind, with the
same option, return type and errors and with all the parameters, and marked uncertain where the list says so; a
constant has the listed type (result) and value (parameters).
With a program: `rapidc builtins --format=tsv` lists all these names, each with its kind and a status.
Prints one line per offence; exit status 1 if there is any.
"""

import argparse
import csv
import json
import pathlib
import re
import subprocess
import sys

MODES = {"VAR", "PERS", "INOUT", "REF"}

# Rows of the tables that are not declared, and why.
EXEMPT = {
    "TRUE": "literal of the language",
    "FALSE": "literal of the language",
    "BASE_SHARED": "name of a module",
    "MotSupOn": "system output, not a RAPID name",
    "MotSupTrigg": "system output, not a RAPID name",
    "AckErrDialog": "system input, not a RAPID name",
    "Start": "system input, not a RAPID name",
    "POWER ON (event)": "event",
    "RESTART (event)": "event",
    "STOP (event)": "event",
    "QSTOP (event)": "event",
    "SYS_FAIL": "system state",
    "ERR_GLUEFLOW": "example of an error that a program books itself",
}
# Rows whose parameters or result the table itself marks as uncertain and that are declared otherwise on purpose.
REDEFINED = {"EGMSetupAI", "EGMSetupAO", "EGMSetupGI", "WZLimSup", "WZDOSet", "SearchJ"}
# Names that the list and the program call by different kinds, and why.
OTHER_KIND = {
    "load0": "a persistent that cannot be changed",
    "tool0": "a persistent that cannot be changed",
    "wobj0": "a persistent that cannot be changed",
    "SYS_RESET": "a system routine",
}
STATUSES = {"implemented", "declared only"}


def plain(value):
    """A value as text that does not depend on blanks or on how numbers are written."""
    return re.sub(r"(?<![\w\"])[-+]?[\d.]+(?:E[-+]?\d+)?", lambda m: repr(float(m.group())), value.replace(" ", ""))


class Checker:
    def __init__(self):
        self.offences = []
        self.types = set()
        self.data = {}
        self.routines = {}

    def offence(self, place, text):
        self.offences.append(f"{place}: {text}")

    def form(self, path):
        text = path.read_text(encoding="utf-8")
        if "\t" in text or "\r" in text:
            self.offence(path.name, "tab or carriage return")
        lines = text.split("\n")
        if len(lines) > 601:
            self.offence(path.name, f"{len(lines)} lines, at most 600")
        for number, line in enumerate(lines, 1):
            if len(line) > 130:
                self.offence(f"{path.name}:{number}", "line is longer than 130 characters")

    def read(self, builtins):
        """Takes over the declarations that stdlib_gen has read."""
        for entry in json.loads(builtins.read_text(encoding="utf-8")):
            key = entry["name"].lower()
            if entry["kind"] == "datatype":
                self.types.add(key)
            elif entry["kind"] in ("constant", "data"):
                self.data[key] = entry
            else:
                self.routines[key] = entry

    def names(self, path):
        with path.open(encoding="utf-8", newline="") as file:
            rows = list(csv.DictReader(file, delimiter="\t", quoting=csv.QUOTE_NONE))
        for row in rows:
            name, kind = row["name"], row["kind"]
            if name in EXEMPT:
                continue
            key = name.lower()
            if kind == "datatype":
                found = key in self.types
            elif kind in ("instruction", "function"):
                found = key in self.routines
                if found:
                    self.compare(path.name, row)
            else:
                found = key in self.data or key in self.routines
                if kind == "constant" and key in self.data:
                    self.compare_value(path.name, row)
            if not found:
                self.offence(path.name, f"{kind} {name} is not declared")
        return rows

    def compare_value(self, table, row):
        """The parameters of a constant are its value; `-` when it is not known."""
        name, datum = row["name"], self.data[row["name"].lower()]
        if row["result"].lower() != datum["type"].lower():
            self.offence(table, f"{name} is declared as {datum['type']}, the list says {row['result']}")
        if row["parameters"] != "-" and plain(row["parameters"]) != plain(datum["value"]):
            self.offence(table, f"{name} is {datum['value']}, the list says {row['parameters']}")

    def compare(self, table, row):
        name = row["name"]
        routine = self.routines[name.lower()]
        if row["kind"] != routine["kind"]:
            self.offence(table, f"{name} is declared as the other kind of routine")
        result = routine.get("returns", "-")
        if row["result"] not in ("-", "?") and row["result"].lower() != result.lower():
            self.offence(table, f"{name} returns {result}, the list says {row['result']}")
        option = routine.get("option", "-")
        if option != row["option"]:
            self.offence(table, f"{name} has option {option}, the list says {row['option']}")
        if row["confidence"] != "high" and routine["confidence"] == "high":
            self.offence(table, f"{name} is declared as certain, the list has {row['confidence']} confidence")
        raises = re.findall(r"\w+", routine.get("raises", ""))
        for error in re.findall(r"ERR_\w+", row["errors"]):
            if error not in raises:
                self.offence(table, f"{name}: error {error} is not declared")
        if name not in REDEFINED and row["parameters"] != "-":
            self.compare_parameters(table, row, [parameter["name"].lower() for parameter in routine["params"]])

    def compare_parameters(self, table, row, declared):
        name, listed = row["name"], []
        for token in re.findall(r"\[[^\]]*\]|[^\s\[\]]+", row["parameters"].replace("{*}", "")):
            word = token.strip("[]").split()[-1].lstrip("\\").split(":")[0]
            if word not in MODES and re.match(r"\w+$", word):
                listed.append(word.lower())
        for word in listed:
            if word not in declared:
                self.offence(table, f"{name}: parameter {word} is not declared")
        order = [w for w in declared if w in listed]
        if order != [w for w in listed if w in declared]:
            self.offence(table, f"{name}: order of parameters differs")

    def listing(self, program, rows):
        """The output of `rapidc builtins`, by name."""
        run = subprocess.run([program, "builtins", "--format=tsv"], capture_output=True, text=True, check=False)
        lines = [line.split("\t") for line in run.stdout.splitlines()]
        if run.returncode != 0 or not lines or lines[0] != ["name", "kind", "chapter", "status"]:
            self.offence("rapidc builtins", f"exit status {run.returncode}, or no header")
            return
        listed = {}
        for line in lines[1:]:
            if len(line) != 4 or line[3] not in STATUSES:
                self.offence("rapidc builtins", f"not understood: {line}")
                continue
            listed.setdefault(line[0].lower(), set()).add(line[1])
        for row in rows:
            name, kinds = row["name"], listed.get(row["name"].lower(), set())
            if name not in EXEMPT and row["kind"] not in kinds and not (kinds and name in OTHER_KIND):
                self.offence("rapidc builtins", f"{row['kind']} {name} is not listed")


def main():
    parser = argparse.ArgumentParser(description="Checks stdlib/data and stdlib/decl.")
    here = pathlib.Path(__file__).resolve().parent.parent
    parser.add_argument("--stdlib", type=pathlib.Path, default=here / "stdlib")
    parser.add_argument("--names", type=pathlib.Path, default=here / "tests/stdlib/predefined_names.tsv")
    parser.add_argument("--builtins", type=pathlib.Path, default=here / "build/generated/stdlib/builtins.json",
                        help="the declarations as stdlib_gen has read them")
    parser.add_argument("--rapidc", type=pathlib.Path, help="the program whose list of names is checked")
    options = parser.parse_args()
    if not options.builtins.exists():
        parser.error(f"{options.builtins} is not there: build first (ninja -C build stdlib_tables)")
    checker = Checker()
    files = sorted(options.stdlib.glob("data/*.sysx")) + sorted(options.stdlib.glob("decl/*.sysx"))
    if not files:
        parser.error(f"no declarations in {options.stdlib}")
    for path in files:
        checker.form(path)
    checker.read(options.builtins)
    rows = checker.names(options.names)
    if options.rapidc:
        checker.listing(options.rapidc, rows)
    for offence in checker.offences:
        print(offence)
    print(f"{len(checker.types)} types, {len(checker.data)} data, {len(checker.routines)} routines in "
          f"{len(files)} files; {len(checker.offences)} offences")
    return 1 if checker.offences else 0


if __name__ == "__main__":
    sys.exit(main())
