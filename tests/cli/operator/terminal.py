"""Runs a command at a terminal of its own and types each answer when its question has appeared.

terminal.py QUESTION=ANSWER ... -- COMMAND ...
"""

import os
import pty
import subprocess
import sys
import tempfile

split = sys.argv.index("--")
answers = [argument.split("=", 1) for argument in sys.argv[1:split]]
keyboard, terminal = pty.openpty()
with tempfile.TemporaryFile() as shown:
    process = subprocess.Popen(sys.argv[split + 1:], stdin=terminal, stdout=shown, stderr=subprocess.PIPE)
    os.close(terminal)
    seen = ""
    for question, answer in answers:
        while question not in seen:
            part = os.read(process.stderr.fileno(), 4096).decode()
            if not part:
                sys.exit(f"the program ended before it asked '{question}':\n{seen}")
            seen += part
        seen = seen.split(question, 1)[1]
        os.write(keyboard, (answer + "\n").encode())
    if not answers:
        os.close(keyboard)
    rest = process.stderr.read().decode()
    status = process.wait()
    shown.seek(0)
    sys.stdout.write(shown.read().decode())
    sys.stderr.write(rest)
sys.exit(status)
