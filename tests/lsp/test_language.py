"""The server's knowledge of a program, in the protocol's own words (items 8 to 16 of what rapidc promises)."""

import os
import unittest

from client import CAPABILITIES, LspCase, ServerError, at, changes_of, edited, part, place, span, uri

TEXT = """MODULE cell
  ! Counts what was done.
  PERS num total := 0;
  CONST num limit := 5 * 2;
  CONST robtarget home := [[600,0,700],[1,0,0,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  RECORD part
    num weight;
    string name;
  ENDRECORD
  VAR part stock{3};

  PROC main()
    VAR num n := 1;
    report "start" \\count:=n;
    total := total + limit;
    MoveJ home, v100, z10, tool0;
    stock{1}.weight := Abs(n);
    n := weigh(stock{1});
    IF n > limit THEN
      TPWrite "heavy";
    ENDIF
  ENDPROC

  ! Writes a line.
  PROC report(string text \\num count)
    IF Present(count) TPWrite text \\Num:=count;
  ENDPROC

  FUNC num weigh(part p)
    RETURN p.weight;
  ENDFUNC
ENDMODULE
"""


class GlobalNamesAfterEdits(LspCase):
    """Completion offers what the modules declare now (manual 1.1.5: global names are seen in the whole task)."""

    def offered(self, client, document, text):
        items = client.request("textDocument/completion", at(document, text, "x := sh", offset=7))["items"]
        return sorted((i["label"], i["detail"]) for i in items if i["label"].startswith("sh"))

    def test_names_come_and_go_with_their_modules(self):
        user = "MODULE user\n  PROC main()\n    VAR num x;\n    x := sh;\n  ENDPROC\nENDMODULE\n"
        one = "MODULE one\n  CONST num shape := 1;\nENDMODULE\n"
        two = "MODULE two\n  LOCAL CONST num shy := 1;\nENDMODULE\n"
        self.write("one.modx", one)
        self.write("two.modx", two)
        client, document = self.opened(user, "user.modx")
        paths = [os.path.join(self.work(), name) for name in ("one.modx", "two.modx")]
        first, second = (client.open(path, text) for path, text in zip(paths, (one, two)))
        self.assertEqual(self.offered(client, document, user), [("shape", "CONST num")])  # LOCAL: not seen outside
        client.change(second, 2, two.replace("LOCAL CONST", "CONST"))
        self.assertEqual(self.offered(client, document, user), [("shape", "CONST num"), ("shy", "CONST num")])
        client.change(first, 2, one.replace("shape", "shade"))
        self.assertEqual(self.offered(client, document, user), [("shade", "CONST num"), ("shy", "CONST num")])
        # Both declare it: offered once; when one of the two leaves, the other one is seen.
        client.change(second, 3, two.replace("LOCAL CONST num shy", "VAR num shade"))
        self.assertEqual([label for label, _ in self.offered(client, document, user)], ["shade"])
        client.change(first, 3, "MODULE one\nENDMODULE\n")
        self.assertEqual(self.offered(client, document, user), [("shade", "VAR num")])
        client.change(second, 4, "MODULE two\nENDMODULE\n")
        self.assertEqual(self.offered(client, document, user), [])


class DeclarationsOfLargePrograms(LspCase):
    def test_offered_described_and_checked(self):
        """Decision 144: a declaration that other modules see is offered and described before these are checked; then a
        module that names it is judged."""
        routine = "  PROC filler{0}()\n" + "    TPWrite \"filler\";\n" * 60 + "  ENDPROC\n"
        self.write("filler.modx", "MODULE filler\n" + "".join(routine.format(i) for i in range(250)) + "ENDMODULE\n")
        user = "MODULE user\n  PROC use()\n    mine := v100;\n  ENDPROC\nENDMODULE\n"
        other = self.write("user.modx", user)
        text = "MODULE m\n  PROC main()\n    MoveL *,m;\n  ENDPROC\nENDMODULE\n"
        client, document = self.opened(text)
        self.assertEqual(self.codes(client.published(uri(other))), ["RAP2001"])
        declaration = "  ! How fast we are.\n  VAR speeddata mine;\n"
        client.change(document, 2, ((1, 0), (1, 0), declaration))
        items = client.request("textDocument/completion", {"textDocument": {"uri": document},
                                                           "position": {"line": 4, "character": 13}})["items"]
        first = min(items, key=lambda i: i["sortText"])
        self.assertEqual((first["label"], first["detail"]), ("mine", "VAR speeddata"))
        described = client.request("completionItem/resolve", first)["documentation"]["value"]
        self.assertIn("How fast we are.", described)
        self.assertEqual(client.next_published(uri(other)), [])


class Language(LspCase):
    def setUp(self):
        super().setUp()
        self.client, self.document = self.opened(TEXT, "cell.modx")

    def ask(self, method, word, nth=1, offset=0, **more):
        return self.client.request("textDocument/" + method, {**at(self.document, TEXT, word, nth, offset), **more})

    def after(self, statement):
        """Replaces the line of TPWrite "heavy" by another one; the position at its end."""
        line = place(TEXT, "TPWrite \"heavy\"")["line"]
        self.version = getattr(self, "version", 1) + 1
        old = getattr(self, "written", TEXT.split("\n")[line])
        self.client.change(self.document, self.version, ((line, 0), (line, len(old)), statement))
        self.written = statement
        return {"textDocument": {"uri": self.document}, "position": {"line": line, "character": len(statement)}}


class Completion(Language):
    def complete(self, statement):
        self.where = self.after(statement)
        return self.client.request("textDocument/completion", self.where)["items"]

    def names(self, statement):
        return [item["label"] for item in self.complete(statement)]

    def item(self, statement, name):
        found = [i for i in self.complete(statement) if i["label"].startswith(name)]
        self.assertTrue(found, name)
        return found[0]

    def test_the_type_that_is_expected_comes_first(self):
        best = sorted(self.complete("      MoveJ home, v"), key=lambda i: i.get("sortText", i["label"]))[:20]
        self.assertTrue(all(i["label"].startswith("v") for i in best), best)
        self.assertIn("v100", [i["label"] for i in self.complete("      MoveJ home, v")])
        self.assertIn("z10", self.names("      MoveJ home, v100, "))

    def test_only_optional_arguments_after_a_backslash(self):
        names = self.names("      MoveJ home, v100, z10, tool0 \\")
        self.assertTrue(any(n.startswith("WObj") for n in names), names)
        self.assertFalse(any(n.startswith(("home", "IF", "MoveJ")) for n in names), names)
        names = self.names("      report \"a\" \\count:=1 \\")
        self.assertEqual(names, [])

    def test_only_components_after_a_dot(self):
        self.assertEqual(sorted(n.split()[0].rstrip(":") for n in self.names("      n := stock{1}.")), ["name", "weight"])
        self.assertEqual(self.names("      n := home.trans."), ["x", "y", "z"])

    def test_the_letters_are_replaced(self):
        item = self.item("      n := lim", "limit")
        line = self.where["position"]["line"]
        self.assertEqual(item["textEdit"]["range"], span((line, 11), (line, 14)))
        self.assertEqual(item["textEdit"]["newText"], "limit")

    def test_snippets_for_clients_that_have_them(self):
        items = [i for i in self.complete("      IF") if i.get("insertTextFormat") == 2]
        self.assertTrue(any("ENDIF" in i["textEdit"]["newText"] and "$" in i["textEdit"]["newText"] for i in items))
        other = self.client_without_snippets()
        self.assertFalse(any(i.get("insertTextFormat") == 2 for i in other))

    def client_without_snippets(self):
        client = self.connect()
        capabilities = {**CAPABILITIES, "textDocument": {}}
        client.initialize([self.work()], capabilities)
        document = client.open(os.path.join(self.work(), "cell.modx"), TEXT)
        return client.request("textDocument/completion", at(document, TEXT, "IF n", offset=2))["items"]

    def test_resolve_gives_the_comment(self):
        item = self.item("      repo", "report")
        self.assertNotIn("documentation", item)
        resolved = self.client.request("completionItem/resolve", item)
        self.assertEqual(resolved["label"], item["label"])
        self.assertIn("Writes a line.", resolved["documentation"]["value"])
        known = self.client.request("completionItem/resolve", self.item("      TPWri", "TPWrite"))
        self.assertIn("TPWrite", known["documentation"]["value"])

    def test_triggers(self):
        client = self.connect()
        offered = client.initialize()["capabilities"]["completionProvider"]
        self.assertEqual((offered["triggerCharacters"], offered["resolveProvider"]), (["\\", "."], True))


class Hover(Language):
    def text(self, word, nth=1, offset=0):
        return self.ask("hover", word, nth, offset)["contents"]["value"]

    def test_declarations_and_comments(self):
        hover = self.ask("hover", "total", 2)
        self.assertEqual(hover["contents"]["kind"], "markdown")
        self.assertIn("PERS num total", hover["contents"]["value"])
        self.assertIn("Counts what was done.", hover["contents"]["value"])
        self.assertEqual(part(TEXT, hover["range"]), "total")
        self.assertIn("PROC report(string text\\num count)", self.text("report"))
        self.assertIn("RECORD part", self.text("part p"))
        self.assertIn("speeddata v100", self.text("v100"))

    def test_values(self):
        self.assertIn("10", self.text("limit"))
        self.assertIn("600", self.text("home", 2))

    def test_reach_of_the_robot(self):
        path = self.write("MOC.cfg", 'MOC:CFG_1.0:6:0::\n#\nROBOT:\n\n      -name "ROB_1" -use_robot_type "ROB1_120_0.58_3" \n')
        self.client.notify("workspace/didChangeWatchedFiles", {"changes": [{"uri": uri(path), "type": 1}]})
        text = TEXT.replace("[600,0,700],[1,0,0,0]", "[374,0,630],[0.7071068,0,0.7071068,0]")
        self.client.change(self.document, 2, text)
        near = self.client.request("textDocument/hover", at(self.document, text, "home", 2))["contents"]["value"]
        self.assertIn("axis 1 at 0.0", near)
        text = text.replace("[374,0,630]", "[9000,0,630]")
        self.client.change(self.document, 3, text)
        far = self.client.request("textDocument/hover", at(self.document, text, "home", 2))["contents"]["value"]
        self.assertIn("IRB 120", far)
        self.assertNotIn("axis 1 at", far)

    def test_nothing(self):
        self.assertIsNone(self.ask("hover", "Counts"))
        self.assertIsNone(self.client.request("textDocument/hover", {"textDocument": {"uri": self.document},
                                                                     "position": {"line": 9999, "character": 0}}))

    def test_plain_text_for_clients_without_markdown(self):
        client = self.connect()
        client.initialize([self.work()], {})
        document = client.open(os.path.join(self.work(), "cell.modx"), TEXT)
        hover = client.request("textDocument/hover", at(document, TEXT, "report"))
        self.assertEqual(hover["contents"]["kind"], "plaintext")
        self.assertNotIn("```", hover["contents"]["value"])


class Signature(Language):
    def active(self, statement):
        help_ = self.client.request("textDocument/signatureHelp", self.after(statement))
        signature = help_["signatures"][help_["activeSignature"]]
        number = signature.get("activeParameter", help_.get("activeParameter"))
        return signature["label"], signature["parameters"][number]["label"] if number < len(signature["parameters"]) else None

    def test_instructions_and_functions(self):
        label, parameter = self.active("      report ")
        self.assertEqual(label, "PROC report(string text\\num count)")
        self.assertEqual(parameter, "string text")
        self.assertEqual(self.active("      report \"a\" \\count:=")[1], "\\num count")
        self.assertEqual(self.active("      n := weigh(")[1], "part p")
        self.assertIn("zonedata Zone", self.active("      MoveJ home, v100, ")[1])
        self.assertIn("WObj", self.active("      MoveJ home, v100, z10, tool0 \\WObj:=")[1])

    def test_no_call(self):
        self.assertIsNone(self.client.request("textDocument/signatureHelp", self.after("      ")))


class Navigation(Language):
    def places(self, method, word, nth=1, **more):
        found = self.ask(method, word, nth, **more)
        self.assertTrue(all(f["uri"] == self.document for f in found))
        return [f["range"]["start"] for f in found]

    def test_definition(self):
        for method in ("definition", "declaration"):
            self.assertEqual(self.places(method, "total", 2), [place(TEXT, "total")])
        self.assertEqual(self.places("definition", "weight", 2), [place(TEXT, "weight")])
        self.assertEqual(self.places("definition", "count:=n"), [place(TEXT, "count)")])

    def test_definition_of_a_predefined_name_is_readable(self):
        for word in ("MoveJ", "v100", "tool0", "Abs", "robtarget"):
            found = self.ask("definition", word)
            self.assertEqual(len(found), 1, word)
            path = found[0]["uri"].removeprefix("file://")
            self.assertTrue(found[0]["uri"].startswith("file:///"))
            with open(path, encoding="utf-8") as file:
                self.assertEqual(part(file.read(), found[0]["range"]), word)

    def test_type_definition(self):
        self.assertEqual(self.places("typeDefinition", "stock", 2), [place(TEXT, "part")])

    def test_implementation_of_a_call_by_name(self):
        self.client.change(self.document, 2, TEXT.replace('TPWrite "heavy"', '%"report"% "a"'))
        found = self.ask("implementation", 'TPWrite "heavy"', offset=3)
        self.assertEqual([f["range"]["start"] for f in found], [place(TEXT, "report(")])

    def test_references(self):
        everywhere = self.places("references", "total", context={"includeDeclaration": True})
        self.assertEqual(everywhere, [place(TEXT, "total", n) for n in (1, 2, 3)])
        self.assertEqual(self.places("references", "total", context={"includeDeclaration": False}), everywhere[1:])

    def test_highlight(self):
        found = self.ask("documentHighlight", "total", 2)
        self.assertEqual([(f["range"]["start"], f["kind"]) for f in found],
                         [(place(TEXT, "total"), 1), (place(TEXT, "total", 2), 3), (place(TEXT, "total", 3), 2)])

    def test_call_hierarchy(self):
        item = self.ask("prepareCallHierarchy", "weigh(part")[0]
        self.assertEqual((item["name"], item["kind"]), ("weigh", 12))
        incoming = self.client.request("callHierarchy/incomingCalls", {"item": item})
        self.assertEqual([(c["from"]["name"], c["fromRanges"][0]["start"]) for c in incoming], [("main", place(TEXT, "weigh(stock"))])
        main = incoming[0]["from"]
        outgoing = self.client.request("callHierarchy/outgoingCalls", {"item": main})
        self.assertTrue({"report", "weigh"} <= {c["to"]["name"] for c in outgoing})

    def test_across_modules(self):
        other = self.write("other.modx", "MODULE other\n  PROC helper()\n    total := 1;\n  ENDPROC\nENDMODULE\n")
        self.client.notify("workspace/didChangeWatchedFiles", {"changes": [{"uri": uri(other), "type": 1}]})
        found = self.ask("references", "total", context={"includeDeclaration": False})
        self.assertEqual({f["uri"] for f in found}, {self.document, uri(other)})


class Rename(Language):
    def rename(self, word, new, nth=1):
        edits = changes_of(self.ask("rename", word, nth, newName=new))
        return edited(TEXT, edits[self.document])

    def refused(self, method, word, nth=1, **more):
        with self.assertRaises(ServerError) as caught:
            self.ask(method, word, nth, **more)
        self.assertTrue(str(caught.exception))

    def test_prepare(self):
        found = self.ask("prepareRename", "total", 2)
        self.assertEqual((part(TEXT, found["range"]), found["placeholder"]), ("total", "total"))
        for word in ("MoveJ", "v100", "PROC", "heavy", "Counts", "10,"):
            self.refused("prepareRename", word)

    def test_everywhere(self):
        self.assertEqual(self.rename("total", "sum"), TEXT.replace("total", "sum"))

    def test_named_arguments_follow(self):
        new = self.rename("count)", "amount")
        self.assertIn("\\amount:=n", new)
        self.assertIn("Present(amount)", new)

    def test_strings_that_spell_the_name_are_shown(self):
        """window/showMessage: text without a line end of its own."""
        program = "MODULE m\n  PROC old()\n  ENDPROC\n  PROC main()\n    old;\n    %\"old\"%;\n  ENDPROC\nENDMODULE\n"
        self.client.change(self.document, 2, program)
        self.client.request("textDocument/rename", {**at(self.document, program, "old"), "newName": "fresh"})
        shown = [n["params"]["message"] for n in self.client.notifications if n["method"] == "window/showMessage"]
        self.assertEqual(len(shown), 1)
        self.assertIn(':6:6: the string "old"', shown[0])
        self.assertNotIn("\n", shown[0])

    def test_refused(self):
        for new in ("1x", "IF", "a" * 33, "a b", "", "limit", "report"):
            self.refused("rename", "total", newName=new)
        self.refused("rename", "MoveJ", newName="go")

    def test_letters_of_latin_1(self):
        """Manual, letters: those of ISO 8859-1. A message has one line, whatever the name."""
        edits = self.ask("rename", "total", newName="gr\u00f6\u00dfe")["documentChanges"][0]["edits"]
        self.assertEqual({e["newText"] for e in edits}, {"gr\u00f6\u00dfe"})
        for new, shown in (("\u03bbx", "'\u03bbx'"), ("sum\n", "'sum\\x0A'"), ("a\x00", "'a\\x00'")):
            with self.assertRaises(ServerError) as refused:
                self.ask("rename", "total", newName=new)
            self.assertTrue(str(refused.exception).startswith(shown + " is not a name"), str(refused.exception))

    def test_files_of_the_workspace(self):
        path = self.write("other.modx", "MODULE other\n  PROC helper()\n    total := 1;\n  ENDPROC\nENDMODULE\n")
        self.client.notify("workspace/didChangeWatchedFiles", {"changes": [{"uri": uri(path), "type": 1}]})
        answer = self.ask("rename", "total", newName="sum")
        versions = {c["textDocument"]["uri"]: c["textDocument"]["version"] for c in answer["documentChanges"]}
        self.assertEqual(versions, {self.document: 1, uri(path): None})


class Outline(Language):
    def test_document_symbols(self):
        found = self.client.request("textDocument/documentSymbol", {"textDocument": {"uri": self.document}})
        self.assertEqual([f["name"] for f in found], ["cell"])
        children = found[0]["children"]
        self.assertEqual([(c["name"], c["kind"]) for c in children],
                         [("total", 13), ("limit", 14), ("home", 14), ("part", 23), ("stock", 13), ("main", 12),
                          ("report", 12), ("weigh", 12)])
        self.assertEqual([c["name"] for c in children[3]["children"]], ["weight", "name"])
        self.assertEqual(part(TEXT, children[5]["selectionRange"]), "main")
        self.assertTrue(part(TEXT, children[5]["range"]).endswith("ENDPROC"))

    def test_workspace_symbols(self):
        found = self.client.request("workspace/symbol", {"query": "rep"})
        self.assertIn(("report", self.document), [(f["name"], f["location"]["uri"]) for f in found])
        self.assertEqual(part(TEXT, [f for f in found if f["name"] == "report"][0]["location"]["range"]), "report")

    def test_folding(self):
        found = self.client.request("textDocument/foldingRange", {"textDocument": {"uri": self.document}})
        starts = {f["startLine"] for f in found}
        for word in ("MODULE", "RECORD", "PROC main", "IF n", "PROC report", "FUNC"):
            self.assertIn(place(TEXT, word)["line"], starts)
        self.assertTrue(all(f["startLine"] < f["endLine"] for f in found))

    def test_selection(self):
        found = self.client.request("textDocument/selectionRange", {"textDocument": {"uri": self.document},
                                                                    "positions": [place(TEXT, "heavy"), place(TEXT, "limit")]})
        self.assertEqual(len(found), 2)
        step, sizes = found[0], []
        while step:
            sizes.append(len(part(TEXT, step["range"])))
            step = step.get("parent")
        self.assertEqual(sizes, sorted(set(sizes)))
        self.assertGreater(len(sizes), 3)


    def test_selection_in_a_deep_text(self):
        """SelectionRange.parent nests: readers of JSON limit the depth. The innermost ranges and the whole stay."""
        text = "MODULE m\nPROC main()\n" + "IF TRUE THEN\n" * 300 + "Stop;\n" + "ENDIF\n" * 300 + "ENDPROC\nENDMODULE\n"
        self.client.change(self.document, 2, text)
        step = self.client.request("textDocument/selectionRange", {"textDocument": {"uri": self.document},
                                                                   "positions": [place(text, "Stop")]})[0]
        parts = []
        while step:
            parts.append(part(text, step["range"]))
            step = step.get("parent")
        self.assertLessEqual(len(parts), 100)
        self.assertEqual(parts[0], "Stop")
        self.assertTrue(parts[-1].startswith("MODULE"))
        self.assertEqual(parts, sorted(parts, key=len))


class Tokens(Language):
    def decode(self, data):
        legend = self.connect().initialize()["capabilities"]["semanticTokensProvider"]["legend"]
        lines, found, line, start = TEXT.split("\n"), [], 0, 0
        for i in range(0, len(data), 5):
            line, start = line + data[i], data[i + 1] + (start if data[i] == 0 else 0)
            modifiers = {m for bit, m in enumerate(legend["tokenModifiers"]) if data[i + 4] >> bit & 1}
            found.append((lines[line][start:start + data[i + 2]], legend["tokenTypes"][data[i + 3]], modifiers))
        return found

    def test_full(self):
        data = self.client.request("textDocument/semanticTokens/full", {"textDocument": {"uri": self.document}})["data"]
        found = self.decode(data)
        self.assertIn(("limit", "variable", {"declaration", "readonly"}), found)
        self.assertIn(("MoveJ", "function", {"defaultLibrary"}), found)
        self.assertIn(("weight", "property", {"declaration"}), found)
        self.assertIn(("text", "parameter", {"declaration"}), found)
        self.assertTrue(any(name == "part" and kind in ("type", "struct", "class") for name, kind, _ in found))

    def test_delta(self):
        params = {"textDocument": {"uri": self.document}}
        full = self.client.request("textDocument/semanticTokens/full", params)
        self.client.change(self.document, 2, ((0, 0), (0, 0), "! remark\n"))
        delta = self.client.request("textDocument/semanticTokens/full/delta", {**params, "previousResultId": full["resultId"]})
        data = full["data"]
        for edit in sorted(delta["edits"], key=lambda e: e["start"], reverse=True):
            data[edit["start"]:edit["start"] + edit["deleteCount"]] = edit.get("data", [])
        self.assertEqual(data, self.client.request("textDocument/semanticTokens/full", params)["data"])
        self.assertLess(sum(len(e.get("data", [])) for e in delta["edits"]), 10)

    def test_range(self):
        line = place(TEXT, "MoveJ")["line"]
        data = self.client.request("textDocument/semanticTokens/range", {"textDocument": {"uri": self.document},
                                                                         "range": span((line, 0), (line + 1, 0))})["data"]
        self.assertEqual([name for name, _, _ in self.decode(data)], ["MoveJ", "home", "v100", "z10", "tool0"])


class Hints(Language):
    def test_inlay_hints(self):
        found = self.client.request("textDocument/inlayHint", {"textDocument": {"uri": self.document},
                                                               "range": span((0, 0), (100, 0))})
        line = place(TEXT, "MoveJ")["line"]
        here = [h for h in found if h["position"]["line"] == line and h.get("kind") == 2]
        self.assertEqual([h["label"].rstrip(": ") for h in here], ["ToPoint", "Speed", "Zone", "Tool"])
        self.assertEqual(here[0]["position"], place(TEXT, "home", 2))
        line = place(TEXT, "report")["line"]
        self.assertEqual([h["label"].rstrip(": ") for h in found if h["position"]["line"] == line], ["text"])

    def test_code_lens(self):
        found = self.client.request("textDocument/codeLens", {"textDocument": {"uri": self.document}})
        resolved = [f if "command" in f else self.client.request("codeLens/resolve", f) for f in found]
        titles = {(part(TEXT, f["range"]), f["command"]["title"]) for f in resolved}
        self.assertIn(("weigh", "1 reference"), titles)
        self.assertIn(("main", "Run"), titles)

    def test_links(self):
        text = "MODULE m\n  PROC main()\n    Load \"HOME:/part.modx\";\n  ENDPROC\nENDMODULE\n"
        target = self.write("HOME/part.modx", "MODULE part\nENDMODULE\n")
        document = self.client.open(self.write("m.modx", text), text)
        found = self.client.request("textDocument/documentLink", {"textDocument": {"uri": document}})
        self.assertEqual([(part(text, f["range"]), f["target"]) for f in found], [("HOME:/part.modx", uri(target))])


class Actions(Language):
    def actions(self, text, word, **context):
        self.client.change(self.document, 2, text)
        where = place(text, word)
        return self.client.request("textDocument/codeAction", {
            "textDocument": {"uri": self.document}, "range": {"start": where, "end": where},
            "context": {"diagnostics": [], **context}})

    def test_quick_fix_by_place(self):
        text = TEXT.replace("total := total", "total = total")
        found = [a for a in self.actions(text, "= total") if a["kind"] == "quickfix"]
        self.assertEqual(found[0]["diagnostics"][0]["source"], "rapidc")
        self.assertEqual(edited(text, changes_of(found[0]["edit"])[self.document]), TEXT)

    def test_fix_all(self):
        text = TEXT.replace("total := total", "total = total").replace("n := weigh", "n = weigh")
        found = self.actions(text, "MODULE", only=["source.fixAll"])
        self.assertEqual([a["kind"] for a in found], ["source.fixAll"])
        self.assertEqual(edited(text, changes_of(found[0]["edit"])[self.document]), TEXT)

    def test_only(self):
        text = TEXT.replace("total := total", "total = total")
        self.assertEqual({a["kind"] for a in self.actions(text, "= total", only=["quickfix"])}, {"quickfix"})

    def test_create_routine(self):
        text = TEXT.replace('TPWrite "heavy"', "stackAll 5")
        found = [a for a in self.actions(text, "stackAll") if "stackAll" in a["title"] and a["kind"] == "quickfix"]
        self.assertTrue(found)
        new = edited(text, changes_of(found[0]["edit"])[self.document])
        self.client.change(self.document, 3, new)
        errors = [d for d in self.client.published(self.document, 3) if d["severity"] == 1]
        self.assertEqual(errors, [])

    def test_teach_a_value_into_a_persistent(self):
        value = "[[400, 0, 500], [0, 0, 1, 0], [0, 0, 0, 0], [9E9, 9E9, 9E9, 9E9, 9E9, 9E9]]"
        text = TEXT.replace('TPWrite "heavy"', f"MoveL {value}, v100, fine, tool0")
        found = [a for a in self.actions(text, "400", only=["refactor.extract"]) if "PERS robtarget 'p10'" in a["title"]]
        self.assertEqual(len(found), 1)
        new = edited(text, changes_of(found[0]["edit"])[self.document])
        self.assertIn(f"PERS robtarget p10:={value};", new)
        self.assertIn("MoveL p10, v100", new)
        self.client.change(self.document, 3, new)
        self.assertEqual([d for d in self.client.published(self.document, 3) if d["severity"] == 1], [])

    def test_refactorings_are_offered(self):
        kinds = {a["kind"].split(".")[0] for a in self.actions(TEXT, "limit", only=["refactor"])}
        self.assertEqual(kinds, {"refactor"})


class Formatting(Language):
    UGLY = "MODULE m\nproc main()\nVAR num n:=1;\nif n=1 then\nn:=2;\nendif\nendproc\nENDMODULE\n"

    def formatted(self, text):
        path = os.path.join(self.folder, "fmt.modx")
        with open(path, "w", encoding="utf-8", newline="") as file:
            file.write(text)
        import subprocess
        from client import RAPIDC
        subprocess.run([RAPIDC, "fmt", path], check=True)
        with open(path, encoding="utf-8", newline="") as file:
            return file.read()

    def test_as_fmt(self):
        self.client.change(self.document, 2, self.UGLY)
        edits = self.client.request("textDocument/formatting", {"textDocument": {"uri": self.document},
                                                                "options": {"tabSize": 4, "insertSpaces": True}})
        self.assertEqual(edited(self.UGLY, edits), self.formatted(self.UGLY))
        self.assertGreater(len(edits), 3)

    def test_range(self):
        self.client.change(self.document, 2, self.UGLY)
        edits = self.client.request("textDocument/rangeFormatting", {
            "textDocument": {"uri": self.document}, "range": span((2, 0), (3, 0)), "options": {"tabSize": 4, "insertSpaces": True}})
        lines, expected = edited(self.UGLY, edits).split("\n"), self.formatted(self.UGLY).split("\n")
        self.assertEqual(lines[2], expected[2])
        self.assertEqual(lines[:2] + lines[3:], self.UGLY.split("\n")[:2] + self.UGLY.split("\n")[3:])

    def test_mistakes_keep_their_words(self):
        text = self.UGLY.replace("n:=2;", "n:= ) 2 wrong;")
        self.client.change(self.document, 2, text)
        edits = self.client.request("textDocument/formatting", {"textDocument": {"uri": self.document},
                                                                "options": {"tabSize": 4, "insertSpaces": True}})
        self.assertEqual(edited(text, edits).upper().split(), text.upper().split())

    def test_end_words_are_inserted(self):
        text = "MODULE m\n  PROC main()\n    VAR num n;\n    IF n = 1 THEN\n\n  ENDPROC\nENDMODULE\n"
        self.client.change(self.document, 2, text)
        edits = self.client.request("textDocument/onTypeFormatting", {
            "textDocument": {"uri": self.document}, "position": {"line": 4, "character": 0}, "ch": "\n",
            "options": {"tabSize": 2, "insertSpaces": True}})
        lines = edited(text, edits).split("\n")
        self.assertEqual(lines[5], "    ENDIF")
        self.assertTrue(lines[4].startswith("    ") and not lines[4].strip())
        closed = "\n".join(lines)
        self.client.change(self.document, 3, closed.replace(lines[4], "\n" + lines[4], 1))
        again = self.client.request("textDocument/onTypeFormatting", {
            "textDocument": {"uri": self.document}, "position": {"line": 4, "character": 0}, "ch": "\n",
            "options": {"tabSize": 2, "insertSpaces": True}})
        self.assertFalse(any("ENDIF" in e["newText"] for e in again))

    def on_type(self, text, place, typed, version, spaces=True):
        self.client.change(self.document, version, text)
        edits = self.client.request("textDocument/onTypeFormatting", {
            "textDocument": {"uri": self.document}, "position": {"line": place[0], "character": place[1]}, "ch": typed,
            "options": {"tabSize": 4, "insertSpaces": spaces}})
        return edited(text, edits).split("\n")

    def test_typing_keeps_the_indentation_of_the_file(self):
        """docs/editors.md: the line typed is laid out inside; its indentation is that of the file, unless the line above has that of
        rapidc fmt."""
        version = 2
        for one in ("    ", "\t"):
            lines = ["MODULE m", one + "PROC main()", 2 * one + "IF TRUE THEN", 3 * one + 'TPWrite   "x" ;', 2 * one + "ENDIF",
                     one + "ENDPROC", "ENDMODULE", ""]
            typed = self.on_type("\n".join(lines), (3, len(lines[3])), ";", version, one != "\t")
            self.assertEqual(typed[3], 3 * one + 'TPWrite "x";')
            opened = self.on_type("\n".join(lines[:3] + [""] + lines[5:]), (3, 0), "\n", version + 1, one != "\t")
            self.assertEqual(opened[3:5], [3 * one, 2 * one + "ENDIF"])
            version += 2
        laid_out = 'MODULE m\n   PROC main()\n      TPWrite "a";\n  TPWrite   "b";\n   ENDPROC\nENDMODULE\n'
        self.assertEqual(self.on_type(laid_out, (3, 16), ";", version)[3], '      TPWrite "b";')

    def test_a_block_at_the_margin_takes_the_options(self):
        """FormattingOptions.tabSize and insertSpaces, where the text shows no indentation yet."""
        text = "PROC main()\n\n"
        self.assertEqual(self.on_type(text, (1, 0), "\n", 2)[1:3], ["    ", "ENDPROC"])
        self.assertEqual(self.on_type(text, (1, 0), "\n", 3, False)[1:3], ["\t", "ENDPROC"])

    def test_typing_beyond_the_text(self):
        """Position.line counts the lines of the document: on a line that it does not have nothing is laid out, and the server stays."""
        text = "MODULE m\n  PROC main()\n  ENDPROC\nENDMODULE\n"
        for version, line in enumerate((5, 6, 100, 2**31 - 1), 2):
            for offset, typed in enumerate(("\n", ";")):
                self.assertEqual("\n".join(self.on_type(text, (line, 0), typed, 2 * version + offset)), text)


class Configuration(Language):
    CONFIG = 'EIO:CFG_1.0:6:1::\n#\nEIO_SIGNAL:\n\n      -Name "doGrip" -SignalType "DO" \n#\nEIO_CROSS:\n\n' \
             '      -Name "c1" -Res "doGrip" -Act1 "diGo"\n'
    PROGRAM = "MODULE cell\n  PROC main()\n    SetDO doGrip, 1;\n  ENDPROC\nENDMODULE\n"

    def setUp(self):
        super().setUp()
        self.client.change(self.document, 2, self.PROGRAM)
        self.config = self.client.open(self.write("EIO.cfg", self.CONFIG), self.CONFIG, language="cfg")
        self.client.notify("workspace/didChangeWatchedFiles", {"changes": [{"uri": self.config, "type": 1}]})

    def test_from_rapid_to_the_configuration(self):
        found = self.client.request("textDocument/definition", at(self.document, self.PROGRAM, "doGrip"))
        self.assertEqual([(f["uri"], part(self.CONFIG, f["range"])) for f in found], [(self.config, "doGrip")])

    def test_references_of_a_signal(self):
        """ReferenceContext.includeDeclaration: the signal is declared in EIO.cfg, which a cross connection names again."""
        ask = at(self.document, self.PROGRAM, "doGrip")
        for declaration, expected in ((True, [1, 2]), (False, [2])):
            found = self.client.request("textDocument/references", {**ask, "context": {"includeDeclaration": declaration}})
            self.assertEqual([f["range"]["start"] for f in found if f["uri"] == self.document], [place(self.PROGRAM, "doGrip")])
            self.assertEqual([f["range"]["start"] for f in found if f["uri"] == self.config],
                             [place(self.CONFIG, "doGrip", nth) for nth in expected])

    def test_from_the_configuration_to_rapid(self):
        found = self.client.request("textDocument/references", {**at(self.config, self.CONFIG, "doGrip"),
                                                                "context": {"includeDeclaration": False}})
        self.assertIn(self.document, [f["uri"] for f in found])
        found = self.client.request("textDocument/definition", at(self.config, self.CONFIG, "doGrip", 2))
        self.assertEqual([f["range"]["start"] for f in found], [place(self.CONFIG, "doGrip")])

    def test_completion_and_hover(self):
        end = place(self.CONFIG, '-SignalType "DO" ', offset=17)
        start = end["line"], end["character"]
        self.client.change(self.config, 2, (start, start, "-"))
        end["character"] += 1
        found = self.client.request("textDocument/completion", {"textDocument": {"uri": self.config}, "position": end})
        labels = [i["label"] for i in found["items"]]
        self.assertIn("Access", labels)
        self.assertNotIn("SignalType", labels)
        hover = self.client.request("textDocument/hover", at(self.config, self.CONFIG, "SignalType"))
        self.assertIn("SignalType", hover["contents"]["value"])


class ProgramFiles(Language):
    """Issue 19: completion and definition in .pgf: the modules beside it that it does not list yet; an entry leads to its file."""

    def test_modules_of_a_program_file(self):
        program = "<?xml version=\"1.0\"?>\n<Program>\n<Module>cell.modx</Module>\n<Module></Module>\n<Module>pa</Module>\n</Program>\n"
        part = self.write("part.mod", "MODULE part\nENDMODULE\n")
        self.write("notes.txt", "")
        document = self.client.open(self.write("p.pgf", program), program)
        for word, offset in (("<Module></", 8), (">pa<", 3)):
            found = self.client.request("textDocument/completion", at(document, program, word, offset=offset))["items"]
            self.assertEqual([i["label"] for i in found], ["part.mod"])
        self.assertEqual(edited(program, [found[0]["textEdit"]]), program.replace(">pa<", ">part.mod<"))
        outside = self.client.request("textDocument/completion", at(document, program, "<Program>", offset=9))
        self.assertEqual(outside["items"], [])
        self.assertEqual([f["uri"] for f in self.client.request("textDocument/definition", at(document, program, "cell"))],
                         [self.document])
        self.client.change(document, 2, program.replace(">pa<", ">part.mod<"))
        found = self.client.request("textDocument/definition", at(document, program, ">pa<", offset=2))
        self.assertEqual([f["uri"] for f in found], [uri(part)])


class FileOperations(Language):
    def test_renaming_the_file_of_a_module(self):
        program = '<?xml version="1.0" encoding="ISO-8859-1" ?>\n<Program>\n\t<Module>cell.modx</Module>\n</Program>\n'
        path = self.write("p.pgf", program)
        new = os.path.join(self.work(), "station.modx")
        edit = changes_of(self.client.request("workspace/willRenameFiles",
                                              {"files": [{"oldUri": self.document, "newUri": uri(new)}]}))
        self.assertEqual(edited(TEXT, edit[self.document]), TEXT.replace("MODULE cell", "MODULE station", 1))
        self.assertEqual(edited(program, edit[uri(path)]), program.replace("cell.modx", "station.modx"))
        self.assertIsNone(self.client.request("workspace/willRenameFiles", {"files": [
            {"oldUri": "file:///x/a.txt", "newUri": "file:///x/b.txt"}]}))

    def test_renaming_a_file_of_a_backup(self):
        """The list of a backup names its modules with their folder, by task: only the line of this file follows."""
        module = "MODULE pick\n  PROC main()\n  ENDPROC\nENDMODULE\n"
        path = self.write("cell/RAPID/TASK1/PROGMOD/pick.mod", module)
        for other in ("TASK1/SYSMOD", "TASK2/PROGMOD"):
            self.write(f"cell/RAPID/{other}/pick.mod", module)
        lines = [">>TASK1: (T_ROB1,,)", "SYSMOD\\pick.mod @ ", "PROGMOD\\PICK.MOD @ pick.mod",
                 ">>TASK2: (T_BACK,,)", "PROGMOD\\pick.mod @ ", ">>EOF:", ""]
        text = "\r\n".join(lines)
        listed = self.write("cell/BACKINFO/backinfo.txt", text)
        client = self.connect()
        client.initialize([os.path.join(self.work(), "cell")])
        new = os.path.join(os.path.dirname(path), "place.mod")
        edit = changes_of(client.request("workspace/willRenameFiles",
                                         {"files": [{"oldUri": uri(path), "newUri": uri(new)}]}))
        lines[2] = "PROGMOD\\place.mod @ place.mod"
        self.assertEqual(edited(text, edit[uri(listed)]), "\r\n".join(lines))


if __name__ == "__main__":
    unittest.main()
