#!/usr/bin/env python3
"""Proves that each error constant of each built-in is raised by a test.

`!@ raises:` of stdlib/decl says which error constants a built-in raises. A pair counts when a test, executed here with
`--errors`, raises that number in a statement that calls the built-in. Tests that name both are executed, as long as a pair is open. EXEMPT holds the pairs that no program can raise here, each with the reason; an entry that is not needed any
more is a mistake, too.
"""

import argparse
import collections
import concurrent.futures
import csv
import os
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "tests/harness"))

import cases  # noqa: E402
from discovery import discover  # noqa: E402

EXEMPT = {
    ("Decr", "ERR_NUM_LIMIT"): "a step of 1 does not change a number near the limit",
    ("Incr", "ERR_NUM_LIMIT"): "a step of 1 does not change a number near the limit",
    ("SiConnect", "ERR_ARGVALERR"): "check refuses everything but a persistent with a name of its own",
    ("StartMoveRetry", "ERR_PROGSTOP"): "the handler that executes it belongs to a program that is started",
    ("StartMoveRetry", "ERR_STARTMOVE"): "the handler that executes it belongs to a program that is started",
}
# Errors of a definition that the instruction raises which uses it.
RAISED_AT = {
    ("ProcerrRecovery", "ERR_PATH_STOP"): "MoveL",
    ("TriggSpeed", "ERR_AO_LIM"): "TriggL",
}


def declared_pairs():
    """(built-in, constant) of all declarations, in the order of the files."""
    for path in sorted((ROOT / "stdlib/decl").glob("*.sysx")):
        constants = []
        for line in path.read_text(encoding="utf-8").splitlines():
            if found := re.match(r"\s*!@ raises:\s*(.*)", line):
                constants = [name.strip() for name in found[1].split(",") if name.strip()]
            elif constants and (found := re.match(r"\s*!@\s+(ERR_[\w, ]+)$", line)):
                constants += [name.strip() for name in found[1].split(",") if name.strip()]
            elif found := re.match(r"\s*(?:PROC|FUNC\s+\w+)\s+(\w+)", line):
                yield from ((found[1], constant) for constant in constants)
                constants = []


def error_numbers():
    """Number of each predefined constant ERR_..."""
    numbers = {}
    for path in (ROOT / "stdlib/data").glob("*.sysx"):
        for name, number in re.findall(r"CONST errnum (\w+) := (\d+);", path.read_text(encoding="utf-8")):
            numbers[name] = int(number)
    return numbers


def code_of(text):
    """RAPID text in lower case, without the contents of strings and comments."""
    return re.sub(r'"[^"\n]*"|![^\n]*', lambda found: '""' if found[0][0] == '"' else "", text).lower()


def statement_at(text, line, column):
    """The statement that begins there, up to its `;`, or the head of a compound one."""
    rest = "".join(text.splitlines(keepends=True)[line - 1:])[max(column - 1, 0):]
    code = code_of(rest)
    end = re.search(r";|\bthen\b|\bdo\b|\bcase\b", code)
    return code[:end.start()] if end else code


def files_of(test):
    """The RAPID files of a test, and what it consists of besides."""
    path = pathlib.Path(test.path)
    folder = path if path.is_dir() else path.parent
    if path.is_dir() or path.suffix == ".test":
        return [each for each in folder.rglob("*") if each.suffix in cases.SOURCE_SUFFIXES]
    inputs = test.directives().get("inputs", "").split()
    return [path, *(folder / name for name in inputs)]


class Audit:
    def __init__(self, rapidc):
        self.rapidc = rapidc
        self.numbers = error_numbers()
        self.pairs = list(declared_pairs())
        self.proved = set()
        self.of_number = collections.defaultdict(list)
        for name, constant in self.pairs:
            self.of_number[self.numbers[constant]].append((name, constant))

    def read(self, path, text_of=None):
        """Takes what a file of --errors proves. `text_of`: the text of a module by its path."""
        texts = {}
        with open(path, encoding="utf-8", newline="") as file:
            for row in csv.DictReader(file):
                source = row["file"]
                if source not in texts:
                    texts[source] = text_of(source) if text_of else cases.read(source) if os.path.exists(source) else ""
                words = set(re.findall(r"\w+", statement_at(texts[source], int(row["line"]), int(row["column"]))))
                self.proved |= {(name, constant) for name, constant in self.of_number[int(row["number"])]
                                if RAISED_AT.get((name, constant), name).lower() in words}

    def run(self, test, scratch):
        errors = os.path.join(scratch, "errors.csv")
        environment = {"RAPIDC": self.rapidc}
        if isinstance(test, cases.ProgramTest):
            directives = test.directives()
            inputs, compile_options, run_options = test.command_parts(directives)
            profile = [] if "jit" in directives.get("modes", "jit").split() else ["--stepping"]
            cases.execute([self.rapidc, "run", *profile, *inputs, *compile_options, *run_options, "--errors=" + errors],
                          scratch, 60, environment=environment)
            self.take(errors)
            return
        for command_line, expectations in test.steps():
            text = command_line.replace("{dir}", os.path.dirname(test.path)).replace("{tmp}", scratch)
            words = shlex.split(text.replace("{src}", str(ROOT)))
            command = [self.rapidc if word == "rapidc" else word for word in words]
            if run := next((i for i in range(1, len(words)) if words[i - 1:i + 1] == ["rapidc", "run"]), 0):
                command.insert(run + 1, "--errors=" + errors)
            stdin = "".join(value + "\n" for key, value in expectations if key == "stdin")
            cases.execute(command, scratch, 60, stdin.encode(), environment)
            self.take(errors)

    def take(self, errors):
        if os.path.exists(errors):
            self.read(errors)
            os.unlink(errors)

    def run_served(self, path, case):
        """A test of `rapidc serve`: its harness passes --errors on. Its modules are files in the folder `programs`."""
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run([sys.executable, str(path), case], env={**os.environ, "RAPIDC": self.rapidc, "RAPIDC_ERRORS": folder},
                           capture_output=True, check=False, timeout=300)
            for errors in sorted(pathlib.Path(folder).iterdir()):
                self.read(errors, lambda source: cases.read(path.parent / "programs" / os.path.basename(source)))

    def missing(self):
        return [pair for pair in self.pairs if pair not in self.proved]

    def search(self):
        """Executes the tests that name both of a pair, the ones with most pairs first, as long as a pair is open."""
        found = {name: test for name, test in discover(str(ROOT)).items()
                 if isinstance(test, (cases.ProgramTest, cases.CommandTest))}
        words = {name: set(re.findall(r"\w+", "\n".join(
            path.read_text(encoding="utf-8", errors="replace") for path in files_of(test)).lower()))
                 for name, test in found.items()}
        named = {name: {pair for pair in self.pairs if pair[0].lower() in has and pair[1].lower() in has}
                 for name, has in words.items()}
        order = sorted((name for name in found if named[name]), key=lambda name: -len(named[name]))

        def judge(name):
            if named[name] <= self.proved:
                return
            with tempfile.TemporaryDirectory() as scratch:
                self.run(found[name], scratch)

        with concurrent.futures.ThreadPoolExecutor(os.cpu_count() or 2) as pool:
            list(pool.map(judge, order))
        for path in sorted((ROOT / "tests/serve").glob("test_*.py")):
            for case in re.findall(r"^class (\w+)(.*?)(?=^class |\Z)", path.read_text(encoding="utf-8"), re.M | re.S):
                if "program(" in case[1] and any(constant in case[1] for _, constant in self.missing()):
                    self.run_served(path, case[0])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--rapidc", default=str(ROOT / "build/rapidc"), help="the executable under test")
    options = parser.parse_args()
    audit = Audit(os.path.abspath(options.rapidc))
    audit.search()
    missing = audit.missing()
    mistakes = [f"{name} {constant}: no test raises it" for name, constant in missing if (name, constant) not in EXEMPT]
    mistakes += [f"{name} {constant}: the exemption is not needed" for name, constant in EXEMPT
                 if (name, constant) not in missing]
    for mistake in mistakes:
        print(mistake)
    if not mistakes:
        print(f"{len(audit.pairs)} pairs of built-in and error constant, {len(EXEMPT)} exempt")
    return 1 if mistakes else 0


if __name__ == "__main__":
    sys.exit(main())
