"""partner.py NAME MODULE COMMAND...: runs a command on a copy of the module, and is the UDP partner that guides its robot.

{sio} in the command is a configuration of the device EGMSensor with the port of this partner, {program} the copy. NAME is a
function below. The output of the command follows what it prints, then its exit status.
"""

import math
import os
import socket
import struct
import subprocess
import sys
import tempfile

LIMIT = 30  # s; whatever takes longer hangs
CORRECTION, PATH_CORRECTION = 3, 4


def real(field, value):
    return bytes([field << 3 | 1]) + struct.pack("<d", value)


def message(field, content):
    return bytes([field << 3 | 2, len(content)]) + content


def sensor(joints):
    """An EgmSensor message for these axes, in degrees."""
    planned = message(1, b"".join(real(1, joint) for joint in joints))
    return message(1, bytes([0x18, CORRECTION])) + message(2, planned)


def path_correction(offset):
    """An EgmSensorPathCorr message: mm in path coordinates."""
    position = message(1, b"".join(real(axis + 1, offset[axis]) for axis in range(3)))
    return message(1, bytes([0x18, PATH_CORRECTION])) + message(2, position + bytes([0x10, 1]))


def fields(data):
    """Numbers and contents of the fields of a message: an int, a float or bytes."""
    at = 0

    def varint():
        nonlocal at
        value = shift = 0
        while True:
            byte = data[at]
            at += 1
            value |= (byte & 0x7F) << shift
            shift += 7
            if byte < 0x80:
                return value

    while at < len(data):
        tag = varint()
        if tag & 7 == 0:
            value = varint()
        elif tag & 7 == 1:
            value = struct.unpack("<d", data[at:at + 8])[0]
            at += 8
        else:
            size = varint()
            value = data[at:at + size]
            at += size
        yield tag >> 3, value


def part(data, *path):
    for number in path:
        data = next(value for field, value in fields(data) if field == number)
    return data


def joints_of(data, place):
    return [value for _, value in fields(part(data, place, 1))]


def sine(partner):
    """Lets axis 1 swing by 10 degrees once in two seconds of the robot's time, then stand at 5 degrees."""
    got, reached, numbers, parts = 0, [], [], set()
    while True:
        try:
            data, robot = partner.recvfrom(2000)
        except TimeoutError:
            break
        got += 1
        partner.settimeout(2)
        numbers.append(part(data, 1, 1))
        parts.update(number for number, _ in fields(data))
        reached.append(joints_of(data, 2)[0])
        first = part(data, 1, 2) if got == 1 else first
        seconds = (part(data, 1, 2) - first) / 1000
        wanted = 10 * math.sin(math.pi * seconds) if seconds < 2 else 5
        partner.sendto(sensor([wanted, 0, 0, 0, 30, 0]), robot)
    print("numbered", numbers == list(range(len(numbers))))
    print("all fields", parts == set(range(1, 14)))
    print("swings to", round(max(reached[: 400])), round(min(reached[: 400])) + 0)
    print("ends at", round(reached[-1], 1))


def wave(partner):
    """Corrects the path across by 5 mm, then by 3 mm the other way when the robot is beyond y = 0, and upwards by 2 mm."""
    seen, times = [], []
    while True:
        try:
            data, robot = partner.recvfrom(2000)
        except TimeoutError:
            break
        partner.settimeout(2)
        times.append(part(data, 1, 2))
        place = dict(fields(part(data, 2, 2, 1)))
        seen.append((place[1], place[2], place[3]))
        across = 5 if place[2] < 0 else -3
        partner.sendto(path_correction((100, across, -2)), robot)
    print("each 24 ms", {b - a for a, b in zip(times, times[1:])} == {24})
    first = [x for x, y, z in seen if -25 < y < -5]
    second = [x for x, y, z in seen if 30 < y < 49]
    print("first", round(min(first), 2), round(max(first), 2))
    print("then", round(min(second), 2), round(max(second), 2))
    print("height", round(seen[-1][2], 2))


def main():
    name, module, command = sys.argv[1], sys.argv[2], sys.argv[3:]
    with tempfile.TemporaryDirectory() as folder, socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as partner:
        partner.bind(("127.0.0.1", 0))
        partner.settimeout(LIMIT)
        sio = os.path.join(folder, "SIO.cfg")
        with open(sio, "w", encoding="utf-8") as file:
            file.write('SIO:CFG_1.0:7:0::\n#\nCOM_TRP:\n\n      -Name "EGMSensor" -Type "UDPUC" '
                       f'-RemoteAdress "127.0.0.1" -RemotePortNumber {partner.getsockname()[1]}\n')
        command = [text.replace("{sio}", sio).replace("{program}", module) for text in command]
        with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE) as process:
            globals()[name](partner)
            out, err = process.communicate(timeout=LIMIT)
        print(out.decode(), end="")
        print("status", process.returncode)
        sys.stderr.write(err.decode())


main()
