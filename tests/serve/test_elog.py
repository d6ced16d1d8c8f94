"""The event log (contract 18, 24, 26, 30, 41; facts 7)."""

import re
import urllib.parse

from rws_client import read_xhtml
from serve_testing import ServeCase, main

MODULE = """MODULE MainModule
  PERS num wanted := 0;
  PROC main()
    VAR num written := 0;
    ErrWrite\\W, "First warning", "The text of it" \\RL2:="more of it";
    WHILE TRUE DO
      WaitUntil written < wanted;
      written := written + 1;
      ErrWrite\\I, "Message " + ValToStr(written), "Number " + ValToStr(written);
    ENDWHILE
  ENDPROC
ENDMODULE
"""


class PagesOfRobotWare8(ServeCase):
    """controller.md 2.3: RobotWare 8 counts pages from 1, oldest first; a client begins at the last page and follows `next`."""

    OPTIONS = ("--no-program-start", "--robotware=8")

    def test_start_is_a_page(self):
        one, two = self.client(1), self.client(2)
        for number in range(60):
            state = "motoroff" if number % 2 else "motoron"
            self.assertEqual(one.post("/rw/panel/ctrlstate?action=setctrlstate", {"ctrl-state": state}).status, 204)
        domain = next(entry for entry in two.get("/rw/elog").entries() if entry.title == "0")
        count = int(domain.values["numevts"])
        read = []
        path = "/rw/elog/0?lang=en&limit=10&start=2"
        while path:
            response = two.get(path)
            self.assertEqual(response.status, 200)
            read += [int(entry.title.rsplit("/", 1)[1]) for entry in response.entries()]
            path = response.links().get("next", "").replace("&amp;", "&")
        self.assertEqual(read, list(range(read[-1] - count + 11, read[-1] + 1)))  # all but the ten of page 1
        self.assertEqual(two.get(f"/rw/elog/0?limit=10&start={count}").status, 400)


class EventLog(ServeCase):
    MODULE = MODULE
    written = 0

    def test_saving_all_messages(self):
        """RWS documentation, saveraw: 202 with Location of a progress resource; A10: the path is one of the file service."""
        for client in self.both():
            self.write(client, 1)
            name = f"log{client.dialect}.txt"
            response = client.act("/rw/elog", "saveraw", {"path": f"/fileservice/$HOME/{name}"})
            self.assertEqual(response.status, 202)
            self.assertEqual(client.get(urllib.parse.urlsplit(response.header("location")).path).values()["state"], "ready")
            self.assertIn(f"Message {type(self).written}".encode(), client.get(f"/fileservice/$HOME/{name}").body)
            for wrong in ("", "name", "/fileservice/$NONE/x"):
                self.assertEqual(client.act("/rw/elog", "saveraw", {"path": wrong}).status // 100, 4, wrong)

    def numbers(self, response):
        return [int(entry.title.rsplit("/", 1)[1]) for entry in response.entries("elog-message-li")]

    def write(self, client, count):
        """Lets the program write so many more messages of domain 8."""
        cls = type(self)
        before = self.all(client, 8)
        cls.written += count
        if client.dialect == 1:
            done = client.post("/rw/rapid/symbol/data/RAPID/T_ROB1/MainModule/wanted?action=set", {"value": cls.written})
        else:
            client.post("/rw/mastership/edit/request")
            done = client.post("/rw/rapid/symbol/RAPID/T_ROB1/MainModule/wanted/data", {"value": cls.written})
            client.post("/rw/mastership/edit/release")
        self.assertEqual(done.status, 204)
        last = f"Message {cls.written}"
        self.eventually(lambda: any(entry.values["title"] == last for entry in
                                    self.client(1).get("/rw/elog/8?limit=5").entries()), 20)
        return before

    def all(self, client, domain, query=""):
        numbers, path = [], f"/rw/elog/{domain}?lang=en{query}"
        while path:
            response = client.get(path)
            self.assertEqual(response.status, 200)
            self.assertLessEqual(len(response.entries()), 50)
            numbers += self.numbers(response)
            following = response.links().get("next")
            path = following.replace("&amp;", "&") if following else None
        return numbers

    def test_domains(self):
        """Facts 7: the domains; li elog-domain-li with domain-name, numevts and buffsize 1000."""
        for client in self.both():
            domains = {entry.title.rsplit("/", 1)[-1]: entry.values for entry in client.get("/rw/elog").entries("elog-domain-li")}
            self.assertLessEqual({"0", "1", "2", "3", "4", "5", "7", "8", "9", "11", "12"}, set(domains))
            self.assertEqual(domains["0"]["buffsize"], "1000")
            count = sum(len(client.get(f"/rw/elog/{domain}").entries()) for domain in (4, 9))
            self.assertEqual(count, int(domains["4"]["numevts"]) + int(domains["9"]["numevts"]))

    def test_a_message(self):
        """Facts 7: the values of a message; line 30: its title ends in its number."""
        for client in self.both():
            entry = next(entry for entry in self.eventually(lambda: client.get("/rw/elog/8?lang=en&order=fifo").entries())
                         if entry.values["title"] == "First warning")
            values = entry.values
            self.assertEqual((values["msgtype"], int(values["code"]) // 10000), ("2", 8))
            self.assertRegex(values["tstamp"], r"^\d{4}-\d\d-\d\d T \d\d:\d\d:\d\d$")
            self.assertIn("The text of it", values["desc"])
            for name in ("conseqs", "causes", "actions", "argc"):
                self.assertIn(name, values)
            number = entry.title.rsplit("/", 1)[1]
            for path in (f"/rw/elog/8/{number}", f"/rw/elog/0/{number}", f"/rw/elog/seqnum/{number}"):
                one = client.get(path + "?lang=en").values("elog-message")
                self.assertEqual((one["title"], one["code"]), ("First warning", values["code"]))
            self.assertEqual(client.get("/rw/elog/8/999999").status, 404)
            self.assertEqual(client.get(f"/rw/elog/4/{number}").status, 404)
            self.assertEqual(client.get("/rw/elog/99").status, 404)

    def test_order_and_pages(self):
        """Lines 24 and 30: pages of 50; 1.0 lists the newest first, 2.0 the oldest unless order=lifo; numbers grow by one over all."""
        one, two = self.client(1), self.client(2)
        self.write(one, 70)
        first, second = self.all(one, 0), self.all(two, 0)
        self.assertEqual(first, sorted(first, reverse=True))
        self.assertEqual(second, sorted(first))
        self.assertEqual(second, list(range(second[0], second[0] + len(second))))
        lifo = two.get("/rw/elog/0?order=lifo", headers={"Accept": "application/xhtml+xml;v=2.1"})
        self.assertEqual((lifo.status, self.numbers(lifo)), (200, first[:50]))
        self.assertTrue(lifo.header("content-type").startswith("application/xhtml+xml"))
        self.assertEqual(self.numbers(one.get("/rw/elog/0?limit=3")), first[:3])
        self.assertEqual(self.numbers(one.get("/rw/elog/0?start=2&limit=3")), first[2:5])
        self.assertEqual(one.get("/rw/elog/0?order=odd").status, 400)
        self.assertEqual(len(two.get("/rw/elog/8").json()["_embedded"]["resources"]), 50)

    def test_what_the_app_sdk_reads(self):
        """App SDK: the number of messages from resource=info, `start` as a page, the pages from rel=last, numbers from the hrefs."""
        client = self.client(2)
        self.write(client, 60)
        info = client.get("/rw/elog/8?resource=info").entries()
        self.assertEqual([(entry.type, entry.values["buffsize"]) for entry in info], [("elog-domain", "1000")])
        count = int(info[0].values["numevts"])
        self.assertGreaterEqual(count, 60)
        links = client.get("/rw/elog/8?start=1&limit=20").links()
        self.assertIn(f"start={(count + 19) // 20}&", links["last"].replace("&amp;", "&"))
        self.assertTrue(client.get("/rw/elog/8").json()["_links"]["base"]["href"].endswith("/rw/elog/"))
        read = []
        for page in range(1, (count + 19) // 20 + 1):
            read += [entry.links["self"].split("/") for entry in client.get(f"/rw/elog/8?start={page}&limit=20").entries()]
        self.assertEqual([int(number) for _, number in read], self.all(client, 8))
        self.assertEqual({domain for domain, _ in read}, {"8"})
        one = client.get(f"/rw/elog/seqnum/{read[0][1]}?lang=en").json()
        self.assertEqual([entry["_type"] for entry in one["state"]], ["elog-message"])

    def test_arguments(self):
        """Line 33: 10125 has arguments; facts 7: argc and argv, typed. The task is among them."""
        client = self.client(1, form="json")
        self.assertEqual(client.post("/rw/rapid/execution?action=stop", {"stopmode": "stop"}).status, 204)
        self.addCleanup(client.post, "/rw/rapid/execution?action=start",
                        {"regain": "continue", "execmode": "continue", "cycle": "forever", "condition": "none", "stopatbp": "disabled"})
        found = lambda: [state for state in client.get("/rw/elog/1?lang=en").json()["_embedded"]["_state"]  # noqa: E731
                         if state["code"] == "10125"]
        message = self.eventually(found)[0]
        self.assertEqual(int(message["argc"]), len(message["argv"]))
        self.assertIn({"type": "string", "value": "T_ROB1"},
                      [{"type": each["type"], "value": each["value"]} for each in message["argv"]])
        self.typed_arguments(message)

    def typed_arguments(self, message):
        """Decision 128: XHTML of order=lifo has the types of the arguments as attributes; all other has spans without (line 20)."""
        expected = [(f"arg{i}", each["type"], each["value"]) for i, each in enumerate(message["argv"], 1)]
        for version, order, ending in (("2.0", "", ""), ("2.0", "&order=lifo", ' type="([a-z]+)"'), ("2.1", "", ' type="([a-z]+)"')):
            text = self.client(2).get(f"{message['_title']}?lang=en{order}", headers={"Accept": f"application/xhtml+xml;v={version}"}).body.decode()
            found = re.findall(f'<span class="(arg[0-9]+)"{ending}>([^<]*)</span>', text)
            self.assertEqual(found, expected if ending else [(name, value) for name, _, value in expected])

    def test_arguments_of_the_program(self):
        """Published clients find header and lines of ErrWrite by their places, argument 1 to 5; a line that is left out is empty."""
        client = self.client(1, form="json")
        found = lambda: [state for state in client.get("/rw/elog/8?lang=en").json()["_embedded"]["_state"]  # noqa: E731
                         if state["title"] == "First warning"]
        message = self.eventually(found)[0]
        self.assertEqual([each["value"] for each in message["argv"]], ["First warning", "The text of it", "more of it", "", ""])

    def test_arguments_as_xhtml(self):
        """A published client takes each li of the list for a message, with its number at the end of the title, and the arguments from
        the spans arg1, arg2 ..."""
        for client in self.both():
            self.write(client, 1)
            page = client.get("/rw/elog/8?lang=en", headers={"Accept": "application/xhtml+xml;v=2.0"}).body.decode()
            items = re.findall(r"<li ([^>]*)>", page)
            self.assertTrue(items)
            for item in items:
                self.assertRegex(item, r'title="/rw/elog/8/\d+"')
            self.assertIn('<span class="arg1">', page)

    def test_subscription(self):
        """Line 41: elog/0; an event has the number and a link, below 1 KiB."""
        for client in self.both():
            response = client.subscribe(("/rw/elog/8", 1))
            self.assertEqual(response.status, 201)
            socket = self.socket(client, response)
            self.write(client, 1)
            text = socket.text()
            event = read_xhtml(text)[1][0]
            self.assertEqual(event.type, "elog-message-ev")
            number = event.values["seqnum"]
            # RWS documentation: rel=self links to the message; A5, A7 and A8 read it there. Another one repeats what was subscribed (2.4).
            self.assertIn(f'<a href="/rw/elog/8/{number}" rel="self"></a><a href="/rw/elog/8" rel="self"></a>', text)
            self.assertEqual(client.get(f"/rw/elog/8/{number}").values()["title"], f"Message {type(self).written}")

    def test_clear(self):
        """Facts 2.3: clear, clearall."""
        one, two = self.client(1), self.client(2)
        self.write(one, 2)
        self.assertEqual(one.act("/rw/elog/8", "clear").status, 204)
        self.assertEqual(self.all(two, 8), [])
        self.write(two, 2)
        self.assertEqual(len(self.all(two, 8)), 2)
        self.assertEqual(two.act("/rw/elog", "clearall").status, 204)
        self.assertEqual(self.all(one, 0), [])


if __name__ == "__main__":
    main()
