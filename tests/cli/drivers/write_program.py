"""write_program.py FOLDER: the file that program_file.modx executes."""

import os
import struct
import sys


def numbers(*values):
    return struct.pack("<%df" % len(values), *values)


data = numbers(10) + numbers(7) + b"a_title"
for command, place, fine in ((5, (400, 0, 500), 0), (6, (400, 100, 500), 0), (8, (400, 100, 550), 1)):
    data += numbers(1, command, *place, fine)
data += numbers(2, 0.25)
data += numbers(1, 12, 400, 0, 550, 1)
os.makedirs(sys.argv[1], exist_ok=True)
with open(os.path.join(sys.argv[1], "program.bin"), "wb") as out:
    out.write(data)
