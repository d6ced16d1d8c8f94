"""check_options.py RAPIDC EXECUTABLE: an option of 'rapidc build', 'run' or 'serve' that an executable lacks is refused with the name of
the command that has it. The options are those that the help texts list."""

import re
import subprocess
import sys

RAPIDC, EXECUTABLE = sys.argv[1:]


def options(*command):
    text = subprocess.run([*command, "--help"], capture_output=True, text=True, timeout=60).stdout
    return {name for line in re.findall(r"^ +(-\S+)", text, re.M) for name in line.split(",")}


own = options(EXECUTABLE)
problems, count = [], 0
for command in ("build", "run", "serve"):
    for option in sorted(options(RAPIDC, command) - own):
        count += 1
        result = subprocess.run([EXECUTABLE, option], capture_output=True, text=True, timeout=60)
        if result.returncode != 3 or not re.search(rf"'{option}' is an option of 'rapidc \w+'", result.stderr):
            problems.append(f"{option} of {command}: exit {result.returncode}, {result.stderr.strip()}")
print("\n".join(problems) if problems else f"{count} options")
