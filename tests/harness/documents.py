"""Tests of documents: their programs, links and forms."""

import glob
import os
import re

from cases import describe_failure, difference, execute, read

FENCE = re.compile(r"^```([a-z-]*)\s*$(.*?)^```\s*$", re.MULTILINE | re.DOTALL)
LINK = re.compile(r"\]\(([^)\s]*)\)")
HEADING = re.compile(r"^#+ +(.*?)\s*$", re.MULTILINE)


def anchors(text):
    """The anchors of the headings of a page, as web pages of repositories make them."""
    found = set()
    for heading in HEADING.findall(FENCE.sub("", text)):
        plain = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading).replace("`", "").lower()
        found.add(re.sub(r"[^\w\- ]", "", plain).replace(" ", "-"))
    return found


def broken_links(path, text):
    problems = []
    for link in LINK.findall(FENCE.sub("", text)):
        if "://" in link or link.startswith("mailto:"):
            continue
        target, _, anchor = link.partition("#")
        page = os.path.join(os.path.dirname(path), target) if target else path
        if not os.path.exists(page):
            problems.append(f"a link leads nowhere: {link}")
        elif anchor and page.endswith(".md") and anchor not in anchors(read(page)):
            problems.append(f"a link leads to a heading that does not exist: {link}")
    return problems


class DocumentTest:
    """RAPID blocks of a page compile; a block `output` right after one is what that program prints. Links inside the
    project lead to files and headings."""

    def __init__(self, path):
        self.path = path

    def run(self, context, scratch):
        text = read(self.path)
        problems = []
        blocks = [(m.group(1), m.group(2).lstrip("\n"), text.count("\n", 0, m.start()) + 1)
                  for m in FENCE.finditer(text)]
        for index, (language, code, line) in enumerate(blocks):
            if language != "rapid" or not re.search(r"^\s*MODULE\b", code, re.MULTILINE):
                continue
            path = os.path.join(scratch, f"block{line}.modx")
            with open(path, "w", encoding="utf-8") as file:
                file.write(code)
            follows = blocks[index + 1] if index + 1 < len(blocks) else ("", "", 0)
            runs = follows[0] == "output"
            command = [context.rapidc, "run" if runs else "check", path]
            output = execute(command, scratch, 20)
            if output.status != 0:
                problems.append(f"line {line}: the block fails\n" + describe_failure(command, output))
            elif runs and output.stdout != follows[1]:
                problems.append(f"line {line}: " + difference(follows[1], output.stdout, "output"))
        return problems + broken_links(self.path, text)


class DecisionsTest:
    """docs/decisions: every file has a number, a date, a status and its three parts, and a row of the index."""

    FORM = re.compile(r"^# (\d+)\. .+\n\nDate: \d{4}-\d\d-\d\d\. Status: (accepted|replaced by \d+)\.\n\n"
                      r"## Context\n\n\S.*\n## Choice\n\n\S.*\n## Consequences\n\n\S", re.DOTALL)

    def __init__(self, folder):
        self.folder = folder

    def run(self, _context, _scratch):
        problems, numbers = [], {}
        index = read(os.path.join(self.folder, "README.md"))
        for name in sorted(os.listdir(self.folder)):
            path = os.path.join(self.folder, name)
            text = read(path)
            problems += [f"{name}: {problem}" for problem in broken_links(path, text)]
            if name == "README.md":
                continue
            match = self.FORM.match(text)
            if not match or not name.startswith(f"{int(match.group(1)):04d}-"):
                problems.append(f"{name}: expected NNNN-title.md with '# N. Title', 'Date: ... Status: ...', and the parts "
                                "Context, Choice, Consequences")
                continue
            if f"({name})" not in index:
                problems.append(f"{name}: README.md has no row for it")
            if match.group(1) in numbers:
                problems.append(f"{name} has the number of {numbers[match.group(1)]}")
            numbers[match.group(1)] = name
        return problems


class LanguageSupportTest:
    """docs/language_support.md agrees with `rapidc builtins` and with the folders of the tests."""

    STATES = {"P", "partial", "read"}

    def __init__(self, path):
        self.path = path

    def rows(self):
        """(line number, chapters, feature, state, remarks) of the table."""
        for number, line in enumerate(read(self.path).splitlines(), 1):
            cells = [cell.strip() for cell in line.strip().strip("|").split("|")]
            if line.startswith("| ") and len(cells) == 4 and cells[2] != "state":
                yield number, *cells

    def run(self, context, scratch):
        listing = execute([context.rapidc, "builtins", "--format=tsv"], scratch, 20).stdout
        predefined = [row.split("\t") for row in listing.splitlines()[1:]]
        declared_only = {name: status == "declared only" for name, _, _, status in predefined}
        tests = os.path.join(context.source, "tests")
        problems, named, chapters = [], set(), set()
        for number, where, feature, state, remarks in self.rows():
            chapters |= set(re.findall(r"[\d.]+", where))
            if state not in self.STATES:
                problems.append(f"line {number}: state '{state}', expected one of {', '.join(sorted(self.STATES))}")
            for name in re.findall(r"[A-Za-z_]\w*", feature):
                if name not in declared_only:
                    continue
                named.add(name)
                if declared_only[name] != (state == "read"):
                    problems.append(f"line {number}: '{name}' is "
                                    f"{'declared only' if declared_only[name] else 'implemented'}, not '{state}'")
            for path in re.findall(r"\b((?:golden|tasks|cli|samples|unit)/[\w*/]+)", remarks):
                found = glob.glob(os.path.join(tests, path + "*")) or glob.glob(os.path.join(tests, path + "_*"))
                if not found:
                    problems.append(f"line {number}: no test is named {path}")
        unlisted = {chapter for _, _, chapter, _ in predefined if re.match(r"^1\.\d", chapter)} - chapters
        if unlisted:
            problems.append("chapters with built-ins, but without a row: " + ", ".join(sorted(unlisted)))
        missing = sorted(name for name, only in declared_only.items() if only and name not in named)
        if missing:
            problems.append("declared only, but without a row of state 'read': " + ", ".join(missing))
        return problems
