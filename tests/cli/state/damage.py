"""damage.py FOLDER HOW [RAPIDC MODULE]: damages the state file in a folder."""

import json
import os
import random
import subprocess
import sys

folder, how = sys.argv[1], sys.argv[2]
path = os.path.join(folder, "state.json")
with open(path, "rb") as file:
    data = file.read()


def write(content):
    with open(path, "wb") as out:
        out.write(content)


def change(edit):
    state = json.loads(data)
    edit(state)
    write(json.dumps(state).encode())


def spoil(choose):
    """Bytes changed, cut out, or put in."""
    bad = bytearray(data)
    for _ in range(choose.randrange(1, 6)):
        at = choose.randrange(len(bad))
        kind = choose.randrange(3)
        if kind == 0:
            bad[at] = choose.randrange(256)
        elif kind == 1:
            del bad[at:at + choose.randrange(1, 20)]
        else:
            bad[at:at] = bytes(choose.choice(b'[]{}",:0123456789eE+-.') for _ in range(4))
    return bytes(bad)


if how == "cut":
    write(data[:len(data) // 2])
elif how == "foreign":
    write(b'{"name": "something else"}')
elif how == "version":
    change(lambda state: state.update(version=99))
elif how == "type":
    change(lambda state: state["persistents"].update(RUNS=[1, 2]))
elif how == "value":
    change(lambda state: state["persistents"]["RUNS"].update(value='"text"'))
else:
    generator = random.Random(11)
    for _ in range(25):
        write(spoil(generator))
        done = subprocess.run([sys.argv[3], "run", sys.argv[4], "--state=" + folder], stdout=subprocess.DEVNULL,
                              stderr=subprocess.DEVNULL, timeout=60, check=False)
        if done.returncode not in (0, 1):
            print("status", done.returncode)
            break
    else:
        print("never a crash")
