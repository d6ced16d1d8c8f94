"""killed.py RAPIDC MODULE: kills a program that saves its module again and again; the file must always be whole."""

import os
import random
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time

ROUNDS = 12


def main():
    choose = random.Random(5)
    with open(sys.argv[2], encoding="utf-8") as file:
        original = file.read()
    seen = set()
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "forever.modx")
        shutil.copy(sys.argv[2], path)
        for _ in range(ROUNDS):
            process = subprocess.Popen([sys.argv[1], "run", path, "--home=" + folder],
                                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            before = os.stat(path).st_ino
            end = time.monotonic() + 20
            while os.stat(path).st_ino == before and time.monotonic() < end:  # until it saves for the first time
                time.sleep(0.002)
            time.sleep(choose.random() * 0.05)
            process.send_signal(signal.SIGKILL)
            process.wait()
            with open(path, encoding="utf-8") as file:
                text = file.read()
            count = re.search(r"count := (\d+);", text).group(1)
            expected = original.replace("count := 0;", f"count := {count};").replace(
                'text := ""', f'text := "saved {count}"')
            if text != expected:
                print(f"broken:\n{text}")
                return
            seen.add(int(count))
    print("whole" if len(seen) > 1 else "it never saved")


main()
