"""What a SeaNet reply must look like, as lists of faults in words; an empty list means that all is well."""

import seanet_wire as wire

SWEEP_CODES = (0, 1, 2, 5)


def frame_faults(frame):
    """Faults of the 13-byte header and of the sizes that the message id fixes."""
    raw = frame.raw
    expected = {
        7: ("sender", wire.IMAGING_NODE),
        8: ("receiver", wire.HOST_NODE),
        11: ("sequence", 0x80),
        12: ("node copy", wire.IMAGING_NODE),
        9: ("byte count", 0 if frame.message == wire.HEAD_DATA else (len(raw) - 11) & 0xFF),
    }
    faults = [
        f"{name} at {at} is {raw[at]:#04x}, not {value:#04x}"
        for at, (name, value) in expected.items()
        if raw[at] != value
    ]
    size = wire.FIXED_SIZES.get(frame.message)
    if size is not None and len(raw) != size:
        faults.append(f"{frame.name} has {len(raw)} bytes, not {size}")
    return faults


def alive_faults(alive):
    """Faults of an mtAlive."""
    faults = []
    if alive.params_byte not in (0x00, 0x80):
        faults.append(f"parameters byte {alive.params_byte:#04x}")
    if alive.position > 6399:
        faults.append(f"position {alive.position}")
    if alive.has(wire.IN_CENTRE, wire.CENTRED):
        faults.append(f"both InCentre and Centred in {alive.head_inf:#04x}")
    if alive.params_byte == 0 and alive.has(wire.NO_PARAMS):
        faults.append(f"parameters byte 0 but NoParams in {alive.head_inf:#04x}")
    return faults


def line_faults(line, command, device_type=0x11):
    """Faults of one HeadData against the HeadCommand in force: every echoed field, status and sizes."""
    same = ("control", "range_scale", "ad_span", "ad_low", "ad_interval", "left", "right", "step")
    faults = [
        f"{name} is {getattr(line, name)}, sent {getattr(command, name)}"
        for name in same
        if getattr(line, name) != getattr(command, name)
    ]
    wanted = {
        "tx_number": command.tx_number[0],
        "gain": command.gain[0],
        "data_bytes": command.data_bytes(),
        "heading_offset": 0,
        "device_type": device_type,
    }
    faults += [
        f"{name} is {getattr(line, name)}, not {value}"
        for name, value in wanted.items()
        if getattr(line, name) != value
    ]
    if line.head_status != (0x10 if command.control & wire.ADC8ON else 0):
        faults.append(f"head status {line.head_status:#04x}")
    if line.sweep not in SWEEP_CODES:
        faults.append(f"sweep code {line.sweep}")
    if line.bearing > 6399:
        faults.append(f"bearing {line.bearing}")
    if not command.control & wire.ADC8ON and command.bins % 2 and line.levels and line.levels[-1]:
        faults.append("the nibble after the last bin is not 0")
    return faults


def is_jump(line, previous, command):
    """True when `line` is not one step from `previous`, nor cut at a limit of the sector, nor inside it.

    The direction is not judged: scanright, invert and reversals make it the scenario's business.
    """
    sector = not command.control & wire.CONTINUOUS and command.left != command.right
    if sector and (line.bearing - command.left) % 6400 > (command.right - command.left) % 6400:
        return True
    if previous is None:
        return False
    moved = (line.bearing - previous.bearing) % 6400
    if moved in (command.step, 6400 - command.step):
        return False
    at_limit = sector and line.bearing in (command.left % 6400, command.right % 6400)
    return not (at_limit and min(moved, 6400 - moved) < command.step)
