"""The tests of all kinds by name, for ctest (a process for each) and for `./dev test --quick` (few processes)."""

import dataclasses
import os
import re
import subprocess
import sys

from cases import describe_failure, execute
from discovery import discover

# Groups that `./dev test --quick` leaves out: each of their tests starts several processes, or needs seconds.
NOT_QUICK = {"cli", "errors", "fuzz", "interpreted"}
# Folders whose programs run interpreted, too: what leaves a routine or enters it elsewhere than at its beginning.
INTERPRETED = ("golden/errors", "golden/flow", "golden/interrupts", "golden/stop", "cli/state", "cli/step")
# Unit tests with these tags need seconds.
SLOW_TAGS = {"random", "large", "slow"}
# Unit tests that one process of `--quick` runs.
BATCH = 24


@dataclasses.dataclass
class ProgramRun:
    """A test that is the exit status of a command; it runs in the build folder."""
    command: list
    timeout: int
    tags: tuple = ()

    def run(self, context, _scratch):
        output = execute(self.command, context.build, self.timeout)
        if output.status == 0:
            return []
        return [describe_failure(self.command, output), output.stdout.strip()[-4000:]]


def unit_cases(program):
    """(name, tags) of the Catch2 cases in the unit test program; none when it is not built."""
    if not os.access(program, os.X_OK):
        return []

    def listing(option):
        return subprocess.run([program, option], capture_output=True, text=True, check=False).stdout.splitlines()

    names = [line for line in listing("--list-test-names-only") if line.strip()]
    # --list-tests has the same order, but wraps long names: a case begins with two blanks, its tags with six.
    tags = []
    for line in listing("--list-tests"):
        if re.match(r"^  \S", line):
            tags.append([])
        elif re.match(r"^      \[", line) and tags:
            tags[-1] += re.findall(r"\[(\w[^\]]*)\]", line)
    return list(zip(names, tags if len(tags) == len(names) else [[] for _ in names]))


def case_filter(name):
    """The name as a Catch2 test spec that matches it and nothing else."""
    for character in '\\,[':
        name = name.replace(character, "\\" + character)
    return name


def unit_test(program, names, timeout, tags=()):
    return ProgramRun([program, "-w", "NoTests", ",".join(map(case_filter, names))], timeout, tags)


def unit_program(build):
    return os.path.join(build, "rapidc_unit_tests")


def missing_unit_tests(build):
    """A test that fails, because the program is missing."""
    return {"unit/rapidc_unit_tests is not built; build the target rapidc_tests": ProgramRun([unit_program(build)], 60)}


def unit_tests(build):
    program = unit_program(build)
    return {"unit/" + name: unit_test(program, [name], 240, tags) for name, tags in unit_cases(program)} or \
        missing_unit_tests(build)


def batches_of_unit_tests(build):
    """The quick unit tests, several for each process."""
    names = [name for name, tags in unit_cases(unit_program(build)) if not SLOW_TAGS & set(tags)]
    batches = [names[i:i + BATCH] for i in range(0, len(names), BATCH)]
    return {f"unit/{batch[0]}, and the next {len(batch) - 1}": unit_test(unit_program(build), batch, 240)
            for batch in batches} or missing_unit_tests(build)


def python(*command):
    """Without the packages of the machine: reading their list takes longer than most tests."""
    return [sys.executable, "-S", *command]


def checks(source, build):
    """Tests of the sources themselves, and programs with a test for each."""
    scripts = os.path.join(source, "scripts")
    rapidc = os.path.join(build, "rapidc")
    return {
        "layers/classes": ProgramRun(python(os.path.join(scripts, "check_classes.py"), "--source", source), 60),
        "layers/layering": ProgramRun(python(os.path.join(scripts, "check_layering.py"), "--source", source), 60),
        "layers/layering_test": ProgramRun(python(os.path.join(source, "tests", "layers", "layering_test.py")), 60),
        "layers/runtime_alone": ProgramRun([os.path.join(build, "rapidc_runtime_alone")], 60),
        "stdlib/names": ProgramRun(python(os.path.join(scripts, "check_stdlib.py"), "--builtins",
                                          os.path.join(build, "generated", "stdlib", "builtins.json"), "--rapidc", rapidc), 60),
        "errors/every_constant": ProgramRun(python(os.path.join(scripts, "check_error_tests.py"), "--rapidc", rapidc), 900),
    }


def replays(source, build):
    """The kept inputs of the fuzzers, and some random programs."""
    corpora = os.path.join(source, "tests", "fuzz", "corpus")
    replay = os.path.join(source, "tests", "harness", "replay.py")
    found = {"fuzz/" + entry.name: ProgramRun(python(replay, os.path.join(build, "rapidc_replay_" + entry.name), entry.path), 240)
             for entry in sorted(os.scandir(corpora), key=lambda entry: entry.name) if entry.is_dir()}
    for name in ("tasks", "mutant"):
        found[f"fuzz/{name}_random"] = ProgramRun([os.path.join(build, "rapidc_replay_" + name), "-random=8"], 240)
    return found


def is_quick(name):
    return name.partition("/")[0] not in NOT_QUICK


def quick_tests(found, source, build):
    """The tests of `--quick` by name, long ones first, so that none is left alone at the end."""
    tests = {**batches_of_unit_tests(build), **checks(source, build), **{name: found[name] for name in sorted(found)}}
    return {name: test for name, test in tests.items() if is_quick(name)}


def bracket(text):
    """A CMake argument that is taken literally."""
    return f"[==[{text}]==]"


def write_ctest(path, source, build):
    """Registers all tests, a process for each. Labels: the group (unit, golden, diag ...), for unit tests their tags as well."""
    runner = python(os.path.join(source, "tests", "harness", "run_tests.py"), "--source", source, "--build", build)
    tests = unit_tests(build)
    tests.update({name: ProgramRun(runner + ["--one", name], 120) for name in sorted(discover(source))})
    tests.update({"interpreted/" + folder: ProgramRun(runner + ["--modes", "words stepwords", folder], 600)
                  for folder in INTERPRETED})
    tests.update(replays(source, build))
    tests.update(checks(source, build))
    lines = []
    for name, test in tests.items():
        group = name.partition("/")[0]
        labels = ";".join([group, *sorted(set(test.tags) - {group})])
        lines.append(f"add_test({bracket(name)} {' '.join(bracket(word) for word in test.command)})")
        lines.append(f"set_tests_properties({bracket(name)} PROPERTIES TIMEOUT {test.timeout} "
                     f"WORKING_DIRECTORY {bracket(build)} LABELS {bracket(labels)})")
    with open(path, "w", encoding="utf-8") as file:
        file.write("\n".join(lines) + "\n")
