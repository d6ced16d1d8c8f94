"""with_rapidc.py RAPIDC COMMAND...: runs a built executable that is to find rapidc there."""

import os
import subprocess
import sys

sys.exit(subprocess.run(sys.argv[2:], env=dict(os.environ, RAPIDC=sys.argv[1]), check=False).returncode)
