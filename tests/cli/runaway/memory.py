"""memory.py COMMAND...: runs a command; prints its status and whether it stayed below a bound of memory."""

import os
import resource
import subprocess
import sys

done = subprocess.run(sys.argv[1:], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, timeout=100, check=False,
                      env=dict(os.environ, ASAN_OPTIONS="quarantine_size_mb=1:detect_leaks=0"))
peak = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss // 1024  # MB
print(done.stdout.decode(), end="")
print("status", done.returncode)
print("bounded" if peak < 400 else f"{peak} MB")
