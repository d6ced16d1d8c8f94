"""Finds all tests that are files, by name."""

import os

from cases import SOURCE_SUFFIXES, CommandTest, ProgramTest
from diagnostics import DiagnosticTest
from documents import DecisionsTest, DocumentTest, LanguageSupportTest
from phases import discover_phases


def discover_programs(root, prefix, found):
    for where, folders, names in os.walk(root):
        folders.sort()
        relative = os.path.relpath(where, root)
        base = prefix if relative == "." else f"{prefix}/{relative}"
        if "expected.out" in names:
            found[base] = ProgramTest(where, os.path.join(where, "expected"))
            folders.clear()
            continue
        if any(name.endswith("Test.modx") for name in names):  # for `rapidc test`: cli/test/sample
            continue
        for name in sorted(names):
            stem, suffix = os.path.splitext(name)
            if suffix in SOURCE_SUFFIXES:
                found[f"{base}/{stem}"] = ProgramTest(os.path.join(where, name), os.path.join(where, stem))


def files_below(root, tests):
    """(name of the test, path) of every file below a folder."""
    for where, folders, names in os.walk(root):
        folders.sort()
        for name in sorted(names):
            path = os.path.join(where, name)
            yield os.path.relpath(os.path.splitext(path)[0], tests), path


def discover_documents(source, found):
    docs = os.path.join(source, "docs")
    pages = [os.path.join(source, "README.md")]
    for folder in (docs, os.path.join(docs, "language")):
        pages += [os.path.join(folder, name) for name in sorted(os.listdir(folder)) if name.endswith(".md")]
    for page in pages:
        name = os.path.relpath(page, docs if page.startswith(docs) else source)
        found["docs/" + os.path.splitext(name)[0]] = DocumentTest(page)
    found["docs/language_support_state"] = LanguageSupportTest(os.path.join(docs, "language_support.md"))
    found["docs/decisions"] = DecisionsTest(os.path.join(docs, "decisions"))


def discover_files(tests, kind, suffixes, make, found):
    for name, path in files_below(os.path.join(tests, kind), tests):
        if path.endswith(suffixes):
            found[name] = make(path)


def discover(source, group=None):
    """All tests by name, or those of one group."""
    found = {}
    tests = os.path.join(source, "tests")
    finders = {
        "golden": lambda: discover_programs(os.path.join(tests, "golden"), "golden", found),
        "tasks": lambda: discover_programs(os.path.join(tests, "tasks"), "tasks", found),
        "samples": lambda: discover_programs(os.path.join(source, "samples"), "samples", found),
        "diag": lambda: discover_files(tests, "diag", SOURCE_SUFFIXES, DiagnosticTest, found),
        "cli": lambda: discover_files(tests, "cli", ".test", CommandTest, found),
        "phases": lambda: discover_phases(tests, found),
        "docs": lambda: discover_documents(source, found),
    }
    for name, find in finders.items():
        if group in (None, name):
            find()
    return found
