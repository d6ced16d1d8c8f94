"""partner.py NAME MODULE COMMAND...: runs a command on a module, and is the UDP partner that guides its robot.

{sio} in the command is a configuration of the device EGMSensor with the port of this partner, {program} the module, {work} a
folder for outputs. NAME is a function of partners.py. The output of the command follows what it prints, then its exit status; events
are those with the numbers of EGM.
"""

import json
import os
import subprocess
import sys
import tempfile

import partners
from egm import Peer

LIMIT = 30  # s; whatever takes longer hangs
EVENTS = (41822, 41830, 50446, 50930, 70940)


def main():
    name, module, command = sys.argv[1], sys.argv[2], sys.argv[3:]
    peer = Peer()
    with tempfile.TemporaryDirectory() as folder:
        sio = os.path.join(folder, "SIO.cfg")
        with open(sio, "w", encoding="utf-8") as file:
            file.write('SIO:CFG_1.0:7:0::\n#\nCOM_TRP:\n\n      -Name "EGMSensor" -Type "UDPUC" '
                       f'-RemoteAdress "127.0.0.1" -RemotePortNumber {peer.port}\n')
        events = os.path.join(folder, "events.jsonl")
        command = [text.replace("{sio}", sio).replace("{program}", module).replace("{work}", folder) for text in command]
        with subprocess.Popen(command + ["--events=" + events], stdout=subprocess.PIPE, stderr=subprocess.PIPE) as process:
            getattr(partners, name)(peer)
            out, err = process.communicate(timeout=LIMIT)
        print(out.decode(), end="")
        print("status", process.returncode)
        with open(events, encoding="utf-8") as file:
            numbers = [json.loads(line)["number"] for line in file]
        for number in EVENTS:
            if number in numbers:
                print(f"event {number}: {numbers.count(number)}")
        sys.stderr.write(err.decode())


main()
