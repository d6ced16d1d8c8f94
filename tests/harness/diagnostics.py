"""Tests of diagnostics: programs whose comments hold the diagnostics that they must give (tests/diag/README.md).

This is the only reader of these annotations."""

import dataclasses
import json
import os
import re
import shlex

from cases import BadTest, describe_failure, directives_of, execute

CARETS = re.compile(r"^(\s*!\s*)(\^+)\s*(error|warning|note)\[(RAP\d{4})\](?::\s*(.*?))?\s*$")
EXPECT = re.compile(r"!@\s*expect\s+@?([+-]?\d+)(?::(\d+)(?:-(\d+))?)?\s+(error|warning|note)\[(RAP\d{4})\]"
                    r"(?::\s*(.*?))?\s*$")
END_OF_LINE = re.compile(r"\S.*!\s*(error|warning|note)\[(RAP\d{4})\](?::\s*(.*?))?\s*$")
FIXED = re.compile(r"^\s*! fixed:\s*(.*?)\s*$")
CODE = re.compile(r"^RAP\d{4}")
CHAPTER = re.compile(r"^\d+(\.\d+)*(, \d+(\.\d+)*)*$")
DECISION = re.compile(r"^decision (\d+)$")

# Warnings that something is not implemented yet: they come and go with the work and are not part of a rule.
STATE_OF_WORK = {"RAP7003", "RAP7004"}


@dataclasses.dataclass
class Expected:
    line: int
    column: int
    end: int
    severity: str
    code: str
    text: str

    def matches(self, diagnostic):
        return (diagnostic["line"] == self.line and diagnostic["severity"] == self.severity and
                diagnostic["code"] == self.code and
                (self.column == 0 or diagnostic["column"] == self.column) and
                (self.end == 0 or diagnostic["endLine"] != diagnostic["line"] or
                 diagnostic["endColumn"] == self.end) and
                (not self.text or self.text in diagnostic["message"]))

    def __str__(self):
        place = f"{self.line}:{self.column}" if self.column else str(self.line)
        return f"{place} {self.severity}[{self.code}] {self.text}"


def annotations(lines):
    """Expected diagnostics written in comments: under the place with carets, at the end of the line, or !@ expect."""
    found, code_line = [], 0
    for number, line in enumerate(lines, 1):
        match = CARETS.match(line)
        if match:
            begin = len(match.group(1)) + 1
            found.append(Expected(code_line, begin, begin + len(match.group(2)), match.group(3), match.group(4),
                                  match.group(5) or ""))
            continue
        match = EXPECT.search(line)
        if match:
            found.append(Expected(number + int(match.group(1)), int(match.group(2) or 0), int(match.group(3) or 0),
                                  match.group(4), match.group(5), match.group(6) or ""))
            continue
        code_line = number
        match = END_OF_LINE.search(line)
        if match and not line.lstrip().startswith("!"):
            found.append(Expected(number, 0, 0, match.group(1), match.group(2), match.group(3) or ""))
    return found


def fixed_lines(lines):
    """`! fixed: reg1 := 5;` below a line is that line after --fix: (number, text)."""
    found, code_line = [], 0
    for number, line in enumerate(lines, 1):
        match = FIXED.match(line)
        if match:
            found.append((code_line, match.group(1)))
        elif not line.lstrip().startswith("!"):
            code_line = number
    return found


def unnamed_rule(source, directives):
    """Why the test does not name the rule that it checks; "" when it does."""
    if "manual" in directives:
        good = CHAPTER.match(directives["manual"])
        return "" if good else f"'manual: {directives['manual']}' is not a chapter such as 1.3.1"
    rule = directives.get("rule", "")
    if not rule:
        return "the test does not name its rule: add '!@ manual: CHAPTER', '!@ rule: decision N' or '!@ rule: docs/PAGE.md'"
    match = DECISION.match(rule)
    if match:
        start = f"{int(match.group(1)):04d}-"
        known = any(name.startswith(start) for name in os.listdir(os.path.join(source, "docs", "decisions")))
        return "" if known else f"there is no {rule}"
    return "" if os.path.isfile(os.path.join(source, rule)) else f"there is no page {rule}"


def begin_of(edit):
    return (edit["line"], edit["column"])


def end_of(edit):
    return (edit["endLine"], edit["endColumn"])


def certain_edits(diagnostics):
    """(edits, number of diagnostics they belong to) of the certain fixes that do not touch each other."""
    edits, count = [], 0
    for diagnostic in diagnostics:
        fixes = diagnostic.get("fixes", [])
        if not fixes or not fixes[0]["certain"]:
            continue
        fresh = fixes[0]["edits"]
        if any(begin_of(a) <= end_of(b) and begin_of(b) <= end_of(a) for a in fresh for b in edits):
            continue
        edits += fresh
        count += 1
    return edits, count


def edited(text, edits):
    """The text after the edits; their columns count characters."""
    lines = text.split("\n")
    for edit in sorted(edits, key=begin_of, reverse=True):
        first, last = lines[edit["line"] - 1], lines[edit["endLine"] - 1]
        lines[edit["line"] - 1:edit["endLine"]] = (
            first[:edit["column"] - 1] + edit["text"] + last[edit["endColumn"] - 1:]).split("\n")
    return "\n".join(lines)


def without_annotation(line):
    return re.sub(r"\s*!\s*(error|warning)\[RAP.*$", "", line).strip()


class DiagnosticTest:
    """All diagnostics that the comments of a program hold, and no others; its certain fixes correct their mistakes."""

    def __init__(self, path):
        self.path = path
        self.encoding = "latin-1" if path.endswith((".mod", ".sys")) else "utf-8"

    def check(self, context, directives, path):
        """(command, its output, the diagnostics)"""
        arguments = [a.replace("{dir}", os.path.dirname(self.path)) for a in shlex.split(directives.get("args", ""))]
        # A program for one rule need not be tidy otherwise; those of 8xxx are about nothing else.
        if os.sep + "8xxx" + os.sep not in self.path:
            arguments = ["-W", "no-lint", *arguments]
        command = [context.rapidc, "check", "--format=json", *arguments, path]
        output = execute(command, os.path.dirname(path), 20)
        try:
            return command, output, [dict(d, column=d["column"]) for d in json.loads(output.stdout)]
        except (json.JSONDecodeError, TypeError, KeyError):
            return command, output, None

    def run(self, context, scratch):
        with open(self.path, encoding=self.encoding, errors="replace", newline="") as file:
            text = file.read()
        lines = text.splitlines()
        expected = annotations(lines)
        directives = directives_of(self.path)
        if problem := unnamed_rule(context.source, directives):
            raise BadTest(problem)
        if match := CODE.match(os.path.basename(self.path)):
            if all(e.code != match.group() for e in expected):
                raise BadTest(f"no {match.group()} is expected, the code that the file is named after")
        command, output, found = self.check(context, directives, self.path)
        if found is None:
            return ["check --format=json did not print JSON\n" + describe_failure(command, output) +
                    "\nstdout: " + output.stdout[:500]]
        problems = []
        wants_error = any(e.severity == "error" for e in expected)
        if output.status != (1 if wants_error else 0):
            problems.append(f"expected exit status {1 if wants_error else 0}\n" + describe_failure(command, output))
        rest = [d for d in found if d["severity"] != "note"]
        for want in expected:
            hit = next((d for d in rest if want.matches(d)), None)
            if hit is None:
                problems.append(f"expected, not reported: {want}")
            else:
                rest.remove(hit)
        problems += [f"reported, not expected: {d['line']}:{d['column']}-{d['endColumn']} "
                     f"{d['severity']}[{d['code']}]: {d['message']}" for d in rest if d["code"] not in STATE_OF_WORK]
        return problems + self.judge_fixes(context, directives, text, found, scratch)

    def judge_fixes(self, context, directives, text, found, scratch):
        edits, count = certain_edits(found)
        promised = fixed_lines(text.splitlines())
        if not count:
            return [f"line {line} is not fixed" for line, _ in promised]
        after = edited(text, edits)
        fixed = after.splitlines()
        problems = [f"line {line} is fixed to: {without_annotation(fixed[line - 1])}" for line, want in promised
                    if without_annotation(fixed[line - 1]) != want]
        path = os.path.join(scratch, os.path.basename(self.path))
        with open(path, "w", encoding=self.encoding, newline="") as file:
            file.write(after)
        left = self.check(context, directives, path)[2] or []
        if len(left) + count != len(found):
            problems.append(f"after {count} fixes of {len(found)} diagnostics:\n" + "\n".join(
                f"{d['line']}:{d['column']} {d['code']}: {d['message']}" for d in left))
        return problems
