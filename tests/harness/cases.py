"""Tests that are programs or command lines: how each is run and judged."""

import dataclasses
import difflib
import json
import os
import re
import shlex
import shutil
import signal
import subprocess

SOURCE_SUFFIXES = (".modx", ".sysx", ".mod", ".sys")
COMPILE_OPTIONS = ("--task=", "--config=", "--robot-config=")
DIRECTIVE = re.compile(r"^\s*!@\s*([a-z]+):\s*(.*?)\s*$")
# A command of a .test file that takes longer hangs; generous, because other work may slow the machine down.
HANGS_AFTER_S = 120
MODES = ("jit", "parts", "aot", "step", "words", "stepwords")
INTERPRETED_MODES = {"words", "stepwords"}
KNOWN_DIRECTIVES = {"test", "exit", "args", "modes", "manual", "timeout", "inputs", "rule"}


class BadTest(Exception):
    """The files of a test are not a valid test."""


@dataclasses.dataclass
class Context:
    source: str
    build: str
    rapidc: str
    update: bool
    modes: list

    def interprets_all(self):
        return set(self.modes) <= INTERPRETED_MODES


@dataclasses.dataclass
class Output:
    status: int
    stdout: str
    stderr: str


def read(path):
    with open(path, encoding="utf-8", newline="") as file:
        return file.read()


def execute(command, cwd, timeout, stdin=None, environment=None):
    """Runs a command, with further environment variables; a signal that killed it gives a negative status. At the time limit
    whatever it started ends with it."""
    program = os.path.join(cwd, command[0]) if "/" in command[0] else command[0]  # "./cell" is one of the folder
    if not shutil.which(program, path=os.environ.get("PATH")):
        return Output(127, "", f"there is no program {command[0]}")
    with subprocess.Popen(command, cwd=cwd, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                          start_new_session=True, env={**os.environ, **(environment or {})}) as process:
        status = 124
        try:
            out, err = process.communicate(stdin or b"", timeout)
            status = process.returncode
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)
            out, err = process.communicate()
            err += f"\n(timed out after {timeout} s)".encode()
    return Output(status, out.decode("utf-8", "replace"), err.decode("utf-8", "replace"))


def directives_of(path):
    """The `!@ name: value` lines of a RAPID file, at any place."""
    found = {}
    with open(path, encoding="utf-8", errors="replace") as file:
        for line in file:
            match = DIRECTIVE.match(line)
            if match and match.group(1) in KNOWN_DIRECTIVES:
                if match.group(1) in found:
                    raise BadTest(f"{path} has '!@ {match.group(1)}:' twice: write it once, with all values")
                found[match.group(1)] = match.group(2)
    return found


def difference(expected, actual, what):
    lines = difflib.unified_diff(expected.splitlines(), actual.splitlines(), f"expected {what}", f"actual {what}",
                                 lineterm="")
    text = "\n".join(list(lines)[:60])
    if not text:
        text = f"{what} differs only in line ends: expected {expected!r}, actual {actual!r}"[:400]
    return text


def describe_failure(command, output):
    text = f"command: {shlex.join(command)}\nexit status {output.status}"
    if output.stderr.strip():
        text += "\nstderr: " + output.stderr.strip()[-2500:]
    return text


def missing_patterns(patterns, text):
    """Lines of a pattern file that match nowhere in text. `!` before a pattern: it must match nowhere."""
    problems = []
    for line in patterns.splitlines():
        line = line.strip()
        if not line or line.startswith("#"):
            continue
        if line.startswith("!"):
            if re.search(line[1:].strip(), text, re.MULTILINE):
                problems.append(f"found, but must not be there: {line[1:].strip()}")
        elif not re.search(line, text, re.MULTILINE):
            problems.append(f"not found: {line}")
    return problems


def matches_json(expected, actual):
    """Every member of expected is in actual; a string starting with ~ is a regular expression."""
    if isinstance(expected, dict):
        return isinstance(actual, dict) and all(
            key in actual and matches_json(value, actual[key]) for key, value in expected.items())
    if isinstance(expected, str) and expected.startswith("~"):
        return re.search(expected[1:], str(actual)) is not None
    return expected == actual


# ---- programs with expected output --------------------------------------------------------------------------------


class ProgramTest:
    """A program (one file, or a folder) and beside it what it prints; run in memory, as a built executable, and in the
    stepping profile."""

    def __init__(self, path, stem, defaults=None):
        self.path = path    # file or folder given to rapidc
        self.stem = stem    # path of the expectation files without their suffix
        self.defaults = defaults or {}

    def expectation(self, suffix):
        path = self.stem + suffix
        return path if os.path.exists(path) else None

    def directives(self):
        found = dict(self.defaults)
        if os.path.isdir(self.path):
            for name in sorted(os.listdir(self.path)):
                if name.endswith(SOURCE_SUFFIXES):
                    for key, value in directives_of(os.path.join(self.path, name)).items():
                        found.setdefault(key, value)
        else:
            found.update(directives_of(self.path))
        return found

    def command_parts(self, directives):
        """(inputs, options that the compiler needs, options of the run)"""
        folder = self.path if os.path.isdir(self.path) else os.path.dirname(self.path)
        if "inputs" in directives:
            inputs = [os.path.join(folder, name) for name in directives["inputs"].split()]
        else:
            inputs = [self.path]
        arguments = [a.replace("{dir}", folder) for a in shlex.split(directives.get("args", ""))]
        compile_options = [a for a in arguments if a.startswith(COMPILE_OPTIONS)]
        run_options = [a for a in arguments if not a.startswith(COMPILE_OPTIONS)]
        if not os.path.isdir(self.path):
            if self.expectation(".cfg"):
                compile_options.append("--config=" + self.stem + ".cfg")
            if self.expectation(".stim.csv"):
                run_options.append("--stimulus=" + self.stem + ".stim.csv")
        return inputs, compile_options, run_options

    def run(self, context, scratch):
        directives = self.directives()
        inputs, compile_options, run_options = self.command_parts(directives)
        expected_status = int(directives.get("exit", "0"))
        timeout = float(directives.get("timeout", "30"))
        problems = []
        for mode in directives.get("modes", " ".join(MODES)).split():
            if mode not in MODES:
                raise BadTest(f"unknown mode '{mode}'")
            if mode not in context.modes:
                continue
            outputs = {".signals": os.path.join(scratch, mode + ".signals.csv"),
                       ".events": os.path.join(scratch, mode + ".events.jsonl")}
            extra = []
            if self.expectation(".signals"):
                extra.append("--signals=" + outputs[".signals"])
            if self.expectation(".events"):
                extra.append("--events=" + outputs[".events"])
            if mode != "aot":
                profile = {"step": ["--stepping"], "parts": ["--in-parts"], "words": ["--interpreted"],
                           "stepwords": ["--interpreted", "--stepping"]}.get(mode, [])
                command = [context.rapidc, "run", *profile, *inputs, *compile_options, *run_options, *extra]
            else:
                program = os.path.join(scratch, "program")
                build = [context.rapidc, "build", *inputs, *compile_options, "-o", program]
                built = execute(build, scratch, 60)
                if built.status != 0 or not os.path.exists(program):
                    problems.append("build failed\n" + describe_failure(build, built))
                    continue
                command = [program, *self.stimulus_of_folder(), *run_options, *extra]
            # Executables that load modules or write them ask rapidc to do it.
            output = execute(command, scratch, timeout, environment={"RAPIDC": context.rapidc})
            problems += [f"[{mode}] {p}" for p in
                         self.judge(context, command, output, expected_status, outputs, mode)]
        return problems

    def stimulus_of_folder(self):
        """`rapidc run FOLDER` reads FOLDER/stimulus.csv by itself; a built executable needs the option."""
        path = os.path.join(self.path, "stimulus.csv")
        return ["--stimulus=" + path] if os.path.isdir(self.path) and os.path.exists(path) else []

    def judge(self, context, command, output, expected_status, outputs, mode):
        problems = []
        expected_path = self.stem + ".out"
        if context.update and mode == "jit":
            with open(expected_path, "w", encoding="utf-8", newline="") as file:
                file.write(output.stdout)
        if not os.path.exists(expected_path):
            return [f"there is no {expected_path}: write what the program must print, an empty file for nothing"]
        expected = read(expected_path)
        if output.stdout != expected:
            problems.append(difference(expected, output.stdout, "stdout"))
        if output.status != expected_status:
            problems.append(f"expected exit status {expected_status}\n" + describe_failure(command, output))
        elif output.stdout != expected:
            problems.append(describe_failure(command, output))
        if self.expectation(".err"):
            problems += [f"stderr: {p}\nstderr was: {output.stderr.strip()[-2000:]}"
                         for p in missing_patterns(read(self.stem + ".err"), output.stderr)]
        elif re.search(r"\b(error|warning)\[RAP\d{4}\]", output.stderr):
            problems.append("a golden program must be free of diagnostics\n" + describe_failure(command, output))
        if self.expectation(".signals"):
            problems += self.judge_signals(context, outputs[".signals"], mode)
        if self.expectation(".events"):
            problems += self.judge_events(outputs[".events"])
        return problems

    def judge_signals(self, context, actual_path, mode):
        actual = read(actual_path) if os.path.exists(actual_path) else ""
        path = self.stem + ".signals"
        if context.update and mode == "jit":
            with open(path, "w", encoding="utf-8", newline="") as file:
                file.write(actual)
        rows = [normal_signal_row(line) for line in actual.splitlines()]
        expected = [normal_signal_row(line) for line in read(path).splitlines()]
        if [r for r in rows if r] == [r for r in expected if r]:
            return []
        return [difference("\n".join(map(str, filter(None, expected))), "\n".join(map(str, filter(None, rows))),
                           "signals")]

    def judge_events(self, actual_path):
        """Each line of the expectation is an object; objects like it must be in the log in this order."""
        actual = [json.loads(line) for line in (read(actual_path) if os.path.exists(actual_path) else "").splitlines()
                  if line.strip()]
        position = 0
        for line in read(self.stem + ".events").splitlines():
            if not line.strip() or line.startswith("#"):
                continue
            expected = json.loads(line)
            while position < len(actual) and not matches_json(expected, actual[position]):
                position += 1
            if position == len(actual):
                log = "\n".join(json.dumps(event) for event in actual)
                return [f"no such event (in this order): {line}\nthe log:\n{log}"]
            position += 1
        return []


def normal_signal_row(line):
    """time_s (to 10 ms),signal,value with numbers compared as numbers; None for the header, comments and blank lines."""
    fields = [field.strip() for field in line.split(",")]
    if len(fields) != 3 or line.startswith("#") or fields[0] == "time_s":
        return None
    try:
        return (round(float(fields[0]), 2), fields[1].lower(), float(fields[2]))
    except ValueError:
        return None


# ---- command line -------------------------------------------------------------------------------------------------


class CommandTest:
    """A .test file: `run:` lines, each followed by what is expected of it.

    run: rapidc check {dir}/x.modx     {dir} = folder of the test, {tmp} = scratch folder, {src} = the project
    exit: 1                            exact status (default 0)
    stdout: / stderr: / either:        a regular expression that must be found
    not: expression                    must not be found in either
    stdin: text                        given to the command
    file: NAME expression              a file in the scratch folder must hold this
    lines: N                           at most N lines on stderr

    Where all modes are interpreted ones, each `rapidc run` interprets.
    """

    def __init__(self, path):
        self.path = path

    def steps(self):
        steps = []
        for number, line in enumerate(read(self.path).splitlines(), 1):
            line = line.strip()
            if not line or line.startswith("#"):
                continue
            key, colon, value = line.partition(":")
            if not colon:
                raise BadTest(f"line {number}: no colon")
            if key == "run":
                steps.append((value.strip(), []))
            elif not steps:
                raise BadTest(f"line {number}: '{key}' before the first run")
            else:
                steps[-1][1].append((key, value.strip()))
        if not steps:
            raise BadTest("no run line")
        return steps

    def run(self, context, scratch):
        folder = os.path.dirname(self.path)
        problems = []

        def fill(text):
            return text.replace("{dir}", folder).replace("{tmp}", scratch).replace("{src}", context.source)

        for command_line, expectations in self.steps():
            command = [context.rapidc if word == "rapidc" else fill(word) for word in shlex.split(command_line)]
            if command[:2] == [context.rapidc, "run"] and context.interprets_all():
                command.insert(2, "--interpreted")
            stdin = "".join(value + "\n" for key, value in expectations if key == "stdin")
            output = execute(command, scratch, HANGS_AFTER_S, stdin.encode(), {"RAPIDC": context.rapidc})
            for problem in self.judge(expectations, output, scratch):
                problems.append(problem + "\n" + describe_failure(command, output) +
                                "\nstdout: " + output.stdout[:1500])
        return problems

    @staticmethod
    def judge(expectations, output, scratch):
        problems = []
        both = output.stdout + "\n" + output.stderr
        status = next((int(value) for key, value in expectations if key == "exit"), 0)
        if output.status != status:
            problems.append(f"expected exit status {status}, got {output.status}")
        if output.status < 0 or output.status >= 124:
            problems.append("the command crashed or hung")
        for key, value in expectations:
            if key in ("exit", "stdin"):
                continue
            if key == "stdout" or key == "stderr" or key == "either":
                text = both if key == "either" else getattr(output, key)
                if not re.search(value, text, re.MULTILINE):
                    problems.append(f"not found in {key}: {value}")
            elif key == "not":
                if re.search(value, both, re.MULTILINE):
                    problems.append(f"must not be there: {value}")
            elif key == "lines":
                if len(output.stderr.strip().splitlines()) > int(value):
                    problems.append(f"more than {value} lines on stderr")
            elif key == "file":
                name, _, pattern = value.partition(" ")
                path = os.path.join(scratch, name)
                if not os.path.exists(path) or not re.search(pattern, read(path), re.MULTILINE):
                    problems.append(f"file {name} is not there or does not hold: {pattern}")
            else:
                raise BadTest(f"unknown expectation '{key}'")
        return problems
