"""Files and folders of the volumes (contract 4, 18, 24, 26, 31; issue 20 section 6: no path leaves a volume)."""

import os
import signal

from serve_testing import RAPIDC, Serve, ServeCase, main  # noqa: F401


class Files(ServeCase):
    def root(self, client):
        return "/fileservice/$HOME" if client.dialect == 1 else "/fileservice/HOME"

    def names(self, response):
        return {(entry.type, entry.title) for entry in response.entries()}

    def act(self, client, path, action, fields):
        if client.dialect == 1:
            return client.post(path, {"fs-action": action, **fields})
        return client.post(f"{path}/{action}", fields)

    def test_volumes(self):
        """Issue 20 section 6: $HOME, $BACKUP, $TEMP, $RAMDISK, $SYSTEM; line 22: fs-device | fs-dir."""
        for client in self.both():
            found = {entry.title.lstrip("$") for entry in client.get("/fileservice").entries()}
            self.assertLessEqual({"HOME", "BACKUP", "TEMP", "RAMDISK", "DATA", "SYSTEM"}, found)
            for path in ("$HOME", "HOME", "$home", "home", "%24HOME"):
                self.assertEqual(client.get("/fileservice/" + path).status, 200, path)
            self.assertEqual(client.get("/fileservice/NOTHING").status, 404)

    def test_a_file_comes_back(self):
        """Raw bytes whatever they are; line 4: in HOME of the host."""
        data = bytes(range(256)) * 300
        for client in self.both():
            path = self.root(client) + f"/data{client.dialect}.bin"
            self.assertEqual(client.put(path, data, headers={"Content-Type": "application/octet-stream"}).status, 201)
            self.assertEqual(client.put(path, data, headers={"Content-Type": "application/octet-stream"}).status, 200)
            response = client.get(path, headers={"Accept": "text/html"})
            self.assertEqual((response.status, response.body), (200, data))
            with open(os.path.join(self.home, f"data{client.dialect}.bin"), "rb") as file:
                self.assertEqual(file.read(), data)
            self.assertEqual(client.delete(path).status, 204)
            self.assertEqual(client.get(path).status, 404)
            self.assertEqual(client.get(path).code(), -1073438713)

    def test_form_type_is_a_file_too(self):
        """Facts 8: the PUT of a module has the content type of forms."""
        client = self.client(1)
        text = "MODULE m\nENDMODULE\n"
        kind = {"Content-Type": "application/x-www-form-urlencoded"}
        self.assertEqual(client.put("/fileservice/$HOME/m.mod", text, headers=kind).status, 201)
        self.assertEqual(client.get("/fileservice/$HOME/m.mod").body.decode(), text)
        client.delete("/fileservice/$HOME/m.mod")

    def test_folders(self):
        """Line 31: create, copy, rename with fs-newname (a bare name); DELETE of a folder is recursive."""
        for client in self.both():
            home = self.root(client)
            top = f"{home}/part{client.dialect}"
            self.assertEqual(self.act(client, home, "create", {"fs-newname": f"part{client.dialect}"}).status, 201)
            self.assertEqual(self.act(client, home, "create", {"fs-newname": f"part{client.dialect}"}).status, 409)
            self.assertEqual(self.act(client, top, "create", {"fs-newname": "inner"}).status, 201)
            client.put(top + "/inner/a.txt", "one", headers={"Content-Type": "text/plain;v=2.0"})
            self.assertEqual(self.act(client, top + "/inner/a.txt", "copy", {"fs-newname": "b.txt"}).status, 204)
            self.assertEqual(self.act(client, top + "/inner/a.txt", "copy", {"fs-newname": "b.txt"}).status, 409)
            elsewhere = f"/fileservice/$TEMP/copy{client.dialect}.txt"  # decision 129: an address instead of a bare name
            self.assertEqual(self.act(client, top + "/inner/a.txt", "copy", {"fs-newname": elsewhere}).status, 204)
            self.assertEqual(client.get(elsewhere).body, client.get(top + "/inner/a.txt").body)
            self.assertEqual(self.act(client, top + "/inner/a.txt", "copy", {"fs-newname": elsewhere}).status, 409)
            self.assertEqual(self.act(client, top + "/inner", "copy", {"fs-newname": elsewhere + "2"}).status, 403)
            for wrong in ("/fileservice/$TEMP/../x", "/fileservice/$NONE/x", "/fileservice/"):
                self.assertEqual(self.act(client, top + "/inner/a.txt", "copy", {"fs-newname": wrong}).status // 100, 4)
            self.assertEqual(self.act(client, top + "/inner/b.txt", "rename", {"fs-newname": "c d&e.txt"}).status, 204)
            listed = client.get(top + "/inner")
            self.assertEqual(self.names(listed), {("fs-file", "a.txt"), ("fs-file", "c d&e.txt")})
            values = listed.entries("fs-file")[0].values
            self.assertEqual((values["fs-size"], values["fs-readonly"]), ("3", "false"))
            self.assertRegex(values["fs-mdate"], r"^\d{4}-\d\d-\d\d T \d\d:\d\d:\d\d$")
            self.assertEqual(client.get(top + "/inner/c%20d%26e.txt").body, b"one")
            self.assertEqual(self.act(client, top, "copy", {"fs-newname": f"again{client.dialect}"}).status, 204)
            self.assertEqual(client.get(f"{home}/again{client.dialect}/inner/a.txt").body, b"one")
            for folder in (top, f"{home}/again{client.dialect}"):
                self.assertEqual(client.delete(folder).status, 204)
                self.assertEqual(client.get(folder).status, 404)

    def test_names_that_are_not_utf8(self):
        """Lines 16, 20: answers are UTF-8 always, and 4xx says what is wrong. A new name is UTF-8; a file of an old backup with another
        name can be read, replaced and removed, and its folder can be listed."""
        old = os.path.join(self.home.encode(), b"caf\xe9.mod")
        for client in self.both():
            home = self.root(client)
            with open(old, "wb") as file:
                file.write(b"old")
            for name in ("new%FF.txt", "a%C3%28.txt", "%ED%A0%80.txt"):
                response = client.put(f"{home}/{name}", "one", headers={"Content-Type": "text/plain;v=2.0"})
                self.assertEqual((response.status, "UTF-8" in response.body.decode()), (400, True))
                self.assertEqual(client.get(f"{home}/{name}").status, 404)
            self.assertEqual(self.act(client, home, "create", {"fs-newname": b"f\xff"}).status, 400)
            self.assertEqual(self.act(client, f"{home}/caf%E9.mod", "copy", {"fs-newname": b"f\xff"}).status, 400)
            self.assertEqual(self.act(client, f"{home}/caf%E9.mod", "rename", {"fs-newname": b"f\xff"}).status, 400)
            backup = "/ctrl/backup?action=backup" if client.dialect == 1 else "/ctrl/backup/create"
            self.assertEqual(client.post(backup, {"backup": b"/fileservice/$BACKUP/f\xff"}).status, 400)
            self.assertIn(("fs-file", "caf?.mod"), self.names(client.get(home)))
            self.assertEqual(client.get(f"{home}/caf%E9.mod").body, b"old")
            self.assertEqual(client.put(f"{home}/caf%E9.mod", "two", headers={"Content-Type": "text/plain;v=2.0"}).status, 200)
            self.assertEqual(client.delete(f"{home}/caf%E9.mod").status // 100, 2)
            self.assertFalse(os.path.exists(old))

    def test_paging(self):
        """Line 24: at most 100 files on a page."""
        client = self.client(2)
        folder = os.path.join(self.home, "many")
        os.mkdir(folder)
        for number in range(130):
            open(os.path.join(folder, f"f{number:03}.txt"), "w").close()
        titles, path = [], "/fileservice/HOME/many"
        while path:
            response = client.get(path)
            titles += [entry.title for entry in response.entries("fs-file")]
            self.assertLessEqual(len(response.entries()), 100)
            path = response.following()
        self.assertEqual(titles, [f"f{number:03}.txt" for number in range(130)])
        # The App SDK asks for /fileservice/FOLDER/ followed by the address of the next page.
        response = client.get("/fileservice/HOME/many")
        self.assertTrue(response.base().endswith("/fileservice/HOME/many/"))
        self.assertEqual(response.entries("fs-file")[0].links["self"], "f000.txt")
        rest = client.get("/fileservice/HOME/many/" + response.links()["next"].replace("&amp;", "&"))
        self.assertEqual([entry.title for entry in rest.entries("fs-file")], titles[100:])
        client.delete("/fileservice/HOME/many")

    def test_nothing_leaves_a_volume(self):
        """Issue 20 section 6: symbolic links, `..`, encodings, NUL."""
        secret = os.path.join(self.folder, "secret.txt")
        with open(secret, "w") as file:
            file.write("secret")
        os.symlink(secret, os.path.join(self.home, "link.txt"))
        os.symlink(self.folder, os.path.join(self.home, "outside"))
        self.addCleanup(os.remove, os.path.join(self.home, "link.txt"))
        self.addCleanup(os.remove, os.path.join(self.home, "outside"))
        plain = {"Content-Type": "text/plain;v=2.0"}
        for client in self.both():
            home = self.root(client)
            for path in ("/../secret.txt", "/%2e%2e/secret.txt", "/..%2fsecret.txt", "/a/../../secret.txt", "/link.txt",
                         "/outside/secret.txt", "/..%5csecret.txt", "/%2e%2e%2fsecret.txt", "/a%00/../../secret.txt",
                         "/..;/secret.txt", "//../secret.txt", "/.%2e/secret.txt"):
                requests = [client.get(home + path), client.put(home + path, "x", headers=plain)]
                if path != "/link.txt":  # DELETE takes away the link itself
                    requests.append(client.delete(home + path))
                for response in requests:
                    self.assertEqual(response.status // 100, 4, (path, response))
                    self.assertNotIn(b"secret\n", response.body)
            for name in ("../x", "..", ".", "a/b", "", "a\\b", "x\0y", "/etc/x"):
                self.assertEqual(self.act(client, home, "create", {"fs-newname": name}).status // 100, 4, repr(name))
            listed = {entry.title for entry in client.get(home).entries()}
            self.assertNotIn("link.txt", listed)
            self.assertNotIn("outside", listed)
            with open(secret) as file:
                self.assertEqual(file.read(), "secret")

    def test_volumes_stay(self):
        for client in self.both():
            self.assertEqual(client.delete(self.root(client)).status, 403)
            self.assertEqual(self.act(client, self.root(client), "rename", {"fs-newname": "x"}).status, 403)

    def test_special_files(self):
        """A FIFO is neither listed nor read: nothing waits for its other end."""
        os.mkfifo(os.path.join(self.home, "pipe"))
        self.addCleanup(os.remove, os.path.join(self.home, "pipe"))
        client = self.client(2)
        self.assertEqual(client.get("/fileservice/HOME/pipe").status // 100, 4)
        self.assertNotIn("pipe", {entry.title for entry in client.get("/fileservice/HOME").entries()})

    def test_errors(self):
        for client in self.both():
            home = self.root(client)
            self.assertEqual(client.put(home + "/no/such/file.txt", "x", headers={"Content-Type": "text/plain;v=2.0"}).status, 404)
            self.assertEqual(client.delete(home + "/nothing").status, 404)
            self.assertEqual(self.act(client, home + "/nothing", "copy", {"fs-newname": "x"}).status, 404)

    def test_cut_upload_leaves_nothing(self):
        """Line 4: a cut upload leaves nothing, and the file stays as it was."""
        client = self.client(1)
        client.put("/fileservice/$HOME/kept.txt", "whole", headers={"Content-Type": "text/plain"})
        cookie = "; ".join(f"{name}={value}" for name, value in client.cookies.items())
        raw = self.server.raw()
        raw.send(f"PUT /fileservice/$HOME/kept.txt HTTP/1.1\r\nHost: 127.0.0.1\r\nCookie: {cookie}\r\nContent-Length: 1000\r\n\r\nhalf")
        raw.close()
        self.assertEqual(client.get("/fileservice/$HOME/kept.txt").body, b"whole")
        self.assertEqual([name for name in os.listdir(self.home) if "rapidc" in name], [])
        client.delete("/fileservice/$HOME/kept.txt")

    def test_ramdisk_path(self):
        """Line 27: `_embedded._state[0]._value` is a path that works after /fileservice/."""
        client = self.client(1, form="json")
        for name in ("$RAMDISK", "$HOME", "$TEMP"):
            value = client.get("/ctrl/" + name).json()["_embedded"]["_state"][0]["_value"]
            path = f"/fileservice/{value}/t.txt"
            self.assertEqual(client.put(path, "x", headers={"Content-Type": "text/plain"}).status, 201)
            self.assertEqual(client.get(path).body, b"x")
            client.delete(path)
        self.assertEqual(client.get("/ctrl/$NOTHING").status, 404)


class Killed(ServeCase):
    def test_uploaded_files_are_whole_after_kill(self):
        """Line 4: after kill -9 files uploaded before are whole."""
        other = os.path.join(self.folder, "other")
        os.mkdir(other)
        server = Serve(os.path.join(self.folder, "inputs"), options=(f"--home={other}",))
        client = server.client(2)
        data = os.urandom(1_000_000)
        for number in range(3):
            kind = {"Content-Type": "application/octet-stream"}
            self.assertEqual(client.put(f"/fileservice/HOME/f{number}", data, headers=kind).status, 201)
        client.disconnect()
        server.stop(signal.SIGKILL)
        server.errors.close()
        self.assertEqual(sorted(os.listdir(other)), ["f0", "f1", "f2"])
        for number in range(3):
            with open(os.path.join(other, f"f{number}"), "rb") as file:
                self.assertEqual(file.read(), data)

    def test_rests_of_a_killed_process_go(self):
        """Line 4: what a killed process had not completed is not a file of the volume: the next one removes it."""
        other = os.path.join(self.folder, "rests")
        rests = ["sub/.upload.rapidc-1-000018.tmp", ".M.mod.rapidc-1-IboSFx.tmp", ".backup1.rapidc-1-x0NXos/HOME/f"]
        kept = ["sub/.profile", "M.mod"]
        for name in rests + kept:
            path = os.path.join(other, name)
            os.makedirs(os.path.dirname(path), exist_ok=True)
            with open(path, "wb") as file:
                file.write(b"x")
        server = Serve(os.path.join(self.folder, "inputs"), options=(f"--home={other}",))
        self.assertEqual(server.stop(), 143)
        server.errors.close()
        found = [os.path.relpath(os.path.join(folder, name), other) for folder, _, names in os.walk(other) for name in names]
        self.assertEqual(sorted(found), sorted(kept))
        self.assertEqual(sorted(os.listdir(other)), ["M.mod", "sub"])


if __name__ == "__main__":
    main()
