"""Symbols: values, properties, types, search, validate, events (controller.md 2.2 to 2.4; contract 26, 28, 29, 31, 35, 41, 42)."""

import urllib.parse

from rapid_testing import RapidCase, data, properties
from serve_testing import main

MODULE = """MODULE M
  RECORD inner
    num a;
    string b;
  ENDRECORD
  RECORD outer
    inner first;
    pos place;
  ENDRECORD
  ALIAS num count;
  CONST num limit := 3;
  PERS num number := 5;
  PERS string word := "text";
  TASK PERS bool flag := TRUE;
  PERS dnum large := 4503599627370496;
  LOCAL VAR num list{4} := [1,2,3,4];
  VAR num grid{2,3} := [[1,2,3],[4,5,6]];
  VAR outer both := [[1,"x"],[1,2,3]];
  VAR count many := 7;
  VAR byte code := 65;
  VAR byte codes{2} := [1,2];
  PERS robtarget target := [[600,0,500],[1,0,0,0],[0,0,0,0],[9E+09,9E+09,9E+09,9E+09,9E+09,9E+09]];
  VAR signaldo signal;
  PROC main()
    FOR i FROM 1 TO 30 DO
      number := i;
    ENDFOR
    Stop;
  ENDPROC
  FUNC num twice(num value)
    RETURN 2 * value;
  ENDFUNC
  LOCAL PROC hidden(num value \\num other)
  ENDPROC
ENDMODULE
"""

VALUES = {
    "T_ROB1/M/number": "5", "T_ROB1/number": "5", "T_ROB1/M/word": '"text"', "T_ROB1/M/flag": "TRUE",
    "T_ROB1/M/large": "4503599627370496", "T_ROB1/M/list": "[1,2,3,4]", "T_ROB1/M/list{3}": "3",
    "T_ROB1/M/grid": "[[1,2,3],[4,5,6]]", "T_ROB1/M/grid{2,3}": "6", "T_ROB1/M/both": '[[1,"x"],[1,2,3]]',
    "T_ROB1/M/both.first.b": '"x"', "T_ROB1/M/both.place": "[1,2,3]", "T_ROB1/M/limit": "3", "T_ROB1/M/many": "7",
    "T_ROB1/M/target": "[[600,0,500],[1,0,0,0],[0,0,0,0],[9E+09,9E+09,9E+09,9E+09,9E+09,9E+09]]",
    "T_ROB1/M/target.trans.x": "600",
}


def quoted(symbol):
    return urllib.parse.quote(symbol)


class Values(RapidCase):
    MODULE = MODULE

    def test_reading(self):
        """2.2: values as RAPID writes them; 28: T/x without module; 35: elements and components, percent-encoded."""
        for client in self.both():
            for symbol, value in VALUES.items():
                with self.subTest(symbol=symbol):
                    found = client.get(data(client.dialect, quoted(symbol))).entries()
                    self.assertEqual([(entry.type, entry.values["value"]) for entry in found], [("rap-data", value)])
        self.in_all_forms(data(1, "T_ROB1/M/both"), data(2, "T_ROB1/M/both"))

    def test_the_address_of_an_event(self):
        """2.4: events repeat what was subscribed; published clients read that address, so ";value" is the resource itself."""
        for client in self.both():
            path = data(client.dialect, "T_ROB1/M/word")
            self.assertEqual(client.get(path + ";value").values("rap-data")["value"], '"text"')
            self.assertEqual(client.get(path + ";value").body, client.get(path).body)
            self.assertIn("ctrlexecstate", client.get("/rw/rapid/execution;ctrlexecstate").values())
            self.assertEqual(client.get("/rw/rapid;x/execution").status, 404)
            self.assertEqual(client.get("/;value").status, 404)

    def test_strings_in_xhtml(self):
        """2.2: values travel as RAPID writes them, "text", for clients that use regular expressions."""
        for dialect in (1, 2):
            response = self.client(dialect, form="xhtml").get(data(dialect, "T_ROB1/M/word"))
            self.assertIn(b'<span class="value">"text"</span>', response.body)

    def test_one_encoded_segment(self):
        """28: the slashes of a symbol may be encoded."""
        client = self.client(2)
        for end, span in (("data", "value"), ("properties", "symburl")):
            response = client.get(f"/rw/rapid/symbol/RAPID%2FT_ROB1%2FM%2Fnumber/{end}")
            self.assertIn(span, response.values())
        self.assertEqual(self.client(1).get("/rw/rapid/symbol/data/RAPID%2FT_ROB1%2FM%2Fnumber").values()["value"], "5")

    def test_unknown(self):
        """2.2: -1073414146 not found (RW 6 symbols 400), -1073442816 unknown symbol (400)."""
        for symbol in ("T_ROB1/M/none", "T_ROB1/None/number", "T_NONE/M/number", "T_ROB1/M/list%7B5%7D", "T_ROB1/M/number.x",
                       "T_ROB1/M/list%7B", "T_ROB1/M/main"):
            for dialect, code in ((1, -1073414146), (2, -1073442816)):
                response = self.client(dialect).get(data(dialect, symbol))
                self.assertEqual((response.status, response.code()), (400, code), symbol)

    def values_of_all(self):
        return [self.value("T_ROB1/M/" + name) for name in ("word", "number", "flag", "list", "grid", "both", "limit", "code", "codes")]

    def test_writing(self):
        """35: what is wrong changes nothing: 400 or 403."""
        path = "T_ROB1/M/"
        for client in self.masters():
            def write(symbol, value):
                end = "?action=set" if client.dialect == 1 else ""
                return client.post(data(client.dialect, quoted(path + symbol)) + end, {"value": value}).status

            for symbol, value, shown in (
                    ("number", "-1.5", "-1.5"), ("number", "1E10", "1E+10"), ("number", "5", "5"), ("word", '"a""b\\\\c"', '"a""b\\\\c"'),
                    ("word", '"' + "x" * 80 + '"', '"' + "x" * 80 + '"'), ("word", '"\u00e4"', '"\u00e4"'), ("word", '""', '""'),
                    ("flag", "false", "FALSE"), ("flag", "TRUE", "TRUE"), ("list{2}", "20", "20"),
                    ("list", "[1,2,3,4]", "[1,2,3,4]"), ("grid", "[[6,5,4],[3,2,1]]", "[[6,5,4],[3,2,1]]"),
                    ("grid{1}", "[1,2,3]", "[1,2,3]"), ("both", '[[2,"[,]"],[9E9,0,0]]', '[[2,"[,]"],[9E+09,0,0]]'),
                    ("both.first.a", "3", "3"), ("large", "1234567890123", "1234567890123"), ("many", "8", "8"),
                    ("code", "255", "255"), ("code", "0", "0"), ("codes", "[0,255]", "[0,255]")):
                with self.subTest(symbol=symbol, value=value):
                    self.assertEqual(write(symbol, value), 204)
                    self.assertEqual(self.value(quoted(path + symbol)), shown)
            before = self.values_of_all()
            for symbol, value in (
                    ("word", '"' + "x" * 81 + '"'), ("word", "text"), ("word", '"a'), ("word", "5"), ("number", '"5"'), ("number", "TRUE"),
                    ("number", ""), ("number", "1E39"), ("number", "5 6"), ("number", "nan"), ("flag", "1"), ("flag", "maybe"),
                    ("list", "[1,2,3,4,5]"), ("list", "[1,2,3]"), ("list", "5"), ("list{5}", "1"), ("grid", "[[1,2,3],[4,5]]"),
                    ("both", "[1,2]"), ("both.first", '[1,"x",2]'), ("limit", "4"), ("main", "1"), ("signal", "1"),
                    ("code", "256"), ("code", "-1"), ("code", "1.5"), ("codes", "[1,256]"), ("codes{2}", "300")):
                with self.subTest(symbol=symbol, value=value):
                    self.assertIn(write(symbol, value), (400, 403))
                    self.assertEqual(self.values_of_all(), before)
            self.assertEqual(client.post(data(client.dialect, path + "number") + ("?action=set" if client.dialect == 1 else ""), {}).status, 400)

    def test_values_that_are_not_escaped(self):
        """A7 and librws send RAPID values as they are: the plus sign of 9E+09 arrives as a blank. Strings keep theirs."""
        for client in self.masters():
            path = data(client.dialect, "T_ROB1/M/target") + ("?action=set" if client.dialect == 1 else "")
            value = "[[600,0,500],[1,0,0,0],[0,0,0,0],[9E+09,9E+09,9E+09,9E+09,9E+09,9E+09]]"
            headers = {"Content-Type": "application/x-www-form-urlencoded" + (";v=2.0" if client.dialect == 2 else "")}
            self.assertEqual(client.request("POST", path, body="value=" + value, headers=headers).status, 204)
            self.assertEqual(self.value("T_ROB1/M/target"), value)

    def test_system_data(self):
        """controller.md 6.3: user.sys holds reg1; clients read tool0 of BASE."""
        client = self.client(1)
        self.assertEqual(client.get(data(1, "T_ROB1/user/reg1")).values()["value"], "0")
        self.assertEqual(client.get(data(1, "T_ROB1/BASE/tool0")).values()["value"],
                         "[TRUE,[[0,0,0],[1,0,0,0]],[0.001,[0,0,0.001],[1,0,0,0],0,0,0]]")
        self.assertEqual(client.get(data(1, "T_ROB1/v100")).values()["value"], "[100,500,5000,1000]")

    def test_validate(self):
        """31: symbol/data?action=validate task value datatype | symbol/RAPID/T/data?action=validate value dattyp."""
        for client in self.both():
            for type_, value, good in (("num", "5", True), ("num", '"5"', False), ("string", '"a"', True), ("bool", "TRUE", True),
                                       ("robtarget", VALUES["T_ROB1/M/target"], True), ("robtarget", "[1,2]", False),
                                       ("num{2}", "[1,2]", True), ("num{2}", "[1,2,3]", False), ("outer", '[[1,"x"],[1,2,3]]', True)):
                if client.dialect == 1:
                    response = client.post("/rw/rapid/symbol/data?action=validate", {"task": "T_ROB1", "value": value, "datatype": type_})
                else:
                    response = client.post("/rw/rapid/symbol/RAPID/T_ROB1/data?action=validate", {"value": value, "dattyp": type_})
                self.assertEqual(response.status, 204 if good else 400, (type_, value))


class Properties(RapidCase):
    MODULE = MODULE

    def test_data(self):
        """29: classes, symtyp, local, rdonly, dim; 28: CONST in 2.0 rap-sympropconstant, typurl."""
        for symbol, class1, class2, wanted in (
                ("number", "pers", "pers", {"symtyp": "per", "dattyp": "num", "ndim": "0", "dim": "", "local": "false", "rdonly": "false"}),
                ("flag", "pers", "pers", {"symtyp": "per", "dattyp": "bool", "taskpers": "true"}),
                ("list", "var", "var", {"symtyp": "var", "dattyp": "num", "ndim": "1", "dim": "4", "local": "true"}),
                ("grid", "var", "var", {"ndim": "2", "dim": "2 3"}),
                ("limit", "const", "constant", {"symtyp": "con", "rdonly": "true", "typurl": "RAPID/num"}),
                ("both", "var", "var", {"dattyp": "outer", "typurl": "RAPID/T_ROB1/M/outer"}),
                ("target", "pers", "pers", {"typurl": "RAPID/robtarget"}),
                ("main", "proc", "proc", {"symtyp": "prc"}), ("twice", "func", "func", {"symtyp": "fun", "dattyp": "num"})):
            for dialect, name in ((1, class1), (2, class2)):
                with self.subTest(symbol=symbol, dialect=dialect):
                    entry = self.client(dialect).get(properties(dialect, f"T_ROB1/M/{symbol}")).entries()[0]
                    self.assertEqual(entry.type, f"rap-symprop{name}")
                    self.assertEqual(entry.values["symburl"], f"RAPID/T_ROB1/M/{symbol}")
                    self.assertEqual(entry.values["name"], symbol)
                    self.assertEqual({key: entry.values.get(key) for key in wanted}, wanted)
        self.in_all_forms(properties(1, "T_ROB1/M/both"), properties(2, "T_ROB1/M/both"))

    def test_new_dialect_has_them_as_resources(self):
        """26: 2.0 JSON: symbol properties lie in _embedded.resources, symbol data in state."""
        client = self.client(2)
        self.assertEqual(len(client.get(properties(2, "T_ROB1/M/number")).json()["_embedded"]["resources"]), 1)
        self.assertEqual(len(client.get(data(2, "T_ROB1/M/number")).json()["state"]), 1)

    def test_types(self):
        """28: typurl leads to rap-sympropatomic, rap-symproprecord, rap-sympropalias; components by search: rap-sympropreccomp-li."""
        client = self.client(2)
        for url, type_ in (("RAPID/num", "atomic"), ("RAPID/robtarget", "record"), ("RAPID/T_ROB1/M/outer", "record"),
                           ("RAPID/T_ROB1/M/count", "alias"), ("RAPID/bool", "atomic")):
            path = "/rw/rapid/symbol/" + urllib.parse.quote(url, safe="") + "/properties"
            self.assertEqual(client.get(path).entries()[0].type, f"rap-symprop{type_}", url)
        self.assertEqual(client.get(properties(2, "T_ROB1/M/count")).values()["typurl"], "RAPID/num")
        self.assertEqual(client.get(properties(2, "T_ROB1/M/outer")).values()["ncom"], "2")

        def components(form):
            found, path = [], "/rw/rapid/symbols/search"
            while path:
                response = client.post(path, form)
                self.assertEqual(response.status, 200)
                found += response.entries("rap-sympropreccomp-li")
                next_ = response.links().get("next")
                path = next_ and "/rw/rapid/" + next_.replace("&amp;", "&")
            return [(entry.title, entry.values["comnum"], entry.values["typurl"]) for entry in found]
        own = components({"view": "block", "blockurl": "RAPID/T_ROB1/M/outer", "symtyp": "rcp", "recursive": "FALSE"})
        self.assertEqual(own, [("RAPID/T_ROB1/M/outer/first", "1", "RAPID/T_ROB1/M/inner"), ("RAPID/T_ROB1/M/outer/place", "2", "RAPID/pos")])
        every = components({"view": "block", "blockurl": "RAPID", "symtyp": "rcp", "recursive": "TRUE", "skipshared": "FALSE"})
        self.assertIn(("RAPID/robtarget/trans", "1", "RAPID/pos"), every)
        self.assertIn(("RAPID/robtarget/extax", "4", "RAPID/extjoint"), every)


class Search(RapidCase):
    MODULE = MODULE
    FILES = {"N.modx": "MODULE N\n PERS num other := 1;\n LOCAL VAR num own := 2;\nENDMODULE\n"}

    def names(self, client, form):
        path = "/rw/rapid/symbols?action=search-symbols" if client.dialect == 1 else "/rw/rapid/symbols/search"
        response = client.post(path, form)
        self.assertEqual(response.status, 200, response)
        return [entry.values["name"] for entry in response.entries()]

    def test_block(self):
        """2.3: view, blockurl, symtyp, recursive, dattyp, regexp; 29: symtyp per var con fun prc."""
        for client in self.both():
            form = {"view": "block", "blockurl": "RAPID/T_ROB1", "recursive": "TRUE"}
            self.assertEqual(self.names(client, {**form, "symtyp": "per"}), ["number", "word", "flag", "large", "target", "other"])
            self.assertEqual(self.names(client, {**form, "symtyp": "per", "dattyp": "num"}), ["number", "other"])
            self.assertEqual(self.names(client, {**form, "symtyp": "per", "vartyp": "any"}), self.names(client, {**form, "symtyp": "per"}))
            self.assertEqual(self.names(client, {**form, "symtyp": "con"}), ["limit"])
            for regexp in ("^l.*", "l.*", "^l", "^l|l"):
                self.assertEqual(self.names(client, {**form, "symtyp": "any", "regexp": regexp}), ["limit", "large", "list"])
            self.assertEqual(self.names(client, {**form, "symtyp": "any", "regexp": "rge$"}), ["large"])
            self.assertEqual(self.names(client, {**form, "symtyp": "prc"}), ["main", "hidden"])
            self.assertEqual(self.names(client, {**form, "symtyp": "mod"}), ["M", "N"])
            self.assertEqual(self.names(client, [*form.items(), ("symtyp", "fun"), ("symtyp", "con")]), ["limit", "twice"])
            self.assertEqual(self.names(client, {**form, "blockurl": "RAPID/T_ROB1/M/hidden", "symtyp": "any"}), ["value", "other"])
            self.assertEqual(self.names(client, {**form, "blockurl": "RAPID", "symtyp": "tsk"}), ["T_ROB1"])
            self.assertEqual(self.names(client, {**form, "symtyp": "per", "typurl": "RAPID/robtarget"}), ["target"])

    def test_scope_and_shared(self):
        """2.3: view=scope sees what the block sees; skipshared leaves out what all tasks share."""
        client = self.client(2)
        form = {"view": "scope", "blockurl": "RAPID/T_ROB1/N", "symtyp": "var", "skipshared": "TRUE"}
        self.assertEqual(sorted(self.names(client, form)), ["both", "code", "codes", "grid", "many", "own", "signal"])
        self.assertIn("reg1", self.names(client, {**form, "skipshared": "FALSE"}))

    def test_pages(self):
        """2.3: paged by next; 2.2: -1073445883 bad page number."""
        client = self.client(2)
        form = {"view": "block", "blockurl": "RAPID", "symtyp": "con", "recursive": "TRUE"}
        first = client.post("/rw/rapid/symbols/search", form)
        self.assertLessEqual(len(first.entries()), 200)
        seen, path = [], "/rw/rapid/symbols/search?limit=100"
        while path:
            response = client.post(path, form)
            seen += [entry.title for entry in response.entries()]
            next_ = response.links().get("next")
            path = next_ and "/rw/rapid/" + next_.replace("&amp;", "&")
        self.assertGreater(len(seen), 300)
        self.assertEqual(len(seen), len(set(seen)))
        response = client.post("/rw/rapid/symbols/search?start=x", form)
        self.assertEqual((response.status, response.code()), (400, -1073445883))

    def test_wrong_questions(self):
        for client in self.both():
            path = "/rw/rapid/symbols?action=search-symbols" if client.dialect == 1 else "/rw/rapid/symbols/search"
            good = {"view": "block", "blockurl": "RAPID/T_ROB1", "symtyp": "any"}
            for name, value in (("view", "all"), ("blockurl", "RAPID/NONE"), ("symtyp", "xyz"), ("recursive", "maybe"),
                                ("regexp", "*"), ("regexp", "a" * 81), ("stack", "-1")):
                self.assertIn(client.post(path, {**good, name: value}).status, (400, 404), (name, value))


class Events(RapidCase):
    MODULE = MODULE

    def resource(self, client, symbol):
        return data(client.dialect, symbol) + ";value"

    def test_every_change_of_a_persistent(self):
        """42: priority 2: every change (also many in one cycle); 41: initial values; 2.4: rap-value-ev or rap-data."""
        for client in self.both():
            writer = self.client(1)
            writer.post(data(1, "T_ROB1/M/number") + "?action=set", {"value": "0"})
            response = client.subscribe((self.resource(client, "T_ROB1/M/number"), 2))
            self.assertEqual(response.status, 201, response)
            first = response.entries()[0]
            self.assertIn(first.type, ("rap-value-ev", "rap-data"))
            self.assertEqual(first.values["value"], "0")
            socket = self.socket(client, response)
            self.assertEqual(writer.post("/rw/rapid/execution?action=resetpp").status, 204)
            self.assertEqual(self.start(writer, cycle="once").status, 204)
            self.assertEqual([socket.event().values["value"] for _ in range(30)], [str(i) for i in range(1, 31)])
            self.wait_stopped(writer)
            writer.post(data(1, "T_ROB1/M/number") + "?action=set", {"value": "99"})
            event = socket.event()
            self.assertEqual((event.type, event.values["value"]), (first.type, "99"))

    def test_a_watch_survives_another_program(self):
        """Decision 97: another text of a compiled module makes another controller; the sessions and their subscriptions stay."""
        client, writer = self.client(1), self.client(1)
        socket = self.socket(client, client.subscribe((self.resource(client, "T_ROB1/M/word"), 2)))
        form = {"task": "T_ROB1", "text": MODULE + "\n"}
        self.assertEqual(writer.post("/rw/rapid/modules/M?task=T_ROB1&action=set-module-text", form).status, 204)
        self.assertEqual(writer.post(data(1, "T_ROB1/M/word") + "?action=set", {"value": '"new"'}).status, 204)
        self.assertEqual(socket.event().values["value"], '"new"')

    def test_what_cannot_be_subscribed(self):
        """43: 400 or 404; 2.4: persistents only."""
        for client in self.both():
            for symbol in ("T_ROB1/M/none", "T_ROB1/M/list", "T_ROB1/M/limit", "T_ROB1/M/main"):
                self.assertIn(client.subscribe(self.resource(client, symbol)).status, (400, 404), symbol)


if __name__ == "__main__":
    main()
