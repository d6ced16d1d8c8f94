"""error_loops.py RAPIDC MODULE WAY...: these endless loops of errors end at --max-time, with a short log in order of time.

A way that ends with s is run in the stepping profile, one that ends with b as an executable.
"""

import json
import os
import subprocess
import sys
import tempfile

SECONDS = {10: 40}  # virtual; else 2
MOST_BYTES = {10: 100_000_000}


def judge(way, done, events_path):
    if done.returncode != 4:
        return f"status {done.returncode}\n{done.stderr.decode('utf-8', 'replace')[:2000]}"
    if os.path.getsize(events_path) > MOST_BYTES.get(way, 100_000) or len(done.stderr) > 10_000_000:
        return "the log is not bounded"
    with open(events_path, encoding="utf-8") as file:
        events = [json.loads(line) for line in file]
    times = [event["time"] for event in events]
    if times != sorted(times) or any(event.get("since", 0) > event["time"] for event in events):
        return "the log is not in order of time"
    if way in (1, 2, 3, 5, 6, 9):
        handled = sum(event.get("count", 1) for event in events if event["number"] == 40901)
        if handled < 2000 or b"(x " not in done.stderr:  # 15 instructions in a millisecond
            return f"{handled} errors were handled"
    if way == 10:
        text = done.stderr.decode()
        if events[-1]["number"] != 20906 or "were not written" not in text:
            return "the log does not say how many events it leaves out"
        if events[-2]["number"] != 20901 or "Time limit reached" not in text:
            return "what ended the run is left out"
    return ""


def main():
    rapidc, module, ways = sys.argv[1], sys.argv[2], sys.argv[3:]
    with open(module, encoding="utf-8") as file:
        source = file.read()
    fine = True
    with tempfile.TemporaryDirectory() as folder:
        path, events = os.path.join(folder, "loop.modx"), os.path.join(folder, "events.jsonl")
        for word in ways:
            way = int(word.rstrip("sb"))
            with open(path, "w", encoding="utf-8") as file:
                file.write(source.replace("VAR intnum tick;", f"CONST num way := {way};"))
            command = [rapidc, "run", *(["--stepping"] if word.endswith("s") else []), path]
            if word.endswith("b"):
                command = [os.path.join(folder, "loop")]
                subprocess.run([rapidc, "build", path, "-o", command[0]], check=True, stderr=subprocess.DEVNULL)
            command += [f"--max-time={SECONDS.get(way, 2)}", "--events=" + events]
            done = subprocess.run(command, capture_output=True, timeout=60, check=False)
            problem = judge(way, done, events)
            fine = fine and not problem
            if problem:
                print(f"way {word}: {problem}")
    print("fine" if fine else "")


main()
