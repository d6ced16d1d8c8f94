"""edit.py FILE PATTERN TEXT: replaces the first match."""

import re
import sys

path, pattern, text = sys.argv[1:]
with open(path, encoding="utf-8") as file:
    content = file.read()
with open(path, "w", encoding="utf-8") as file:
    file.write(re.sub(pattern, lambda match: text, content, count=1))
