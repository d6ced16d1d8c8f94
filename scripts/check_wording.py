#!/usr/bin/env python3
"""Looks for phrases that docs/style.md replaces.

usage: check_wording.py [BASE]   lines added since BASE (default: origin/main, else the parent commit)
       check_wording.py --all    every text of the project
"""

import re
import subprocess
import sys

# (pattern, what to write instead), applied to comments, strings and prose
HABITS = [
    (r"\b(told|tells)\b", "reported, reports, gives"),
    (r"\bbehind\b(?! (axis|the lower arm|\(1\)))", "after"),  # in space it is correct
    (r"\bahead of\b(?! time)", "before"),
    (r"\b(goes|go|going) on\b", "continues, continue"),
    (r"\bstands for\b", "means, represents"),
    (r"\bstands\b", "is"),
    (r"(?<!there )\b(is|are) no (?!longer|more|less|such)\w+", "is not a ..., are not ..."),
    (r"\bnobody\b", "is not used, is not needed; no task, no handler"),
    (r"\breplace[sd]? [^.;]{1,40} by\b", "replace ... with"),
    (r"\bchanged? places\b", "are swapped, swap"),
    (r", also (when|while|if|where|after|before)\b", "even when, even if"),
    (r"\b(has|have|had|of|in|to|with) another (type|form|order|kind|way|format|number of)\b", "a different type ..."),
    (r"\bbe it\b", "which may be"),
    (r"\banew\b", "again"),
    (r"\bkeeps? step with\b", "keeps pace with"),
    (r"\ball is well\b", "succeeds, has no problems"),
    (r"\bon every way\b", "on every path"),
    (r"\bmend(s|ed|ing)?\b", "correct"),
    (r"\bpassed over\b", "skipped"),
    (r"(?:^|[.!?] )(What|Who|Where) [^?]*\.(?: |$)", "a sentence with the subject first"),
]
PATTERNS = [(re.compile(pattern, 0 if "What" in pattern else re.IGNORECASE), instead) for pattern, instead in HABITS]

CODE = (".cpp", ".h", ".def", ".py", ".cmake", ".sysx", ".modx")
PROSE = (".md",)
# Texts about the habits themselves, and records of the past.
EXEMPT = ("docs/style.md", "scripts/check_wording.py", "CHANGELOG.md")


def git(*arguments):
    return subprocess.run(("git",) + arguments, capture_output=True, text=True, check=False)


def texts_of(path, line):
    """The parts of a line that people read: prose, comments and strings."""
    if path.endswith(PROSE):
        return [re.sub(r"`[^`]*`", "`code`", line)]
    texts = re.findall(r'"((?:[^"\\]|\\.)*)"', line)
    marker = {".py": "#", ".cmake": "#", ".modx": "!", ".sysx": "!"}.get(path[path.rfind("."):], "//")
    place = line.find(marker)
    if place >= 0:
        texts.append(line[place:].lstrip("/!#< "))
    return texts


def added_lines(base):
    path, number = "", 0
    for line in git("diff", "--unified=0", "--no-color", base, "--").stdout.splitlines():
        if line.startswith("+++ "):
            path = line[6:]
        elif line.startswith("@@"):
            number = int(re.match(r"@@ -\S+ \+(\d+)", line).group(1))
        elif line.startswith("+"):
            yield path, number, line[1:]
            number += 1


def all_lines():
    for path in git("ls-files").stdout.splitlines():
        if not path.endswith(CODE + PROSE):
            continue
        with open(path, encoding="utf-8", errors="replace") as file:
            for number, line in enumerate(file, 1):
                yield path, number, line.rstrip("\n")


def default_base():
    for name in ("origin/main", "HEAD~1"):
        if git("rev-parse", "--verify", "--quiet", name).returncode == 0:
            return name
    return "HEAD"


def main():
    arguments = sys.argv[1:]
    lines = all_lines() if arguments == ["--all"] else added_lines(arguments[0] if arguments else default_base())
    found = 0
    for path, number, line in lines:
        if not path.endswith(CODE + PROSE) or path in EXEMPT:
            continue
        for text in texts_of(path, line):
            for pattern, instead in PATTERNS:
                match = pattern.search(text)
                if match:
                    found += 1
                    print(f'{path}:{number}: "{match.group(0).strip()}": write {instead} (docs/style.md)')
    print(f"wording: {found} phrases to change")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
