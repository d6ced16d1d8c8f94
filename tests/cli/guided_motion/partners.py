"""The partners of the tests: each takes a Peer, talks with the robot until it is silent, and prints what it saw."""

import math
import socket

import egm
from egm import joints_of, sensor

REST = (0, 0, 0, 0, 30, 0)  # where the arm begins


def axis_1(angle):
    return sensor((angle,) + REST[1:])


def sine(peer):
    """Lets axis 1 swing by 10 degrees once in two seconds of the robot's time, then stay at 5 degrees."""
    reached, numbers = [], []
    for message in peer.messages():
        numbers.append(message["header"]["seqno"])
        reached.append(joints_of(message)[0])
        first = message["header"]["tm"] if len(numbers) == 1 else first
        seconds = (message["header"]["tm"] - first) / 1000
        peer.send(axis_1(10 * math.sin(math.pi * seconds) if seconds < 2 else 5))
    print("numbered", numbers == list(range(len(numbers))))
    print("swings to", round(max(reached[: 400])), round(min(reached[: 400])) + 0)
    print("ends at", round(reached[-1], 1))


def wave(peer):
    """Corrects the path across by 5 mm, then by 3 mm the other way when the robot is beyond y = 0, and upwards by 2 mm."""
    seen, times = [], []
    for message in peer.messages():
        times.append(message["header"]["tm"])
        place = message["feedBack"]["cartesian"]["pos"]
        seen.append((place["x"], place["y"], place["z"]))
        peer.send(egm.path_correction(100, 5 if place["y"] < 0 else -3, -2))
    print("each 24 ms", {b - a for a, b in zip(times, times[1:])} == {24})
    first = [x for x, y, z in seen if -25 < y < -5]
    second = [x for x, y, z in seen if 30 < y < 49]
    print("first", round(min(first), 2), round(max(first), 2))
    print("then", round(min(second), 2), round(max(second), 2))
    print("height", round(seen[-1][2], 2))


def complete(peer):
    """Looks at every field while it streams, guides and streams again."""
    paths, guided, last = None, [], None
    for message in peer.messages():
        seen = set(paths_of(message))
        paths = seen if paths is None else paths & seen
        guided.append((message["mciState"]["state"], message["rapidExecState"]["state"], message["motorState"]["state"]))
        last = message
        for place in ("feedBack", "planned"):
            assert len(joints_of(message, place)) == 6
        turn = message["feedBack"]["cartesian"]
        assert close(from_euler(turn["euler"]), turn["orient"]), turn
        assert 0 <= message["feedBack"]["time"]["usec"] < 1000000 and message["header"]["mtype"] == egm.DATA
        peer.send(axis_1(3))
    print("\n".join(sorted(paths)))
    changes = [guided[0]] + [b for a, b in zip(guided, guided[1:]) if a != b]
    print("guidance, execution, motors", changes)
    print("forces", len(last["measuredForce"]["value"]), "test signals", len(last["testSignals"]["value"]), "moves", last["moveIndex"])


def paths_of(message, before=""):
    for name, value in message.items():
        if isinstance(value, dict):
            yield from paths_of(value, before + name + ".")
        else:
            yield before + name


def from_euler(euler):
    """The quaternion of rotations about z, the new y and the new x."""
    x, y, z = (math.radians(euler[name]) / 2 for name in "xyz")
    cx, sx, cy, sy, cz, sz = math.cos(x), math.sin(x), math.cos(y), math.sin(y), math.cos(z), math.sin(z)
    return (cx * cy * cz + sx * sy * sz, sx * cy * cz - cx * sy * sz, cx * sy * cz + sx * cy * sz, cx * cy * sz - sx * sy * cz)


def close(q, orient):
    r = [orient[name] for name in ("u0", "u1", "u2", "u3")]
    return abs(abs(sum(a * b for a, b in zip(q, r))) - 1) < 1e-9


def sessions(peer):
    """Counts the messages of each session, and looks whether they are numbered from 0 by one."""
    counts, in_order, ports = [], True, set()
    for message in peer.messages():
        ports.add(peer.robot)
        number = message["header"]["seqno"]
        if number == 0:
            counts.append(0)
        in_order = in_order and number == counts[-1]
        counts[-1] += 1
        peer.send(axis_1(0))
    print("sessions", len(counts), "in order", in_order, "none empty", min(counts) > 0, "one port", len(ports) == 1)


def streamed(peer):
    """Answers the first messages of the stream only."""
    for count, _ in enumerate(peer.messages()):
        if 10 <= count < 13:
            peer.send(axis_1(5))


BAD = {
    "no message": b"no message",
    "another type": sensor(REST, mtype=egm.DATA),
    "five joints": sensor(REST[:5]),
    "seven joints": sensor(REST + (0,)),
    "not a number": sensor((math.nan,) + REST[1:]),
    "infinite": sensor(REST, external=(math.inf,)),
    "infinite speed": sensor(REST, speed=egm.part(1, egm.reals(math.inf))),
    "no unit quaternion": sensor(REST, pos=(0, 0, 0), orient=(1, 1, 0, 0)),
}


def junk(peer):
    """Eight bursts of datagrams that cannot be used, each for 200 ms between 400 ms of good ones."""
    kinds, farthest = list(BAD.values()), 0
    for count, message in enumerate(peer.messages()):
        burst, place = divmod(count, 150)
        farthest = max(farthest, abs(joints_of(message)[0] - 2)) if count > 100 else 0
        if place >= 100 and burst < len(kinds):
            peer.send(kinds[burst])
            if place % 10 == 0:
                peer.send(axis_1(2))
        else:
            peer.send(axis_1(2))
    print("stays within", math.ceil(farthest * 10) / 10)


def silent_junk(peer):
    """Answers for 0.4 s, then with datagrams that cannot be used only."""
    times = []
    for message in peer.messages():
        times.append(message["header"]["tm"])
        peer.send(axis_1(2) if times[-1] - times[0] < 400 else BAD["not a number"])
    print("ends after", round((times[-1] - times[0]) / 100) * 100, "ms")


def foreign(peer):
    """The right answers come from elsewhere after 0.4 s."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as other:
        other.bind(("127.0.0.1", 0))
        times, reached = [], 0
        for message in peer.messages():
            times.append(message["header"]["tm"])
            reached = max(reached, joints_of(message)[0])
            if times[-1] - times[0] < 400:
                peer.send(axis_1(2))
            else:
                other.sendto(axis_1(20), peer.robot)
    print("ends after", round((times[-1] - times[0]) / 100) * 100, "ms, not beyond", math.ceil(reached * 10) / 10)


def steps(peer):
    """Asks axis 1 for 8 degrees at once, and looks how long it takes to come there."""
    begin = reached = None
    fastest, before = 0, None
    for message in peer.messages():
        time, angle = message["header"]["tm"], joints_of(message)[0]
        begin = time if begin is None else begin
        if before is not None:
            fastest = max(fastest, (angle - before[1]) / (time - before[0]) * 1000)
        if reached is None and abs(angle - 8) < 0.2:
            reached = time - begin
        before = time, angle
        peer.send(axis_1(8))
    print("reached within 200 ms", reached is not None and reached < 200)
    print("fastest", round(fastest))


def far(peer):
    """Asks axis 1 for 400 degrees."""
    reached = []
    for message in peer.messages():
        reached.append(joints_of(message)[0])
        peer.send(axis_1(400))
    print("goes to", round(max(reached), 1))


def pose(peer):
    """Leads the TCP 20 mm along x of its frame from where it began, turned by 10 degrees about z; then 3 m away for 0.1 s."""
    start, last = None, None
    for message in peer.messages():
        place = message["feedBack"]["cartesian"]
        start = start or (message["header"]["tm"], place)
        pos = [start[1]["pos"][name] for name in "xyz"]
        euler = [start[1]["euler"][name] for name in "xyz"]
        away = 3000 if 800 < message["header"]["tm"] - start[0] < 900 else 20
        peer.send(sensor(pos=(pos[0] + away, pos[1], pos[2]), euler=(euler[0], euler[1], euler[2] + 10)))
        last = place
    print("moved", [round(last["pos"][name] - start[1]["pos"][name], 1) + 0 for name in "xyz"])
    print("turned", [round((last["euler"][name] - start[1]["euler"][name]) % 360, 1) for name in "xyz"])


def singular(peer):
    """Turns the tool by 60 degrees in two seconds, its point at rest, so that axis 5 passes 0 while the tool is turned aside by 1 degree:
    axes 4 and 6 have to turn by about 180 degrees beside the singularity."""
    start, angles, ways, last = None, [], [], None
    for message in peer.messages():
        place = message["feedBack"]["cartesian"]
        pos = [place["pos"][name] for name in "xyz"]
        orient = tuple(place["orient"][name] for name in ("u0", "u1", "u2", "u3"))
        start = start or (message["header"]["tm"], pos, orient)
        seconds = (message["header"]["tm"] - start[0]) / 1000
        angles.append((seconds, joints_of(message)))
        ways.append(math.dist(pos, start[1]))
        tilt = turned(turned(start[2], 1, -min(30 * seconds, 60)), 2, min(seconds, 1))
        last = abs(sum(a * b for a, b in zip(tilt, orient)))
        peer.send(sensor(pos=start[1], orient=tilt))
    steps = [[(b - a) / (later[0] - now[0]) for a, b in zip(now[1], later[1])]
             for now, later in zip(angles, angles[1:]) if later[0] > now[0]]
    print("passed", angles[0][1][4] > 20 and angles[-1][1][4] < -20)
    print("fastest", round(max(abs(speed) for step in steps for speed in step), 1))
    print("away by less than 20 mm", max(ways) < 20)
    print("reached", last > math.cos(math.radians(0.1)) and ways[-1] < 0.1)


def turned(orient, axis, angle):
    """The orientation, turned about an axis of the base (0 to 2), in degrees."""
    half = math.radians(angle) / 2
    a = [math.cos(half), 0, 0, 0]
    a[axis + 1] = math.sin(half)
    b = orient
    return (a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3], a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
            a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1], a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0])


def speed(peer):
    """Sends back where the robot is, with a speed of 50 mm/s along z and 5 degrees/s about it, for a second."""
    seen = []
    for message in peer.messages():
        place = message["feedBack"]["cartesian"]
        seen.append((message["header"]["tm"] / 1000, place["pos"]["z"]))
        pos = [place["pos"][name] for name in "xyz"]
        orient = [place["orient"][name] for name in ("u0", "u1", "u2", "u3")]
        moves = seen[-1][0] - seen[0][0] < 1
        peer.send(sensor(pos=pos, orient=orient, speed=egm.part(2, egm.reals(0, 0, 50 if moves else 0, 0, 0, 5 if moves else 0))))
    middle = [entry for entry in seen if 0.4 < entry[0] - seen[0][0] < 0.9]
    print("speed", round((middle[-1][1] - middle[0][1]) / (middle[-1][0] - middle[0][0])))


def stopped(peer):
    """The program is stopped and started again meanwhile: messages continue, and the robot is at rest."""
    seen = []
    for message in peer.messages():
        time = message["header"]["tm"]
        seen.append((time, message["rapidExecState"]["state"], message["motorState"]["state"], joints_of(message)[0]))
        peer.send(axis_1(40))
    states = [seen[0][1:3]] + [b[1:3] for a, b in zip(seen, seen[1:]) if a[1] != b[1]]
    print("execution and motors", states)
    print("each 4 ms", {b[0] - a[0] for a, b in zip(seen, seen[1:])} == {4})
    standing = [angle for time, state, motors, angle in seen if state == 1][50:]
    print("at rest", len(standing) > 50 and max(standing) - min(standing) < 1e-9)
    print("moves on", seen[-1][3] > standing[-1] + 1)


def seven(peer):
    """Axis 7 of the arm is the first external joint."""
    last = None
    for message in peer.messages():
        last = message["feedBack"]
        peer.send(sensor(REST, external=(12,)))
    print("joints", [round(v, 1) + 0 for v in last["joints"]["value"]], "external", [round(v, 1) + 0 for v in last["externalJoints"]["value"]])


def numbers(peer):
    """Data for RAPID without a target, then a target without data."""
    got = []
    for count, message in enumerate(peer.messages()):
        data = message["rapidFromRobot"]
        got.append((data["digVal"], data["value"]))
        if count < 100:
            peer.send(sensor(rapid=egm.number(1, 1) + egm.real(2, 7) + egm.real(2, 8.5)))
        else:
            peer.send(axis_1(4))
    print("from RAPID", got[0], got[-1])


def ramp(peer):
    """Leads axis 1 to 30 degrees and answers until the robot is back."""
    most = last = 0
    for message in peer.messages():
        last = joints_of(message)[0]
        most = max(most, last)
        peer.send(axis_1(30))
    print("to", round(most), "and back at", round(last, 1) + 0)


def quiet(peer):
    """Never answers."""
    print("messages came", sum(1 for _ in peer.messages()) > 100)
