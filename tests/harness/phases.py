"""Snapshots of the phases of the compiler: one small program for each chapter (tests/phases/README.md)."""

import os

from cases import describe_failure, difference, execute, read

PHASES = ("tokens", "tree", "symbols", "ir")


class PhaseTest:
    """`rapidc emit --as=PHASE` of a program prints the file NAME.PHASE beside it."""

    def __init__(self, path):
        self.path = path

    def run(self, context, _scratch):
        folder, name = os.path.split(self.path)
        problems = []
        for phase in PHASES:
            command = [context.rapidc, "emit", "--as=" + phase, name]
            output = execute(command, folder, 20)
            if output.status != 0:
                problems.append(f"{phase}: " + describe_failure(command, output))
                continue
            snapshot = os.path.splitext(self.path)[0] + "." + phase
            if context.update:
                with open(snapshot, "w", encoding="utf-8", newline="") as file:
                    file.write(output.stdout)
            elif not os.path.exists(snapshot):
                problems.append(f"there is no {snapshot}: see tests/phases/README.md")
            elif output.stdout != read(snapshot):
                problems.append(f"{phase}: " + difference(read(snapshot), output.stdout, phase))
        return problems


def discover_phases(tests, found):
    folder = os.path.join(tests, "phases")
    for name in sorted(os.listdir(folder)):
        stem, suffix = os.path.splitext(name)
        if suffix == ".modx":
            found["phases/" + stem] = PhaseTest(os.path.join(folder, name))
