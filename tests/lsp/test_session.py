"""A session from an empty document to the README's program, with mistakes on the way: at each step the editor shows what the
rules of the language say (manual 1.1 to 1.4), and at the end the program has no mistake, is laid out, and prints what the README shows."""

import re
import subprocess
import unittest

from client import RAPIDC, ROOT, LspCase, edited, place

README = (ROOT / "README.md").read_text(encoding="utf-8")
PROGRAM = re.search(r"```rapid\n(.*?)```", README, re.S)[1]
OUTPUT = re.search(r"```output\n(.*?)```", README, re.S)[1]
ERROR = 1


class Session(LspCase):
    def setUp(self):
        super().setUp()
        self.client, self.document = self.opened("", "palletiser.modx")
        self.text, self.version = "", 1

    def put(self, old, new):
        """Replaces the only `old` with `new` as an editor does; the codes of the errors that are shown then."""
        self.assertEqual(self.text.count(old) if old else 1, 1, f"the session names one place by {old!r}")
        start, end = self.spot(old, 0), self.spot(old, len(old))
        self.version += 1
        self.client.change(self.document, self.version, (start, end, new))
        self.text = self.text.replace(old, new, 1) if old else self.text + new
        return self.errors()

    def spot(self, word, offset):
        where = place(self.text, word, offset=offset) if word else place(self.text + "\0", "\0")
        return where["line"], where["character"]

    def errors(self):
        shown = self.client.published(self.document, self.version)
        return sorted(d["code"] for d in shown if d.get("severity") == ERROR)

    def ask(self, method, word):
        """Asks at the end of the word."""
        line, character = self.spot(word, len(word))
        return self.client.request("textDocument/" + method, {"textDocument": {"uri": self.document},
                                                              "position": {"line": line, "character": character}})

    def labels(self, word):
        return [item["label"] for item in self.ask("completion", word)["items"]]

    def test_the_program_of_the_readme(self):
        self.declarations()
        self.function()
        self.main()
        self.handler()
        self.finish()

    def declarations(self):
        # A module ends with ENDMODULE (RAP1202).
        self.assertEqual(self.put("", "MODULE Palletiser\n"), ["RAP1202"])
        self.assertEqual(self.put("", "\nENDMODULE\n"), [])
        # The value of a num is a number (RAP3040), and a declaration ends with a semicolon (RAP1201).
        self.assertEqual(self.put("\n\nEND", '\n  CONST num rows := "2";\n  CONST num columns := 3\n\nEND'), ["RAP1201", "RAP3040"])
        self.assertEqual(self.put('"2"', "2"), ["RAP1201"])
        self.assertEqual(self.put(":= 3", ":= 3;"), [])
        # After VAR a type is expected: "nu" is the beginning of num; rows is data.
        self.put("3;\n\n", "3;\n  VAR nu\n\n")
        offered = self.labels("VAR nu")
        self.assertIn("num", offered)
        self.assertNotIn("rows", offered)
        self.assertEqual(self.put("VAR nu", "VAR num layers := 0;"), [])

    def function(self):
        # A pos has three components (RAP3021).
        start = "\n\nEND"
        self.assertEqual(self.put(start, "\n\n  FUNC pos slot(num n)\n    RETURN [60 * n];\n  ENDFUNC\n\nEND"), ["RAP3021"])
        # A place for a num offers the data of the module, and no instruction.
        self.put("[60 * n]", "[60 * ((n - 1) MOD col")
        offered = self.labels("MOD col")
        self.assertIn("columns", offered)
        self.assertNotIn("TPWrite", offered)
        self.assertEqual(self.put("MOD col", "MOD columns), 60 * ((n - 1) DIV columns), 25 * layers]"), [])

    def main(self):
        # Data has to be declared (RAP2001), and a constant takes no value (RAP5001).
        self.assertEqual(self.put("FUNC\n\nEND", "FUNC\n\n  PROC main()\n    perLayer := rows * columns;\n  ENDPROC\nEND"), ["RAP2001"])
        self.assertEqual(self.put("    perLayer :=", "    VAR num perLayer;\n    perLayer :="), [])
        self.assertEqual(self.put("    perLayer :=", "    rows :="), ["RAP5001"])
        self.assertEqual(self.put("    rows :=", "    perLayer :="), [])
        # FOR ends with ENDFOR (RAP1202); a text and a num cannot be added (RAP3001).
        loop = "columns;\n    FOR n FROM 1 TO perLayer STEP 2 DO\n"
        self.assertEqual(self.put("columns;\n", loop), ["RAP1202"])
        self.assertEqual(self.put("STEP 2 DO\n", 'STEP 2 DO\n      TPWrite "slot " + n;\n    ENDFOR\n'), ["RAP3001"])
        # The parameters of NumToStr: the value, then the number of decimals.
        self.put('" + n;', '" + NumToStr(n, ')
        shown = self.ask("signatureHelp", "NumToStr(n, ")
        signature = shown["signatures"][0]
        self.assertIn("NumToStr", signature["label"])
        self.assertEqual((len(signature["parameters"]) >= 2, shown["activeParameter"]), (True, 1))
        # The optional arguments of TPWrite, of which one call takes one; Pos is misspelt (RAP4003).
        self.put("NumToStr(n, ", 'NumToStr(n, 0) + " at " \\')
        self.assertLessEqual({"Num", "Bool", "Pos", "Orient"}, set(self.labels('" at " \\')))
        self.assertEqual(self.put('" at " \\', '" at " \\Poz:=slot(n);'), ["RAP4003"])
        self.assertEqual(self.put("Poz", "Pos"), [])

    def handler(self):
        self.assertEqual(self.put("ENDFOR\n", "ENDFOR\n    layers := perLayer / (layers - layers);\n  ERROR\n"), [])
        # In a condition the errors that ERRNO can have are offered.
        self.put("  ERROR\n", "  ERROR\n    IF ERRNO = ERR_DIV")
        self.assertIn("ERR_DIVZERO", self.labels("ERR_DIV"))
        self.put("ERR_DIV", 'ERR_DIVZERO THEN\n   TPWrite "one layer of " \\Num:=perLayer;\n      RETURN;\n')
        self.assertEqual(self.errors(), ["RAP1202"])
        self.assertEqual(self.put("      RETURN;\n", "      RETURN;\n    ENDIF\n"), [])

    def finish(self):
        # No mistake is left. The program makes its zero with equal sides of a minus, of which a warning is due (RAP8032).
        self.assertEqual(self.codes(self.client.published(self.document, self.version)), ["RAP8032"])
        # Formatting changes nothing but space, and a second time nothing at all.
        ask = {"textDocument": {"uri": self.document}, "options": {"tabSize": 2, "insertSpaces": True}}
        text = edited(self.text, self.client.request("textDocument/formatting", ask))
        self.assertNotEqual(text, self.text)
        self.assertEqual("".join(text.split()), "".join(PROGRAM.split()))
        self.version += 1
        self.client.change(self.document, self.version, text)
        self.assertFalse(self.client.request("textDocument/formatting", ask))
        self.assertEqual(self.codes(self.client.published(self.document, self.version)), ["RAP8032"])
        done = subprocess.run([RAPIDC, "run", self.write("palletiser.modx", text)], capture_output=True, text=True, check=False)
        self.assertEqual((done.returncode, done.stdout), (0, OUTPUT))
        self.assertEqual(self.client.stop(), 0)


if __name__ == "__main__":
    unittest.main()
