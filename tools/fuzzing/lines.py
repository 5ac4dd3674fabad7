"""Lines of text for readers of it, and messages of MAVLink, ROS 1 and Gazebo, which tell poses, too."""
import pathlib
import re
import struct

ROOT = pathlib.Path(__file__).resolve().parents[2]


def checksum_x25(data, seed):
    value = 0xFFFF
    for byte in data + bytes([seed]):
        value ^= byte
        for _ in range(8):
            value = value >> 1 ^ (0x8408 if value & 1 else 0)
    return value


def mavlink(message, payload, seed, version=2):
    """Frames of common.xml and ardupilotmega.xml: numbers and seeds are published with them."""
    head = struct.pack("<BBBBBBHB", len(payload), 0, 0, 1, 1, 1, message & 0xFFFF, message >> 16) if version == 2 \
        else struct.pack("<BBBBB", len(payload), 1, 1, 1, message)
    return bytes([0xFD if version == 2 else 0xFE]) + head + payload + struct.pack("<H", checksum_x25(head + payload, seed))


def mavlink_messages():
    yield 0, 30, struct.pack("<I6f", 1500, 0.1, 0.2, 3, 0, 0, 0), 39
    yield 1, 31, struct.pack("<I7f", 1500, 1, 0, 0, 0, 0, 0, 0), 246
    yield 2, 32, struct.pack("<I6f", 1500, 1, 2, 3, 0, 0, 0), 185
    yield 3, 33, struct.pack("<I4i3hH", 1500, 473977418, 85455939, 488000, 0, 0, 0, 0, 65535), 104
    yield 4, 108, struct.pack("<21f", 1, *[0] * 9, 1, 2, 3, 47, 8, 100, *[0] * 5), 32
    yield 5, 331, struct.pack("<Q13f42fBB", 1500, 1, 2, 3, 1, *[0] * 9, *[0] * 42, 20, 1), 91


def lines():
    source = (ROOT / "emulator" / "scenario" / "fault_kinds.h").read_text()
    kinds = re.findall(r"\w+", source[source.index("enum class FaultKind {") + 22:].split("}")[0])
    for kind in kinds:
        yield "control", kind, (f'{{"fault": {{"device": "b", "kind": "{kind}"}}}}\n'
                                f'{{"fault": {{"device": "a", "kind": "{kind}", "for": 2}}}}\n')
        yield "fault_answers", kind, (f'{{"ok":true,"t":1.5,"faults":[{{"id":1,"device":"a","kind":"{kind}","rate":0.5,"from":1,'
                                      f'"on":true,"made":3}}]}}\n')
    yield "control", "others", '{"list": true}\n{"status": true}\n{"clear": 3}\n{"clear": "all"}\n'
    for name, text in (("id", '{"ok":true,"id":4}'), ("cleared", '{"ok":true,"cleared":2}'), ("none", '{"ok":true,"t":1,"faults":[]}'),
                       ("refused", '{"ok":false,"error":"no JSON: line 1"}'), ("welcome", '{"ok":true}\n{"ok":true,"id":1}'),
                       ("status", '{"ok":true,"t":1,"devices":[{"name":"a","pings":3,"connected":true,"faults":{"loss":2}}]}')):
        yield "fault_answers", name, text + "\n"
    token = "0123456789abcdef" * 2
    for name, text in (("right", f'{{"token": "{token}"}}'), ("wrong", '{"token": "0"}'), ("none", '{"list": true}')):
        yield "token", name, text
    own = '{"t": 1.5, "position": [1, 2, -3], "orientation": [1, 0, 0, 0], "object": "a"}\n{"now": 2}\n'
    yield "pose", "own", "@" + own
    yield "pose", "ardupilot", '@{"timestamp": 1.5, "position": [1, 2, 3], "attitude": [0.1, 0.2, 3], "rpy_deg": [1, 2, 3]}\n'
    yield "pose", "csv", "\x01t,x,y,z,qw,qx,qy,qz\n0,1,2,3,1,0,0,0\n1,1,2,4,0,1,0,0\n"
    yield "pose", "tum", "\x01# TUM\n0 1 2 3 0 0 0 1\n1.5 2 2 3 0 0 1 0\n"
    yield "steps", "own", "@" + own + '{"now": 2.5}\n{"now": 2.5}\n{"now": 1}\n{"now": 1e9}\n'
    yield "steps", "web", "@POST / HTTP/1.1\r\n\r\n" + own
    yield "steps", "burst", "\x02" + "".join(f'{{"now": {n / 10}, "position": [1, 2, {n}], "rpy_deg": [0, 0, {n}]}}\n' for n in range(9))
    for number, text in enumerate(("water.temperature=4", "devices.a.options.gain=50", "devices.0.endpoints=[pty:/tmp/a]",
                                   "vehicle.pose={position: [0, 0, -3]}", "peers=[192.168.2.0/24]", "clock={mode: stepped}",
                                   "faults=[{device: a, kind: loss, rate: 0.5}]", "effects.multipath=off", "seed=2")):
        yield "set", str(number), text + "\nseed=1\n"
    for number, text in enumerate(("pty:/tmp/echoloop/a?usb_latency=16&group=dialout", "serial:///dev/ttyUSB0:115200", "tcp://localhost:9",
                                   "tcp-listen://127.0.0.1:9090?idle=10", "udp://10.0.0.255:65400?local_port=65502", "unix:/tmp/c",
                                   "udp-listen://0.0.0.0:0", "192.168.2.0/24", "10.1.2.3", "255.255.255.255/32")):
        yield "places", str(number), text
    body = '"position": {"x": 1, "y": 2, "z": 3}, "orientation": {"x": 0, "y": 0, "z": 0, "w": 1}'
    stamp = '"header": {"frame_id": "map", "stamp": {"sec": 1, "nanosec": 5}}'
    for name, message in (("odometry", f'{{{stamp}, "child_frame_id": "base_link", "pose": {{"pose": {{{body}}}}}}}'),
                          ("stamped", f'{{{stamp}, "pose": {{{body}}}}}'), ("pose", f"{{{body}}}"),
                          ("clock", '{"clock": {"secs": 1, "nsecs": 5}}'),
                          ("tf", f'{{"transforms": [{{{stamp}, "child_frame_id": "a", "transform": {{"translation": {{"x": 1, "y": 2, '
                                 f'"z": 3}}, "rotation": {{"x": 0, "y": 0, "z": 0, "w": 1}}}}}}]}}')):
        yield "poses_rosbridge", name, f'{{"op": "publish", "topic": "/a", "msg": {message}}}'
    yield "poses_rosbridge", "status", '{"op": "status", "level": "error", "msg": "no"}'
    yield "poses_truth", "header", '{"echoloop_truth": 1}'
    shot = '"pan": 0.5, "tilt": -0.2, "beam_width": 0.02, "first_bin_time": 0, "bin_interval": 3e-5, "bins": 100'
    yield "poses_truth", "ping", (
        f'{{"device": "a", "unix": 1.7e9, "sound_speed": 1500, "world_from_sonar": {{"position": [1, 2, -5], '
        f'"orientation": [1, 0, 0, 0]}}, "shot": {{{shot}}}, "beams": [-0.5, 0.5], "rows": [0, 0.1], '
        f'"axis_range": [1, null, 2, 2.2], "objects": [[[1, 40, 20]], [], [[2, 0, 3], [1, 50, 9]], []]}}')


def ros1(text="map", child=""):
    """A header, and what most messages hold behind it: numbers little-endian, texts behind their length."""
    head = struct.pack("<III", 1, 12, 500) + struct.pack("<I", len(text)) + text.encode()
    return head + (struct.pack("<I", len(child)) + child.encode() if child else "".encode())


def poses():
    body = struct.pack("<7d", 1, 2, 3, 0, 0, 0, 1)
    covariance = bytes(36 * 8)
    transform = ros1(child="base_link") + body
    types = [ros1(child="base_link") + body + covariance + bytes(48) + covariance, body, ros1() + body, ros1() + body + covariance,
             struct.pack("<I", 1) + transform, transform, struct.pack("<II", 12, 500)]
    for number, message in enumerate(types):
        yield "poses_ros1", str(number), bytes([number]) + message

    def field(number, value):  # of protobuf, length-delimited
        return bytes([number << 3 | 2, len(value)]) + value

    def doubles(*values):
        return b"".join(bytes([number + 1 << 3 | 1]) + struct.pack("<d", value) for number, value in enumerate(values))
    time = b"\x08\x0c\x10\x05"
    pose = field(1, field(1, time)) + field(2, b"boat") + b"\x18\x07" + field(4, doubles(1, 2, 3)) + field(5, doubles(0, 0, 0, 1))
    for number, message in enumerate((pose, field(1, field(1, time)) + field(2, pose[:100]), field(1, field(1, time)) + field(2, pose),
                                      field(1, field(1, time)) + field(4, time) + field(3, time), field(4, time) + field(2, time))):
        yield "poses_gz", str(number), bytes([number]) + message
