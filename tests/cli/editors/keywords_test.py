#!/usr/bin/env python3
"""The files of editors/: every keyword of the lexer is in every word list and no other word is; what package.json names is there; the
settings of Helix and Kate have the keys that these editors read."""

import json
import pathlib
import re
import sys
import tomllib
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


# Helix refuses a file with a key of [[language]] that it does not know (docs.helix-editor.com, Languages and Adding languages).
HELIX_LANGUAGE = {"name", "scope", "file-types", "roots", "comment-token", "comment-tokens", "indent", "language-servers", "auto-format",
                  "debugger"}
HELIX_DEBUGGER = {"name", "transport", "command", "args", "templates"}
HELIX_TEMPLATE = {"name", "request", "completion", "args"}
# docs.kde.org, Kate handbook, LSP Client Plugin, Configuration.
KATE_SERVER = {"command", "commandDebug", "root", "rootIndicationFileNames", "rootIndicationFilePatterns", "url", "highlightingModeRegex",
               "initializationOptions", "settings", "documentLanguageId", "use"}


def helix_problems():
    """The server takes documents of the language "rapid"; the debugger starts a program that the user chooses."""
    settings = tomllib.loads((EDITORS / "helix/languages.toml").read_text(encoding="utf-8"))
    language = settings["language"][0]
    debugger = language["debugger"]
    for what, given, known in (("language", language, HELIX_LANGUAGE), ("debugger", debugger, HELIX_DEBUGGER),
                               *(("template", template, HELIX_TEMPLATE) for template in debugger["templates"])):
        if set(given) - known:
            yield f"helix: {what} has unknown keys {sorted(set(given) - known)}"
    if language["name"] != "rapid" or not language["scope"]:
        yield "helix: the language is not rapid"
    if set(language["language-servers"]) - set(settings["language-server"]):
        yield "helix: a language server is not defined"
    types = {each if isinstance(each, str) else each["glob"].removeprefix("*.") for each in language["file-types"]}
    if types != {"modx", "sysx", "mod", "sys"}:
        yield f"helix: the file types are {sorted(types)}"
    if debugger["transport"] != "stdio" or debugger["templates"][0]["args"]["program"] != "{0}":
        yield "helix: the debugger has no program on standard input and output"
    for command, word in ((settings["language-server"]["rapidc"], "lsp"), (debugger, "dap")):
        if (command["command"], command["args"]) != ("rapidc", [word]):
            yield f"helix: the command is not rapidc {word}"


def kate_problems():
    """The name of the server is the language id that the server gets; the mode is the one of rapid.xml."""
    servers = json.loads((EDITORS / "kate/lspclient.json").read_text(encoding="utf-8"))["servers"]
    mode = ElementTree.parse(EDITORS / "kate/rapid.xml").getroot().get("name")
    if list(servers) != ["rapid"]:
        yield f"kate: the servers are {sorted(servers)}"
    server = servers["rapid"]
    if set(server) - KATE_SERVER:
        yield f"kate: unknown keys {sorted(set(server) - KATE_SERVER)}"
    if server["command"] != ["rapidc", "lsp"] or not re.search(server["highlightingModeRegex"], mode):
        yield "kate: the command is not rapidc lsp for the mode of rapid.xml"
    if server.get("documentLanguageId", True) is not True or set(server["settings"]) != {"rapidc"}:
        yield "kate: the server gets no language id, or no settings of rapidc"


def main():
    wanted = keywords()
    problems = [*vscode_problems(), *helix_problems(), *kate_problems()]
    for editor, words in (("vim", vim_words()), ("emacs", emacs_words()), ("kate", kate_words())):
        if words - CONTEXTUAL != wanted:
            problems.append(f"{editor}: missing {sorted(wanted - words)}, unknown {sorted(words - CONTEXTUAL - wanted)}")
    for problem in problems:
        print(problem)
    print(f"{len(wanted)} keywords, {len(problems)} problems")
    return 1 if problems or len(wanted) < 50 else 0


if __name__ == "__main__":
    sys.exit(main())
