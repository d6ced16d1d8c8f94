"""Shared by the tests of resources around RAPID: paths in both dialects, and the four forms of a resource."""

import os
import time

from serve_testing import ServeCase


def data(dialect, symbol):
    """controller.md 2.3, Symbols: RWS 1.0 has the symbol at the end of the path, RWS 2.0 in the middle."""
    return f"/rw/rapid/symbol/data/RAPID/{symbol}" if dialect == 1 else f"/rw/rapid/symbol/RAPID/{symbol}/data"


def properties(dialect, symbol):
    if dialect == 1:
        return f"/rw/rapid/symbol/properties/RAPID/{symbol}"
    return f"/rw/rapid/symbol/RAPID/{symbol}/properties"


def program(name):
    """Text of a module in the folder programs."""
    with open(os.path.join(os.path.dirname(__file__), "programs", name), encoding="utf-8") as file:
        return file.read()


class RapidCase(ServeCase):
    """A server with a program stopped at main, motors off."""

    OPTIONS = ("--no-program-start",)

    def master(self, dialect):
        """A client that may change programs: RWS 2.0 needs mastership (contract 38)."""
        client = self.client(dialect)
        if dialect == 2:
            self.assertEqual(client.post("/rw/mastership/edit/request").status, 204)
            self.addCleanup(client.post, "/rw/mastership/edit/release")
        return client

    def masters(self):
        """One for each dialect, one after the other."""
        for dialect in (1, 2):
            with self.subTest(dialect=dialect):
                client = self.master(dialect)
                yield client
                client.close()

    def setUp(self):
        self._reader = None

    def reader(self):
        """One client of RWS 1.0 for the whole test: sessions are limited."""
        if self._reader is None:
            self._reader = self.client(1)
        return self._reader

    def value(self, symbol):
        """The value of a symbol; a session has only so many requests within a second (contract 16)."""
        while (response := self.reader().get(data(1, symbol))).status == 503:
            time.sleep(0.1)
        return response.values("rap-data")["value"]

    def in_all_forms(self, path1, path2):
        """The entries of a resource, which are the same in XHTML and JSON of a dialect (contract 21)."""
        found = {}
        for dialect, path in ((1, path1), (2, path2)):
            forms = ("xhtml", "json") if dialect == 1 else ("xhtml", "hal")
            entries = []
            for form in forms:
                response = self.client(dialect, form=form).get(path)
                self.assertEqual(response.status, 200, (dialect, form, response))
                entries.append(response.entries())
            self.assertEqual(entries[0], entries[1], f"XHTML and JSON of {path} differ")
            found[dialect] = entries[0]
        return found

    def state(self, client, path, span):
        return client.get(path).values()[span]

    def start(self, client, **fields):
        """Motors on and a start; contract 38: that needs no mastership."""
        path = "/rw/panel/ctrlstate?action=setctrlstate" if client.dialect == 1 else "/rw/panel/ctrl-state"
        self.assertEqual(client.post(path, {"ctrl-state": "motoron"}).status, 204)
        form = {"regain": "continue", "execmode": "continue", "cycle": "asis", "condition": "none",
                "stopatbp": "enabled", "alltaskbytsp": "true", **fields}
        return client.act("/rw/rapid/execution", "start", form)

    def wait_stopped(self, client):
        self.eventually(lambda: self.state(client, "/rw/rapid/execution", "ctrlexecstate") == "stopped",
                        message="the program does not stop")
