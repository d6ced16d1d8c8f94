#!/usr/bin/env python3
"""Lists pairs of a built-in and an error constant that no test covers.

`!@ raises:` of stdlib/decl says which error constants a built-in raises. A pair counts as covered when one test (a program with
its further modules) calls the built-in and names the constant. EXEMPT holds the pairs that no program can raise here, each with
the reason; an entry that is not needed any more is a mistake, too.
"""

import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
TESTS = ("golden", "tasks", "cli")
EXEMPT = {
    ("Decr", "ERR_NUM_LIMIT"): "a step of 1 does not change a number near the limit",
    ("RMQGetMessage", "ERR_RMQ_INVMSG"): "only a client outside of the controller sends such messages",
    ("RMQReadWait", "ERR_RMQ_INVMSG"): "only a client outside of the controller sends such messages",
    ("StartMoveRetry", "ERR_PROGSTOP"): "the handler that executes it belongs to a program that is started",
    ("StartMoveRetry", "ERR_STARTMOVE"): "the handler that executes it belongs to a program that is started",
    ("UIMsgWrite", "ERR_TP_NO_CLIENT"): "the message is written to the console when nobody else shows it",
    ("UIShow", "ERR_UISHOW_FULL"): "RobotWare 7 has no such views: the first one raises ERR_UISHOW_FATAL",
}


def declared_pairs():
    """(built-in, constant) of all declarations, in the order of the files."""
    for path in sorted((ROOT / "stdlib/decl").glob("*.sysx")):
        constants = []
        for line in path.read_text(encoding="utf-8").splitlines():
            if found := re.match(r"\s*!@ raises:\s*(.*)", line):
                constants = [name.strip() for name in found[1].split(",") if name.strip()]
            elif found := re.match(r"\s*(?:PROC|FUNC\s+\w+)\s+(\w+)", line):
                yield from ((found[1], constant) for constant in constants)
                constants = []


def tests():
    """The words of each test in lower case. Modules of one folder with `!@ inputs:` are one test."""
    for part in TESTS:
        words = {}
        for path in (ROOT / "tests" / part).rglob("*"):
            if path.suffix not in (".modx", ".mod", ".sysx", ".sys"):
                continue
            text = path.read_text(encoding="utf-8", errors="replace").lower()
            key = path.parent if part == "tasks" or (path.parent / "expected.out").exists() else path
            words.setdefault(key, set()).update(re.findall(r"\w+", re.sub(r'"[^"\n]*"', "", text)))
        yield from words.values()


def main():
    covered = list(tests())
    pairs = list(declared_pairs())
    missing = [(name, constant) for name, constant in pairs
               if not any(name.lower() in words and constant.lower() in words for words in covered)]
    mistakes = [f"{name} {constant}: no test raises it" for name, constant in missing if (name, constant) not in EXEMPT]
    mistakes += [f"{name} {constant}: the exemption is not needed" for name, constant in EXEMPT
                 if (name, constant) not in missing]
    for mistake in mistakes:
        print(mistake)
    if not mistakes:
        print(f"{len(pairs)} pairs of built-in and error constant, {len(EXEMPT)} exempt")
    return 1 if mistakes else 0


if __name__ == "__main__":
    sys.exit(main())
