"""in_use.py FOLDER COMMAND...: runs a command while another process holds the folder's lock."""

import fcntl
import os
import subprocess
import sys

with open(os.path.join(sys.argv[1], "lock"), "w", encoding="utf-8") as lock:
    fcntl.flock(lock, fcntl.LOCK_EX)
    print("status", subprocess.run(sys.argv[2:], check=False).returncode)
