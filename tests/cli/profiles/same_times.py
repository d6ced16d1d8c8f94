"""Every profile prints the same: what a program prints and its events, with their times (decision 7).

same_times.py RAPIDC WORK INPUT [OPTION ...]: "fine", or the first line that differs.
"""
import os
import subprocess
import sys


def output(command):
    result = subprocess.run(command, capture_output=True, text=True, timeout=120)
    return f"status {result.returncode}\n{result.stdout}{result.stderr}".splitlines()


def profiles(rapidc, work, source, options):
    for flags in [], ["--stepping"], ["--interpreted"], ["--no-optimise"]:
        yield " ".join(["run", *flags]), output([rapidc, "run", *flags, source, *options])
    for flags in [], ["--stepping"]:
        executable = os.path.join(work, "program")
        subprocess.run([rapidc, "build", *flags, source, "-o", executable, *options], check=True)
        yield " ".join(["build", *flags]), output([executable])


def main(rapidc, work, source, *options):
    expected = None
    for name, lines in profiles(rapidc, work, source, options):
        if expected is None:
            expected = lines
            if len(lines) < 10:
                return f"too few lines: {lines}"
            continue
        for number in range(max(len(lines), len(expected))):
            pair = [text[number] if number < len(text) else "nothing" for text in (expected, lines)]
            if pair[0] != pair[1]:
                return f"{name}: line {number + 1} is '{pair[1]}', with 'run' '{pair[0]}'"
    return "fine"


if __name__ == "__main__":
    print(main(*sys.argv[1:]))
