#!/usr/bin/env python3
"""Checks every #include against the layers of the architecture and reports files and functions that are too long.

An include that crosses a layer the wrong way is an error, and so is a word of RAPID in a layer that knows no source
language; length is only reported.
"""

import argparse
import os
import re
import sys

# Layer of a file = the longest of these prefixes. The value lists the layers it may include besides itself; all of them
# stand further up in this table (check_table), so that no two layers need each other.
LAYERS = {
    # configuration text and letter case: needed by the front end and by the runtime, and knows neither
    "config": [],
    "frontend/source": ["config"],
    "frontend/diag": ["frontend/source", "config"],
    "frontend/syntax": ["frontend/source", "frontend/diag", "config"],
    "frontend/sema": ["frontend/source", "frontend/diag", "frontend/syntax", "config"],
    "frontend/edit": ["frontend/source", "frontend/diag", "frontend/syntax", "frontend/sema", "config"],
    "frontend/project": ["frontend/source", "frontend/diag", "frontend/syntax", "frontend/sema", "config"],
    "frontend/format": ["frontend/source", "frontend/diag", "frontend/syntax", "frontend/sema", "frontend/edit",
                        "frontend/project", "config"],
    "frontend/query": ["frontend/source", "frontend/diag", "frontend/syntax", "frontend/sema", "frontend/edit",
                       "frontend/format", "frontend/project", "config"],
    "frontend/lint": ["frontend/source", "frontend/diag", "frontend/syntax", "frontend/sema", "frontend/project",
                      "config"],
    "frontend/workspace": ["frontend/source", "frontend/diag", "frontend/syntax", "frontend/sema", "frontend/edit",
                           "frontend/project", "frontend/format", "frontend/lint", "config"],
    "ir/core": [],
    "ir/verify": ["ir/core"],
    "ir/text": ["ir/core", "ir/verify"],
    "ir/passes": ["ir/core", "ir/text", "ir/verify"],
    # C layout, shared by code generation and runtime; the headers stand alone
    "runtime/abi": [],
    "ir/lower": ["ir/core", "ir/text", "ir/verify", "ir/passes", "frontend/", "runtime/abi", "config"],
    # code generation and the runtime share the C layout of runtime/abi and nothing else
    "codegen": ["ir/core", "ir/text", "ir/verify", "ir/passes", "runtime/abi"],
    # arms and paths, which know nothing of the rest
    "runtime/robot": [],
    "runtime/motion": ["runtime/robot"],
    # the controller, from what all of it shares up to the whole
    "runtime/base": ["config"],
    "runtime/value": ["runtime/abi"],
    "runtime/interpreter": ["runtime/abi"],
    "runtime/program": ["runtime/abi", "runtime/base"],
    "runtime/log": ["runtime/base", "config"],
    "runtime/sched": ["runtime/abi", "runtime/base", "runtime/log"],
    "runtime/net": ["runtime/base", "runtime/log", "runtime/sched"],
    "runtime/io": ["runtime/abi", "runtime/base", "runtime/sched", "config"],
    "runtime/sim": ["runtime/base", "runtime/log", "runtime/sched", "runtime/motion"],
    "runtime/report": ["runtime/base", "runtime/robot", "runtime/motion", "runtime/sim", "config"],
    "runtime/debug": ["runtime/abi", "runtime/base", "runtime/value", "runtime/program", "runtime/log", "runtime/sched",
                      "runtime/motion", "config"],
    "runtime/host": ["runtime/", "config"],
    "stdlib": ["runtime/abi"],
    "stdlib/gen": ["frontend/", "ir/core", "runtime/abi", "config"],
    "stdlib/impl": ["runtime/", "stdlib", "config"],
    # main of built executables: no part of the compiler
    "tools/program_main": ["runtime/", "stdlib"],
    # Content-Length frames of both servers
    "tools/protocol": ["config"],
    # the language server: what the runtime and the standard library know is handed in
    "tools/lsp": ["config", "frontend/", "tools/protocol"],
    # inputs -> program with code in memory
    "tools/program": ["config", "frontend/", "ir/", "codegen", "runtime/", "stdlib", "stdlib/"],
    # the long-lived controller
    "tools/service": ["config", "frontend/", "runtime/", "stdlib", "stdlib/", "tools/program"],
    # HTTP, TLS and WebSockets: knows nothing of robots
    "tools/http": ["config"],
    # Robot Web Services: resources, sessions, subscriptions
    "tools/rws": ["config", "frontend/", "runtime/", "stdlib", "stdlib/", "tools/program", "tools/service", "tools/http"],
    # the web page of the controller
    "tools/pendant": ["config", "frontend/", "runtime/", "stdlib", "stdlib/", "tools/program", "tools/service", "tools/http", "tools/rws"],
    "tools": ["config", "frontend/", "ir/", "codegen", "runtime/", "stdlib", "stdlib/", "tools/lsp", "tools/protocol",
              "tools/program", "tools/service", "tools/http", "tools/rws", "tools/pendant"],
    "tests": ["config", "frontend/", "ir/", "codegen", "runtime/", "stdlib", "stdlib/", "tools", "tools/"],
}

# Headers that cost every file that sees them much compile time, or that belong to one part: the only layers and files that
# may include them.
RESTRICTED = [
    (re.compile(r"^(llvm|clang|lld)(-c)?/"), ["codegen", "tests"], "LLVM headers belong to codegen"),
    (re.compile(r"^boost/context/"), ["runtime/sched", "tests"], "fibres belong to runtime/sched"),
    (re.compile(r"^boost/(beast|asio)\b"), ["tools/http"], "sockets are used through the headers of tools/http"),
    (re.compile(r"^openssl/"), ["tools/http"], "TLS, digests and random numbers belong to tools/http"),
    (re.compile(r"^boost/property_tree/"), ["stdlib/impl/reference_interface/xml_text.cpp"],
     "XML is read through stdlib/impl/reference_interface/xml_text.h"),
    (re.compile(r"^Eigen/"), ["runtime/robot", "runtime/motion", "stdlib/impl", "tests"],
     "matrices belong to robot, motion and the built-ins"),
    (re.compile(r"^CLI/"), ["runtime/host/command_line.cpp"], "options are added through runtime/host/command_line.h"),
    (re.compile(r"^nlohmann/json\.hpp$"), ["config/json_text.h", "runtime/robot/model_json.cpp", "tests"],
     "JSON comes with config/json_text.h"),
    (re.compile(r"^(config/json_text|runtime/host/(json_numbers|cbor))\.h$"),
     ["config/json_text.cpp", "frontend/diag/render_json.cpp", "frontend/diag/render_sarif.cpp",
      "frontend/project/settings.cpp", "runtime/log/event.cpp", "runtime/debug/call_chain.cpp", "runtime/host/json_numbers.h",
      "runtime/host/cbor.h", "runtime/host/cbor.cpp", "runtime/host/saved_state.cpp", "runtime/host/state_image.cpp",
      "runtime/host/chain_image.cpp", "runtime/host/path_image.cpp", "runtime/host/unit_messages.cpp",
      "runtime/report/page_data.cpp",
      "stdlib/impl/flow/errors.cpp", "stdlib/impl/io/kept_cyclic_bools.cpp", "stdlib/impl/motion/kept_settings.cpp", "stdlib/impl/motion/kept_triggers.cpp",
      "stdlib/impl/conveyor/kept_conveyors.cpp", "stdlib/impl/motion/kept_world_zones.cpp", "stdlib/impl/motion/soft_servo.cpp", "stdlib/impl/servo_guns/kept_guns.cpp",
      "stdlib/impl/spot/spot_gun.cpp", "stdlib/impl/vision/kept_cameras.cpp",
      "stdlib/impl/queues/kept_messages.cpp", "stdlib/impl/time/clocks.cpp", "stdlib/impl/vision/camera_file.cpp", "stdlib/gen/emit_reference.cpp",
      "tools/lsp", "tools/rapidc/missing_report.cpp", "tools/program/program_sources.cpp", "tools/rapidc/robots_command.cpp",
      "tools/pendant", "tools/rapidc/dap/messages.h", "tools/rws/render_json.cpp", "tools/testing/json_report.cpp", "tests"],
     "JSON costs a file seconds: add it to this list only when the file reads or writes JSON itself"),
    (re.compile(r"^(egm\.pb\.h|google/protobuf/.*)$"), ["stdlib/impl/guided_motion/egm_messages.cpp"],
     "messages of EGM are made and read through stdlib/impl/guided_motion/egm_messages.h"),
    (re.compile(r"^catch2/"), ["tests"], "the test framework belongs to tests"),
]

# Words of RAPID, in code, comments and texts of layers that know no source language.
LANGUAGE_WORDS = re.compile(r"\b(RAPID|TRUE|FALSE|PERS|TRAP|ERRNO|INTNO|ERR_\w+|LONG_JMP_\w+|NORMAL|STATIC|SEMISTATIC|"
                            r"9[eE]\+?0?9|d?num|errnum|intnum|robtarget|jointtarget|signald[io]|traps?|TPWrite|RobotWare)\b")
WITHOUT_LANGUAGE = ["ir/core", "ir/verify", "ir/text", "ir/passes", "codegen"]

INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')
SOURCE_FOLDERS = ("config", "frontend", "ir", "codegen", "runtime", "stdlib", "tools", "tests")
OWN_FOLDERS = SOURCE_FOLDERS
MAX_FILE_LINES = 600
MAX_FUNCTION_LINES = 60


def layer_of(path):
    best = None
    for prefix in LAYERS:
        if path == prefix or path.startswith(prefix + "/"):
            if best is None or len(prefix) > len(best):
                best = prefix
    return best


def allowed(source, target):
    """A rule ending in `/` allows the whole tree below it, any other rule one layer."""
    return source == target or any(target == rule or (rule.endswith("/") and target.startswith(rule))
                                   for rule in LAYERS[source])


def check_table(layers, errors):
    """Every rule names layers further up: then no chain of includes comes back to where it began."""
    order = list(layers)
    for place, layer in enumerate(order):
        for rule in layers[layer]:
            named = [name for name in order if name == rule or (rule.endswith("/") and name.startswith(rule))]
            errors.extend(f"{layer} may include {name}, which is not further up in the table of layers"
                          for name in named if name != layer and order.index(name) > place)
            if not named:
                errors.append(f"{layer} may include {rule}, which is in no layer")


def files_below(root):
    for folder in SOURCE_FOLDERS:
        for where, folders, names in os.walk(os.path.join(root, folder)):
            folders.sort()
            for name in sorted(names):
                if name.endswith((".h", ".cpp", ".def")):
                    yield os.path.relpath(os.path.join(where, name), root)


def check_includes(path, lines, errors):
    layer = layer_of(path)
    if layer is None:
        errors.append(f"{path}:1: no layer is defined for this folder; add it to scripts/check_layering.py")
        return
    for number, line in enumerate(lines, 1):
        match = INCLUDE.match(line)
        if not match:
            continue
        style, name = match.groups()
        for pattern, places, reason in RESTRICTED:
            if pattern.match(name) and not any(path == place or path.startswith(place + "/") for place in places):
                errors.append(f"{path}:{number}: <{name}> in {layer}: {reason}")
        if style != '"':
            continue
        target = name
        if target.split("/")[0] not in OWN_FOLDERS:
            if "/" not in target or target.startswith("natives/") or (layer == "tests" and target.startswith("unit/")):
                continue  # beside the file, generated, or a helper of the unit tests
            errors.append(f'{path}:{number}: "{name}": own headers are included by their path from the root')
            continue
        target_layer = layer_of(target)
        if target_layer is None:
            errors.append(f'{path}:{number}: "{name}" is in no layer')
        elif not allowed(layer, target_layer):
            errors.append(f'{path}:{number}: {layer} may not include {target_layer} ("{name}")')


def check_words(path, lines, errors):
    layer = layer_of(path)
    if layer not in WITHOUT_LANGUAGE:
        return
    for number, line in enumerate(lines, 1):
        word = LANGUAGE_WORDS.search(line)
        if word:
            errors.append(f"{path}:{number}: '{word.group()}' is a word of RAPID; {layer} knows no source language")


def has_reason(lines, number):
    """Whether a comment "// Size: ..." directly before the function says why it is long."""
    return number > 1 and any(line.startswith("// Size: ") for line in lines[max(0, number - 3):number - 1])


def function_lengths(lines):
    """Yields (line, length) of function bodies: an unindented line opening a brace up to the unindented brace.

    Rough on purpose: the code is formatted by clang-format, so a definition at namespace level starts in column 1.
    """
    start = None
    for number, line in enumerate(lines, 1):
        text = line.rstrip("\n")
        if start is None:
            opens = text.endswith("{") and text[:1] not in ("", " ", "}", "#", "/")
            if opens and not has_reason(lines, number) and "(" in text + "".join(lines[max(0, number - 4):number]) and not re.match(
                    r"(namespace|struct|class|enum|union|extern|constexpr|inline constexpr|const|static const)\b",
                    text):
                start = number
        elif text.startswith("}"):
            yield start, number - start + 1
            start = None


def check_tree(root):
    """Prints what is wrong below the folder; the exit status."""
    errors, notes, count = [], [], 0
    check_table(LAYERS, errors)
    for path in files_below(root):
        with open(os.path.join(root, path), encoding="utf-8", errors="replace") as file:
            lines = file.readlines()
        count += 1
        check_includes(path, lines, errors)
        check_words(path, lines, errors)
        if path.endswith(".def"):
            continue
        if len(lines) > MAX_FILE_LINES:
            notes.append(f"{path}: {len(lines)} lines (aim: at most {MAX_FILE_LINES})")
        for line, length in function_lengths(lines):
            if length > MAX_FUNCTION_LINES:
                notes.append(f"{path}:{line}: a function of {length} lines (aim: at most {MAX_FUNCTION_LINES})")
    for note in notes:
        print("note:", note)
    for error in errors:
        print("error:", error)
    print(f"layering: {count} files, {len(errors)} errors, {len(notes)} length notes")
    if count == 0:
        print("error: no source files found below", root)
        return 1
    return 1 if errors else 0


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--source", default=os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
    return check_tree(os.path.abspath(parser.parse_args().source))


if __name__ == "__main__":
    sys.exit(main())
