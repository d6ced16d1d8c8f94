"""/users and /uas (contract 8, 22; controller.md 2.3, 8)."""

from rapid_testing import RapidCase
from serve_testing import main


class Users(RapidCase):
    def test_registration(self):
        """controller.md 8: POST /users must answer 200 or 201. Published clients of RWS 1.0 (C#, Go, Python) take 201 alone, and 200
        of ?action=set-locale."""
        form = {"username": "me", "application": "app", "location": "here", "ulocale": "local"}
        for client in self.both():
            self.assertIn(client.post("/users", form).status, (201,) if client.dialect == 1 else (200, 201))
            self.assertEqual(client.get("/users").status, 200)
        self.assertEqual(self.client(1).post("/users?action=set-locale", {"type": "local"}).status, 200)
        client = self.client(2)
        client.post("/users", form)
        found = client.get("/users/login-info").values("user-login-info")
        self.assertEqual([found[f"user-{name}"] for name in ("alias", "name", "locale", "application", "location")],
                         ["me", "Default User", "local", "app", "here"])
        self.assertEqual(client.post("/users", {"username": "x" * 81}).status, 400)
        self.assertIn(client.post("/users/register", form).status, (200, 201, 204))
        for locale in ("remote", "local"):  # 2.3: register local or remote user
            del form["ulocale"]
            self.assertIn(client.post(f"/users/register/{locale}", {**form, "local-key": "123456"}).status, (200, 201))
            form["ulocale"] = locale
            self.assertEqual(client.get("/users/login-info").values("user-login-info")["user-locale"], locale)

    def test_one_entry_for_each_session(self):
        """2.3: /users are those who are logged on; contract 12: a login makes a session, /logout ends it."""
        reader = self.client(1)

        def count():
            return len(reader.get("/users").entries("user-li"))
        before = count()
        others = self.both()
        for number, other in enumerate(others, 1):
            other.get("/rw/system")
            self.assertEqual(count(), before + number)
        for other in others:
            other.get("/logout")
        self.eventually(lambda: count() == before)

    def test_grants(self):
        """Contract 8: all grants, in both dialects; 22: user-grant | uas-grant, grant-info."""
        names = [entry.title for entry in self.client(1).get("/users/grants").entries("user-grant")]
        self.assertIn("UAS_FULL_ACCESS", names)
        client = self.client(2)
        self.assertEqual([entry.values["grantname"] for entry in client.get("/uas/user/grants").entries("uas-grant")], names)
        self.assertEqual([entry.values["grant-name"] for entry in client.get("/uas/grants").entries("grant-info")], names)
        self.assertEqual(client.get("/users/grant-exists?grant=UAS_BACKUP").values("user-grant-status")["status"], "true")
        self.assertEqual(client.get("/users/grant-exists?grant=NONE").status, 400)
        self.assertEqual(client.get("/uas/ldap/settings").status, 403)  # A10: listed, and refused without the option
        self.assertEqual(client.get("/uas/user/password-change-allow").values()["status"], "false")
        self.assertEqual(client.post("/uas/user/password", {"old-password": "robotics", "new-password": "x"}).status, 403)
        self.in_all_forms("/users/grants", "/uas/grants")

    def test_privilege(self):
        """Contract 22: /users/rmmp: privilege; /users/rmmp/poll: status."""
        for client in self.both():
            self.assertEqual(client.get("/users/rmmp").values()["privilege"], "none")
            response = client.post("/users/rmmp", {"privilege": "modify"})
            self.assertIn(response.status, (200, 202, 204))
            if response.status != 204:  # 2.5, A5: its client reads the type before the body, which may be empty
                self.assertRegex(response.header("Content-Type"), "^application/")
            self.assertEqual(client.get("/users/rmmp").values()["privilege"], "modify")
            self.assertEqual(client.get("/users/rmmp/poll").values()["status"], "GRANTED")
            self.assertEqual(client.act("/users/rmmp", "cancel").status, 204)
            self.assertEqual(client.get("/users/rmmp").values()["privilege"], "none")
            self.assertNotEqual(client.get("/users/rmmp/poll").values()["status"], "GRANTED")

    def test_privilege_that_is_granted(self):
        """RWS 1.0 documentation, Grant or deny RMMP: POST /users/rmmp?action=set with uid and privilege modify, exec or deny."""
        client, grant = self.client(1), "/users/rmmp?action=set"
        client.post("/users/rmmp", {"privilege": "modify"})
        form = {"uid": client.get("/users/rmmp").values()["userid"]}
        for level, status in (("modify", "GRANTED"), ("deny", "NO SUCH REQUEST"), ("exec", "GRANTED")):
            self.assertEqual(client.post(grant, {**form, "privilege": level}).status, 204)
            self.assertEqual(client.get("/users/rmmp/poll").values()["status"], status)
        for wrong in ({"uid": "0", "privilege": "modify"}, {"uid": "x", "privilege": "modify"}, {**form, "privilege": "all"}, {}):
            self.assertEqual(client.post(grant, wrong).status, 400)
        client.act("/users/rmmp", "cancel")


if __name__ == "__main__":
    main()
