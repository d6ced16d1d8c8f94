"""HTTP itself: keep-alive, limits, request smuggling, origins, formats (contract 11, 15 to 21)."""

import os
import socket
import ssl
import time

from rws_client import FORM, HAL, XHTML2, read_xhtml, unchecked_context
from serve_testing import SLOW, Serve, ServeCase, main

PATH = "/rw/panel/opmode"
MOTORS = {1: "/rw/panel/ctrlstate?action=setctrlstate", 2: "/rw/panel/ctrl-state"}  # needs no mastership
NO_5XX = {501, 503, 505}


class Connections(ServeCase):
    def logged_on(self):
        """Headers of a session of RWS 1.0 for raw requests."""
        client = self.client()
        self.assertEqual(client.get(PATH).status, 200)
        return "Host: 127.0.0.1\r\nCookie: " + "; ".join(f"{k}={v}" for k, v in client.cookies.items()) + "\r\n"

    def ask(self, text, kind="http"):
        """Sends bytes; (the response or None, whether the connection ends)."""
        raw = self.server.raw(kind)
        try:
            raw.send(text)
            response = raw.read()
            return response, response is None or raw.has_ended(5 * SLOW)
        finally:
            raw.close()

    def test_keep_alive_and_pipelining(self):
        """Contract 11: responses come in order over one connection, each with its length."""
        headers = self.logged_on()
        raw = self.server.raw()
        paths = ["/rw/panel/opmode", "/rw/panel/ctrlstate", "/rw/panel/speedratio", "/rw/unknown"] * 5
        raw.send("".join(f"GET {path} HTTP/1.1\r\n{headers}\r\n" for path in paths))
        for path in paths:
            response = raw.read()
            self.assertIsNotNone(response.header("content-length"))
            name = path.rsplit("/", 1)[1]
            if name == "unknown":
                self.assertEqual(response.status, 404)
            else:
                self.assertIn(name, response.values())
        raw.close()

    def test_bytes_one_by_one(self):
        headers = self.logged_on()
        raw = self.server.raw()
        for byte in f"GET {PATH} HTTP/1.1\r\n{headers}\r\n".encode():
            raw.send(bytes([byte]))
        self.assertEqual(raw.read().status, 200)
        raw.close()

    def test_no_body_with_204(self):
        headers = self.logged_on()
        raw = self.server.raw()
        body = "speed-ratio=50"
        raw.send(f"POST /rw/panel/speedratio?action=setspeedratio HTTP/1.1\r\n{headers}Content-Type: {FORM}\r\n"
                 f"Content-Length: {len(body)}\r\n\r\n{body}GET {PATH} HTTP/1.1\r\n{headers}\r\n")
        first = raw.read()
        self.assertEqual(first.status, 204)
        self.assertEqual(first.header("content-length") or "0", "0")
        self.assertEqual(raw.read().status, 200)
        raw.close()

    def test_chunked_bodies(self):
        headers = self.logged_on()
        raw = self.server.raw()
        raw.send(f"POST /rw/panel/speedratio?action=setspeedratio HTTP/1.1\r\n{headers}Content-Type: {FORM}\r\n"
                 "Transfer-Encoding: chunked\r\n\r\n6;x=y\r\nspeed-\r\n8\r\nratio=60\r\n0\r\nTrailer: x\r\n\r\n"
                 f"GET /rw/panel/speedratio HTTP/1.1\r\n{headers}\r\n")
        self.assertEqual(raw.read().status, 204)
        self.assertEqual(raw.read().values()["speedratio"], "60")
        raw.close()

    def test_expect_continue(self):
        headers = self.logged_on()
        raw = self.server.raw()
        body = "speed-ratio=70"
        raw.send(f"POST /rw/panel/speedratio?action=setspeedratio HTTP/1.1\r\n{headers}Content-Type: {FORM}\r\n"
                 f"Expect: 100-continue\r\nContent-Length: {len(body)}\r\n\r\n")
        self.assertEqual(raw.read().status, 100)
        raw.send(body)
        self.assertEqual(raw.read().status, 204)
        raw.close()

    def test_too_large_headers(self):
        """Contract 15."""
        for name, text in {
            "one header": "GET / HTTP/1.1\r\nHost: a\r\nX: " + "x" * 70000 + "\r\n\r\n",
            "all together": "GET / HTTP/1.1\r\nHost: a\r\n" + "".join(f"X{i}: {'x' * 500}\r\n" for i in range(150)) + "\r\n",
            "too many": "GET / HTTP/1.1\r\nHost: a\r\n" + "".join(f"X{i}: 1\r\n" for i in range(1001)) + "\r\n",
            "target": "GET /" + "x" * 70000 + " HTTP/1.1\r\nHost: a\r\n\r\n",
            "no end": "GET / HTTP/1.1\r\nHost: a\r\nX: " + "x" * 100000,
        }.items():
            with self.subTest(name):
                response, ended = self.ask(text)
                self.assertTrue(ended)
                if response:
                    self.assertIn(response.status, (431, 414, 400))

    def test_header_in_many_pieces(self):
        """Contract 15: the limit holds for the sum."""
        raw = self.server.raw()
        try:
            raw.send("GET / HTTP/1.1\r\nHost: a\r\n")
            for i in range(400):
                raw.send(f"X{i}: {'x' * 500}\r\n")
                if i % 50 == 0:
                    time.sleep(0.01)
        except OSError:
            pass  # closed in between
        response = raw.read()
        self.assertTrue(response is None or response.status in (431, 400))
        raw.close()

    def test_declared_body_too_large(self):
        """Contract 15: more than 64 MiB is refused without reading it."""
        headers = self.logged_on()
        for method, path in (("PUT", "/fileservice/$HOME/big.bin"), ("POST", "/rw/panel/opmode?action=setopmode")):
            response, ended = self.ask(f"{method} {path} HTTP/1.1\r\n{headers}Content-Length: {64 * 1024 * 1024 + 1}\r\n\r\n")
            self.assertIn(response.status, (413, 400))
            self.assertTrue(ended)
        self.assertFalse(os.path.exists(os.path.join(self.home, "big.bin")))

    def test_endless_chunks(self):
        headers = self.logged_on()
        raw = self.server.raw()
        chunk = b"100000\r\n" + b"x" * 0x100000 + b"\r\n"
        raw.send(f"PUT /fileservice/$HOME/big.bin HTTP/1.1\r\n{headers}Transfer-Encoding: chunked\r\n\r\n")
        try:
            for _ in range(80):
                raw.send(chunk)
        except OSError:
            pass
        response = raw.read()
        self.assertTrue(response is None or response.status in (413, 400))
        self.assertFalse(os.path.exists(os.path.join(self.home, "big.bin")))
        raw.close()

    def test_slow_headers(self):
        """Contract 15: 200 connections that send nothing more cost others nothing, and end after 20 s."""
        client = self.client()
        self.assertEqual(client.get(PATH).status, 200)
        slow = [socket.create_connection(("127.0.0.1", self.server.port())) for _ in range(100)]
        slow += [socket.create_connection(("127.0.0.1", self.server.port("https"))) for _ in range(100)]
        begin = time.monotonic()
        for i, connection in enumerate(slow):
            if i % 2:
                connection.sendall(b"GET / HTTP/1.1\r\nHost:")
        for _ in range(50):
            self.assertEqual(client.get(PATH).status, 200)
        self.assertLess(time.monotonic() - begin, 5 * SLOW)
        for connection in slow:
            connection.settimeout(max(0.1, begin + 25 * SLOW - time.monotonic()))
            try:
                while connection.recv(4096):
                    pass
            except ConnectionError:
                pass
            connection.close()
        self.assertGreater(time.monotonic() - begin, 15)

    def test_smuggling(self):
        """Contract 16: what could be read in two ways is refused, and the connection ends."""
        headers = self.logged_on()
        second = f"GET {PATH} HTTP/1.1\r\n{headers}\r\n"
        for name, lines in {
            "both": "Content-Length: 3\r\nTransfer-Encoding: chunked\r\n",
            "both, the other way": "Transfer-Encoding: chunked\r\nContent-Length: 3\r\n",
            "two lengths": "Content-Length: 3\r\nContent-Length: 4\r\n",
            "the same length twice": "Content-Length: 0\r\nContent-Length: 0\r\n",
            "a list of lengths": "Content-Length: 0, 0\r\n",
            "a sign": "Content-Length: +3\r\n",
            "negative": "Content-Length: -1\r\n",
            "a huge length": "Content-Length: 99999999999999999999999\r\n",
            "hexadecimal": "Content-Length: 0x3\r\n",
            "another coding": "Transfer-Encoding: gzip\r\n",
            "two codings": "Transfer-Encoding: gzip, chunked\r\n",
            "chunked twice": "Transfer-Encoding: chunked\r\nTransfer-Encoding: chunked\r\n",
            "identity": "Transfer-Encoding: identity\r\n",
            "a blank before the colon": "Content-Length : 0\r\n",
            "a tab before the colon": "Transfer-Encoding\t: chunked\r\n",
            "a continued line": "X: a\r\n Content-Length: 0\r\n",
            "a line without colon": "nonsense\r\n",
            "an empty name": ": x\r\n",
            "NUL": "X: a\0b\r\n",
            "a bare line end": "X: a\nContent-Length: 3\r\n",
        }.items():
            with self.subTest(name):
                response, ended = self.ask(f"POST {PATH} HTTP/1.1\r\n{headers}{lines}\r\n0\r\n\r\n{second}")
                self.assertTrue(ended)
                if response:
                    self.assertTrue(400 <= response.status < 500 or response.status == 501, response)

    def test_chunks_that_are_none(self):
        headers = self.logged_on()
        for body in ("x\r\n", "-1\r\n", "FFFFFFFFFFFFFFFFFF\r\n", "3\r\nabcdef\r\n", "3 \r\nabc\r\n0\r\n\r\n" + "1" * 100000):
            with self.subTest(body=body[:20]):
                response, ended = self.ask(f"POST {PATH} HTTP/1.1\r\n{headers}Transfer-Encoding: chunked\r\n\r\n{body}")
                if response:
                    self.assertNotIn(response.status // 100, {2} if len(body) < 50 else set())
                    self.assertTrue(response.status < 500 or response.status in NO_5XX)

    def test_malformed_requests(self):
        """Contract 16."""
        headers = self.logged_on()
        for line, status in {
            "GET /rw/%zz HTTP/1.1": {400}, "GET /rw/% HTTP/1.1": {400}, "GET /rw/%00 HTTP/1.1": {400},
            "GET /rw/panel/opmode?x=%1 HTTP/1.1": {400}, "GET rw HTTP/1.1": {400}, "GET /a\0b HTTP/1.1": {400},
            "GET / HTTP/2.0": {400, 505}, "GET / HTTP/1.2": {400, 505}, "GET / HTTP/9": {400, 505}, "GET /": {400}, "nonsense": {400},
            "G\x01T / HTTP/1.1": {400}, "BREW / HTTP/1.1": {400, 405, 501}, "TRACE / HTTP/1.1": {400, 405, 501},
            "CONNECT a:1 HTTP/1.1": {400, 405, 501}, "GET / / HTTP/1.1": {400, 505},
        }.items():
            with self.subTest(line):
                response, _ = self.ask(f"{line}\r\n{headers}\r\n")
                self.assertIn(response.status, status)

    def test_hosts(self):
        """Contract 16: two Host headers, no Host, a Host that is none; it is not echoed unescaped."""
        cookie = self.logged_on().split("\r\n")[1] + "\r\n"
        for name, lines in {"two": "Host: a\r\nHost: a\r\n", "none": "", "blanks": "Host: a b\r\n", "markup": "Host: a\"><script>\r\n",
                            "path": "Host: a/b\r\n", "user": "Host: u@a\r\n"}.items():
            with self.subTest(name):
                response, _ = self.ask(f"GET {PATH} HTTP/1.1\r\n{lines}{cookie}\r\n")
                self.assertEqual(response.status, 400)
                self.assertNotIn(b"<script>", response.body)
        response, _ = self.ask(f"GET {PATH} HTTP/1.1\r\nHost: robot.example:80\r\nConnection: close\r\n{cookie}\r\n")
        self.assertEqual(response.status, 200)

    def test_head(self):
        headers = self.logged_on()
        raw = self.server.raw()
        raw.send(f"HEAD {PATH} HTTP/1.1\r\n{headers}\r\nGET {PATH} HTTP/1.1\r\n{headers}\r\n")
        head = raw.read(is_head=True)
        self.assertEqual(head.status, 200)
        full = raw.read()
        self.assertEqual(head.header("content-length"), str(len(full.body)))
        raw.close()

    def test_http_1_0(self):
        headers = self.logged_on()
        response, ended = self.ask(f"GET {PATH} HTTP/1.0\r\n{headers}\r\n")
        self.assertEqual(response.status, 200)
        self.assertTrue(ended)

    def test_junk_on_the_tls_port(self):
        for data in (b"GET / HTTP/1.1\r\nHost: a\r\n\r\n", os.urandom(500), b"\x16\x03\x01\xff\xff" + b"x" * 1000):
            connection = socket.create_connection(("127.0.0.1", self.server.port("https")), timeout=30)
            connection.sendall(data)
            try:
                while connection.recv(4096):
                    pass
            except ConnectionError:
                pass
            connection.close()
        self.assertEqual(self.client(2).get(PATH).status, 200)


class Ending(ServeCase):
    """Contract 2 and 3."""

    def inputs(self):
        return os.path.join(self.folder, "inputs")

    def test_sigterm_while_clients_are_there(self):
        server = Serve(self.inputs())
        client = server.client(1)
        response = client.subscribe(PATH)
        socket_ = client.open_events(response)
        half = server.raw().send("GET / HTTP/1.1\r\n")
        secure = server.raw("https")
        begin = time.monotonic()
        self.assertEqual(server.stop(), 143)
        self.assertLess(time.monotonic() - begin, 2 * SLOW)
        self.assertIsNone(socket_.text())
        for each in (half, secure, socket_, client):
            each.close()

    def test_motors_on_and_the_program_stopped(self):
        """Contract 5 with --motors-on: stopped at main, and a client may start it at once."""
        server = Serve(self.inputs(), options=("--no-program-start", "--motors-on"))
        client = server.client(1)
        self.assertEqual(client.get("/rw/panel/ctrlstate").values()["ctrlstate"], "motoron")
        self.assertEqual(client.get("/rw/rapid/execution").values()["ctrlexecstate"], "stopped")
        form = {"regain": "continue", "execmode": "continue", "cycle": "forever", "condition": "none"}
        self.assertEqual(client.act("/rw/rapid/execution", "start", form).status, 204)
        client.close()
        self.assertEqual(server.stop(), 143)

    def test_one_line_on_stdout(self):
        server = Serve(self.inputs())
        self.assertEqual(sorted(server.addresses), ["http", "https", "web"])
        client = server.client(2)
        client.get(PATH)
        client.close()
        server.process.terminate()
        self.assertEqual(server.process.stdout.read(), b"")
        self.assertEqual(server.stop(), 143)

    def test_what_cannot_begin(self):
        taken = str(self.server.port())
        for arguments in ((self.inputs(), "--http-port=" + taken), (self.inputs(), "--https-port=" + taken), ("/none/at/all",),
                          (self.inputs(), "--no-such-option"), (self.inputs(), "--http-port=70000"), (self.inputs(), "--listen=0.0.0.0"), ()):
            with self.subTest(arguments=arguments[1:]):
                server = Serve(*arguments, wait=False)
                status = server.process.wait(20 * SLOW)
                self.assertNotIn(status, (0, 143, -15))
                self.assertEqual(server.process.stdout.read(), b"")
                self.assertTrue(server.stderr_text().strip())
                server.process.stdout.close()


class Certificate(ServeCase):
    """Contract 9."""

    def test_versions_of_tls(self):
        for version, works in ((ssl.TLSVersion.TLSv1_1, False), (ssl.TLSVersion.TLSv1_2, True), (ssl.TLSVersion.TLSv1_3, True)):
            context = unchecked_context()
            context.minimum_version = context.maximum_version = version
            context.set_ciphers("DEFAULT:@SECLEVEL=0")
            connection = socket.create_connection(("127.0.0.1", self.server.port("https")), timeout=30)
            try:
                context.wrap_socket(connection).close()
                self.assertTrue(works, version)
            except (ssl.SSLError, OSError):
                self.assertFalse(works, version)

    def test_alternative_names(self):
        port = self.server.port("https")
        certificate = ssl.get_server_certificate(("127.0.0.1", port))
        context = ssl.create_default_context(cadata=certificate)
        for name in ("127.0.0.1", "localhost"):
            with socket.create_connection(("127.0.0.1", port), timeout=30) as connection:
                with context.wrap_socket(connection, server_hostname=name) as secure:
                    self.assertIn(("IP Address", "127.0.0.1"), secure.getpeercert()["subjectAltName"])


class Origins(ServeCase):
    """Contract 17."""

    def test_changes(self):
        for client in self.both():
            own = client.address
            path, fields = MOTORS[client.dialect], {"ctrl-state": "motoron"}
            self.assertEqual(client.post(path, fields).status, 204)
            self.assertEqual(client.post(path, fields, headers={"Origin": own}).status, 204)
            for origin in ("null", "http://evil.example", "https://127.0.0.1", "http://127.0.0.1:1", own + "0", own + "/x", ""):
                for method in ("POST", "PUT", "DELETE"):
                    response = client.request(method, path, fields=fields, headers={"Origin": origin})
                    self.assertEqual(response.status, 403, (origin, method))
                    self.assertIsNone(response.header("access-control-allow-origin"))
            response = client.get(PATH, headers={"Origin": "http://evil.example"})
            self.assertIsNone(response.header("access-control-allow-origin"))

    def test_names_that_lead_here(self):
        """A name that its owner lets lead to 127.0.0.1 is not an own origin (DNS rebinding)."""
        client = self.client()
        client.get(PATH)
        response = client.post("/rw/panel/speedratio?action=setspeedratio", {"speed-ratio": "80"},
                               headers={"Host": f"evil.example:{client.port}", "Origin": f"http://evil.example:{client.port}"})
        self.assertEqual(response.status, 403)

    def test_upgrades(self):
        for client in self.both():
            response = client.subscribe(PATH)
            for origin in ("null", "http://evil.example"):
                self.assertEqual(self.socket(client, response, headers={"Origin": origin}).status, 403)
            self.assertEqual(self.socket(client, response, headers={"Origin": client.address}).status, 101)

    def test_upgrades_of_libraries(self):
        """17: the server's own origin. Libraries outside browsers write it with the scheme of the WebSocket (ws4py, Go clients)."""
        for client in self.both():
            response = client.subscribe(PATH)
            own = response.header("location").split("/poll")[0]
            other = own.replace("wss:", "ws:") if client.dialect == 2 else own.replace("ws:", "wss:")
            for origin in (other, own + "0"):
                self.assertEqual(self.socket(client, response, headers={"Origin": origin}).status, 403, origin)
            self.assertEqual(self.socket(client, response, headers={"Origin": own}).status, 101)


class Formats(ServeCase):
    """Contract 18 to 21."""

    def test_accept_of_2_0(self):
        client = self.client(2)
        for accept, status, answer in (
            (HAL, 200, HAL), (XHTML2, 200, XHTML2), (HAL + ";", 200, HAL), ("application/hal+json; v=2.0", 200, HAL),
            ("text/html, " + XHTML2, 200, XHTML2), ("APPLICATION/HAL+JSON;V=2.0", 200, HAL), (HAL + ";q=0.9", 200, HAL),
            ("*/*", 406, None), ("application/json", 406, None), ("application/hal+json", 406, None), ("text/html", 406, None),
            ("application/hal+json;v=1.0", 406, None), ("application/xhtml+xml;v=2.1", 406, None), ("", 406, None),
            ("application/hal+json;v=2.00", 406, None),
        ):
            with self.subTest(accept):
                response = client.get(PATH, headers={"Accept": accept})
                self.assertEqual(response.status, status)
                if answer:
                    self.assertEqual(response.header("content-type"), answer)
        log = client.get("/rw/elog/0?order=lifo", headers={"Accept": "application/xhtml+xml;v=2.1"})
        self.assertEqual(log.status, 200)
        self.assertTrue(log.header("content-type").startswith("application/xhtml+xml"))

    def test_accept_never_matters_in_1_0_nor_for_files(self):
        client = self.client(1)
        for accept in ("*/*", "application/json", "text/plain", ""):
            self.assertEqual(client.get(PATH, headers={"Accept": accept}).header("content-type").split(";")[0], "application/xhtml+xml")
        response = client.get(PATH + "?json=1", headers={"Accept": "text/html"})
        self.assertEqual(response.header("content-type").split(";")[0], "application/json")
        client = self.client(2)
        self.assertIn(client.put("/fileservice/$HOME/a.txt", b"\x00\xff").status, (200, 201, 204))
        self.assertEqual(client.get("/fileservice/$HOME/a.txt", headers={"Accept": "text/plain"}).body, b"\x00\xff")

    def test_forms_of_2_0(self):
        client = self.client(2)
        for content, statuses in ((FORM, {415, 406}), (FORM + ";v=1.0", {415, 406}), ("application/json", {415, 406}),
                                  (FORM + ";v=2.0", {204}), (FORM + "; v=2.0", {204}), (FORM + ";charset=utf-8;v=2.0", {204})):
            with self.subTest(content):
                response = client.request("POST", MOTORS[2], body="ctrl-state=motoron", headers={"Content-Type": content})
                self.assertIn(response.status, statuses)

    def test_shape_of_xhtml(self):
        """Contract 20."""
        for client in self.both():
            client.form = "xhtml"
            for path in (PATH, "/rw/rapid/tasks", "/rw/system", "/rw/elog/0", "/rw/unknown", "/fileservice", "/"):
                text = client.get(path).body
                self.assertFalse(text.startswith(b"\xef\xbb\xbf"))
                text = text.decode("utf-8")
                self.assertNotIn("<!--", text)
                self.assertRegex(text, r'<base href="https?://127\.0\.0\.1:\d+/')
                kind, entries, links, spans = read_xhtml(text)
                if path == "/rw/unknown":
                    self.assertEqual(kind, "status")
                    self.assertLess(int(spans["code"]), 0)
                    self.assertTrue(spans["msg"])
                    continue
                self.assertEqual(kind, "state")
                self.assertIn("self", links)
                for entry in entries:
                    self.assertTrue(entry.type and " " not in entry.type)
                    self.assertTrue(entry.title)

    def test_json_and_xhtml_say_the_same(self):
        """Contract 21; in 2.0 every value is a string."""
        for dialect, forms in ((1, ("xhtml", "json")), (2, ("xhtml", "hal"))):
            clients = [self.client(dialect, form=form) for form in forms]
            for path in (PATH, "/rw/rapid/tasks", "/rw/rapid/execution", "/rw/system", "/ctrl", "/users", "/rw/iosystem/signals",
                         "/rw/cfg/sys", "/rw/mastership"):
                with self.subTest(dialect=dialect, path=path):
                    responses = [client.get(path) for client in clients]
                    self.assertEqual({response.status for response in responses}, {200})
                    self.assertEqual(responses[0].entries(), responses[1].entries())
                    for entry in responses[1].entries():
                        for value in entry.values.values():
                            self.assertIsInstance(value, str)

    def test_errors_in_every_form(self):
        for dialect, form in ((1, "xhtml"), (1, "json"), (2, "xhtml"), (2, "hal")):
            with self.subTest(dialect=dialect, form=form):
                response = self.client(dialect, form=form).get("/rw/unknown")
                self.assertEqual(response.status, 404)
                self.assertEqual(response.code(), -1073414146)
                response = self.client(dialect, form=form).request("PATCH", "/rw/system")  # refused before a resource is looked for
                self.assertEqual(response.status, 501)
                self.assertEqual(response.body.lstrip()[:1], b"<" if form == "xhtml" else b"{")
                self.assertLess(response.code(), 0)

    def test_methods(self):
        for client in self.both():
            self.assertEqual(client.delete(PATH).status, 405)
            for path in ("/", "/rw", "/rw/dipc", "/rw/rapid/uiinstr"):  # contract 22
                self.assertEqual(client.get(path).status, 200, path)

    def test_invalid_forms(self):
        for client in self.both():
            headers = {"Content-Type": FORM + (";v=2.0" if client.dialect == 2 else "")}
            for body in ("ctrl-state=%zz", "ctrl-state=%", "a=%00"):
                response = client.request("POST", MOTORS[client.dialect], body=body, headers=headers)
                self.assertEqual(response.status, 400)


if __name__ == "__main__":
    main()
