#!/usr/bin/env python3
"""Measures how many messages a single typing mistake gives.

Takes programs of tests/golden that need no configuration, makes one mistake at a time in each (a token or a character lost or
doubled, two neighbours exchanged, a sign for a similar one), and counts the errors of `rapidc check`. Prints how many mistakes
give no error, one, and several, for each kind of mistake and in all; `--several` lists the last. With `--compare` another rapidc checks the same mistakes, and every
difference is listed. `--every N` takes each N-th mistake: 1 means all, some tens of thousands.
"""

import argparse
import collections
import concurrent.futures
import os
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
TOKEN = re.compile(r'![^\n]*|"(?:[^"\n]|"")*"|\w+|:=|<>|<=|>=|\S')
SIMILAR = {":=": "=", "=": ":=", ";": ":", ",": ".", ".": ",", "(": "[", ")": "]", "{": "(", "}": ")", "\\": "/", "<>": "!="}


def mistakes(text):
    """(description, text with the mistake) of each single mistake."""
    tokens = [found for found in TOKEN.finditer(text) if not found[0].startswith("!")]
    for i, token in enumerate(tokens):
        begin, end, word = token.start(), token.end(), token[0]
        line = text.count("\n", 0, begin) + 1

        def changed(what, replacement, begin=begin, end=end, word=word, line=line):
            return f"line {line}, {word!r}: {what}", text[:begin] + replacement + text[end:]

        yield changed("lost", "")
        if word in SIMILAR:
            yield changed(f"as {SIMILAR[word]!r}", SIMILAR[word])
        if len(word) > 2 and word.isidentifier():
            middle = len(word) // 2
            yield changed("a letter lost", word[:middle] + word[middle + 1:])
            yield changed("a letter doubled", word[:middle] + word[middle] + word[middle:])
            if word[middle - 1].lower() != word[middle].lower():
                yield changed("letters exchanged", word[:middle - 1] + word[middle] + word[middle - 1] + word[middle + 1:])
        elif not word.isidentifier():
            yield changed("doubled", word + word)
        if i + 1 < len(tokens):
            following = tokens[i + 1]
            between = text[end:following.start()]
            yield changed("exchanged with the next", following[0] + between + word, end=following.end())


def programs():
    for path in sorted((ROOT / "tests/golden").rglob("*.modx")):
        text = path.read_text(encoding="utf-8")
        if not path.with_suffix(".cfg").exists() and path.with_suffix(".out").exists() and "!@ args" not in text:
            yield path, text


def errors(rapidc, path):
    """Codes of the errors, in order."""
    done = subprocess.run([rapidc, "check", path], capture_output=True, text=True, check=False)
    if done.returncode not in (0, 1):
        return [f"exit status {done.returncode}"]
    return re.findall(r"error\[(RAP\d{4})\]", done.stderr + done.stdout)


def kind_of(what):
    """"line 3, ';': as ':'" is of the kind "another sign"."""
    kind = what.rsplit(": ", 1)[1]
    return "another sign" if kind.startswith("as ") else kind


def counted(counts):
    total = sum(counts.values())
    share = 100 / max(total, 1)
    return (f"{total} mistakes: {counts[0]} without an error ({counts[0] * share:.1f} %), {counts[1]} with one, "
            f"{counts[2]} with several ({counts[2] * share:.1f} %)")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--rapidc", default=str(ROOT / "build/rapidc"))
    parser.add_argument("--compare", metavar="RAPIDC", help="another version, for the differences")
    parser.add_argument("--every", type=int, default=10, help="take each N-th mistake (default 10)")
    parser.add_argument("--several", action="store_true", help="list the mistakes with several errors")
    parser.add_argument("-j", type=int, default=os.cpu_count() or 2)
    options = parser.parse_args()
    cases = []
    for path, text in programs():
        cases += [(path, what, wrong) for what, wrong in mistakes(text)]
    total = len(cases)
    cases = cases[::options.every]
    counts, kinds, differences = collections.Counter(), collections.defaultdict(collections.Counter), []
    with tempfile.TemporaryDirectory() as folder:

        def judge(number):
            path, what, wrong = cases[number]
            file = os.path.join(folder, f"{number}.modx")
            with open(file, "w", encoding="utf-8") as out:
                out.write(wrong)
            found = errors(options.rapidc, file)
            other = errors(options.compare, file) if options.compare else found
            os.unlink(file)
            return f"{path.relative_to(ROOT)}: {what}", found, other

        with concurrent.futures.ThreadPoolExecutor(options.j) as pool:
            for name, found, other in pool.map(judge, range(len(cases))):
                counts[min(len(found), 2)] += 1
                kinds[kind_of(name)][min(len(found), 2)] += 1
                if found != other:
                    differences.append(f"{name}: {' '.join(found) or 'none'} (the other: {' '.join(other) or 'none'})")
                if options.several and len(found) > 1:
                    print(f"{name}: {' '.join(found)}")
    for difference in differences:
        print(difference)
    for kind, own in sorted(kinds.items()):
        print(f"{kind}: {counted(own)}")
    print(f"{counted(counts)}, of {total}" + (f"; {len(differences)} differ" if options.compare else ""))
    return 0


if __name__ == "__main__":
    sys.exit(main())
