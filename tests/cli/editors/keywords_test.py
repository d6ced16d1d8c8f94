#!/usr/bin/env python3
"""The files of editors/: every keyword of the lexer is in every word list and no other word is; what package.json names is there."""

import json
import pathlib
import re
import sys
import xml.etree.ElementTree as ElementTree

ROOT = pathlib.Path(__file__).resolve().parents[3]
EDITORS = ROOT / "editors"
CONTEXTUAL = {"TASK"}  # words only where the grammar has them (frontend/syntax)


def keywords():
    text = (ROOT / "frontend/syntax/token_kinds.def").read_text(encoding="utf-8")
    return set(re.findall(r'^KEYWORD\(\w+, "(\w+)"\)', text, re.MULTILINE))


def vim_words():
    text = (EDITORS / "vim/syntax/rapid.vim").read_text(encoding="utf-8")
    lines = re.findall(r"^syntax keyword rapid(?!Todo)\w+ (.*)$", text, re.MULTILINE)
    return {word for line in lines for word in line.split() if word != "contained"}


def emacs_words():
    text = (EDITORS / "emacs/rapid-mode.el").read_text(encoding="utf-8")
    lists = re.findall(r"\(defconst rapid--(?:control|structure|storage|operators) '\(([^)]*)\)\)", text)
    return set(re.findall(r'"(\w+)"', " ".join(lists)))


def kate_words():
    tree = ElementTree.parse(EDITORS / "kate/rapid.xml")
    return {item.text for item in tree.iter("item")}


def vscode_problems():
    """Commands, files and settings of package.json."""
    folder = EDITORS / "vscode"
    package = json.loads((folder / "package.json").read_text(encoding="utf-8"))
    contributes = package["contributes"]
    sources = "\n".join(path.read_text(encoding="utf-8") for path in sorted((folder / "src").glob("*.ts")))
    for command in contributes["commands"]:
        name = command["command"].removeprefix("rapidc.")
        if f'"{name}"' not in sources and f'"{command["command"]}"' not in sources:
            yield f"package.json: no source registers the command {command['command']}"
    named = [language["configuration"] for language in contributes["languages"] if "configuration" in language]
    named += [icon for language in contributes["languages"] for icon in language.get("icon", {}).values()]
    named += [entry["path"] for kind in ("grammars", "snippets") for entry in contributes[kind]]
    for name in named:
        path = folder / name
        if not path.is_file():
            yield f"package.json: {name} is not there"
        elif path.suffix == ".json":
            json.loads(path.read_text(encoding="utf-8"))
    lock = json.loads((folder / "package-lock.json").read_text(encoding="utf-8"))["packages"][""]
    for kind in ("dependencies", "devDependencies"):
        if lock.get(kind) != package.get(kind):
            yield f"package-lock.json: {kind} are not those of package.json"
        for name, version in package[kind].items():
            if not re.fullmatch(r"\d+\.\d+\.\d+", version):
                yield f"package.json: {name} {version} is not one version"
    # launch arguments of the debug adapter
    launch = contributes["debuggers"][0]["configurationAttributes"]["launch"]["properties"]
    for name in ("program", "stopOnEntry", "robot", "config", "tasks", "stimulus", "home", "realtime"):
        if name not in launch:
            yield f"package.json: the launch argument {name} is missing"


def main():
    wanted = keywords()
    problems = list(vscode_problems())
    for editor, words in (("vim", vim_words()), ("emacs", emacs_words()), ("kate", kate_words())):
        if words - CONTEXTUAL != wanted:
            problems.append(f"{editor}: missing {sorted(wanted - words)}, unknown {sorted(words - CONTEXTUAL - wanted)}")
    for problem in problems:
        print(problem)
    print(f"{len(wanted)} keywords, {len(problems)} problems")
    return 1 if problems or len(wanted) < 50 else 0


if __name__ == "__main__":
    sys.exit(main())
