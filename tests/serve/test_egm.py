"""EGM of a controller that serves clients: rules 46, 47 and 52 of the contract for clients, with Robot Web Services at the same time.

Run by ctest as serve/egm; by hand: RAPIDC=build/rapidc python3 tests/serve/test_egm.py
"""

import json
import os
import subprocess
import sys
import tempfile
import time
import unittest
import urllib.request

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "cli", "guided_motion"))
import egm  # noqa: E402

RAPIDC = os.environ.get("RAPIDC", "build/rapidc")
ON, OFF = 1, 2  # motors
STOPPED, RUNNING = 1, 2  # execution

PROGRAM = r"""MODULE Guided
  VAR egmident process;

  PROC main()
    EGMGetId process;
    EGMSetupUC ROB_1, process, "default", "EGMSensor:" \Joint \CommTimeout:=5;
    EGMActJoint process \MaxSpeedDeviation:=20;
    EGMRunJoint process, EGM_STOP_HOLD \J1 \CondTime:=600;
  ENDPROC
ENDMODULE
"""


class Server:
    """rapidc serve with one module and a peer of EGM."""

    def __init__(self):
        self.folder = tempfile.TemporaryDirectory()
        self.peer = egm.Peer()
        module, sio = (os.path.join(self.folder.name, name) for name in ("Guided.modx", "SIO.cfg"))
        with open(module, "w", encoding="utf-8") as file:
            file.write(PROGRAM)
        with open(sio, "w", encoding="utf-8") as file:
            file.write('SIO:CFG_1.0:7:0::\n#\nCOM_TRP:\n\n      -Name "EGMSensor" -Type "UDPUC" '
                       f'-RemoteAdress "127.0.0.1" -RemotePortNumber {self.peer.port}\n')
        self.process = subprocess.Popen([RAPIDC, "serve", module, "--config=" + sio], stdout=subprocess.PIPE,
                                        stderr=subprocess.DEVNULL)
        self.address = json.loads(self.process.stdout.readline())["http"]
        passwords = urllib.request.HTTPPasswordMgrWithDefaultRealm()
        passwords.add_password(None, self.address, "Default User", "robotics")
        self.client = urllib.request.build_opener(urllib.request.HTTPDigestAuthHandler(passwords),
                                                  urllib.request.HTTPCookieProcessor())

    def post(self, path, form):
        with self.client.open(urllib.request.Request(self.address + path, form.encode()), timeout=10) as reply:
            return reply.status

    def close(self):
        self.process.terminate()
        self.process.wait(10)
        self.process.stdout.close()
        self.peer.socket.close()
        self.folder.cleanup()


class Egm(unittest.TestCase):
    def setUp(self):
        self.server = Server()
        self.addCleanup(self.server.close)
        self.last = None

    def answer(self, seconds, asked=90):
        """The messages of so many seconds, each answered with `asked` degrees for axis 1; in order and without a gap."""
        messages, end = [], time.monotonic() + seconds
        while time.monotonic() < end:
            message = self.server.peer.receive()
            self.assertIsNotNone(message, "messages end")
            if self.last is not None:
                self.assertEqual(message["header"]["seqno"], self.last["header"]["seqno"] + 1)
                self.assertEqual(message["header"]["tm"], self.last["header"]["tm"] + 4)
            self.last = message
            messages.append(message)
            self.server.peer.send(egm.sensor((asked, 0, 0, 0, 30, 0)))
        return messages

    def states(self, message):
        return message["rapidExecState"]["state"], message["motorState"]["state"]

    def test_stop_and_motors_off_during_guidance(self):
        moving = self.answer(0.4)
        self.assertEqual(moving[0]["header"]["seqno"], 0)
        self.assertEqual(self.states(moving[-1]), (RUNNING, ON))
        self.assertGreater(egm.joints_of(moving[-1])[0], 1)

        self.assertEqual(self.server.post("/rw/rapid/execution?action=stop", "stopmode=stop"), 204)
        stopped = self.answer(0.6)
        self.assertEqual(self.states(stopped[-1]), (STOPPED, ON))
        self.assertEqual(egm.joints_of(stopped[-1]), egm.joints_of(stopped[-20]))

        self.assertEqual(self.server.post("/rw/panel/ctrlstate?action=setctrlstate", "ctrl-state=motoroff"), 204)
        dark = self.answer(0.4)
        self.assertEqual(self.states(dark[-1]), (STOPPED, OFF))
        self.assertEqual(egm.joints_of(dark[-1]), egm.joints_of(stopped[-1]))

        self.assertEqual(self.server.post("/rw/panel/ctrlstate?action=setctrlstate", "ctrl-state=motoron"), 204)
        self.assertEqual(self.server.post("/rw/rapid/execution?action=start", "regain=continue&execmode=continue"
                                          "&cycle=forever&condition=none&stopatbp=disabled&alltaskbytsp=false"), 204)
        again = self.answer(0.6)
        self.assertEqual(self.states(again[-1]), (RUNNING, ON))
        self.assertGreater(egm.joints_of(again[-1])[0], egm.joints_of(dark[-1])[0] + 1)

    def test_program_pointer_to_main_ends_the_session(self):
        self.answer(0.2)
        self.assertEqual(self.server.post("/rw/rapid/execution?action=stop", "stopmode=stop"), 204)
        self.answer(0.2)
        self.assertEqual(self.server.post("/rw/rapid/execution?action=resetpp", ""), 204)
        end = time.monotonic() + 1
        count = 0
        while time.monotonic() < end and self.server.peer.receive() is not None:
            count += 1
        self.assertLess(count, 100, "messages continue after the program was reset")


if __name__ == "__main__":
    unittest.main()
