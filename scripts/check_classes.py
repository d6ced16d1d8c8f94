#!/usr/bin/env python3
"""Finds classes with more than 60 member functions or 25 data members.

A larger class needs a reason: a line "// Size: ..." directly before it.
"""

import glob
import os
import re
import sys

MOST_FUNCTIONS, MOST_FIELDS = 60, 25
HEAD = re.compile(r"\b(class|struct)\s+(?:\[\[[^\]]*\]\]\s*)?([A-Za-z_][\w:]*)\s*(?:final\s*)?(?::[^;{()]*)?\{")
NOT_FIELDS = re.compile(r"^(using|friend|typedef|enum|static constexpr|constexpr|static_assert|template|class|struct|union|#)")


def without_texts(source):
    """The source with comments and literals blanked, of the same length."""
    def blank(match):
        return re.sub(r"[^\n]", " ", match.group(0))
    return re.sub(r'//[^\n]*|/\*.*?\*/|R"\(.*?\)"|"(?:[^"\\\n]|\\.)*"|\'(?:[^\'\\\n]|\\.)+\'', blank, source, flags=re.S)


def members(body):
    """Declarations at the top level of a class body; a body of a function or class becomes "{}"."""
    depth, statement = 0, ""
    for char in body:
        if char == "{":
            depth += 1
            if depth == 1:
                statement += "{"
        elif char == "}":
            depth -= 1
            if depth == 0:
                statement += "}"
                head = statement.strip()
                # A function body ends the member; an initialiser or a nested type goes up to its semicolon.
                if "(" in head and not re.match(r"^(class|struct|union|enum)\b", head) and not re.search(r"=\s*\{\}$", head):
                    yield head
                    statement = ""
        elif depth == 0:
            if char == ";":
                yield statement.strip()
                statement = ""
            else:
                statement += char
                if char == ":":
                    statement = re.sub(r"\b(public|protected|private)\s*:$", "", statement)


def is_function(member):
    head = re.sub(r"<[^<>]*(<[^<>]*>[^<>]*)*>", "<>", member.split("=")[0].split("{")[0])
    return "(" in head


def count(body):
    functions = fields = 0
    for member in members(body):
        if not member:
            continue
        if member.startswith("template"):
            functions += "(" in member
        elif is_function(member) and not member.startswith(("using", "friend", "typedef", "static_assert")):
            functions += 1
        elif not NOT_FIELDS.match(member):
            fields += 1 + re.sub(r"<.*>|\{.*\}|\[.*\]", "", member).count(",")
    return functions, fields


def body_end(source, begin):
    depth = 0
    for place in range(begin, len(source)):
        if source[place] == "{":
            depth += 1
        elif source[place] == "}":
            depth -= 1
            if depth == 0:
                return place
    return len(source)


def main():
    arguments = sys.argv[1:]
    if arguments[:1] == ["--source"]:
        os.chdir(arguments[1])
        arguments = arguments[2:]
    files = arguments or sorted(glob.glob("**/*.h", recursive=True) + glob.glob("**/*.cpp", recursive=True))
    found = classes = 0
    for path in files:
        if path.startswith(("tests/", "build")):
            continue
        with open(path, encoding="utf-8") as file:
            original = file.read()
        source = without_texts(original)
        for match in HEAD.finditer(source):
            begin = match.end() - 1
            functions, fields = count(source[begin + 1:body_end(source, begin)])
            classes += 1
            if functions <= MOST_FUNCTIONS and fields <= MOST_FIELDS:
                continue
            before = original[:match.start()].rstrip().rsplit("\n", 3)
            if any(line.lstrip().startswith("// Size:") for line in before[1:]):
                continue
            line = original.count("\n", 0, match.start()) + 1
            found += 1
            print(f"{path}:{line}: {match.group(2)} has {functions} member functions and {fields} data members; "
                  f"split it, or give a reason in a line \"// Size: ...\" before it")
    print(f"classes: {classes} looked at, {found} too large")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
