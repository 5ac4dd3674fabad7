"""Bytes of Blueprint Oculus messages to values and back, from the protocol's description. It opens no socket."""

import math
import struct

MAGIC = 0x4F53
FIRE, RESULT, DUMMY = 0x15, 0x23, 0xFF
HEADER = struct.Struct("<HHHHHIH")
SETTINGS = struct.Struct("<BBBBBdddd")
STATUS = struct.Struct("<IHHI6I4s4s4s6s8dd")
LOW, HIGH = 1, 2
RATES = {10: 0, 15: 1, 40: 2, 5: 3, 2: 4, 0: 5}
METRES, BITS16, GAIN_WORDS, SIMPLE, ASSIST, BEAMS512 = 1, 2, 4, 8, 16, 64
BITS32 = 0x200
LARGEST_MESSAGE = 8 << 20

# Behind the echo of the settings: name and format, in their order.
RESULT_V1 = struct.Struct("<II dddd I B d HH III".replace(" ", ""))
NAMES_V1 = (
    "ping status frequency temperature pressure sound_speed start data_size resolution ranges beams"
    " image_offset image_size message_size"
).split()
RESULT_V2 = struct.Struct("<II ddd ddd d d B d HH 4I III".replace(" ", ""))
NAMES_V2 = (
    "ping status frequency temperature pressure heading pitch roll sound_speed start data_size resolution ranges"
    " beams spare0 spare1 spare2 spare3 image_offset image_size message_size"
).split()


def fire(version=1, mode=LOW, rate=0, speed=0xFF, gamma=127, flags=METRES | SIMPLE, range=10.0, gain=50.0,
         sound_speed=0.0, salinity=0.0, ext_flags=0, sized=True):
    """A fire message of version 1 (53 bytes) or 2 (89 bytes). Hosts on the maker's own client do not tell its size."""
    payload = SETTINGS.pack(mode, rate, speed, gamma, flags, range, gain, sound_speed, salinity)
    if version == 2:
        payload += struct.pack("<9I", ext_flags, *[0] * 8)
    return HEADER.pack(MAGIC, 0, 0, FIRE, 2 if version == 2 else 0, len(payload) if sized else 0, 0) + payload


def read_header(data):
    """{source, id, version, size}, or None where no header stands. `size` is that of the payload."""
    magic, source, _, ident, version, size, _ = HEADER.unpack_from(data)
    if magic != MAGIC or size > LARGEST_MESSAGE:
        return None
    return {"source": source, "id": ident, "version": version, "size": size}


def read_status(data):
    """(values, faults) of a status datagram; values are None unless it has its 142 bytes."""
    if len(data) != 142:
        return None, [f"status of {len(data)} bytes"]
    header = read_header(data)
    if header is None:
        return None, ["no header in the status"]
    fields = STATUS.unpack_from(data, 16)
    value = {
        "id": fields[0],
        "type": fields[1],
        "part": fields[2],
        "bits": fields[3],
        "ip": ".".join(map(str, fields[10])),
        "mask": ".".join(map(str, fields[11])),
        "client": ".".join(map(str, fields[12])),
        "temperatures": fields[14:22],
        "pressure": fields[22],
    }
    faults = []
    if header["source"] != value["id"]:
        faults.append(f"source {header['source']} in the header, device id {value['id']}")
    if header["size"] != 126:
        faults.append(f"payload size {header['size']} in the status")
    if value["bits"] & 7 != 3:
        faults.append(f"state {value['bits'] & 7} is not the main program")
    return value, faults


class Ping:
    """A result: `settings` as echoed, the fields by name as attributes, bearings in degrees, and the image."""

    def __init__(self, version, settings, fields, bearings, image):
        self.version, self.settings, self.bearings, self.image = version, settings, bearings, image
        self.__dict__.update(fields)
        self.sample_bytes = self.data_size + 1
        self.has_gains = bool(settings["flags"] & GAIN_WORDS)
        self.row_bytes = self.beams * self.sample_bytes + 4 * self.has_gains

    def gain(self, row):
        """The gain word: amplitude = sample / sqrt(gain)."""
        return struct.unpack_from("<I", self.image, row * self.row_bytes)[0]

    def row(self, row):
        """Samples of all beams, port to starboard."""
        at = row * self.row_bytes + 4 * self.has_gains
        code = {1: "B", 2: "H", 4: "I"}[self.sample_bytes]
        return struct.unpack_from(f"<{self.beams}{code}", self.image, at)

    def beam(self, degrees):
        """Index of the beam nearest to a bearing."""
        return min(range(self.beams), key=lambda i: abs(self.bearings[i] - degrees))

    def column(self, beam):
        return [self.row(row)[beam] for row in range(self.ranges)]

    def metres(self, row):
        return (row + 0.5) * self.resolution


def read_result(data):
    """(Ping, faults) of a whole message; the Ping is None where the sizes do not hold together."""
    header = read_header(data)
    version = 2 if header["version"] == 2 else 1
    fields, names, at = (RESULT_V2, NAMES_V2, 89) if version == 2 else (RESULT_V1, NAMES_V1, 53)
    if len(data) < at + fields.size:
        return None, [f"result of {len(data)} bytes"]
    names = dict(zip(names, fields.unpack_from(data, at)))
    settings = dict(
        zip("mode rate speed gamma flags range gain sound_speed salinity".split(), SETTINGS.unpack_from(data, 16))
    )
    end = at + fields.size + 2 * names["beams"]
    per_sample = names["data_size"] + 1
    size = names["ranges"] * (names["beams"] * per_sample + (4 if settings["flags"] & GAIN_WORDS else 0))
    offset = names["image_offset"]
    faults = []
    if names["image_size"] != size:
        faults.append(f"image of {names['image_size']} bytes, rows and beams ask for {size}")
    if names["message_size"] != len(data):
        faults.append(f"message size {names['message_size']} in {len(data)} bytes")
    if offset < end or offset + size > len(data):
        return None, faults + [f"image at {offset} of {len(data)} bytes, bearings end at {end}"]
    bearings = struct.unpack_from(f"<{names['beams']}h", data, at + fields.size)
    if any(a >= b for a, b in zip(bearings, bearings[1:])):
        faults.append("bearings do not ascend")
    sines = [math.sin(math.radians(b / 100)) for b in bearings]
    even = [sines[0] + (sines[-1] - sines[0]) * i / (len(sines) - 1) for i in range(len(sines))]
    if max(abs(a - b) for a, b in zip(sines, even)) > math.radians(0.011):
        faults.append("bearings are not evenly spaced in sine")
    return Ping(version, settings, names, [b / 100 for b in bearings], data[offset : offset + size]), faults
