"""Reads frames that the C++ codecs wrote and compares every field. Written from the protocol descriptions with the
struct module only: it shares no table with the C++ code, so a field at a wrong place shows up here.

Usage: independent_reader.py WRITER    (WRITER prints JSON lines {name, hex, fields})
"""
import json
import math
import struct
import subprocess
import sys

# SeaNet, little endian: offset from '@', struct format, field.
HEAD = [(14, "H", "hd_ctrl"), (16, "B", "hd_type"), (17, "I", "tx_n1"), (21, "I", "tx_n2"), (25, "I", "rx_n1"),
        (29, "I", "rx_n2"), (33, "H", "tx_pulse"), (35, "H", "range_scale"), (37, "H", "left_limit"),
        (39, "H", "right_limit"), (41, "B", "ad_span"), (42, "B", "ad_low"), (43, "B", "initial_gain1"),
        (44, "B", "initial_gain2"), (45, "H", "slope1"), (47, "H", "slope2"), (49, "B", "motor_time"),
        (50, "B", "step_size"), (51, "H", "ad_interval"), (53, "H", "bins"), (55, "H", "max_ad_buffer"),
        (57, "H", "lockout"), (59, "H", "minor_axis_direction"), (61, "B", "major_axis_pan"), (62, "B", "ctl2"),
        (63, "H", "scan_z")]
V3B = [(0, "B", "ad_span1"), (1, "B", "ad_span2"), (2, "B", "ad_low1"), (3, "B", "ad_low2"),
       (4, "B", "initial_gain1"), (5, "B", "initial_gain2"), (6, "B", "adc_set_point1"), (7, "B", "adc_set_point2"),
       (8, "H", "adv_slope1"), (10, "H", "adv_slope2"), (12, "H", "slope_delay1"), (14, "H", "slope_delay2")]
# A profiler's commands: the same places, other meanings.
PROFILER = [(offset, fmt, {"ad_span": "ad_threshold", "ad_low": "filt_gain", "initial_gain1": "agc_max",
                           "initial_gain2": "agc_set_point", "ad_interval": "scan_time", "bins": "prf_spl",
                           "max_ad_buffer": "prf_ctl2"}.get(name, name)) for offset, fmt, name in HEAD]
GAINS = [(0, "B", "ad_threshold1"), (1, "B", "ad_threshold2"), (2, "B", "filt_gain1"), (3, "B", "filt_gain2"),
         (4, "B", "agc_max1"), (5, "B", "agc_max2"), (6, "B", "agc_set_point1"), (7, "B", "agc_set_point2"),
         (8, "H", "adv_slope1"), (10, "H", "adv_slope2"), (12, "H", "slope_delay1"), (14, "H", "slope_delay2")]
PORT = ["baud_low", "baud_high", "parity_low", "parity_high", "data_bits_low", "data_bits_high"]


def prefixed(fields, prefix, shift=0):
    return [(offset + shift, fmt, prefix + name) for offset, fmt, name in fields]


PARAMETERS = prefixed(HEAD, "parameters.")
SEANET = {  # name: (id, total bytes or None, fields)
    "ReBoot": (16, 14, []), "SendVersion": (23, 14, []), "SendBBUser": (24, 14, []), "StopAlives": (66, 14, []),
    "SendData": (25, 18, [(13, "I", "time_ms")]),
    "HeadCommand": (19, 66, [(13, "B", "type")] + PARAMETERS),
    "HeadCommandDual": (19, 82, [(13, "B", "type")] + PARAMETERS + prefixed(V3B, "v3b.", 65)),
    "HeadCommandReverse": (19, 15, [(13, "B", "type")]),
    "HeadCommandGain": (19, 31, [(13, "B", "type")] + prefixed(V3B, "v3b.", 14)),
    "Alive": (4, 22, [(13, "B", "will_send"), (14, "I", "time_ms"), (18, "H", "motor_position"),
                      (20, "B", "head_inf")]),
    "VersionData": (1, 25, [(13, "B", "software_version"), (14, "B", "info_bits"), (15, "H", "serial_number"),
                            (17, "I", "program_length"), (21, "H", "checksum"), (23, "B", "node")]),
    "BBUserData": (6, None, [(13, "B", "surface_control"), (14, "B", "reserved14"), (15, "H", "clock"),
                             (17, "H", "length"), (19, "B", "device_marker"), (20, "B", "reserved20"),
                             (21, "4B", "reserved21"), (25, "H", "lan_baud_low"), (27, "H", "lan_baud_high"),
                             (29, "H", "lan_sensitivity_low"), (31, "H", "lan_sensitivity_high"),
                             (33, "H", "lan_timeout")]
                   + [(35 + 2 * i, "H", "a0." + n) for i, n in enumerate(PORT)]
                   + [(47 + 2 * i, "H", "a1." + n) for i, n in enumerate(PORT)]
                   + [(59, "40B", "block1"), (99, "B", "half_duplex"), (100, "46B", "block2"),
                      (146, "B", "half_duplex_dst")]),
    "FpgaCalData": (63, 80, [(13, "66B", "content")]),
    "FpgaVersionData": (57, 28, [(13, "14B", "content")]),
    "HeadData": (2, None, [(13, "H", "total_count"), (15, "B", "device_type"), (16, "B", "head_status"),
                           (17, "B", "sweep_code"), (18, "H", "hd_ctrl"), (20, "H", "range_scale"),
                           (22, "I", "tx_n"), (26, "B", "gain"), (27, "H", "slope"), (29, "B", "ad_span"),
                           (30, "B", "ad_low"), (31, "H", "heading_offset"), (33, "H", "ad_interval"),
                           (35, "H", "left_limit"), (37, "H", "right_limit"), (39, "B", "step_size"),
                           (40, "H", "bearing"), (42, "H", "data_bytes")]),
    "AuxData": (8, None, [(13, "H", "count")]),
    "ProfilerCommand": (19, 82, [(13, "B", "type")] + prefixed(PROFILER, "parameters.")
                        + prefixed(GAINS, "gains.", 65)),
    "ProfilerGainCommand": (19, 31, [(13, "B", "type")] + prefixed(GAINS, "gains.", 14)),
    "ProfilerData": (2, None, [(15, "B", "device_type"), (16, "B", "head_status"), (17, "B", "sweep_code"),
                               (18, "H", "hd_ctrl"), (20, "H", "range_scale"), (22, "I", "tx_n"), (26, "B", "gain"),
                               (27, "H", "slope"), (29, "B", "ad_threshold"), (30, "B", "filt_gain"),
                               (31, "H", "left_limit"), (33, "H", "right_limit"), (35, "B", "step_size"),
                               (36, "H", "scan_time"), (38, "H", "count")]),
}


def read(data, order, fields):
    out = {}
    for offset, fmt, name in fields:
        values = struct.unpack_from(order + fmt, data, offset)
        if fmt.endswith("s"):
            out[name] = values[0].split(b"\0")[0].decode("ascii")
        else:
            out[name] = list(values) if len(fmt) > 1 else values[0]
    return out


def seanet(name, data):
    message_id, total, fields = SEANET[name]
    length = len(data) - 6
    assert data[0:1] == b"@" and data[-1] == 0x0A, "start or end"
    assert data[1:5] == b"%04X" % length and data[5] + 256 * data[6] == length, "length"
    assert data[10] == message_id and data[11] == 0x80, "id or sequence"
    assert total is None or total == len(data), "size"
    command = message_id in (16, 19, 23, 24, 25, 66)
    sonar = 20 if name.startswith("Profiler") else 2
    assert (data[7], data[8], data[12]) == ((255, sonar, sonar) if command else (sonar, 255, sonar)), "nodes"
    assert data[9] == (0 if message_id == 2 else (length - 5) & 0xFF), "byte 9"
    out = read(data, "<", fields)
    if name == "HeadData":
        count = out["data_bytes"]
        assert len(data) == count + 45 and out["total_count"] == count + 31, "Dbytes"
        out["bins"] = list(data[44:44 + count])
    if name == "ProfilerData":
        count = out["count"]
        total = int.from_bytes(data[13:15], "little")
        assert len(data) == 2 * count + 51 == total + 14, "count"
        out["echo_times"] = [int.from_bytes(data[40 + 2 * i:42 + 2 * i], "little") for i in range(count)]
        out["trailer"] = list(data[40 + 2 * count:-1])
    if name == "AuxData":
        assert len(data) == out["count"] + 16, "count"
        out["data"] = list(data[15:-1])
    if name == "BBUserData":
        assert len(data) in (264, 175), "size"
        out["rest"] = list(data[147:-1])
    return out


# R2Sonic, big endian: offset from the start of the section.
H0 = [(4, "12s", "model"), (16, "12s", "serial"), (28, "I", "ping_seconds"), (32, "I", "ping_nanoseconds"),
      (36, "I", "ping_number"), (40, "f", "ping_period"), (44, "f", "sound_speed"), (48, "f", "frequency"),
      (52, "f", "tx_power"), (56, "f", "tx_pulse_width"), (60, "f", "tx_beam_width_vertical"),
      (64, "f", "tx_beam_width_horizontal"), (68, "f", "tx_steering_vertical"), (72, "f", "tx_steering_horizontal"),
      (76, "H", "projector_temperature"), (78, "h", "vtx_offset"), (80, "f", "rx_bandwidth"),
      (84, "f", "rx_sample_rate"), (88, "f", "rx_range"), (92, "f", "rx_gain"), (96, "f", "rx_spreading"),
      (100, "f", "rx_absorption"), (104, "f", "rx_mount_tilt"), (108, "I", "reserved108"),
      (112, "H", "reserved112"), (114, "H", "points")]
STATUS = {  # words are counted by the 4th character of the name
    "SER3": [(4, "12s", "serial")], "PRT3": [(4, "12s", "part")], "MDL3": [(4, "12s", "model")],
    "FWV6": [(4, "24s", "firmware")], "FWT6": [(4, "24s", "firmware")],
    "PRJ9": [(4, "12s", "serial"), (16, "12s", "part"), (28, "12s", "model")], "OPT1": [(4, "I", "options")],
    "SENa": [(4, "I", "gps_seconds"), (8, "I", "gps_fraction"), (12, "f", "pitch"), (16, "f", "roll"),
             (20, "f", "heave"), (24, "f", "heading"), (28, "f", "sound_speed"), (32, "f", "depth_uncalibrated"),
             (36, "f", "depth"), (40, "f", "fpga_temperature")],
    "SEN7": [(4, "I", "gps_seconds"), (8, "I", "gps_fraction"), (12, "f", "pitch"), (16, "f", "roll"),
             (20, "f", "heave"), (24, "f", "reserved"), (28, "f", "sound_speed")],
    "ADC3": [(4, "f", "supply_voltage"), (8, "f", "supply_current"), (12, "f", "transmitter_voltage")],
    "ADC2": [(4, "f", "supply_voltage"), (8, "f", "supply_current")],
    "ETH6": [(4, "I", "link"), (8, "I", "rx_packets"), (12, "I", "tx_packets"), (16, "I", "rx_overflows"),
             (20, "8B", "mac")],
    "TIM2": [(4, "f", "round_trip"), (8, "f", "spare")], "LED1": [(4, "I", "lamps")],
}
PLAIN = {
    "R2DS": (24, [(4, "12s", "serial"), (16, "I", "config_id"), (20, "I", "reserved")]),
    "R2DD": (44, [(4, "I", "gui_ip"), (8, "H", "gui_port"), (10, "H", "reserved10"), (12, "8I", "reserved12")]),
    "R2DI": (72, [(4, "12s", "serial"), (16, "12s", "part"), (28, "12s", "model"), (40, "8I", "reserved")]),
    "R2DC": (164, [(4, "12s", "serial"), (16, "I", "config_id"), (20, "I", "mask"), (24, "I", "gateway"),
                   (28, "I", "gui_ip"), (32, "H", "gui_port"), (34, "H", "system_index"), (36, "4I", "head_ip"),
                   (52, "4H", "head_port"), (60, "4I", "sim_ip"), (76, "4H", "sim_port"), (84, "8I", "daq_ip"),
                   (116, "8H", "daq_port"), (132, "8I", "reserved")]),
}


PARTS = ("M1", "M2", "S1", "D0", "D1")


def part_fields(tag, body):
    """Sections of which a ping has many; their counts stand in themselves."""
    if tag in ("M1", "M2"):
        samples, beams = struct.unpack_from(">H", body, 20)[0], struct.unpack_from(">H", body, 26)[0]
        fields = [(4, "I", "ping_number"), (8, "f", "reserved8"), (12, "I", "total_samples"),
                  (16, "I", "first_sample"), (20, "H", "samples"), (22, "H", "total_beams"), (24, "H", "first_beam"),
                  (26, "H", "beams"), (28, "I", "reserved28"), (32, "I", "reserved32")]
        if tag == "M1":
            return fields + array(36, beams * samples, "H", "data")
        return fields + pairs(36, beams * samples, [("H", "magnitude"), ("h", "phase")])
    if tag == "S1":
        count = struct.unpack_from(">H", body, 10)[0]
        return [(4, "I", "ping_number"), (8, "H", "snippet"), (10, "H", "samples"), (12, "I", "first_sample"),
                (16, "f", "angle"), (20, "f", "scale_first"), (24, "f", "scale_last"),
                (28, "I", "reserved28")] + array(32, count, "H", "magnitude")
    count = struct.unpack_from(">H", body, 16)[0]
    fields = [(4, "I", "ping_number"), (8, "I", "total_samples"), (12, "I", "first_sample"), (16, "H", "samples"),
              (18, "H", "reserved18"), (20, "8f", "scaling")]
    if tag == "D0":
        return fields + pairs(52, count, [("H", "port"), ("H", "starboard")])
    return fields + [(52, "f", "angle_scale")] + pairs(56, count, [("H", "port"), ("h", "port_angle"),
                                                                  ("H", "starboard"), ("h", "starboard_angle")])


def pairs(offset, count, members):
    out = []
    for i in range(count):
        for fmt, name in members:
            out.append((offset, fmt, f"data[{i}].{name}"))
            offset += 2
    return out


def section_fields(tag, n, m0=None):
    more = (4, "6f", "more")
    if tag == "M0":
        beams, bins = m0
        return [(4, "I", "ping_number"), (8, "f", "reserved8"), (12, "I", "total_samples"), (16, "I", "total_bins"),
                (20, "I", "first_bin"), (24, "H", "bins"), (26, "H", "total_beams"), (28, "H", "first_beam"),
                (30, "H", "beams"), (32, "I", "reserved32")] + array(36, beams * bins, "B", "data")
    return {
        "H0": H0,
        "R0": [(4, "f", "scale")] + array(8, n, "H", "r"),
        "A0": [(4, "f", "first"), (8, "f", "last"), (12, "6f", "more")],
        "A2": [(4, "f", "first"), (8, "f", "scale"), (12, "6f", "more")] + array(36, n, "H", "step"),
        "A1": [more] + array(28, n, "f", "angle"),
        "I1": [(4, "f", "scale")] + array(8, n, "H", "intensity"),
        "G0": [(4, "f", "gate_min"), (8, "f", "gate_max"), (12, "f", "slope")],
        "G1": [(4, "f", "scale")] + [(8 + 2 * i + k, "B", f"gate[{i}].{'min' if k == 0 else 'max'}")
                                     for i in range(n) for k in (0, 1)],
        "Q0": array(4, (n + 7) // 8, "I", "flags"),
    }[tag]


def array(offset, count, fmt, name):
    # struct has no empty array; "0B" would do, a count of one must stay a list
    return [(offset, f"{count}{fmt}", name)]


def sections(data):
    assert struct.unpack_from(">I", data, 4)[0] == len(data), "PacketSize"
    out, at, n = {"stream_id": struct.unpack_from(">I", data, 8)[0]}, 12, 0
    while at < len(data):
        tag, size = data[at:at + 2].decode("ascii"), struct.unpack_from(">H", data, at + 2)[0]
        assert size % 4 == 0 and at + size <= len(data), "section size"
        body = data[at:at + size]
        if tag == "H0":
            n = struct.unpack_from(">H", body, 114)[0]
        m0 = struct.unpack_from(">H", body, 30) + struct.unpack_from(">H", body, 24) if tag == "M0" else None
        fields = part_fields(tag, body) if tag in PARTS else section_fields(tag, n, m0)
        if tag == "H0" and size == 140:  # of SNI0 and TPX0
            fields = [(at_, fmt, f"settings.{name}") for at_, fmt, name in H0] + [(116, "6f", "more")]
        used = max([4] + [offset + struct.calcsize(">" + fmt) for offset, fmt, _ in fields])
        assert used <= size < used + 4 and not any(body[used:]), "padding"
        name = tag if tag in ("A0", "A2", "M1", "M2", "D0", "D1") else tag.lower()
        out.update({f"{name}.{k}": v for k, v in read(body, ">", fields).items()})
        at += size
    return out


def status(data):
    assert struct.unpack_from(">I", data, 4)[0] == len(data), "PacketSize"
    out, at = {"stream_id": struct.unpack_from(">I", data, 8)[0]}, 12
    while at < len(data):
        tag = data[at:at + 4].decode("ascii")
        size = 4 + 4 * int(tag[3], 36)
        assert at + size <= len(data), "status section size"
        if tag in STATUS:
            out.update({f"{tag}.{k}": v for k, v in read(data[at:at + size], ">", STATUS[tag]).items()})
        else:
            out[tag] = list(struct.unpack_from(f">{(size - 4) // 4}I", data, at + 4))
        at += size
    return out


def r2sonic(name, data):
    assert data[:4].decode("ascii") == name[:4], "name"
    if name in PLAIN:
        size, fields = PLAIN[name]
        assert len(data) == size, "size"
        return read(data, ">", fields)
    if name == "CMD0":
        assert len(data) % 8 == 4, "size"
        out = {}
        for i in range(len(data) // 8):
            out[f"commands[{i}].name"] = data[4 + 8 * i:8 + 8 * i].decode("ascii")
            out[f"commands[{i}].raw"] = struct.unpack_from(">I", data, 8 + 8 * i)[0]
        return out
    return status(data) if name in ("STH0", "STS0") else sections(data)


def same(a, b):
    if isinstance(a, list):
        return isinstance(b, list) and len(a) == len(b) and all(same(x, y) for x, y in zip(a, b))
    if isinstance(a, float) or isinstance(b, float):
        return math.isclose(a, b, rel_tol=1e-6, abs_tol=1e-12)
    return a == b


def check(line):
    name, data, told = line["name"], bytes.fromhex(line["hex"]), line["fields"]
    found = seanet(name, data) if name in SEANET else r2sonic(name, data)
    told.pop("name", None)  # the packet's own name, compared above
    assert set(found) == set(told), f"fields {set(found) ^ set(told)}"
    wrong = [key for key in found if not same(found[key], told[key])]
    assert not wrong, "; ".join(f"{key}: read {found[key]}, written {told[key]}" for key in wrong)
    return len(found)


def main():
    output = subprocess.run([sys.argv[1]], check=True, capture_output=True, text=True).stdout
    lines = [json.loads(line) for line in output.splitlines()]
    failures, fields, names = [], 0, set()
    for line in lines:
        names.add(line["name"])
        try:
            fields += check(line)
        except (AssertionError, struct.error, KeyError) as error:
            failures.append(f"{line['name']}: {error}\n  {line['hex']}")
    print("\n".join(failures[:10]))
    print(f"{len(lines)} frames of {len(names)} kinds, {fields} fields, {len(failures)} failures")
    return 1 if failures or len(names) < 26 else 0


if __name__ == "__main__":
    sys.exit(main())
