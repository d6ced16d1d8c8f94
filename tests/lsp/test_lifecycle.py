"""Chapter "Lifecycle Messages" of the protocol, JSON-RPC 2.0, and item 2 of what rapidc promises: error codes, exit statuses."""

import os
import signal
import subprocess
import time
import unittest

from client import RAPIDC, LspCase, ServerError, span


class Lifecycle(LspCase):
    def code(self, client, method, params=None):
        with self.assertRaises(ServerError) as caught:
            client.request(method, params)
        return caught.exception.code

    def test_initialize_names_the_server(self):
        client = self.connect()
        result = client.initialize()
        self.assertEqual(result["serverInfo"]["name"], "rapidc")
        self.assertRegex(result["serverInfo"]["version"], r"^\d+\.\d+")
        self.assertEqual(result["capabilities"]["positionEncoding"], "utf-16")
        self.assertTrue(result["capabilities"]["textDocumentSync"]["openClose"])
        self.assertEqual(client.stop(), 0)

    def test_requests_before_initialize(self):
        client = self.connect()
        self.assertEqual(self.code(client, "textDocument/hover", {}), -32002)
        self.assertEqual(self.code(client, "shutdown"), -32002)
        client.notify("textDocument/didOpen", {"nonsense": 1})  # dropped
        client.initialize()
        self.assertEqual(client.stop(), 0)

    def test_second_initialize(self):
        client = self.connect()
        client.initialize()
        self.assertEqual(self.code(client, "initialize", {"capabilities": {}}), -32600)

    def test_wrong_initialize_can_be_repeated(self):
        client = self.connect()
        self.assertEqual(self.code(client, "initialize"), -32602)
        self.assertEqual(self.code(client, "initialize", {"capabilities": 5}), -32602)
        self.assertEqual(self.code(client, "initialize", {"capabilities": {}, "processId": "7"}), -32602)
        client.initialize()
        self.assertEqual(client.stop(), 0)

    def test_requests_after_shutdown(self):
        client = self.connect()
        client.initialize()
        client.request("shutdown")
        self.assertEqual(self.code(client, "textDocument/hover", {}), -32600)
        self.assertEqual(self.code(client, "shutdown"), -32600)
        client.notify("exit")
        self.assertEqual(client.wait(), 0)

    def test_exit_without_shutdown(self):
        client = self.connect()
        client.initialize()
        client.notify("exit")
        self.assertEqual(client.wait(), 1)

    def test_unknown_requests_and_notifications(self):
        client = self.connect()
        client.initialize()
        self.assertEqual(self.code(client, "textDocument/fly", {}), -32601)
        self.assertEqual(self.code(client, "$/fly", {}), -32601)
        client.notify("$/fly", {"a": 1})
        client.notify("workspace/fly", {"a": 1})
        self.assertEqual(client.stop(), 0)

    def test_wrong_parameters(self):
        client = self.connect()
        client.initialize()
        for params in (None, {}, {"textDocument": 5}, {"textDocument": {"uri": 7}}, [1], {"textDocument": {"uri": "file:///x.modx"}}):
            self.assertEqual(self.code(client, "textDocument/formatting", params), -32602, params)
        for position in (None, {}, {"line": -1, "character": 0}, {"line": 1.5, "character": 0}, {"line": "1", "character": 0}):
            self.assertEqual(self.code(client, "textDocument/onTypeFormatting",
                                       {"textDocument": {"uri": "file:///x.modx"}, "position": position, "ch": "\n"}), -32602)
        document = client.open("/tmp/a.modx", "MODULE a\nENDMODULE\n")
        for context in (None, {}, {"diagnostics": 7}):  # CodeActionContext: diagnostics is an array, and required
            self.assertEqual(self.code(client, "textDocument/codeAction",
                                       {"textDocument": {"uri": document}, "range": span((0, 0), (0, 1)), "context": context}), -32602)

    def test_messages_that_are_no_requests(self):
        client = self.connect()
        client.initialize()
        for body in ("[]", "5", "null", '"text"', "{}", '{"id": 7}', '{"jsonrpc": "2.0", "id": 7, "method": 5}',
                     '{"jsonrpc": "2.0", "id": {"a": 1}, "method": "shutdown"}', '{"id": 7, "method": "shutdown"}',
                     '[{"jsonrpc": "2.0", "id": 7, "method": "shutdown"}]'):
            client.send_body(body)
            answer = client.take()
            self.assertEqual(answer["error"]["code"], -32600, body)
            self.assertIn(answer["id"], (7, None))
        self.assertEqual(client.stop(), 0)

    def test_no_json(self):
        client = self.connect()
        client.initialize()
        for body in ("{", "", "nonsense", b"\xff\xfe{}", '{"jsonrpc": "2.0", "id": 1', "[" * 100000):
            client.send_body(body)
            answer = client.take()
            self.assertEqual((answer["error"]["code"], answer["id"]), (-32700, None), body)
        self.assertEqual(client.stop(), 0)

    def test_headers_in_any_form(self):
        client = self.connect()
        body = b'{"jsonrpc":"2.0","id":1,"method":"initialize","params":{"capabilities":{}}}'
        client.send_bytes(b"Content-Type: application/vscode-jsonrpc; charset=utf-8\r\ncontent-length:%d\r\n\r\n" % len(body))
        for i in range(len(body)):  # byte by byte
            client.send_bytes(body[i:i + 1])
        self.assertIn("capabilities", client.response(1)["result"])
        client.send_bytes(b"a stray line\r\n\r\n")
        self.assertEqual(client.stop(), 0)

    def test_text_ids(self):
        client = self.connect()
        client.initialize()
        client.send({"id": "abc", "method": "textDocument/fly"})
        self.assertEqual(client.response("abc")["error"]["code"], -32601)

    def test_end_of_input(self):
        client = self.connect()
        client.initialize()
        client.process.stdin.close()
        self.assertEqual(client.process.wait(timeout=30), 1)

    def test_end_of_input_in_the_middle_of_a_message(self):
        client = self.connect()
        client.send_bytes(b"Content-Length: 1000\r\n\r\n{")
        client.process.stdin.close()
        self.assertEqual(client.process.wait(timeout=30), 1)

    def test_a_client_that_no_longer_reads(self):
        with subprocess.Popen([RAPIDC, "lsp"], stdin=subprocess.PIPE, stdout=subprocess.PIPE) as process:
            process.stdout.close()
            body = b'{"jsonrpc":"2.0","id":1,"method":"initialize","params":{"capabilities":{}}}'
            process.stdin.write(b"Content-Length: %d\r\n\r\n" % len(body) + body)
            process.stdin.flush()
            self.assertEqual(process.wait(timeout=30), 1)

    def test_a_client_that_dies_while_others_hold_the_pipe(self):
        with subprocess.Popen(["sleep", "60"]) as parent:
            client = self.connect()
            client.request("initialize", {"processId": parent.pid, "capabilities": {}})
            os.kill(parent.pid, signal.SIGKILL)
            parent.wait()
            self.assertEqual(client.process.wait(timeout=30), 1)

    def test_cancelled_requests(self):
        client = self.connect()
        client.initialize()
        text = "MODULE m\n" + "".join(f"  VAR num n{i};\n" for i in range(3000)) + "ENDMODULE\n"
        document = client.open(self.write("m.modx", text), text)
        first = client.start("textDocument/formatting", {"textDocument": {"uri": document},
                                                         "options": {"tabSize": 2, "insertSpaces": True}})
        last = client.start("textDocument/formatting", {"textDocument": {"uri": document},
                                                        "options": {"tabSize": 2, "insertSpaces": True}})
        client.notify("$/cancelRequest", {"id": last})
        client.notify("$/cancelRequest", {"id": 12345})
        self.assertIn("result", client.response(first))
        answer = client.response(last)
        self.assertTrue("result" in answer or answer["error"]["code"] == -32800)

    def many_uses(self):
        """A module that uses a variable often: client, document, text, parameters of a long request for the uses, their number."""
        routines, lines = 400, 25
        text = "MODULE m\n  VAR num n;\n" + "".join(
            f"  PROC p{i}()\n" + "    n := n + 1;\n" * lines + "  ENDPROC\n" for i in range(routines)) + "ENDMODULE\n"
        client, document = self.opened(text)
        client.settle()
        ask = {"textDocument": {"uri": document}, "position": {"line": 1, "character": 10},
               "context": {"includeDeclaration": False}}
        return client, document, text, ask, 2 * routines * lines

    def test_a_request_is_cancelled_while_it_is_worked_on(self):
        # Chapter "Cancellation Support": the request still gets an answer, the error RequestCancelled.
        client, document, _, ask, uses = self.many_uses()
        number = client.start("textDocument/references", ask)
        client.notify("$/cancelRequest", {"id": number})
        client.notify("$/cancelRequest", {"id": number})
        self.assertEqual(client.response(number)["error"]["code"], -32800)
        # The conversation continues, and the next answer is a whole one.
        self.assertEqual(len(client.request("textDocument/references", ask)), uses)
        # A request that has its answer cannot be cancelled; its id is free again.
        client.notify("$/cancelRequest", {"id": number})
        client.send({"id": number, "method": "textDocument/references", "params": ask})
        self.assertEqual(len(client.response(number)["result"]), uses)
        self.assertEqual(client.stop(), 0)

    def test_an_edit_overtakes_requests_that_wait(self):
        # Chapter "Error codes", ContentModified; issue 19: a request that is overtaken is cancelled, no request blocks typing.
        client, document, text, ask, uses = self.many_uses()
        numbers = [client.start("textDocument/references", ask) for _ in range(80)]
        self.assertIn("result", client.response(numbers[0]))
        time.sleep(0.15)  # longer than a request may wait when an edit comes
        client.change(document, 2, text.replace("num n;", "num n; VAR num m;"))
        self.assertEqual(client.response(numbers[-1])["error"]["code"], -32801)
        # Requests after the edit are answered.
        self.assertEqual(len(client.request("textDocument/references", ask)), uses)
        self.assertEqual(client.stop(), 0)

    def test_an_edit_overtakes_requests_that_come_to_wait_after_it(self):
        # As above, but the edit comes at once: requests before it need not be answered when they are not reached soon.
        client, document, text, ask, _ = self.many_uses()
        numbers = [client.start("textDocument/references", ask) for _ in range(160)]
        client.change(document, 2, text.replace("num n;", "num n; VAR num m;"))
        self.assertEqual(client.response(numbers[-1])["error"]["code"], -32801)
        # Each of the others has one answer: a result or the same error.
        codes = {client.response(number).get("error", {"code": 0})["code"] for number in numbers[:-1]}
        self.assertLessEqual(codes, {0, -32801})
        self.assertEqual(client.stop(), 0)

    def test_usage(self):
        done = subprocess.run([RAPIDC, "lsp", "-Wno-such-warning-name"], input=b"", capture_output=True, check=False)
        self.assertEqual((done.returncode, done.stdout), (3, b""))
        self.assertIn(b"no-such-warning-name", done.stderr)


if __name__ == "__main__":
    unittest.main()
