"""What drivers say to Doppler logs, altimeters and side-scans, as in talkers.py."""

import json
import struct

from talkers import damaged, golden, on


def waterlinked(json_port="tcp", line="line"):
    ask = lambda command, **values: json.dumps({"command": command, "parameters": values}).encode() + b"\n"  # noqa: E731
    asked = (ask("get_config"), ask("set_config", speed_of_sound=1480, range_mode="0<=2"), ask("get_config"),
             ask("set_config", acoustic_enabled=False), ask("trigger_ping"), ask("set_config", acoustic_enabled=True),
             ask("set_config", speed_of_sound="fast"), ask("reset_dead_reckoning"), ask("calibrate_gyro"), ask("no_such"), b"{noise\n")  # fmt: skip
    # Of the serial protocol, with checksums of CRC-8: what a log says of itself and of its settings, then damage.
    lines = (b"wcv\r\n", b"wcw\r\n", b"wcc\r\n", b"wcs,1475,0,y,n,auto\r\n", b"wcr\r\n", b"wcx,*00\r\n", b"noise\r\n")
    return on(json_port, None, *asked) + on(line, *lines) + on(json_port, None, None)


def teledyne(port="line"):
    stop = b"+++"
    asked = ("PS0", "PA", "EX?", "EX11111", "BX00300", "EC1480", "ES20", "EA+04500", "WP1", "WN010", "WS0100", "TP00:00.50", "PD4", "CS")
    words = on(port, None, None, None, stop, *[(text + "\r").encode() for text in asked], None, None)
    later = ("PD5", "PD0", "WP0", "EX00000", "BX99999", "PD7", "ZZ9", "CF11110", "CS")
    words += on(port, stop, *[(text + "\r").encode() for text in later], None, None, b"\r", None, b"===", None, None)
    last = ("PD13", "BK1", "BL10,20,60", "#BL?", "BL80,160,200", "PD6", "BK3", "CS")
    return words + on(port, stop, *[(text + "\r").encode() for text in last], None, None)


def wayfinder(port="line"):
    word = lambda name: golden(f"wayfinder/{name}")  # noqa: E731
    asked = (None, word("get_system"), word("set_sound_speed"), word("set_time"), word("set_older_setup"), word("set_setup"), word("start"),
             None, damaged(word("get_system")), b"noise", word("get_system")[:9], word("refusal"), word("data"), word("set_sound_speed"), None)  # fmt: skip
    return on(port, *asked)


def nucleus(commands="commands"):
    asked = ("ID", "GETFW", "GETHW", "GETALL", "START", "", "", "STOP", "SETBT,DS=\"ON\"", "GETBT", "GETBTLIM", "SETTRIG,FREQ=8",
             "SETTRIG,FREQ=99", "SETAHRS,FREQ=5", "SETMISSION,SV=1480", "SETCLOCKSTR,TIME=\"2026-01-02 03:04:05\"", "GETCLOCKSTR",
             "SETTRIG,SRC=\"COMMAND\"", "START", "TRIG", "", "NOSUCH", "$PNOR,GETBT*00", "GETERROR", "STOP", "SETDEFAULT", "SAVE", "START",
             "", "")  # fmt: skip
    words = [b"wrong\r\n", b"nortek\r\n"] + [(text + "\r\n").encode() if text else None for text in asked]
    return on(commands, None, *words)


def nortek_dvl(commands="commands"):
    asked = ("ID", "", "GETSTATE", "SETBT,VR=4", "K1W%!Q", "MC", "GETALL", "SETDVL,0,\"OFF\",\"INTSR\",8.0,\"\",1490.0,35.0",
             "SETBT,30.00,5.00,4,0,21,-10.0,\"XYZ\"", "SETBT,DF=359,WT=\"ON\",WTDF=22,PLMODE=\"MAX\"", "GETBTLIM", "SETBT,DF=353", "GETERROR",
             "SETCLOCK,YEAR=2026,MONTH=1,DAY=2,HOUR=3,MINUTE=4,SECOND=5", "GETCLOCK", "START", "", "", "\x03", "CO", "", "K1W%!Q", "MC",
             "SETDVL,TRIG=\"COMMAND\",SV=0", "START", "TRIG", "", "NOSUCH", "$PNOR,GETBT*00", "K1W%!Q", "MC", "SETDEFAULT,ALL", "SAVE,ALL",
             "START", "", "")  # fmt: skip
    words = [b"nortek\r\n", b"\r\n"] + [(text + "\r\n").encode() if text else None for text in asked]
    return on(commands, None, *words)


def jsf(kind, command=0, subsystem=21, channel=0, body=b""):
    """A message to an EdgeTech."""
    return struct.pack("<HBBHBBBBHI", 0x1601, 13, 0, kind, command, subsystem, channel, 0, 0, len(body)) + body


def edgetech(port="commands"):
    number = lambda value: struct.pack("<I", value)  # noqa: E731
    asked = (jsf(120, 0, 21, 0, number(1)), jsf(83, 0, 21, 0, number(1)), jsf(83, 0, 21, 1, number(1)), jsf(128, 1, 21), None,
             golden("edgetech/range_set"), jsf(128, 1, 21), None, jsf(128, 0, 21, 0, number(10**6)), jsf(128, 1, 21), jsf(83, 0, 21, 1, number(0)),
             None, jsf(83, 0, 20, 0, number(1)), jsf(120, 0, 20, 0, number(1)), jsf(129, 1, 20), jsf(121, 0, 20, 0, number(3)),
             jsf(121, 1, 20), jsf(22, 1), jsf(125, 0, 21, 0, number(1)), None, jsf(125, 0, 21, 0, number(0)), jsf(23, 1), jsf(9999, 1),
             jsf(128, 1, 99), b"noise" * 5 + jsf(128, 1), jsf(128, 1)[:9], jsf(25), None)  # fmt: skip
    return on(port, *asked)


def imagenex_872(port="tcp"):
    command = golden("imagenex/side_scan_command")
    changed = lambda **at: bytes(at.get(f"b{i}", byte) for i, byte in enumerate(command))  # noqa: E731
    starboard = changed(b18=2)
    words = (command, starboard, changed(b3=50), changed(b3=50, b18=2), changed(b3=35), changed(b7=0), changed(b8=60), changed(b10=0),
             starboard, changed(b3=250), changed(b18=7), damaged(command), command[:20], command, b"noise" + command, starboard, None)  # fmt: skip
    return on(port, *words)


def imagenex_831l(port="tcp"):
    command = golden("imagenex/pipe_command")
    changed = lambda **at: bytes(at.get(f"b{i}", byte) for i, byte in enumerate(command))  # noqa: E731
    ahead = changed(b5=0)
    words = (ahead, ahead, command, changed(b5=1), changed(b22=1), changed(b3=2), changed(b3=20), changed(b3=60), changed(b3=33), changed(b8=6),
             changed(b10=170), changed(b11=60, b12=30), changed(b13=0), changed(b14=100), changed(b15=40), changed(b21=255), changed(b21=0),
             changed(b23=1), changed(b25=80), changed(b25=79), changed(b2=0x10), damaged(command), command[:20], command, b"noise" + ahead,
             None)  # fmt: skip
    return on(port, *words)


ALTIMETERS = {
    "benthos-psa916": [None] * 10,
    "echologger-ect400": [b"#\r", b"#range 20000\r", b"#output 3\r", b"#interval 0.5\r", b"#go\r", None, None, b"#offset 100\r",
                          b"#nmeadpt 1\r", b"#nosuch\r", b"noise", None, None],
    "imagenex-863": [None] * 10,
    "tritech-pa200": [None] * 6 + [b"Z", None, b"Z", b"F", None, None],
    "tritech-pa500": [None] * 6 + [b"#Z", None, b"Z", b"F", b"noise", None],
    "valeport-va500": [None, None, b"#", b"#039\r", b"S\r", b"#082;1\r", b"S\r", b"#830;1480\r", b"#831\r", b"M4\r", None, None, b"#",
                       b"#999\r", b"#028\r", None],
}  # fmt: skip
