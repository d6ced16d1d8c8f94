#!/usr/bin/env python3
"""Checks the declarations of everything predefined (stdlib/data, stdlib/decl).

Usage: check_stdlib.py [--stdlib DIR] [--names NAMES.tsv] [--rapidc PROGRAM]

The generator (stdlib_gen) checks the words of attributes, this script the rest.
Always: names declared once (RAPID ignores case), types used are declared, order within a file (types, data,
routines), reserved words, documentation and attributes of every routine, error numbers distinct and outside the
user range, texts of at most 80 bytes, size of files.
With names (columns name, kind, option, confidence, result, errors, parameters; default tests/stdlib): every
instruction, function, data type, constant and system datum named there is declared, as the right kind, with the
same option, return type and errors and with all the parameters, and marked uncertain where the list says so; a
constant has the listed type (result) and value (parameters).
With a program: `rapidc builtins --format=tsv` lists all these names, each with its kind and a status.
Prints one line per offence; exit status 1 if there is any.
"""

import argparse
import csv
import pathlib
import re
import subprocess
import sys

RESERVED = set("""ALIAS AND BACKWARD BREAK CASE CONNECT CONST CONTINUE DEFAULT DIV DO ELSE ELSEIF ENDFOR ENDFUNC ENDIF
ENDMODULE ENDPROC ENDRECORD ENDTEST ENDTRAP ENDWHILE ERROR EXIT FALSE FOR FROM FUNC GOTO IF INOUT LOCAL MOD MODULE
NOSTEPIN NOT NOVIEW OR PERS PROC RAISE READONLY RECORD RETRY RETURN STEP SYSMODULE TEST THEN TO TRAP TRUE TRYNEXT
UNDO VAR VIEWONLY WHILE WITH XOR""".split())
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
# Summaries that say no more than the name: at least so many words for a routine or type.
SHORTEST_SUMMARY = 3


def plain(value):
    """A value as text that does not depend on blanks or on how numbers are written."""
    return re.sub(r"(?<![\w\"])[-+]?[\d.]+(?:E[-+]?\d+)?", lambda m: repr(float(m.group())), value.replace(" ", ""))


class Checker:
    def __init__(self):
        self.offences = []
        self.types = {}
        self.data = {}
        self.routines = {}
        self.places = {}
        self.used_types = []
        self.errors_named = []
        self.error_numbers = {}
        self.summaries = {}

    def offence(self, place, text):
        self.offences.append(f"{place}: {text}")

    def declare(self, place, name, table, value):
        key = name.lower()
        if name.upper() in RESERVED:
            self.offence(place, f"{name} is a reserved word")
        if key in self.places:
            self.offence(place, f"{name} is already declared at {self.places[key]}")
        self.places[key] = place
        table[key] = value

    def summary(self, place, name, kind, doc):
        """A summary of its own, in words: nothing empty, nothing copied from another name of the kind."""
        text = doc[0].rstrip(".").lower() if doc else ""
        if kind != "datum" and len(text.split()) < SHORTEST_SUMMARY:
            self.offence(place, f"{name}: the summary says too little")
        other = self.summaries.setdefault((kind, text), name)
        if text and other != name:
            self.offence(place, f"{name} has the summary of {other}")

    # ---- reading ---------------------------------------------------------------------------------------------
    def read(self, path):
        text = path.read_text(encoding="utf-8")
        if "\t" in text or "\r" in text:
            self.offence(path.name, "tab or carriage return")
        lines = text.split("\n")
        if len(lines) > 601:
            self.offence(path.name, f"{len(lines)} lines, at most 600")
        stage = 0  # 1 types, 2 data, 3 routines
        doc, attrs = [], []
        number = 0
        while number < len(lines):
            place = f"{path.name}:{number + 1}"
            line = lines[number]
            if len(line) > 130:
                self.offence(place, "line is too long")
            code = line.strip()
            number += 1
            if code.startswith("!!"):
                doc.append(code[2:].strip())
            elif code.startswith("!@"):
                attrs.append(code[2:].strip())
            elif not code:
                doc, attrs = [], []
            elif code.startswith("!") or re.match(r"(MODULE|ENDMODULE)\b", code):
                pass
            else:
                word = code.split()[0].upper()
                kind = 1 if word in ("RECORD", "ALIAS") else 2 if word in ("CONST", "VAR", "PERS") else 3
                if kind < stage:
                    self.offence(place, "order is: types, data, routines")
                stage = max(stage, kind)
                if kind < 3 and not doc:
                    self.offence(place, "no documentation")
                attributes = self.attributes(place, attrs)
                if kind < 3:
                    self.summary(place, re.split(r"[ ;]", code)[1 if word == "RECORD" else 2],
                                 "type" if kind == 1 else "datum", doc)
                if word == "RECORD":
                    number = self.record(place, lines, number, code, attributes)
                elif word == "ALIAS":
                    self.alias(place, code)
                elif kind == 2:
                    self.datum(place, code)
                elif word in ("PROC", "FUNC"):
                    while ")" not in code:
                        code += " " + lines[number].strip()
                        number += 1
                    self.routine(place, code, doc, attributes)
                    number = self.body(place, word, lines, number)
                else:
                    self.offence(place, f"not understood: {code}")
                doc, attrs = [], []

    def attributes(self, place, lines):
        """`key: value` pairs, several a line apart by three spaces; a line without a key continues the last."""
        found = {}
        last = None
        for line in lines:
            for part in re.split(r" {3,}", line):
                match = re.match(r"([a-z]+): *(.*)$", part)
                if match:
                    last = match.group(1)
                    found.setdefault(last, []).append(match.group(2))
                elif last:
                    found[last][-1] += " " + part
        return found

    def record(self, place, lines, number, code, attributes):
        name = code.split()[1]
        components = 0
        while lines[number].strip().upper() != "ENDRECORD":
            match = re.match(r"\s*(\w+) (\w+);$", lines[number])
            if match:
                self.used_types.append((f"{place} {name}", match.group(1)))
                if match.group(2).upper() in RESERVED:
                    self.offence(place, f"{name}: component {match.group(2)} is a reserved word")
                components += 1
            elif not lines[number].strip().startswith("!"):
                self.offence(place, f"component not understood: {lines[number].strip()}")
            number += 1
        if not components and "class" not in attributes:
            self.offence(place, f"record {name} has neither components nor a class")
        self.declare(place, name, self.types, components)
        return number + 1

    def alias(self, place, code):
        match = re.match(r"ALIAS (\w+) (\w+);$", code)
        if not match:
            self.offence(place, f"not understood: {code}")
            return
        self.used_types.append((place, match.group(1)))
        self.declare(place, match.group(2), self.types, match.group(1))

    def datum(self, place, code):
        match = re.match(r"(CONST|VAR|PERS) (\w+) (\w+)( := (.+))?;$", code)
        if not match:
            self.offence(place, f"not understood: {code}")
            return
        kind, data_type, name, _, value = match.groups()
        self.used_types.append((place, data_type))
        self.declare(place, name, self.data, (data_type.lower(), value))
        if kind == "CONST" and value is None:
            self.offence(place, f"constant {name} has no value")
        if value and value.startswith('"') and len(re.sub(r"\\[0-9A-F]{2}", "x", value[1:-1]).encode()) > 80:
            self.offence(place, f"text of {name} is longer than 80 bytes")
        if data_type.lower() == "errnum" and kind == "CONST":
            if 1 <= float(value) <= 90:
                self.offence(place, f"{name} is in the user range 1 to 90")
            if value in self.error_numbers:
                self.offence(place, f"{name} has the number of {self.error_numbers[value]}")
            self.error_numbers[value] = name

    def routine(self, place, code, doc, attributes):
        match = re.match(r"(PROC|FUNC (\w+)) (\w+)\((.*)\)$", code)
        if not match:
            self.offence(place, f"not understood: {code}")
            return
        _, result, name, parameters = match.groups()
        if result:
            self.used_types.append((place, result))
        names = []
        for group in re.split(r"[\\|]|,(?![^{]*\})", parameters):
            words = group.split()
            if not words:
                continue
            if words[0] in MODES:
                words.pop(0)
            if len(words) != 2 or not re.match(r"\w+(\{\*(,\*)*\})?$", words[1]):
                self.offence(place, f"{name}: parameter not understood: {group.strip()}")
                continue
            self.used_types.append((place, words[0]))
            names.append(words[1].split("{")[0])
        lowered = [n.lower() for n in names]
        for n in names:
            if n.upper() in RESERVED - {"CONTINUE"}:  # RaiseToUser \Continue is the language's own exception
                self.offence(place, f"{name}: parameter {n} is a reserved word")
        if len(set(lowered)) != len(lowered):
            self.offence(place, f"{name}: a parameter is declared twice")
        self.document(place, name, names, result, doc, attributes)
        self.declare(place, name, self.routines, (result.lower() if result else None, lowered, attributes))

    def document(self, place, name, names, result, doc, attributes):
        if not doc or doc[0].startswith("@"):
            self.offence(place, f"{name}: no summary")
        self.summary(place, name, "routine", doc)
        returned = [d[8:].strip().rstrip(".").lower() for d in doc if d.startswith("@return ")]
        if doc and returned and returned[0] == doc[0].rstrip(".").lower():
            self.offence(place, f"{name}: the description of the result repeats the summary")
        described = [d.split()[1] for d in doc if d.startswith("@param") and len(d.split()) > 2]
        for n in names:
            if n not in described:
                self.offence(place, f"{name}: parameter {n} is not described")
        for d in described:
            if d not in names:
                self.offence(place, f"{name}: describes {d}, which is not a parameter")
        if result and not any(d.startswith("@return ") for d in doc):
            self.offence(place, f"{name}: result is not described")
        for key in ("manual", "effects", "confidence"):
            if key not in attributes:
                self.offence(place, f"{name}: attribute {key} is missing")
        effects = attributes.get("effects", ["pure"])[0]
        raises = re.findall(r"\w+", " ".join(attributes.get("raises", [])))
        errors = [d.split()[1] for d in doc if d.startswith("@error")]
        if set(raises) != set(errors):
            self.offence(place, f"{name}: raises and @error differ")
        if raises and effects == "const":
            self.offence(place, f"{name}: cannot be const and raise")
        self.errors_named += [(place, e) for e in raises]
        for deferred in attributes.get("deferred", []):
            if deferred not in names:
                self.offence(place, f"{name}: deferred: {deferred} is not a parameter")

    def body(self, place, word, lines, number):
        """Skips the body, if there is one: a native routine is followed by an empty line or the end."""
        if not lines[number].strip() or lines[number].startswith("ENDMODULE"):
            return number
        while number < len(lines) and lines[number].strip().upper() != "END" + word:
            number += 1
        if number == len(lines):
            self.offence(place, "body without end")
        return number + 1

    # ---- relations -------------------------------------------------------------------------------------------
    def relations(self):
        for place, name in self.used_types:
            if name.lower() not in self.types:
                self.offence(place, f"type {name} is not declared")
        for place, name in self.errors_named:
            if self.data.get(name.lower(), ("",))[0] != "errnum":
                self.offence(place, f"error {name} is not declared")

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
        data_type, value = self.data[row["name"].lower()]
        if row["result"].lower() != data_type:
            self.offence(table, f"{row['name']} is declared as {data_type}, the list says {row['result']}")
        if row["parameters"] != "-" and plain(row["parameters"]) != plain(value or ""):
            self.offence(table, f"{row['name']} is {value}, the list says {row['parameters']}")

    def compare(self, table, row):
        name = row["name"]
        result, declared, attributes = self.routines[name.lower()]
        if (row["kind"] == "function") != (result is not None):
            self.offence(table, f"{name} is declared as the other kind of routine")
        if row["result"] not in ("-", "?") and row["result"].lower() != result:
            self.offence(table, f"{name} returns {result}, the list says {row['result']}")
        option = attributes.get("option", ["-"])[0]
        if option != row["option"]:
            self.offence(table, f"{name} has option {option}, the list says {row['option']}")
        if row["confidence"] != "high" and attributes.get("confidence") == ["high"]:
            self.offence(table, f"{name} is declared as certain, the list has {row['confidence']} confidence")
        raises = re.findall(r"\w+", " ".join(attributes.get("raises", [])))
        for error in re.findall(r"ERR_\w+", row["errors"]):
            if error not in raises:
                self.offence(table, f"{name}: error {error} is not declared")
        if name in REDEFINED or row["parameters"] == "-":
            return
        listed = []
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
    parser.add_argument("--rapidc", type=pathlib.Path, help="the program whose list of names is checked")
    options = parser.parse_args()
    checker = Checker()
    files = sorted(options.stdlib.glob("data/*.sysx")) + sorted(options.stdlib.glob("decl/*.sysx"))
    if not files:
        parser.error(f"no declarations in {options.stdlib}")
    for path in files:
        checker.read(path)
    checker.relations()
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
