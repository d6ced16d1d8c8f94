"""stand_ins.py SAMPLE TARGET: copies a sample of a driver and writes modules of our own in the place of the driver's.

Each task gets its entry routine, and the motion task uses every signal, so that the configuration is tried as a whole.
"""

import os
import re
import shutil
import sys


def instances(path, section):
    with open(path, encoding="utf-8") as file:
        text = file.read()
    part = re.search(rf"^{section}:\n(.*?)(^#|\Z)", text, re.MULTILINE | re.DOTALL)
    return [dict(re.findall(r'-(\w+) "([^"]*)"', line)) for line in part[1].split("\n") if line.strip()] if part else []


def main():
    sample, target = sys.argv[1:]
    shutil.copytree(sample, target)
    system = os.path.join(target, "SYS.cfg")
    signals = instances(os.path.join(target, "EIO.cfg"), "EIO_SIGNAL") if os.path.exists(os.path.join(target, "EIO.cfg")) else []
    modules = instances(system, "CAB_TASK_MODULES")
    begins = {}  # file: the task whose entry routine it has
    for task in instances(system, "CAB_TASKS"):
        own = [module for module in modules if module.get("Task") == task["Name"]] or modules
        begins[own[0]["File"]] = task
    for module in modules:
        file = module["File"].split("/")[-1]
        routine = entry_of(begins[module["File"]], signals) if module["File"] in begins else ""
        kind = "(SYSMODULE)" if file.endswith(".sys") else ""
        with open(os.path.join(target, "HOME", file), "w", encoding="utf-8") as out:
            out.write(f"MODULE {file.split('.')[0]}{kind}\n{routine}ENDMODULE\n")


def entry_of(task, signals):
    lines = [f"    TPWrite \"{task['Name']}\";"]
    if task["Name"] == "T_ROB1":
        lines += [f"    IF {read(signal)} = 99 TPWrite \"no\";" for signal in signals]
    return "  PROC " + task.get("Entry", "main") + "()\n" + "\n".join(lines) + "\n    WaitTime 1;\n  ENDPROC\n"


def read(signal):
    function = {"DI": "DInput", "DO": "DOutput", "AO": "AOutput", "GO": "GOutput"}[signal["SignalType"]]
    return f"{function}({signal['Name']})"


main()
