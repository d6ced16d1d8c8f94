"""The messages of EGM (protobuf 2), written and read by hand from the field numbers that controllers use, and a UDP peer."""

import socket
import struct

DATA, CORRECTION, PATH_CORRECTION = 2, 3, 4

VECTOR = {1: "x", 2: "y", 3: "z"}
PLACE = {1: ("joints", {1: "value[]"}), 3: ("externalJoints", {1: "value[]"}), 4: ("time", {1: "sec", 2: "usec"}),
         2: ("cartesian", {1: ("pos", VECTOR), 2: ("orient", {1: "u0", 2: "u1", 3: "u2", 4: "u3"}), 3: ("euler", VECTOR)})}
ROBOT = {1: ("header", {1: "seqno", 2: "tm", 3: "mtype"}), 2: ("feedBack", PLACE), 3: ("planned", PLACE),
         4: ("motorState", {1: "state"}), 5: ("mciState", {1: "state"}), 6: "mciConvergenceMet",
         7: ("testSignals", {1: "value[]"}), 8: ("rapidExecState", {1: "state"}),
         9: ("measuredForce", {1: "fcActive", 2: "value[]"}), 10: "utilizationRate", 11: "moveIndex",
         12: ("collisionInfo", {1: "triggered", 2: "value[]"}), 13: ("rapidFromRobot", {1: "digVal", 2: "value[]"})}


def varint(value):
    out = b""
    while value >= 0x80:
        out += bytes([value & 0x7F | 0x80])
        value >>= 7
    return out + bytes([value])


def real(field, value):
    return bytes([field << 3 | 1]) + struct.pack("<d", value)


def number(field, value):
    return bytes([field << 3]) + varint(value)


def part(field, content):
    return bytes([field << 3 | 2]) + varint(len(content)) + content


def reals(*values):
    """A list of numbers, field 1 each."""
    return b"".join(real(1, value) for value in values)


def record(*values):
    """Numbers in fields 1, 2, 3 ..."""
    return b"".join(real(i + 1, value) for i, value in enumerate(values))


def sensor(joints=None, pos=None, orient=None, euler=None, external=None, mtype=CORRECTION, speed=b"", rapid=b""):
    """An EgmSensor message. `speed`: of part 3, `rapid`: of part 4."""
    pose = (part(1, record(*pos)) if pos is not None else b"") + (part(2, record(*orient)) if orient is not None else b"") + (
        part(3, record(*euler)) if euler is not None else b"")
    planned = (part(1, reals(*joints)) if joints is not None else b"") + (part(2, pose) if pose else b"") + (
        part(3, reals(*external)) if external is not None else b"")
    return part(1, number(3, mtype)) + (part(2, planned) if planned else b"") + (part(3, speed) if speed else b"") + (
        part(4, rapid) if rapid else b"")


def path_correction(*offset):
    """An EgmSensorPathCorr message: mm in path coordinates."""
    return part(1, number(3, PATH_CORRECTION)) + part(2, part(1, record(*offset)) + number(2, 1))


def fields(data):
    """Numbers and contents of the fields of a message: an int, a float or bytes."""
    at = 0

    def read_varint():
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
        tag = read_varint()
        if tag & 7 == 0:
            value = read_varint()
        elif tag & 7 == 1:
            value = struct.unpack("<d", data[at:at + 8])[0]
            at += 8
        else:
            size = read_varint()
            value = data[at:at + size]
            at += size
        yield tag >> 3, value


def read(data, schema=None):
    """The message as a dict by the names of the schema. A field that it does not name is an error."""
    schema = schema if schema is not None else ROBOT
    out = {name[:-2]: [] for name in schema.values() if isinstance(name, str) and name.endswith("[]")}
    for field, value in fields(data):
        name = schema[field]
        if isinstance(name, tuple):
            out[name[0]] = read(value, name[1])
        elif name.endswith("[]"):
            out[name[:-2]].append(value)
        else:
            out[name] = value
    return out


def joints_of(message, place="feedBack"):
    return message[place]["joints"]["value"]


class Peer:
    """A sensor: receives the messages of a controller and answers."""

    def __init__(self, silence=1.5):
        self.socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.socket.bind(("127.0.0.1", 0))
        self.socket.settimeout(30)
        self.silence = silence  # s: then a session is over
        self.robot = None

    @property
    def port(self):
        return self.socket.getsockname()[1]

    def receive(self):
        """The next message; None when none comes."""
        try:
            data, self.robot = self.socket.recvfrom(2000)
        except TimeoutError:
            return None
        self.socket.settimeout(self.silence)
        return read(data)

    def messages(self):
        while (message := self.receive()) is not None:
            yield message

    def send(self, data):
        self.socket.sendto(data, self.robot)
