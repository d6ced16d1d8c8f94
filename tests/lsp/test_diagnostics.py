"""Diagnostics as `rapidc check` has them: pushed with versions, pulled, for folders, backups, configurations (items 3 to 7)."""

import os
import random
import unittest

from client import CAPABILITIES, LspCase, place, span, uri

WRONG = """MODULE m
  PROC main()
    VAR num n;
    n := "text";
    TPWrite NumToStr(n, 0);
  ENDPROC
ENDMODULE
"""
RIGHT = WRONG.replace('"text"', "1")
SYS_CFG = """SYS:CFG_1.0:6:0::
#
CAB_TASKS:

      -Name "T_ROB1" -Type "NORMAL" -MotionTask \\
      -Entry "main"

      -Name "T_BACK" -Type "NORMAL"
#
CAB_TASK_MODULES:
"""


class Push(LspCase):
    def test_range_code_and_version(self):
        client, document = self.opened(WRONG)
        found = client.published(document, 1)
        self.assertEqual(self.codes(found), ["RAP2104"])
        self.assertEqual(found[0]["range"], span((3, 9), (3, 15)))
        self.assertEqual((found[0]["severity"], found[0]["source"]), (1, "rapidc"))
        self.assertTrue(found[0]["codeDescription"]["href"].startswith("file:///"))
        self.assertTrue(os.path.exists(found[0]["codeDescription"]["href"].removeprefix("file://")))

    def test_edit_mends_and_breaks(self):
        client, document = self.opened(WRONG)
        client.published(document, 1)
        client.change(document, 2, ((3, 9), (3, 15), "1"))
        self.assertEqual(client.published(document, 2), [])
        client.change(document, 3, WRONG)
        self.assertEqual(self.codes(client.published(document, 3)), ["RAP2104"])

    def test_several_changes_follow_each_other(self):
        client, document = self.opened("")
        lines = RIGHT.split("\n")
        client.change(document, 2, *[((i, 0), (i, 0), line + "\n") for i, line in enumerate(lines[:-1])])
        self.assertEqual(client.published(document, 2), [])

    def test_same_as_check(self):
        with open(os.path.join(os.path.dirname(__file__), "..", "diag", "README.md"), encoding="utf-8") as file:
            text = file.read()
        client, document = self.opened(text)  # no RAPID at all
        expected = self.check(self.write("m.modx", text))
        found = client.published(document, 1)
        self.assertEqual([(d["code"], d["range"]["start"]["line"] + 1) for d in found],
                         [(d["code"], d["line"]) for d in expected])

    def test_notes_are_related_information(self):
        text = "MODULE m\n  VAR num a;\n  VAR bool a;\nENDMODULE\n"
        client, document = self.opened(text)
        found = [d for d in client.published(document, 1) if "relatedInformation" in d]
        self.assertEqual(found[0]["relatedInformation"][0]["location"]["uri"], document)

    def test_unused_names_are_tagged(self):
        text = "MODULE m\n  PROC main()\n    VAR num spare;\n  ENDPROC\nENDMODULE\n"
        client, document = self.opened(text)
        found = client.published(document, 1)
        self.assertEqual([(d["severity"], d["tags"]) for d in found], [(2, [1])])

    def test_close_returns_to_the_text_on_disk(self):
        path = self.write("m.modx", RIGHT)
        client = self.connect()
        client.initialize([self.work()])
        document = client.open(path, WRONG)
        self.assertEqual(len(client.published(document, 1)), 1)
        client.close(document)
        self.assertEqual(client.next_published(document), [])
        self.assertNotIn("version", client.diagnostics[document])

    def test_close_of_a_file_that_was_never_saved(self):
        client = self.connect()
        client.initialize([self.work()])
        document = client.open(os.path.join(self.work(), "new.modx"), WRONG)
        self.assertEqual(len(client.published(document, 1)), 1)
        client.close(document)
        self.assertEqual(client.next_published(document), [])

    def test_documents_that_are_no_files(self):
        client = self.connect()
        client.initialize()
        document = client.open("untitled:Untitled-1", WRONG)
        self.assertEqual(self.codes(client.published(document, 1)), ["RAP2104"])
        client.close(document)
        self.assertEqual(client.next_published(document), [])

    def test_a_single_file_is_a_program(self):
        other = self.write("other.modx", "MODULE other\n  PROC helper()\n  ENDPROC\nENDMODULE\n")
        text = "MODULE m\n  PROC main()\n    helper;\n  ENDPROC\nENDMODULE\n"
        client, document = self.opened(text, folders=False)
        found = client.published(document, 1)
        self.assertEqual(self.codes(found), self.codes(self.check(self.write("m.modx", text))))
        self.assertEqual(found[0]["relatedInformation"][0]["location"]["uri"], uri(other))

    def test_the_whole_folder_is_reported(self):
        wrong = self.write("wrong.modx", WRONG.replace("MODULE m", "MODULE w").replace("main", "other"))
        client = self.connect()
        client.initialize([self.work()])
        self.assertEqual(self.codes(client.published(uri(wrong))), ["RAP2104"])

    def test_an_edit_changes_another_module(self):
        main = "MODULE m\n  PROC main()\n    helper 1;\n  ENDPROC\nENDMODULE\n"
        helper = "MODULE h\n  PROC helper(num n)\n    TPWrite NumToStr(n, 0);\n  ENDPROC\nENDMODULE\n"
        paths = self.write("m.modx", main), self.write("h.modx", helper)
        client = self.connect()
        client.initialize([self.work()])
        first, second = client.open(paths[0], main), client.open(paths[1], helper)
        self.assertEqual(client.published(first, 1), [])
        client.published(second, 1)
        client.diagnostics.clear()
        client.change(second, 2, ((1, 14), (1, 19), "string n"))
        self.assertTrue(client.published(second, 2))
        self.assertTrue(client.published(first, 1))
        client.diagnostics.clear()
        client.change(second, 3, helper)
        self.assertEqual((client.published(second, 3), client.published(first, 1)), ([], []))

    def test_random_edits_end_as_a_fresh_start(self):
        """Whatever was typed before, the diagnostics are those of the text as it is now."""
        source = WRONG + "MODULE n\n  RECORD part\n    num weight;\n  ENDRECORD\n  VAR part stock{3};\n  FUNC num total(num a)\n" \
            "    FOR i FROM 1 TO 3 DO\n      a := a + stock{i}.weight;\n    ENDFOR\n    RETURN a;\n  ENDFUNC\nENDMODULE\n"
        chance = random.Random(5)
        client, document = self.opened(source)
        text, version = source, 1
        for _ in range(25):
            for _ in range(4):
                begin = chance.randrange(len(text) + 1)
                end = min(len(text), begin + chance.choice((0, 0, 1, 3, 12)))
                word = chance.choice(("", ";", "\n", "n", '"', "ENDIF\n", "IF a > 1 THEN\n", "é", "😀", "{", "ENDMODULE"))
                version += 1
                client.change(document, version, (self.position(text, begin), self.position(text, end), word))
                text = text[:begin] + word + text[end:]
            if chance.random() < 0.3:
                version += 1
                client.change(document, version, source)
                text = source
            found = client.published(document, version)
            fresh = self.connect()
            fresh.initialize([self.work()])
            again = fresh.open(os.path.join(self.work(), "m.modx"), text)
            self.assertEqual(found, fresh.published(again, 1), text)
            fresh.end()

    @staticmethod
    def position(text, offset):
        """In UTF-16 units."""
        line = text[text.rfind("\n", 0, offset) + 1:offset]
        return text.count("\n", 0, offset), len(line.encode("utf-16-le")) // 2


    def test_related_places_follow_an_edit_that_keeps_offsets(self):
        """DiagnosticRelatedInformation.location: the place in the text as it is, even when the edit has as many bytes as it replaces."""
        first = 'MODULE a\n\n  VAR string s := "ab"; PROC main()\n  ENDPROC\nENDMODULE\n'
        second = "MODULE b\n  PROC main()\n  ENDPROC\nENDMODULE\n"
        paths = self.write("a.modx", first), self.write("b.modx", second)
        client = self.connect()
        client.initialize([self.work()])
        edited, other = client.open(paths[0], first), uri(paths[1])

        def place_of_the_first():
            client.settle()
            found = [d for d in client.diagnostics[other]["diagnostics"] if d["severity"] == 1][0]
            pulled = client.request("textDocument/diagnostic", {"textDocument": {"uri": other}})
            self.assertEqual([i for i in pulled["items"] if i["severity"] == 1][0], found)
            return found["relatedInformation"][0]["location"]["range"]["start"], pulled["resultId"]

        client.published(edited, 1)
        before, result = place_of_the_first()
        self.assertEqual(before, {"line": 2, "character": 29})
        client.change(edited, 2, ((1, 0), (2, 0), " "))  # a line less
        client.published(edited, 2)
        after, second_result = place_of_the_first()
        self.assertEqual(after, {"line": 1, "character": 30})
        client.change(edited, 3, ((1, 20), (1, 22), "\u00e4"))  # a character less
        client.published(edited, 3)
        last, third_result = place_of_the_first()
        self.assertEqual(last, {"line": 1, "character": 29})
        self.assertEqual(len({result, second_result, third_result}), 3)


class Encodings(LspCase):
    TEXT = 'MODULE m\n  PROC main()\n    TPWrite "žluť 😀" + 1;\n  ENDPROC\nENDMODULE\n'

    def found(self, encodings, result):
        client = self.connect()
        capabilities = {**CAPABILITIES, "general": {"positionEncodings": encodings}}
        answer = client.initialize([self.work()], capabilities)
        self.assertEqual(answer["capabilities"]["positionEncoding"], result)
        document = client.open(self.write("m.modx", self.TEXT), self.TEXT)
        return client, document, client.published(document, 1)

    def test_utf16(self):
        client, document, found = self.found(["utf-16", "utf-8"], "utf-16")
        self.assertEqual(found[0]["range"], span((2, 22), (2, 23)))
        client.change(document, 2, ((2, 21), (2, 25), ""))  # after the closing quote
        self.assertEqual(client.published(document, 2), [])

    def test_utf8_when_it_comes_first(self):
        client, document, found = self.found(["utf-8", "utf-16"], "utf-8")
        self.assertEqual(found[0]["range"], span((2, 26), (2, 27)))
        client.change(document, 2, ((2, 25), (2, 29), ""))
        self.assertEqual(client.published(document, 2), [])

    def test_line_ends(self):
        text = WRONG.replace("\n", "\r\n")
        client, document = self.opened(text)
        self.assertEqual(client.published(document, 1)[0]["range"], span((3, 9), (3, 15)))
        client.change(document, 2, ((3, 9), (3, 15), "1"))
        self.assertEqual(client.published(document, 2), [])

    def test_old_modules_are_latin1_on_disk(self):
        self.write("old.mod", 'MODULE old\n  PROC helper()\n    TPWrite "\u00e4" + 1;\n  ENDPROC\nENDMODULE\n', "latin-1")
        client = self.connect()
        client.initialize([self.work()])
        found = client.published(uri(os.path.join(self.work(), "old.mod")))
        self.assertEqual(found[0]["range"], span((2, 16), (2, 17)))


class Bounds(LspCase):
    def test_positions_beyond_the_text(self):
        client, document = self.opened(RIGHT)
        client.published(document, 1)
        client.change(document, 2, ((2, 4000), (2, 5000), ""), ((4000, 1), (5000, 7), "! end\n"))
        self.assertEqual(client.published(document, 2), [])

    def test_edits_of_what_is_not_open(self):
        client = self.connect()
        client.initialize([self.work()])
        client.change("file:///nowhere/x.modx", 2, "MODULE x\nENDMODULE\n")
        client.close("file:///nowhere/x.modx")
        document = client.open(self.write("m.modx", WRONG), WRONG)
        self.assertEqual(len(client.published(document, 1)), 1)

    def test_a_wrong_change_leaves_the_text(self):
        client, document = self.opened(WRONG)
        client.published(document, 1)
        client.notify("textDocument/didChange", {"textDocument": {"uri": document, "version": 2},
                                                 "contentChanges": [{"text": ""}, {"range": 5, "text": ""}]})
        client.change(document, 3, ((0, 0), (0, 0), "! remark\n"))
        self.assertEqual(client.published(document, 3)[0]["range"], span((4, 9), (4, 15)))

    def test_a_line_of_megabytes(self):
        text = "MODULE m\n  CONST string s := \"" + "é" * 3_000_000 + "\";\nENDMODULE\n"
        client, document = self.opened(text)
        self.assertTrue(client.published(document, 1))
        client.change(document, 2, ((1, 21), (1, 3_000_021), ""))
        client.published(document, 2)
        self.assertEqual(client.stop(), 0)

    def test_single_surrogates(self):
        client, document = self.opened(RIGHT)
        client.published(document, 1)
        client.send_body('{"jsonrpc":"2.0","method":"textDocument/didChange","params":{"textDocument":{"uri":"%s","version":2},'
                         '"contentChanges":[{"text":"MODULE m\\n! \\ud83d\\nENDMODULE\\n"}]}}' % document)
        self.assertEqual(client.published(document, 2), [])


class Pull(LspCase):
    def test_full_and_unchanged(self):
        client, document = self.opened(WRONG)
        params = {"textDocument": {"uri": document}}
        report = client.request("textDocument/diagnostic", params)
        self.assertEqual((report["kind"], self.codes(report["items"])), ("full", ["RAP2104"]))
        again = client.request("textDocument/diagnostic", {**params, "previousResultId": report["resultId"]})
        self.assertEqual(again, {"kind": "unchanged", "resultId": report["resultId"]})
        client.change(document, 2, RIGHT)
        fresh = client.request("textDocument/diagnostic", {**params, "previousResultId": report["resultId"]})
        self.assertEqual((fresh["kind"], fresh["items"]), ("full", []))

    def test_workspace(self):
        self.write("w.modx", WRONG.replace("MODULE m", "MODULE w").replace("main", "other"))
        client, document = self.opened(WRONG)
        report = client.request("workspace/diagnostic", {"previousResultIds": []})
        found = {item["uri"]: item for item in report["items"]}
        self.assertEqual(found[document]["version"], 1)
        self.assertEqual({uri: self.codes(item["items"]) for uri, item in found.items()},
                         {document: ["RAP2104"], uri(os.path.join(self.work(), "w.modx")): ["RAP2104"]})
        ids = [{"uri": item["uri"], "value": item["resultId"]} for item in report["items"]]
        again = client.request("workspace/diagnostic", {"previousResultIds": ids})
        self.assertEqual({item["kind"] for item in again["items"]}, {"unchanged"})


class Folders(LspCase):
    def test_two_folders_are_two_programs(self):
        helper = "MODULE h\n  PROC helper()\n  ENDPROC\nENDMODULE\n"
        main = "MODULE m\n  PROC main()\n    helper;\n  ENDPROC\nENDMODULE\n"
        paths = self.write("a/m.modx", main), self.write("b/m.modx", main)
        self.write("a/h.modx", helper)
        client = self.connect()
        client.initialize([os.path.dirname(p) for p in paths])
        first, second = (client.open(p, main) for p in paths)
        self.assertEqual(client.published(first, 1), [])
        self.assertEqual(len(client.published(second, 1)), 1)

    def test_folders_come_and_leave(self):
        path = self.write("a/w.modx", WRONG)
        client = self.connect()
        client.initialize([])
        folder = {"uri": uri(os.path.dirname(path)), "name": "a"}
        client.notify("workspace/didChangeWorkspaceFolders", {"event": {"added": [folder], "removed": []}})
        self.assertEqual(len(client.published(uri(path))), 1)
        client.notify("workspace/didChangeWorkspaceFolders", {"event": {"added": [], "removed": [folder]}})
        self.assertEqual(client.next_published(uri(path)), [])

    def test_tasks_of_a_backup(self):
        main = "MODULE m\n  PERS num shared := 1;\n  VAR num own;\n  PROC main()\n    own := shared;\n  ENDPROC\nENDMODULE\n"
        back = "MODULE b\n  PERS num shared;\n  PROC main()\n    shared := own;\n  ENDPROC\nENDMODULE\n"
        paths = self.write("RAPID/TASK1/PROGMOD/m.mod", main), self.write("RAPID/TASK2/PROGMOD/b.mod", back)
        self.write("SYSPAR/SYS.cfg", SYS_CFG)
        client = self.connect()
        client.initialize([self.work()])
        first, second = client.open(paths[0], main), client.open(paths[1], back)
        self.assertEqual([d for d in client.published(first, 1) if d["severity"] == 1], [])
        found = [d for d in client.published(second, 1) if d["severity"] == 1]
        self.assertEqual([d["range"]["start"] for d in found], [place(back, "own")])

    def test_files_on_disk_change(self):
        main = "MODULE m\n  PROC main()\n    helper;\n  ENDPROC\nENDMODULE\n"
        client, document = self.opened(main)
        self.assertEqual(len(client.published(document, 1)), 1)
        path = self.write("h.modx", "MODULE h\n  PROC helper()\n  ENDPROC\nENDMODULE\n")
        client.notify("workspace/didChangeWatchedFiles", {"changes": [{"uri": uri(path), "type": 1}]})
        self.assertEqual(client.next_published(document), [])
        self.write("h.modx", "MODULE h\n  PROC helped()\n  ENDPROC\nENDMODULE\n")
        client.notify("workspace/didChangeWatchedFiles", {"changes": [{"uri": uri(path), "type": 2}]})
        self.assertEqual(len(client.next_published(document)), 1)
        self.write("h.modx", "MODULE h\n  PROC helper()\n  ENDPROC\nENDMODULE\n")
        client.notify("textDocument/didSave", {"textDocument": {"uri": uri(path)}})
        self.assertEqual(client.next_published(document), [])
        os.remove(path)
        client.notify("workspace/didChangeWatchedFiles", {"changes": [{"uri": uri(path), "type": 3}]})
        self.assertEqual(len(client.next_published(document)), 1)

    def test_watchers_are_registered_if_the_client_can(self):
        client = self.connect()
        workspace = {**CAPABILITIES["workspace"], "didChangeWatchedFiles": {"dynamicRegistration": True}}
        client.initialize([self.work()], {**CAPABILITIES, "workspace": workspace})
        client.settle()
        self.assertEqual([m["params"]["registrations"][0]["method"] for m in client.asked], ["workspace/didChangeWatchedFiles"])
        other = self.connect()
        other.initialize([self.work()])
        other.settle()
        self.assertEqual(other.asked, [])

    def test_progress_of_the_first_load(self):
        client = self.connect()
        client.initialize([self.work()], {**CAPABILITIES, "window": {"workDoneProgress": True}})
        client.published(client.open(self.write("m.modx", RIGHT), RIGHT), 1)
        self.assertEqual([m["method"] for m in client.asked], ["window/workDoneProgress/create"])
        kinds = [m["params"]["value"]["kind"] for m in client.notifications if m["method"] == "$/progress"]
        self.assertEqual(kinds, ["begin", "end"])

    def test_configuration_files(self):
        self.write("EIO.cfg", 'EIO:CFG_1.0:6:1::\n#\nEIO_SIGNAL:\n\n      -Name "doGrip" -SignalType "XX"\n')
        client = self.connect()
        client.initialize([self.work()])
        found = client.published(uri(os.path.join(self.work(), "EIO.cfg")))
        self.assertEqual([(d["code"][:4], d["range"]["start"]["line"]) for d in found], [("RAP6", 4)])

    def test_an_open_configuration_counts_before_the_file(self):
        main = "MODULE m\n  PROC main()\n    SetDO doGrip, 1;\n  ENDPROC\nENDMODULE\n"
        config = 'EIO:CFG_1.0:6:1::\n#\nEIO_SIGNAL:\n\n      -Name "doOther" -SignalType "DO"\n'
        path = self.write("EIO.cfg", config)
        client, document = self.opened(main)
        self.assertEqual(len(client.published(document, 1)), 1)
        client.open(path, config.replace("doOther", "doGrip"), language="cfg")
        self.assertEqual(client.next_published(document), [])

    def test_program_files(self):
        text = '<?xml version="1.0" encoding="ISO-8859-1" ?>\n<Program>\n\t<Module>lost.mod</Module>\n</Program>\n'
        path = self.write("p.pgf", text)
        client = self.connect()
        client.initialize([self.work()])
        document = client.open(path, text, language="xml")
        found = client.published(document, 1)
        self.assertEqual([d["severity"] for d in found], [1])
        self.assertEqual(found[0]["range"], span((2, 9), (2, 17)))


class Settings(LspCase):
    TEXT = "MODULE m\n  PROC main()\n    VAR num spare;\n  ENDPROC\nENDMODULE\n"

    def severities(self, client, document):
        return [d["severity"] for d in client.next_published(document)]

    def test_initialization_options(self):
        client = self.connect()
        client.initialize([self.work()], initializationOptions={"warnings": ["error=unused-variable"]})
        document = client.open(self.write("m.modx", self.TEXT), self.TEXT)
        self.assertEqual(self.severities(client, document), [1])

    def test_did_change_configuration(self):
        client, document = self.opened(self.TEXT)
        self.assertEqual(self.severities(client, document), [2])
        client.notify("workspace/didChangeConfiguration", {"settings": {"rapidc": {"warnings": ["no-unused-variable"]}}})
        self.assertEqual(self.severities(client, document), [])

    def test_the_client_is_asked(self):
        client = self.connect()
        client.answers["workspace/configuration"] = lambda params: [
            {"warnings": ["no-lint"]} if item["section"] == "rapidc" else None for item in params["items"]]
        client.initialize([self.work()], {**CAPABILITIES, "workspace": {"configuration": True}})
        document = client.open(self.write("m.modx", self.TEXT), self.TEXT)
        self.assertEqual(self.severities(client, document), [])
        client.answers["workspace/configuration"] = lambda params: [{"warnings": []}]
        client.notify("workspace/didChangeConfiguration", {"settings": None})
        self.assertEqual(self.severities(client, document), [2])

    def test_project_file(self):
        self.write("rapidc.json", '{"warnings": {"unused-variable": "error"}}')
        client, document = self.opened(self.TEXT)
        self.assertEqual(self.severities(client, document), [1])

    def test_wrong_settings_are_shown(self):
        client, document = self.opened(self.TEXT)
        client.published(document, 1)
        client.notify("workspace/didChangeConfiguration", {"settings": {"rapidc": {"warnings": ["no-such-warning-at-all", 5]}}})
        client.settle()
        shown = [m["params"] for m in client.notifications if m["method"] == "window/showMessage"]
        self.assertEqual([m["type"] for m in shown], [2, 2])
        self.assertIn("no-such-warning-at-all", shown[0]["message"] + shown[1]["message"])


if __name__ == "__main__":
    unittest.main()
