"""file_size.py COMMAND...: runs a command whose files must not grow beyond 1 KiB; says how it ended."""

import resource
import subprocess
import sys

done = subprocess.run(sys.argv[1:], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, timeout=100, check=False,
                      preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (1024, 1024)))
print("killed by signal" if done.returncode < 0 else "status not 0" if done.returncode > 0 else "status 0")
print(done.stderr[-300:])
