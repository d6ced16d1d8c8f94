#!/usr/bin/env python3
"""The script that checks layers refuses what it has to: a folder with one wrong include, a table with a cycle."""

import contextlib
import io
import os
import sys
import tempfile
import unittest

ROOT = os.path.abspath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", ".."))
sys.path.insert(0, os.path.join(ROOT, "scripts"))

import check_layering  # noqa: E402

# From the bottom up. An include of a folder further down this list is wrong in each of them.
RUNTIME = ["abi", "interpreter", "robot", "motion", "base", "value", "program", "log", "sched", "net", "io", "sim", "report", "debug", "host"]


def check(files):
    """Exit status and output of the script for a source tree of these files."""
    with tempfile.TemporaryDirectory() as root:
        for path, text in files.items():
            os.makedirs(os.path.dirname(os.path.join(root, path)), exist_ok=True)
            with open(os.path.join(root, path), "w", encoding="utf-8") as file:
                file.write(text)
        output = io.StringIO()
        with contextlib.redirect_stdout(output):
            status = check_layering.check_tree(root)
        return status, output.getvalue()


class Includes(unittest.TestCase):
    def test_upward_includes_in_the_runtime_are_refused(self):
        for below, lower in enumerate(RUNTIME):
            for upper in RUNTIME[below + 1:]:
                status, output = check({f"runtime/{lower}/x.cpp": f'#include "runtime/{upper}/y.h"\n'})
                self.assertEqual(status, 1, f"{lower} includes {upper}")
                self.assertIn(f"runtime/{lower}/x.cpp:1: runtime/{lower} may not include runtime/{upper}", output)

    def test_host_may_include_every_other_folder(self):
        for lower in RUNTIME:
            status, output = check({"runtime/host/x.h": f'#include "runtime/{lower}/y.h"\n'})
            self.assertEqual(status, 0, output)

    def test_the_runtime_does_not_know_the_standard_library_or_the_compiler(self):
        for folder in RUNTIME:
            for target in ("stdlib/native_table.h", "stdlib/impl/support/fail.h", "ir/core/module.h",
                           "frontend/sema/types.h", "codegen/codegen.h", "tools/rapidc/commands.h"):
                status, output = check({f"runtime/{folder}/x.h": f'#include "{target}"\n'})
                self.assertEqual(status, 1, f"runtime/{folder} includes {target}: {output}")

    def test_every_folder_of_the_runtime_has_its_place(self):
        folders = [entry.name for entry in os.scandir(os.path.join(ROOT, "runtime")) if entry.is_dir()]
        self.assertEqual(sorted(folders), sorted(RUNTIME))

    def test_layers_without_a_source_language_hold_none_of_its_words(self):
        for folder in ("ir/core", "ir/passes", "codegen"):
            status, output = check({f"{folder}/x.cpp": 'const char* kind = "SEMISTATIC";\n'})
            self.assertEqual(status, 1, folder)
            self.assertIn(f"{folder}/x.cpp:1: 'SEMISTATIC' is a word of RAPID", output)
        status, output = check({"ir/lower/x.cpp": 'const char* kind = "SEMISTATIC";\n',
                                "ir/core/x.cpp": "int number = 0; // rapidc\n"})
        self.assertEqual(status, 0, output)

    def test_a_folder_without_layer_is_refused(self):
        status, output = check({"runtime/elsewhere/x.h": "\n"})
        self.assertEqual(status, 1)
        self.assertIn("no layer is defined", output)


class CostlyHeaders(unittest.TestCase):
    def refused(self, path, name):
        status, output = check({path: f"#include {name}\n"})
        self.assertIn(status, (0, 1))
        return f"{path}:1: " in output

    def test_command_line_library_has_one_user(self):
        self.assertFalse(self.refused("runtime/host/command_line.cpp", "<CLI/App.hpp>"))
        for path in ("runtime/host/command_line.h", "runtime/host/run_options.cpp", "tools/rapidc/main.cpp"):
            self.assertTrue(self.refused(path, "<CLI/App.hpp>"), path)

    def test_json_only_where_it_is_read_or_written(self):
        for name in ("<nlohmann/json.hpp>", '"config/json_text.h"'):
            for path in ("runtime/debug/state_keepers.h", "stdlib/impl/motion/moves.cpp", "tools/rapidc/main.cpp"):
                self.assertTrue(self.refused(path, name), path)
        self.assertTrue(self.refused("runtime/host/controller.h", '"runtime/host/cbor.h"'))
        self.assertFalse(self.refused("runtime/host/saved_state.cpp", '"config/json_text.h"'))
        self.assertFalse(self.refused("runtime/debug/state_keepers.h", "<nlohmann/json_fwd.hpp>"))


class Table(unittest.TestCase):
    def problems(self, layers):
        errors = []
        check_layering.check_table(layers, errors)
        return errors

    def test_the_table_of_the_project_is_in_order(self):
        self.assertEqual(self.problems(check_layering.LAYERS), [])

    def test_a_cycle_is_refused(self):
        self.assertEqual(len(self.problems({"a": ["b"], "b": ["a"]})), 1)
        self.assertEqual(len(self.problems({"a/x": ["a/"], "a/y": []})), 1)

    def test_a_rule_without_layer_is_refused(self):
        self.assertEqual(len(self.problems({"a": ["gone"]})), 1)


if __name__ == "__main__":
    unittest.main()
