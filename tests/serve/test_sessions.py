"""Log on, cookies, logout, limits of sessions and requests (contract 11 to 14)."""

import re
import threading
import time
from urllib.parse import urlsplit

from serve_testing import ServeCase, main

PATH = "/rw/panel/opmode"


class Digest(ServeCase):
    """Contract 11: Digest over HTTP."""

    def challenge(self, client, path=PATH):
        response = client.send("GET", path)
        self.assertEqual(response.status, 401)
        return response.header("www-authenticate")

    def answer(self, client, authorization, path=PATH, method="GET"):
        return client.send(method, path, None, {"Authorization": authorization})

    def test_challenge(self):
        client = self.client()
        first, second = self.challenge(client), self.challenge(client)
        self.assertTrue(first.startswith("Digest "))
        self.assertIn("robapi", re.search(r'realm="([^"]*)"', first)[1])
        self.assertRegex(first, r'qop="?auth"?')
        nonces = {re.search(r'nonce="([^"]*)"', text)[1] for text in (first, second)}
        self.assertEqual(len(nonces), 2, "nonces differ")

    def test_both_users_with_and_without_qop(self):
        for user in ("Default User", "Admin"):
            for qop in (True, False):
                with self.subTest(user=user, qop=qop):
                    client = self.client(user=user)
                    authorization = client.digest(self.challenge(client), "GET", PATH, qop=qop)
                    response = self.answer(client, authorization)
                    self.assertEqual(response.status, 200)
                    client.cookies = response.cookies()

    def test_a_counter_works_once(self):
        client = self.client()
        authorization = client.digest(self.challenge(client), "GET", PATH)
        first = self.answer(client, authorization)
        self.assertEqual(first.status, 200)
        client.cookies = first.cookies()
        again = self.answer(self.client(), authorization)
        self.assertEqual(again.status, 401)
        self.assertIsNone(again.header("set-cookie"))

    def test_counters_of_one_nonce(self):
        client = self.client()
        challenge = self.challenge(client)
        for counter in (1, 2, 5, 3):
            authorization = client.digest(challenge, "GET", PATH, counter=counter)
            response = self.answer(client, authorization)
            self.assertEqual(response.status, 200, counter)
            client.cookies = response.cookies()

    def test_clients_that_share_a_connection(self):
        """Contract 12: who logs on gets a session, also over the connection of another; 37: mastership is of the session."""
        first, second = self.client(), self.client()
        for each in (first, second):
            each.connection = first.connection
            authorization = each.digest(self.challenge(each), "GET", PATH)
            each.cookies = self.answer(each, authorization).cookies()
        self.assertNotEqual(first.cookies["-http-session-"], second.cookies["-http-session-"])
        domain = "/rw/mastership/motion"
        self.assertEqual(first.act(domain, "request").status, 204)
        refused = second.act(domain, "request")
        self.assertEqual((refused.status, refused.code()), (403, -1073445862))
        self.assertEqual(first.act(domain, "release").status, 204)
        self.assertEqual(second.act(domain, "request").status, 204)
        self.assertEqual(second.act(domain, "release").status, 204)
        second.connection = None

    def test_the_uri_must_be_the_one_of_the_request(self):
        client = self.client()
        authorization = client.digest(self.challenge(client), "GET", "/rw/panel/ctrlstate")
        self.assertEqual(self.answer(client, authorization).status, 401)

    def test_the_uri_may_be_without_the_query(self):
        """A published client (abbrws of Rust) signs the path alone."""
        target = "/rw/iosystem/signals?json=1"
        for uri, status in (("/rw/iosystem/signals", 200), (target, 200), ("/rw/iosystem/signals?json=0", 401), ("/rw/iosystem", 401)):
            client = self.client()
            headers = {"Authorization": client.digest(self.challenge(client), "GET", uri)}
            self.assertEqual(client.send("GET", target, headers=headers).status, status, uri)

    def test_wrong_answers(self):
        client = self.client(password="wrong")
        self.assertEqual(client.get(PATH).status, 401)
        client = self.client(user="Stranger")
        self.assertEqual(client.get(PATH).status, 401)
        client = self.client()
        for text in ("Digest", "Digest ", "Digest username", 'Digest username="Default User', "Digest a=b,,", "Bearer x",
                     'Digest username="Default User", nonce="x", response="y", uri="/rw/panel/opmode", realm="z"'):
            with self.subTest(text=text):
                self.assertEqual(self.answer(client, text).status, 401)

    def test_no_basic_over_http(self):
        client = self.client()
        response = self.answer(client, client.basic())
        self.assertEqual(response.status, 401)
        self.assertTrue(response.header("www-authenticate").startswith("Digest "))


class Basic(ServeCase):
    """controller.md 2.1: Basic over HTTPS."""

    def test_challenge_and_answers(self):
        client = self.client(2)
        response = client.get(PATH, login=False)
        self.assertEqual(response.status, 401)
        self.assertTrue(response.header("www-authenticate").startswith("Basic "))
        for user, password, status in (("Admin", "robotics", 200), ("Default User", "robotics", 200), ("Admin", "wrong", 401),
                                       ("Stranger", "robotics", 401), ("Admin", "", 401), ("", "", 401)):
            with self.subTest(user=user, password=password):
                self.assertEqual(self.client(2, user=user, password=password).get(PATH).status, status)

    def test_broken_headers(self):
        client = self.client(2)
        for text in ("Basic", "Basic ", "Basic !!!", "Basic QQ", "Digest x=y"):
            with self.subTest(text=text):
                self.assertEqual(client.get(PATH, headers={"Authorization": text}, login=False).status, 401)

    def test_wrong_passwords_cost_others_nothing(self):
        """Contract 14, in its sense: while one guesses passwords, another client is answered."""
        other = self.client(2)
        self.assertEqual(other.get(PATH).status, 200)
        end = threading.Event()

        def guess():
            client = self.server.client(2, password="wrong")
            while not end.is_set():
                client.get(PATH)
            client.disconnect()

        threads = [threading.Thread(target=guess) for _ in range(4)]
        for thread in threads:
            thread.start()
        try:
            begin = time.monotonic()
            for _ in range(50):
                self.assertEqual(other.get(PATH).status, 200)
            self.assertLess(time.monotonic() - begin, 10)
        finally:
            end.set()
            for thread in threads:
                thread.join()


class Cookies(ServeCase):
    """Contract 12."""

    def test_cookies_alone_suffice(self):
        for client in self.both():
            first = client.get(PATH)
            self.assertEqual(first.status, 200)
            cookies = first.cookies()
            self.assertGreaterEqual(len(cookies["-http-session-"]), 16)
            self.assertIn("ABBCX", cookies)
            other = self.server.client(client.dialect)
            other.cookies = cookies
            self.assertEqual(other.get(PATH, login=False).status, 200)
            other.disconnect()

    def test_context_cookie_names_the_session_of_a_login(self):
        """Contract 12: a client that returns ABBCX alone and logs on with each request stays in its session."""
        for client in self.both():
            cookies = client.get(PATH).cookies()
            other = self.server.client(client.dialect)
            other.cookies = {"ABBCX": cookies["ABBCX"]}
            challenge = other.get(PATH, login=False)
            self.assertEqual(challenge.status, 401)
            login = (other.digest(challenge.header("www-authenticate"), "GET", PATH)
                     if client.dialect == 1 else other.basic())
            response = other.get(PATH, headers={"Authorization": login})
            self.assertEqual(response.status, 200)
            self.assertEqual(response.cookies()["-http-session-"], cookies["-http-session-"])
            other.disconnect()

    def test_curl_holds_content_back_until_it_is_challenged(self):
        """Contract 11 and 12: curl --digest with a cookie file sends an empty form or file first, and what it has after a challenge."""
        client = self.client()
        path, form = "/rw/panel/speedratio?action=setspeedratio", "speed-ratio=70"
        self.assertEqual(client.put("/fileservice/$HOME/curl.txt", b"before").status, 201)
        for method, target, content in (("POST", path, form), ("PUT", "/fileservice/$HOME/curl.txt", "after")):
            cookie = "; ".join(f"{name}={value}" for name, value in client.cookies.items())
            headers = {"Cookie": cookie, "User-Agent": "curl/7.88.1"}
            if method == "POST":
                headers["Content-Type"] = "application/x-www-form-urlencoded"
            response = client.send(method, target, b"", {**headers, "Content-Length": "0"})
            self.assertEqual(response.status, 401)
            headers["Authorization"] = client.digest(response.header("www-authenticate"), method, target)
            self.assertIn(client.send(method, target, content, headers).status, (200, 204))
        self.assertEqual(client.get("/rw/panel/speedratio").values()["speedratio"], "70")
        self.assertEqual(client.get("/fileservice/$HOME/curl.txt").body, b"after")
        # By a cookie alone, as curl sends it without --digest, and for clients that hold nothing back.
        self.assertEqual(client.send("POST", path, form, {"Cookie": cookie, "User-Agent": "curl/7.88.1"}).status, 204)
        self.assertEqual(client.post(path, {}).status, 400)

    def test_a_subscription_repeats_the_cookies(self):
        """Published clients (the sample of the RWS documentation) take the cookies of the event socket from the reply to /subscription."""
        for client in self.both():
            client.get(PATH)
            before = dict(client.cookies)
            response = client.subscribe(PATH)
            self.assertEqual(response.cookies(), before)
            self.assertEqual(client.get(PATH).cookies(), {})

    def test_cookies_are_not_guessable(self):
        values = [self.client(dialect).get(PATH).cookies()["-http-session-"] for dialect in (1, 1, 2, 2)]
        self.assertEqual(len(set(values)), 4)
        for client in self.both():
            for value in ("", "x", values[0][:-1], values[0] + "0", "0" * 32):
                client.cookies = {"-http-session-": value}
                self.assertEqual(client.get(PATH, login=False).status, 401, value)
            client.cookies = {}

    def test_logout_ends_the_session(self):
        for client in self.both():
            self.assertEqual(client.get(PATH).status, 200)
            self.assertIn(client.get("/logout").status, (200, 204))
            self.assertEqual(client.get(PATH, login=False).status, 401)
            client.cookies = {}

    def test_logout_ends_event_sockets(self):
        for client in self.both():
            response = client.subscribe(PATH)
            self.assertEqual(response.status, 201)
            socket = self.socket(client, response)
            self.assertEqual(socket.status, 101)
            client.get("/logout")
            self.assertIsNone(socket.text(5))
            client.cookies = {}

    def test_logout_ends_mastership(self):
        client, other = self.client(2), self.client(2)
        self.assertEqual(client.post("/rw/mastership/edit/request").status, 204)
        self.assertEqual(other.post("/rw/mastership/edit/request").status, 403)
        client.get("/logout")
        client.cookies = {}
        self.eventually(lambda: other.post("/rw/mastership/edit/request").status == 204)


class Restart(ServeCase):
    """Decision 132: a restart of the controller ends sessions, masterships, privileges, subscriptions and event sockets."""

    def restart(self, client):
        path = "/rw/panel?action=restart" if client.dialect == 1 else "/ctrl/restart"
        self.assertEqual(client.post(path, {"restart-mode": "restart"}).status, 204)

    def test_old_cookies_log_on_again(self):
        for dialect in (1, 2):
            clients = [self.client(dialect), *self.both()]
            for client in clients:
                self.assertEqual(client.get(PATH).status, 200)
            before = [dict(client.cookies) for client in clients]
            self.restart(clients[0])
            for client, cookies in zip(clients, before):
                self.assertEqual(client.get(PATH, login=False).status, 401)
                self.assertEqual(client.get(PATH).status, 200)
                self.assertNotEqual(client.cookies["-http-session-"], cookies["-http-session-"])
                self.assertEqual(client.get(PATH, login=False).status, 200, "the new session counts")

    def test_masterships_end(self):
        old, new, other = self.client(1), self.client(2), self.client(2)
        self.assertEqual(old.post("/rw/mastership/rapid?action=request").status, 204)
        self.assertEqual(new.post("/rw/mastership/motion/request-with-id").status, 200)
        self.restart(other)
        for name in ("edit", "motion"):
            self.assertEqual(other.get(f"/rw/mastership/{name}").values("msh-resource")["mastership"], "nomaster")
            self.assertEqual(other.post(f"/rw/mastership/{name}/request").status, 204)
            self.assertEqual(other.post(f"/rw/mastership/{name}/release").status, 204)

    def test_the_privilege_to_modify_ends(self):
        client = self.client(2)
        self.assertEqual(client.post("/users/rmmp", {"privilege": "modify"}).status, 202)
        self.assertEqual(client.get("/users/rmmp").values()["privilege"], "modify")
        self.restart(self.client(1))
        self.assertEqual(client.get("/users/rmmp").values()["privilege"], "none")
        users = client.get("/users").entries("user-li")
        self.assertEqual(len(users), 1, "the session of this client alone")

    def test_subscriptions_end(self):
        for client in self.both():
            response = client.subscribe(PATH)
            socket = self.socket(client, response)
            self.assertEqual(socket.status, 101)
            self.restart(self.client(2))
            while socket.text(5) is not None:  # events of the time before
                pass
            self.assertIn(socket.close_code, (1000, 1001, 1012))
            self.assertEqual(client.delete(urlsplit(response.header("location")).path).status, 404)


class Limits(ServeCase):
    """Contract 13 and 14."""

    def test_seventy_sessions(self):
        # Not logged on: no sessions.
        strangers = [self.server.client(1 + i % 2) for i in range(80)]
        for client in strangers:
            self.assertEqual(client.get(PATH, login=False, headers={"Authorization": "none"}).status, 401)
        clients = [self.client(1 + i % 2) for i in range(70)]
        for client in clients:
            self.assertEqual(client.get(PATH).status, 200)
        for dialect in (1, 2):
            self.assertEqual(self.client(dialect).get(PATH).status, 503)
        self.assertEqual(clients[0].get(PATH).status, 200, "sessions that exist are served")
        clients[0].close()
        late = self.client(2)
        self.assertEqual(late.get(PATH).status, 200)
        for client in [*clients, late, *strangers]:
            client.close()

    def burst(self, client, count):
        """Sends requests over one connection without waiting; the status of each."""
        raw = self.server.raw()
        cookies = "; ".join(f"{name}={value}" for name, value in client.cookies.items())
        request = f"GET {PATH} HTTP/1.1\r\nHost: 127.0.0.1\r\nCookie: {cookies}\r\n\r\n".encode()
        sender = threading.Thread(target=lambda: raw.send(request * count))
        sender.start()
        states = [raw.read().status for _ in range(count)]
        sender.join()
        raw.close()
        return states

    def test_floods_are_refused_for_their_session_only(self):
        client, other = self.client(), self.client()
        self.assertEqual(client.get(PATH).status, 200)
        self.assertEqual(other.get(PATH).status, 200)
        time.sleep(1.1)  # a second of its own
        self.assertEqual(set(self.burst(client, 299)), {200})
        time.sleep(1.1)
        begin = time.monotonic()
        states = self.burst(client, 2500)
        if time.monotonic() - begin < 2:  # else the machine is too slow to flood
            self.assertIn(503, states)
        self.assertIn(200, states)
        self.assertLessEqual(set(states), {200, 503})
        self.assertEqual(other.get(PATH).status, 200)
        time.sleep(2)
        self.assertEqual(client.get(PATH).status, 200)


if __name__ == "__main__":
    main()
