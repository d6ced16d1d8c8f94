"""System parameters (contract 22, 26, 31, 38; facts 6.1, 6.2)."""

import math

from serve_testing import ServeCase, main

EIO = """EIO:CFG_1.0:7:0::
#
EIO_SIGNAL:

      -Name "doLamp" -SignalType "DO" -Label "Lampe f\u00fcr Z\u00e4hler" -DeviceMap "0"

      -Name "aoValue" -SignalType "AO" -MaxLog 10 -MinLog -1
#
EIO_CROSS:

      -Name "one" -Res "doLamp" -Act1 "diDoor" -Act1_invert

#
EIO_SIGNAL:

      -Name "diDoor" -SignalType "DI"
"""
PROC = """PROC:CFG_1.0:7:0::
#
ODD_TYPE:

      -name "first" -list 30,82 -negative -1 -empty  -on
"""
TYPES = {"moc": {"MECHANICAL_UNIT": "ROB_1", "ROBOT": "ROB_1", "JOINT": "rob1_1", "ARM": "rob1_1", "TRANSMISSION": "rob1_1"},
         "sys": {"MECHANICAL_UNIT_GROUP": "rob1"}}


class Cfg(ServeCase):
    FILES = {"EIO.cfg": EIO, "PROC.cfg": PROC}

    def attributes(self, entry):
        kinds = {nested.type for nested in entry.nested}
        self.assertTrue(kinds <= {"cfg-ia-t-li"} or kinds <= {"cfg-ia-t"}, kinds)
        return {nested.title: nested.values["value"] for nested in entry.nested}

    def instance(self, client, domain, type_, name):
        response = client.get(f"/rw/cfg/{domain}/{type_}/instances/{name}")
        self.assertEqual(response.status, 200, response)
        return self.attributes(response.entries("cfg-dt-instance")[0])

    def editor(self, dialect):
        client = self.client(dialect)
        if dialect == 2:
            self.assertEqual(client.post("/rw/mastership/edit/request").status, 204)
        return client

    def write(self, client, path, values):
        if client.dialect == 1:
            return client.post(path + "?action=set", values)
        return client.post(path, {name: f"[{value},1]" for name, value in values.items()})

    def test_validating_instances(self):
        """A10: POST validate-instances of RWS 2.0; 204 when all of them are there, 404 for others, 400 when the count is wrong."""
        client, path = self.client(2), "/rw/cfg/validate-instances"
        names = [entry.values["instanceid"] for entry in client.get("/rw/cfg/eio/EIO_SIGNAL/instances").entries()][:2]

        def validate(instances, count=None, type_="EIO_SIGNAL"):
            fields = [("operation", "0"), ("cfgdomain", "EIO"), ("cfgtype", type_), ("instancescount", count or len(instances))]
            return client.post(path, fields + [("instances", name) for name in instances]).status

        self.assertEqual(validate(names), 204)
        self.assertEqual(validate(names + ["none"]), 404)
        self.assertEqual(validate(names, type_="NO_TYPE"), 404)
        self.assertEqual((validate(names, count=9), validate([])), (400, 400))

    def test_domains_and_types(self):
        """Line 22: /rw/cfg cfg-domain-li, /rw/cfg/D cfg-dt-li."""
        for client in self.both():
            domains = {entry.title.upper() for entry in client.get("/rw/cfg").entries("cfg-domain-li")}
            self.assertEqual(domains, {"EIO", "SYS", "MOC", "PROC", "SIO", "MMC"})
            types = {entry.title for entry in client.get("/rw/cfg/eio").entries("cfg-dt-li")}
            self.assertLessEqual({"EIO_SIGNAL", "EIO_CROSS"}, types)
            self.assertIn("ODD_TYPE", {entry.title for entry in client.get("/rw/cfg/PROC").entries("cfg-dt-li")})
            self.assertEqual(client.get("/rw/cfg/none").status, 404)
            self.assertEqual(client.get("/rw/cfg/eio/NONE/instances").status, 404)
            self.assertEqual(client.get("/rw/cfg/eio/EIO_SIGNAL/instances/none").status, 404)

    def test_instances(self):
        """Facts 2.2: li cfg-dt-instance-li with cfg-ia-t-li | cfg-ia-t; the values as they are written."""
        for client in self.both():
            entries = client.get("/rw/cfg/EIO/eio_signal/instances").entries("cfg-dt-instance-li")
            self.assertLessEqual({"doLamp", "aoValue", "diDoor"}, {entry.title for entry in entries})
            lamp = self.attributes(next(entry for entry in entries if entry.title == "doLamp"))
            self.assertEqual((lamp["Label"], lamp["SignalType"], lamp["Access"]), ("Lampe f\u00fcr Z\u00e4hler", "DO", "Default"))
            self.assertEqual(self.instance(client, "eio", "EIO_SIGNAL", "aoValue")["MinLog"], "-1")
            cross = self.instance(client, "eio", "EIO_CROSS", "one")
            self.assertEqual((cross["Act1_invert"], cross["Act2_invert"]), ("true", "false"))
            odd = self.instance(client, "proc", "ODD_TYPE", "first")
            self.assertEqual((odd["list"], odd["negative"], odd["on"]), ("30,82", "-1", "true"))

    def test_places_of_rws_2(self):
        """Line 26: lists in resources; one instance in state with _type, instanceid and a list attrib of _title, value."""
        client = self.client(2)
        for path in ("/rw/cfg", "/rw/cfg/eio", "/rw/cfg/eio/EIO_SIGNAL/instances"):
            self.assertTrue(client.get(path).json()["_embedded"]["resources"], path)
        state = client.get("/rw/cfg/eio/EIO_SIGNAL/instances/doLamp").json()["state"][0]
        self.assertEqual((state["_type"], state["instanceid"]), ("cfg-dt-instance", "doLamp"))
        self.assertIn({"_title": "SignalType", "value": "DO"},
                      [{"_title": each["_title"], "value": each["value"]} for each in state["attrib"]])

    def test_implied_by_the_robot(self):
        """Facts 6.2: moc/joint, transmission, mechanical_unit ... come from the robot model; all attributes are given."""
        wanted = {"MECHANICAL_UNIT": ["use_robot"] + [f"use_single_{i}" for i in range(6)],
                  "ROBOT": ["use_robot_type", "base_frame_coordinated"] + [f"use_joint_{i}" for i in range(6)]
                  + [f"base_frame_pos_{c}" for c in "xyz"] + [f"base_frame_orient_u{i}" for i in range(4)],
                  "JOINT": ["logical_axis", "kinematic_axis_number", "use_arm", "use_transmission"],
                  "ARM": ["lower_joint_bound", "upper_joint_bound"], "TRANSMISSION": ["rotating_move"],
                  "MECHANICAL_UNIT_GROUP": ["Robot"] + [f"MechanicalUnit_{i}" for i in range(1, 7)]}
        for client in self.both():
            for domain, types in TYPES.items():
                for type_, first in types.items():
                    entries = client.get(f"/rw/cfg/{domain}/{type_}/instances").entries()
                    self.assertEqual(entries[0].title, first, type_)
                    self.assertLessEqual(set(wanted[type_]), set(self.attributes(entries[0])), type_)
            joints = client.get("/rw/cfg/MOC/JOINT/instances").entries()
            self.assertEqual(len(joints), 6)
            for number, joint in enumerate(joints, 1):
                self.assertEqual(self.attributes(joint)["logical_axis"], str(number))
            self.assertEqual(self.attributes(client.get("/rw/cfg/MOC/TRANSMISSION/instances").entries()[0])["rotating_move"], "true")
            arm = self.attributes(client.get("/rw/cfg/moc/arm/instances").entries()[0])
            self.assertAlmostEqual(float(arm["upper_joint_bound"]), math.radians(165), 4)  # IRB 120, axis 1

    def test_set_and_read(self):
        """Line 31: ?action=set | POST instance with [value,1]; facts 6.1: kinds of values."""
        for dialect in (1, 2):
            client = self.editor(dialect)
            path = "/rw/cfg/eio/EIO_SIGNAL/instances/aoValue"
            for values in ({"Label": "with, comma"}, {"MaxLog": "12.5"}, {"Label": "50"}, {"Invert": "true"}, {"Invert": "false"},
                           {"Label": "-x y"}, {"Label": ""}, {"Label": "a\\b#c"}, {"Category": "\u00e9t\u00e9"}):
                self.assertEqual(self.write(client, path, values).status, 204, values)
                shown = self.instance(client, "eio", "EIO_SIGNAL", "aoValue")
                for name, value in values.items():
                    self.assertEqual(shown[name], value)
            client.close()

    def test_refused_values(self):
        for dialect in (1, 2):
            client = self.editor(dialect)
            path = "/rw/cfg/eio/EIO_SIGNAL/instances/aoValue"
            for values in ({"MaxLog": "high"}, {"SignalType": "XX"}, {"NoSuch": "1"}, {"Label": 'with "quotes"'}, {"Label": "two\nlines"},
                           {"Invert": "perhaps"}, {"MinLog": "100", "MaxLog": "1"}):
                before = self.instance(client, "eio", "EIO_SIGNAL", "aoValue")
                self.assertEqual(self.write(client, path, values).status, 400, values)
                self.assertEqual(self.instance(client, "eio", "EIO_SIGNAL", "aoValue"), before)
            self.assertEqual(self.write(client, "/rw/cfg/eio/EIO_SIGNAL/instances/none", {"Label": "x"}).status, 404)
            client.close()

    def test_create_and_remove(self):
        """Line 31: create-default form name; DELETE of an instance."""
        for dialect in (1, 2):
            client = self.editor(dialect)
            base, name = "/rw/cfg/eio/EIO_SIGNAL/instances", f"doMade{dialect}"
            self.assertEqual(client.act(base, "create-default", {"name": name}).status, 201)
            self.assertEqual(client.act(base, "create-default", {"name": name}).status, 400)
            self.assertEqual(self.instance(client, "eio", "EIO_SIGNAL", name)["Name"], name)
            self.assertEqual(client.delete(f"{base}/{name}").status, 204)
            self.assertEqual(client.get(f"{base}/{name}").status, 404)
            self.assertEqual(client.delete(f"{base}/{name}").status, 404)
            self.assertEqual(client.act(base, "create-default", {"name": ""}).status, 400)
            self.assertEqual(client.delete("/rw/cfg/moc/JOINT/instances/rob1_1").status, 403)
            client.close()

    def test_mastership(self):
        """Line 38: 2.0 needs edit for cfg, else 403, -1073445859; line 37: held by another session -1073445862."""
        client, other = self.client(2), self.client(1)
        path = "/rw/cfg/eio/EIO_SIGNAL/instances/doLamp"
        response = self.write(client, path, {"Label": "x"})
        self.assertEqual((response.status, response.code()), (403, -1073445859))
        client.post("/rw/mastership/edit/request")
        response = self.write(other, path, {"Label": "x"})
        self.assertEqual((response.status, response.code()), (403, -1073445862))
        client.post("/rw/mastership/edit/release")

    def test_files(self):
        """Facts 2.3: load, validate, save; 6.1: what is saved reads back as the same."""
        for dialect in (1, 2):
            client = self.editor(dialect)
            home = "/fileservice/$HOME" if dialect == 1 else "/fileservice/HOME"
            saved = client.act("/rw/cfg/eio", "saveas", {"filepath": "/fileservice/$HOME/eio.cfg"})
            self.assertEqual(saved.status, 204)
            text = client.get(home + "/eio.cfg").body.decode("latin-1")
            self.assertTrue(text.startswith("EIO:CFG_1.0:"))
            self.assertIn('-Name "diDoor" -SignalType "DI"', text)
            self.assertIn("-Act1_invert ", text)
            before = client.get("/rw/cfg/eio/EIO_SIGNAL/instances").entries()
            load = {"filepath": "HOME:/eio.cfg", "action-type": "replace"}
            self.assertEqual(client.act("/rw/cfg", "validate", load).status, 204)
            loaded = client.act("/rw/cfg", "load", load)
            self.assertIn(loaded.status, (202, 204))
            self.assertIn("/progress/", loaded.header("location"))
            self.assertEqual(client.get("/rw/cfg/eio/EIO_SIGNAL/instances").entries(), before)
            self.assertEqual(client.act("/rw/cfg", "load", {**load, "action-type": "add"}).status, 400)
            self.assertEqual(client.act("/rw/cfg", "load", {"filepath": "HOME:/none.cfg"}).status, 400)
            client.put(home + "/bad.cfg", "EIO:CFG_1.0:7:0::\n#\nEIO_SIGNAL:\n\n -Name \"x\" -SignalType \"ZZ\"\n",
                       headers={"Content-Type": "text/plain;v=2.0"})
            self.assertEqual(client.act("/rw/cfg", "load", {"filepath": "$HOME/bad.cfg"}).status, 400)
            self.assertEqual(client.act("/rw/cfg", "validate", {"filepath": "$HOME/bad.cfg"}).status, 400)
            client.put(home + "/new.cfg", f"EIO:CFG_1.0:7:0::\n#\nEIO_SIGNAL:\n\n -Name \"diLoaded{dialect}\" -SignalType \"DI\"\n",
                       headers={"Content-Type": "text/plain;v=2.0"})
            self.assertIn(client.act("/rw/cfg", "load", {"filepath": "$HOME/new.cfg", "action-type": "add"}).status, (202, 204))
            self.assertEqual(self.instance(client, "eio", "EIO_SIGNAL", f"diLoaded{dialect}")["SignalType"], "DI")
            client.close()

    def test_both_forms_are_the_same(self):
        """Line 21."""
        for dialect, forms in ((1, ("xhtml", "json")), (2, ("xhtml", "hal"))):
            first, second = (self.client(dialect, form=form) for form in forms)
            for path in ("/rw/cfg", "/rw/cfg/moc", "/rw/cfg/moc/ARM/instances", "/rw/cfg/eio/EIO_SIGNAL/instances/doLamp"):
                self.assertEqual(first.get(path).entries(), second.get(path).entries(), path)


if __name__ == "__main__":
    main()
