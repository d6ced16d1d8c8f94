"""other_version.py EXECUTABLE COPY: an executable that says it was built by another rapidc."""

import re
import shutil
import sys

with open(sys.argv[1], "rb") as file:
    content = file.read()
shutil.copy(sys.argv[1], sys.argv[2])
changed, count = re.subn(rb"(\x6bfingerprint\x70)[0-9a-f]{4}", rb"\g<1>zzzz", content)
with open(sys.argv[2], "wb") as file:
    file.write(changed)
sys.exit(0 if count == 1 else 1)
