"""address_space.py MB COMMAND [ARGUMENTS]: runs rapidc on a small or a very large module with so much address space and
says how it ended. `{large}` stands for the large module."""

import resource
import subprocess
import sys
import tempfile

LIMIT = int(sys.argv[1]) << 20


def write_large(path):
    with open(path, "w", encoding="utf-8") as file:
        file.write("MODULE Large\n")
        for i in range(120000):
            file.write(f"  VAR num v{i}:={i};\n")
        file.write("  PROC main()\n")
        for i in range(120000):
            file.write(f"    v{i}:=v{i}*2+reg1*(v{i}-{i});\n")
        file.write("  ENDPROC\nENDMODULE\n")


with tempfile.TemporaryDirectory() as folder:
    large = folder + "/large.modx"
    command = [word.replace("{large}", large).replace("{out}", folder + "/out") for word in sys.argv[2:]]
    if command != sys.argv[2:]:
        write_large(large)
    done = subprocess.run(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, timeout=100, check=False,
                          preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (LIMIT, LIMIT)))
lines = done.stderr.strip().splitlines()
if done.returncode == 5 and lines and "out of memory" in lines[-1]:
    print("out of memory")
elif done.returncode == 0:
    print("enough memory")
else:
    print("status", done.returncode, done.stderr[-300:])
