"""What drivers say to each model, in literal bytes: what starts it, some settings, what it does not know, what is damaged.
Everything is said between two steps, one word a step."""

import struct

import aris_wire
import cerulean_wire
import deltat_wire
import imagenex_wire
import oculus_wire
import r2sonic_control
import reson_wire
import seanet_profiler
import seanet_wire
import surveyor_wire
from place import ROOT

SILENCE = None


def golden(name):
    """Of tests/data, as in "ping/set_range"."""
    lines = (ROOT / "tests" / "data" / f"{name}.hex").read_text().splitlines()
    return bytes.fromhex("".join(line.split("#")[0] for line in lines if not line.startswith(("message", "field"))))


def damaged(data):
    """Its last byte but one is wrong."""
    return data[:-2] + bytes([data[-2] ^ 0x55]) + data[-1:]


def on(port, *words):
    return [(port, word) if word else SILENCE for word in words]


def br(number, form="", *values, to=1):
    """A message of the Ping protocol."""
    payload = struct.pack("<" + form, *values)
    data = b"BR" + struct.pack("<HHBB", len(payload), number, 0, to) + payload
    return data + struct.pack("<H", sum(data) & 0xFFFF)


def ping1d(port="line"):
    asked = [br(6, "H", number) for number in (4, 5, *range(1200, 1208), 1211, 1212, 1213, 1214, 1215, 1300)]
    return on(
        port, None, *asked, br(1001, "II", 500, 4000), br(1300), br(1002, "I", 1480000), br(1003, "B", 0),
        br(1001, "II", 300, 6000), br(1300), br(1005, "B", 5), br(1300), br(1004, "H", 150), br(1400, "H", 1300), None, None,
        br(1401, "H", 1300), br(1007, "H", 100), br(1300), br(1000, "B", 9), br(100, "B", 7), br(1006, "B", 0), br(1212),
        br(1006, "B", 1), damaged(br(1300)), br(9999, "I", 1), br(1001, "I", 7), b"noise" + br(1212), br(1400, "H", 1211), None,
        br(1100), None,
    )  # fmt: skip


def transducer(angle, samples=400, mode=1, gain=1, duration=20, period=800, frequency=750, transmit=1):
    return br(2601, "BBHHHHHBB", mode, gain, angle, duration, period, frequency, samples, transmit, 0)


def ping360(port="line"):
    scan = [transducer(angle) for angle in (0, 1, 2, 30, 199, 399)]
    auto = br(2602, "BBHHHHHHBB", 1, 2, 32, 800, 740, 300, 10, 60, 5, 0)
    return on(
        port, br(6, "H", 4), br(6, "H", 5), *scan, transducer(50, 800), transducer(51, gain=2), transducer(52, period=1200),
        transducer(53, duration=100), transducer(54, frequency=650), transducer(55, mode=0), transducer(56, transmit=0), br(2300),
        auto, None, None, transducer(60), br(2000, "BB", 5, 0), transducer(700), transducer(61, samples=3000), transducer(61, samples=1200, period=400),
        damaged(transducer(62)), br(9999, "I", 1), br(2601, "I", 7), br(2903), transducer(63), br(2600, "BB", 0, 0), None,
        transducer(64),
    )  # fmt: skip


def seanet(port="line", older=False):
    """A scanning head: power-up as it is, then commands and lines."""
    both = {"tx_number": (0x02999999, 0x05666666), "rx_number": (0x063D70A3, 0x090A3D70), "slope": (90, 125)} if older else {}
    command = lambda **changes: seanet_wire.HeadCommand(**{**both, **changes}).encode()  # noqa: E731
    ask = seanet_wire.send_data()
    block = bytes([255, 200, 0, 20, 100, 120, 90, 110]) + struct.pack("<4H", 100, 120, 0, 0)
    usual = seanet_wire.USUAL_CONTROL
    settings = [
        command(), command(bins=400, ad_interval=40), command(gain=(160, 60)), command(control=usual | 4),
        command(left=100, right=900, step=16), command(control=usual | 0x87), command(control=usual | 0x807), command(v3b=block),
        command(ad_span=60, ad_low=30, control=usual | 6), seanet_wire.gain_block(100, 20, 150), seanet_wire.reverse_scan(),
    ]  # fmt: skip
    words = on(port, None, seanet_wire.build(seanet_wire.SEND_VERSION), seanet_wire.build(seanet_wire.SEND_BB_USER), *[None] * 14)
    for word in settings:
        words += on(port, word, ask, None, ask)
    rest = (damaged(ask)[:-1], ask, seanet_wire.build(99, b"abc"), seanet_wire.build(seanet_wire.STOP_ALIVES), None, ask,
            seanet_wire.build(seanet_wire.REBOOT), *[None] * 5)
    return words + on(port, *rest)


def profiler(port="line"):
    ask = seanet_wire.build(seanet_wire.SEND_DATA, struct.pack("<I", 0), node=seanet_profiler.NODE)
    block = struct.pack("<B8B4H", 0x1E, 60, 70, 1, 20, 110, 120, 100, 110, 110, 150, 0, 0)
    words = on(port, None, seanet_wire.build(seanet_wire.SEND_VERSION, node=20), seanet_wire.build(seanet_wire.SEND_BB_USER, node=20),
               *[None] * 14)  # fmt: skip
    usual = {"left": 3000, "right": 3400, "range": 6.0}
    for change in ({}, {"step": 16}, {"mode": "first"}, {"mode": "normal", "threshold": 90}, {"gain": 160}, {"alternate": False}):
        words += on(port, seanet_profiler.Command(**{**usual, **change}).encode(), ask, None, None, ask, None, None)
    gain = seanet_wire.build(seanet_wire.HEAD_COMMAND, block, node=20)
    return words + on(port, gain, ask, None, None, damaged(ask)[:-1], seanet_wire.build(99, node=20), ask, None, None)


def imagenex_881a(port="line"):
    command = imagenex_wire.command
    changes = ({}, {}, {"range": 5}, {"gain": 30}, {"points": 25}, {"bits": 4}, {"bits": 16}, {"pulse": 20}, {"logf": 3},
               {"absorption": 100}, {"step": 8}, {"sector": 20, "train": 70}, {"motion": 0x40}, {"least": 10}, {"frequency": 60},
               {"profile": 1}, {"calibrate": 1}, {"delay": 30}, {"mode": 0x40}, {"range": 250}, {"head_id": 0x12}, {"baud": 11})  # fmt: skip
    words = on(port, *[command(**change) for change in changes])
    return words + on(port, command()[:20], command(), golden("imagenex/azimuth_command"), command()[:-1] + b"\xfd\xfd", command(), None)


def imagenex_852(port="line"):
    command = imagenex_wire.sounder_command
    changes = ({}, {}, {"range": 20}, {"gain": 30}, {"points": 25}, {"pulse": 200}, {"absorption": 100}, {"least": 10}, {"profile": 1},
               {"delay": 30}, {"mode": 0x40}, {"range": 250}, {"head_id": 0x12}, {"range": 30, "gain": 20})  # fmt: skip
    return on(port, *[command(**change) for change in changes], command()[:20], command(), command(), None)


def deltat(port="83P"):
    control = deltat_wire.control
    changes = ({"range": 30}, {"gain": 9}, {"sector": 60}, {"sector": 30, "beam_width": 2}, {"beams": 480}, {"beams": 120},
               {"averaging": 3}, {"sound_speed": 1450.0}, {"sound_speed": 1470.0, "little": True}, {"mode": 1}, {"minimum_range": 12},
               {"tilt": 10}, {"roll_compensation": 1}, {"receive_only": 1}, {"external": 0, "range": 10})  # fmt: skip
    bad = bytearray(control())
    bad[7] = 99
    return on(port, None, *[control(**change) for change in changes], control()[:100], bytes(bad), b"XX" + control()[2:], control(), None)


def oculus(data="data"):
    fire = oculus_wire.fire
    usual = {"range": 6.0, "rate": 3}
    changes = ({}, {"mode": oculus_wire.HIGH}, {"gain": 80.0}, {"range": 3.0}, {"gamma": 200}, {"flags": 0x0D}, {"flags": 0x4B},
               {"flags": 0x03}, {"flags": 0x19}, {"flags": 0x08, "range": 50.0}, {"version": 2}, {"version": 2, "ext_flags": 0x200},
               {"sound_speed": 1470.0}, {"salinity": 35.0}, {"rate": 0}, {"sized": False}, {"mode": 9}, {"range": 1e9})  # fmt: skip
    words = on(data, *[fire(**{**usual, **change}) for change in changes])
    other = oculus_wire.HEADER.pack(oculus_wire.MAGIC, 0, 0, 0x99, 0, 4, 0) + b"abcd"
    return words + on(data, golden("oculus/user_config"), other, b"noise", fire(**usual), None, fire(rate=5), None)


def omniscan450(port="tcp"):
    params = cerulean_wire.os_ping_params
    usual = {"length_mm": 8000, "msec_per_ping": 200, "num_results": 300}
    changes = ({}, {"length_mm": 4000}, {"gain_index": 4}, {"num_results": 500}, {"pulse_len_percent": 0.004}, {"start_mm": 1000},
               {"filter_duration_percent": 0.003}, {"length_mm": 0}, {"msec_per_ping": 400}, {"gain_index": 99})  # fmt: skip
    words = on(port, br(6, "H", 4, to=0), br(6, "H", 5, to=0), br(6, "H", 2198, to=0))
    for change in changes:
        words += on(port, params(**{**usual, **change}), None)
    return words + on(port, cerulean_wire.speed_of_sound(1480), None, damaged(params()), br(9999, "I", 1), br(2197, "I", 5),
                      golden("cerulean/os_ping_params_short"), None, params(enable=0), br(6, "H", 2198, to=0), None)  # fmt: skip


def s500(port="tcp"):
    params = cerulean_wire.s500_ping_params
    usual = {"msec_per_ping": 200}
    changes = ({}, {"length_mm": 3000}, {"gain_index": 4}, {"report_id": 1223}, {"report_id": 1300}, {"pulse_len_usec": 100},
               {"start_mm": 500}, {"chirp": 1}, {"decimation": 4}, {"length_mm": 0}, {"gain_index": 99}, {"msec_per_ping": -1})  # fmt: skip
    words = on(port, br(6, "H", 4, to=0), br(6, "H", 5, to=0), br(6, "H", 1308, to=0), br(6, "H", 1223, to=0))
    for change in changes:
        words += on(port, params(**{**usual, **change}), None)
    return words + on(port, cerulean_wire.speed_of_sound(1480), br(6, "H", 1308, to=0), damaged(params()), br(9999, "I", 1),
                      br(1015, "I", 5), br(6, "H", 1300, to=0), br(6, "H", 1214, to=0), None)  # fmt: skip


def surveyor240(port="tcp"):
    params = surveyor_wire.ping_parameters
    usual = {"end_mm": 8000, "msec_per_ping": 250}
    changes = ({}, {"end_mm": 5000}, {"gain_index": 40}, {"sos_mps": 1450.0}, {"enable_yz_point_data": False}, {"n_range_steps": 200},
               {"start_mm": 1000}, {"pulse_len_steps": 3.0}, {"target_ping_hz": 220000}, {"end_mm": 0}, {"enable_channel_data": True},
               {"target_ping_hz": 1}, {"msec_per_ping": 600})  # fmt: skip
    words = on(port, surveyor_wire.request(4), surveyor_wire.request(5), surveyor_wire.utc_response(1767225600123, 5))
    for change in changes:
        words += on(port, params(**{**usual, **change}), None)
    return words + on(port, surveyor_wire.request(3012), surveyor_wire.request(3011), damaged(params()), surveyor_wire.frame(9999, b"abc"),
                      golden("cerulean/surveyor_set_net_info"), params(ping_enable=False), surveyor_wire.request(504), None)  # fmt: skip


def kmall(port="texts"):
    name = "EM2040_40"
    kssis = lambda *words: ("$KSSIS," + ",".join(words)).encode()  # noqa: E731
    values = ("RUNT_PARAM_PU_ANGLE_PORT_RX1=40,RUNT_PARAM_PU_ANGLE_STARB_RX1=50", "STPF=4", "RUNT_PARAM_PU_BEAM_SPACING=Equidistance",
              "SDMA=30", "SDPM1=300kHz", "RUNT_PARAM_PU_WATERCOL=1", "SSPA1=700", "NOTHING=3")  # fmt: skip
    return on(
        port, None, kssis("13", name), kssis("451", name), kssis("454", name), kssis("458", name), None,
        *[kssis("262", name, value) for value in values], kssis("461", "2040"), None, None, kssis("462", "2040"), None,
        kssis("457", "2040"), None, kssis("458", "2040"), None, kssis("999", name), b"$KSSIS,", b"hello", kssis("401", name),
        kssis("455", name), None,
    )  # fmt: skip


def norbit(port="commands"):
    words = (
        "set_power 1", "set_gate_mode 0", "set_range .5 15", "set_time_source 1", "set_rate 4", "set_tp_rate 4", "set_range 2 12",
        "set_resolution 512 64", "set_opening_angle 90", "set_gain 20", "autogain 0", "set_tx 350 40 10 300", "set_direction 5",
        "set_flip 1", "set_gate_mode 1", "depth_range 3 12", "set_vga 40", "sound_velocity 1480", "set_mf_decimation 4",
        "set_snippet_rate 4", "set_mode 0", "set_mode 1", "set_tx_opening_angle 30", "set_range", "set_range 9 3", "set_gain loud",
        "nonsense 3", "get_params", "set_sidescan_mode 1", "set_trigger_mode 1", "set_gate_mode 2", "range 2 12 3 12", "set_power 0",
    )  # fmt: skip
    return on(port, None, *[word.encode() for word in words], b"set_power 1\r\nset_rate 5\r\n", b"\xff\xfe\r\n", None, None)


def reson7k(port="tcp"):
    ticket = iter(range(1, 1000))

    def say(command, form="", *values):
        number = next(ticket)
        content = struct.pack("<II", command, number) + bytes(range(16)) + (struct.pack("<" + form, *values) or b"\0")
        return reson_wire.packet(reson_wire.record(reson_wire.CONTROL, content, 7125), number)

    usual, large = (7000, 7004, 7006, 7027, 7503), (7011, 7018, 7028)
    settings = ((1003, "f", 25), (1004, "f", 4), (1005, "f", 200), (1006, "f", 100e-6), (1007, "I", 1), (1008, "f", 40),
                (1009, "I", 1 << 8), (1010, "5f", 2, 11, 2, 20, 0.1), (1026, "f", 250e3), (1003, "f", 15), (7042, "I", 1),
                (7610, "HfB3x", 0, 1480, 0), (1003, "f", 9e9), (1101, ""), (1100, ""))  # fmt: skip
    words = on(port, None, say(1050, "I", 7001), say(1050, "I", 7503), say(1050, "I", 7004), say(1051, "6I", 5, *usual))
    for row in settings:
        words += on(port, say(*row))
    for kind in large:
        words += on(port, say(1051, "2I", 1, kind), say(1056, "2I", 1, kind), say(1052), say(1051, "2I", 1, 7000))
    return words + on(port, damaged(say(1003, "f", 20)), golden("reson7k/range"), golden("reson7k/subscribe"),
                      golden("reson7k/remote_settings"), say(4711), b"noise", say(1050, "I", 7000), say(1052), None)  # fmt: skip


def http(method, path, body=None):
    text = f"{method} {path} HTTP/1.1\r\nHost: 127.0.0.1:8080\r\n"
    if body is not None:
        text += f"Content-Type: application/json\r\nContent-Length: {len(body)}\r\n"
    return (text + "\r\n" + (body or "")).encode()


def sonar3d(port="http"):
    root = "/api/v1/integration"
    read = ("/about", "/status", "/temperature", "/acoustics/enabled", "/acoustics/range", "/acoustics/speed_of_sound", "/acoustics/mode",
            "/acoustics/salinity", "/udp", "/nothing")  # fmt: skip
    post = (("/acoustics/range", '{"min": 1, "max": 5}'), ("/acoustics/mode", '"high-frequency"'), ("/acoustics/speed_of_sound", "1480"),
            ("/acoustics/mode", '"low-frequency"'), ("/acoustics/range", '{"min": 6, "max": 5}'), ("/acoustics/range", "{"),
            ("/acoustics/salinity", '"salt"'), ("/acoustics/salinity", '"fresh"'), ("/acoustics/enabled", "false"),
            ("/acoustics/enabled", "true"), ("/acoustics/enabled", "7"), ("/about", "1"), ("/udp", '{"mode": "unicast"}'),
            ("/udp", '{"mode": "unicast", "unicast_destination_ip": "127.0.0.1", "unicast_destination_port": 4748}'),
            ("/udp", '{"mode": "multicast"}'))  # fmt: skip
    words = on(port, None, *[http("GET", root + path) for path in read], http("GET", "/api/v1/about"))
    for path, body in post:
        words += on(port, http("POST", root + path, body), http("GET", root + path))
    return words + on(port, golden("http/get_about"), golden("http/post_range"), http("DELETE", root + "/about"), b"\x16\x03\r\n\r\n", None,
                      http("OPTIONS", root + "/udp", ""), None)  # fmt: skip


def aris(port="commands", frames=56000, mode=1):
    say = lambda kind, number, *values: aris_wire.command(kind, number, aris_wire.message(*values))  # noqa: E731
    cookie = iter(range(1, 100))

    def acoustics(rate=4.0, samples=400, delay=2028, cycle=11000, period=8, pulse=11, mode=mode, transmit=True, high=1, power=True,
                  gain=18.0):  # fmt: skip
        return say(aris_wire.SET_ACOUSTICS, 5, next(cookie), rate, samples, delay, cycle, period, pulse, mode, transmit, high, power, gain)

    changes = ({}, {"samples": 600, "cycle": 13000}, {"gain": 10.0}, {"high": 0}, {"transmit": False}, {"pulse": 20}, {"power": False},
               {"delay": 4000, "cycle": 13000}, {"mode": 3}, {"mode": 9}, {"mode": 6}, {"rate": 15.0}, {"samples": 9999}, {"pulse": 999},
               {"mode": 2})  # fmt: skip
    start = on(port, None, say(aris_wire.SET_STREAM, 4, 1), say(aris_wire.SET_RECEIVER, 3, frames),
               say(aris_wire.SET_DATETIME, 2, "2026-Jan-02 03:04:05"), say(aris_wire.SET_SALINITY, 6, 35),
               say(aris_wire.SET_FOCUS, 8, None, 5.0))  # fmt: skip
    ping = aris_wire.command(aris_wire.PING, 16, b"")
    for change in changes:
        start += on(port, acoustics(**change), ping)
    return start + on(port, say(aris_wire.SET_SALINITY, 6, 0), say(aris_wire.SET_TELEPHOTO, 7, True), say(aris_wire.SET_FOCUS, 8, None, 2.0),
                      ping, golden("aris/set_acoustics"), struct.pack(">I", 3) + b"\xff\xff\xff", b"noise", ping, say(77, 5, 1), None)  # fmt: skip


def r2sonic(port="0"):
    command = r2sonic_control.command
    changes = (
        {"RNG0": 20.0}, {"GAN0": 10.0}, {"TXL0": 5e-5, "TXP0": 200.0}, {"FRQ0": 300e3}, {"SEW0": 1.0}, {"BOS0": 1, "BIE0": 1},
        {"TPM0": 1}, {"TPM0": 2, "TPG0": 1}, {"TPM0": 0, "SNIP": 1}, {"SNIP": 0, "AIH0": 200}, {"AIB0": 30.0}, {"AIH0": 0, "WCM0": 1},
        {"WCM0": 2}, {"WCM0": 0},
        {"SPR0": 20.0, "ABS0": 50.0}, {"SVL0": 1480.0, "SVU0": 1}, {"SER0": 0.2}, {"PRX0": 0.1}, {"DGA0": 2.0, "DGB0": 20.0, "DGO0": 1},
        {"RGA0": 3.0, "RGB0": 20.0, "RGO0": 1}, {"UHD0": 1}, {"PROJ": 1}, {"TXS0": 0.1, "RET0": 0.1}, {"PRL0": 2.0, "PRU0": 1},
        {"STM0": 3}, {"RNG0": 1e9}, {"XXX0": 1}, {"RNG0": float("nan")}, {"RNG0": 12.0, "ROS0": 1, "PTS0": 1}, {"TRG0": 2}, {"PNG0": 1},
    )  # fmt: skip
    words = on("discovery", r2sonic_control.discovery("127.0.0.1", 65400))
    for change in changes:
        words += on(port, command(change))
    odd = (command({"RNG0": 9.0})[:-2], b"CMD1" + command({"RNG0": 9.0})[4:], b"noise")
    return words + on(port, *odd) + on("discovery", golden("r2sonic/r2dd"), golden("r2sonic/r2dc")) + on(port, None, None)
