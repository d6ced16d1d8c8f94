"""elsewhere.py RAPIDC MODULE: builds in one folder, with a relative name, runs in another."""

import os
import shutil
import subprocess
import sys
import tempfile

with tempfile.TemporaryDirectory() as folder:
    shutil.copy(sys.argv[2], os.path.join(folder, "m.modx"))
    subprocess.run([sys.argv[1], "build", "m.modx", "-o", "m"], cwd=folder, check=True)
    subprocess.run([os.path.join(folder, "m"), "--save"], cwd="/", env=dict(os.environ, RAPIDC=sys.argv[1]), check=False)
    with open(os.path.join(folder, "m.modx"), encoding="utf-8") as file:
        print("".join(line.strip() + "\n" for line in file if "PERS" in line))
