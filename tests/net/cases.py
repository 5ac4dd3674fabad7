"""Stepped runs of the net: one of each model, and some of several sonars at once. Names of models are those of
`echoloop list`; a model that stands in no run is an error of the net."""

import log_talkers
import talkers
from stepped import Device, Run

PTY = ["pty:{folder}/line"]
LINE = {"line": ("pty", "line")}
DOWN = {"scene": "flat", "at": (0, 0, -12)}
R2SONIC = {**{str(i): ("udp", 65400 + i, 65502) for i in (0, 1, 2, 3, 5, 6)}, "sim": ("udp", 65402 + 16, 65518),
           "discovery": ("udp", 65300, 53810)}  # fmt: skip


def one(model, endpoints, ports, words, pitch=0, options="", **run):
    return Run([Device("sonar", model, endpoints, ports, words, pitch, options)], **run)


def oculus(model):
    ports = {"data": ("tcp", 52100), "status": ("broadcast", 52102)}
    return one(model, ["tcp-listen://127.0.0.1:52100", "udp://127.255.255.255:52102"], ports, talkers.oculus(), pitch=10)


def aris(model, mode):
    ports = {"commands": ("tcp", 56888), "beacon": ("broadcast", 56124), "frames": ("udp", 56000, None)}
    return one(model, ["tcp-listen://127.0.0.1:56888", "udp://127.255.255.255:56124"], ports, talkers.aris(mode=mode), pitch=20)


def r2sonic(model, **more):
    endpoints = ["udp-listen://127.0.0.1:65500", "udp://127.0.0.1:65400", "udp-listen://127.0.0.1:65516"]
    more = {**DOWN, **more}
    return one(model, endpoints, R2SONIC, talkers.r2sonic(), pitch=90, options="range: 15, ping_rate: 4", **more)


def br(model, words, **more):
    ports = {"tcp": ("tcp", 51200), "udp": ("udp", 51300, 51200)}
    return one(model, ["tcp-listen://127.0.0.1:51200", "udp-listen://127.0.0.1:51200"], ports, words, **more)


def altimeter(model):
    return one(model, PTY, LINE, talkers.on("line", *log_talkers.ALTIMETERS[model]), pitch=90, **DOWN)


def waterlinked(model):
    """JSON by TCP, HTTP and the serial line."""
    ports = {"tcp": ("tcp", 16171), "line": ("pty", "line")}
    return one(model, ["tcp-listen://127.0.0.1:16171", "tcp-listen://127.0.0.1:8070", *PTY], ports, log_talkers.waterlinked(), **DOWN)


def teledyne(model, options):
    return one(model, PTY, LINE, log_talkers.teledyne(), options=options, **DOWN)


INS = ["udp://127.0.0.1:10110?local_port=10111", "pty:{folder}/tss1", "pty:{folder}/em3000"]
MODELS = {
    "aris-1200": aris("aris-1200", 1),
    "aris-1800": aris("aris-1800", 3),
    "aris-3000": aris("aris-3000", 6),
    **{model: altimeter(model) for model in log_talkers.ALTIMETERS},
    "dvl-a50": waterlinked("dvl-a50"),
    "dvl-a125": waterlinked("dvl-a125"),
    "dvl-explorer": teledyne("dvl-explorer", "format: pd5"),
    "dvl-navigator": teledyne("dvl-navigator", "frame: ship"),
    "dvl-pathfinder": teledyne("dvl-pathfinder", "heading_alignment: 4500"),
    "dvl-wayfinder": one("dvl-wayfinder", PTY, LINE, log_talkers.wayfinder(), **DOWN),
    "edgetech-2205": one("edgetech-2205", ["tcp-listen://127.0.0.1:1700", "tcp-listen://127.0.0.1:1701"],
                         {"commands": ("tcp", 1700), "data": ("tcp", 1701)}, log_talkers.edgetech(), scene="manifold", at=(-9, 0, -5)),
    "imagenex-831l": one("imagenex-831l", ["tcp-listen://127.0.0.1:4040"], {"tcp": ("tcp", 4040)}, log_talkers.imagenex_831l(),
                         scene="pipe", at=(0, 0.03, -3.02), pitch=-90),
    "imagenex-852": one("imagenex-852", PTY, LINE, talkers.imagenex_852(), pitch=90, **DOWN),
    "imagenex-872": one("imagenex-872", ["tcp-listen://127.0.0.1:4040"], {"tcp": ("tcp", 4040)}, log_talkers.imagenex_872(),
                        scene="manifold", at=(-9, 0, -5)),
    "imagenex-881a": one("imagenex-881a", PTY, LINE, talkers.imagenex_881a(), options="azimuth_drive: true"),
    "imagenex-deltat": one("imagenex-deltat", ["udp://127.0.0.1:4040?local_port=4041"], {"83P": ("udp", 4040, 4041)},
                           talkers.deltat(), pitch=90, options="range: 20, frame_rate: 4", **DOWN),
    "kongsberg-kmall": one("kongsberg-kmall", ["udp-listen://127.0.0.1:14002", "udp://127.0.0.1:6020", "udp://127.0.0.1:4002"],
                           {"datagrams": ("udp", 6020, 14002), "texts": ("udp", 4002, 14002)}, talkers.kmall(), pitch=90,
                           options="range: 15, ping_rate: 4, pinging: false", **DOWN),
    "micron-echosounder": one("micron-echosounder", PTY, LINE, [None] * 12, pitch=90, **DOWN),
    "nmea-echosounder": one("nmea-echosounder", PTY, LINE, [None] * 12, pitch=90, **DOWN),
    "nmea-ins": one("nmea-ins", INS, {"sentences": ("udp", 10110, None), "tss1": ("pty", "tss1"), "em3000": ("pty", "em3000")},
                    [None] * 8, **DOWN),
    "norbit-wbms": one("norbit-wbms", [f"tcp-listen://127.0.0.1:{port}" for port in (2209, 2210, 2211)],
                       {"commands": ("tcp", 2209), "bathymetry": ("tcp", 2210), "water column": ("tcp", 2211)}, talkers.norbit(),
                       pitch=90, **DOWN),
    "nortek-dvl500": one("nortek-dvl500", ["udp://127.0.0.1:9005?local_port=9006", *PTY],
                         {"datagrams": ("udp", 9005, None), **LINE}, log_talkers.nortek_dvl("line"),
                         options="bottom_format: bt9, water_track: true, water_format: wt7, trigger: edges, trigger_rate: 1.5", **DOWN),
    "nortek-dvl1000": one("nortek-dvl1000", [f"tcp-listen://127.0.0.1:{port}" for port in (9000, 9002, 9004)],
                          {"commands": ("tcp", 9000), "data": ("tcp", 9002), "text": ("tcp", 9004)}, log_talkers.nortek_dvl(), **DOWN),
    "nortek-nucleus": one("nortek-nucleus", ["tcp-listen://127.0.0.1:9000", "tcp-listen://127.0.0.1:9002", *PTY],
                          {"commands": ("tcp", 9000), "data": ("tcp", 9002), **LINE}, log_talkers.nucleus(), **DOWN),
    "oculus-m1200d": oculus("oculus-m1200d"),
    "oculus-m3000d": oculus("oculus-m3000d"),
    "oculus-m370s": oculus("oculus-m370s"),
    "oculus-m750d": oculus("oculus-m750d"),
    "omniscan450": br("omniscan450", talkers.omniscan450()),
    "ping1d": one("ping1d", PTY, LINE, talkers.ping1d(), pitch=90),
    "ping360": one("ping360", [*PTY, "udp-listen://127.0.0.1:9092"], {**LINE, "udp": ("udp", 9093, 9092)}, talkers.ping360()),
    "r2sonic-2020": r2sonic("r2sonic-2020"),
    "r2sonic-2022": r2sonic("r2sonic-2022"),
    "r2sonic-2024": r2sonic("r2sonic-2024"),
    "r2sonic-2026": r2sonic("r2sonic-2026"),
    "reson-7k": one("reson-7k", ["tcp-listen://127.0.0.1:7000"], {"tcp": ("tcp", 7000)}, talkers.reson7k(), pitch=90,
                    options="range: 20, max_ping_rate: 4", **DOWN),
    "s500": br("s500", talkers.s500(), pitch=90),
    "sonar-3d-15": one("sonar-3d-15", ["tcp-listen://127.0.0.1:8080", "udp://127.0.0.1:4747"],
                       {"http": ("tcp", 8080), "images": ("udp", 4747, None), "others": ("udp", 4748, None)}, talkers.sonar3d(),
                       options="acoustics: true, range_max: 6", pitch=20),
    "surveyor240": br("surveyor240", talkers.surveyor240(), pitch=90, **DOWN),
    "tritech-micron": one("tritech-micron", PTY, LINE, talkers.seanet()),
    "tritech-profiler": one("tritech-profiler", PTY, LINE, talkers.profiler(), pitch=90),
    "tritech-seaking": one("tritech-seaking", PTY, LINE, talkers.seanet(older=True)),
}  # fmt: skip


def near(name, port, words, **more):
    """A Ping360 on a line of its own."""
    return Device(name, "ping360", [f"pty:{{folder}}/{name}"], {"line": ("pty", name)}, words, **more)


SCAN = talkers.on("line", *[talkers.transducer(angle, 500, gain=2) for angle in range(0, 400, 25)])
SOUNDER = Device("sounder", "nmea-echosounder", ["udp://127.0.0.1:9200?local_port=9201"], {"datagrams": ("udp", 9200, None)}, [], 90)
HEAD = Device("head", "tritech-micron", ["tcp-listen://127.0.0.1:9300"], {"line": ("tcp", 9300)}, talkers.seanet(),
              options="first_alive: 0.1, recentring_alives: 0")  # fmt: skip
FAULTS = """faults:
  - {device: sounder, kind: loss, rate: 0.1}
  - {device: sounder, kind: duplication, rate: 0.1}
  - {device: sounder, kind: wrong_checksum, rate: 0.2}
  - {device: sounder, kind: bit_flips, rate: 0.002}
  - {device: sounder, kind: reordering, rate: 0.1}
  - {device: sounder, kind: jitter, delay: 0.3}
  - {device: sounder, kind: truncation, rate: 0.1}
  - {device: sounder, kind: silence, from: 4, until: 5}
  - {device: scanner, kind: bit_flips, rate: 1e-4, direction: both}
  - {device: scanner, kind: latency, delay: 0.13, from: 2}
  - {device: scanner, kind: split, rate: 0.5, gap: 0.03}
  - {device: scanner, kind: stale_burst, from: 5, for: 0.75}
  - {device: scanner, kind: reboot, at: 7.55, off: 0.35}
  - {device: scanner, kind: stuck_motor, from: 9}
  - {device: scanner, kind: baud_mismatch, baud: 57600, from: 10, for: 0.5}
  - {device: head, kind: loss, rate: 0.05}
  - {device: head, kind: bandwidth, bits_per_second: 30000}
  - {device: head, kind: merge, messages: 2, from: 3, for: 1}
  - {device: head, kind: frozen_image, from: 10}
"""
TOGETHER = {
    "crosstalk": Run([near("left", 0, SCAN * 2), near("right", 1, SCAN[::-1] * 2), MODELS["oculus-m750d"].devices[0]._replace(name="fan")]),
    "crosstalk-off": Run([near("left", 0, SCAN), near("right", 1, SCAN[::-1])],
                         more="effects: {cross_talk: off, speckle: {shape: 4}, multipath: off}"),
    "faults": Run([SOUNDER, near("scanner", 0, SCAN * 3), HEAD], more=FAULTS),
    "trajectory": Run([SOUNDER, near("scanner", 0, SCAN * 2)], scene="manifold", interval=0.5, vehicle="trajectory: way.csv",
                      more="objects: [{node: auv, trajectory: config/moving_auv.csv}]",
                      files={"way.csv": "t,x,y,z,qw,qx,qy,qz\n0,-9,0,-5,1,0,0,0\n8,-6,2,-5.5,0.98,0,0.05,0.19\n20,-5,3,-5,1,0,0,0\n"}),
    "cerqueira": Run([near("scanner", 0, SCAN)], more="render: {rule: cerqueira2016}"),
}  # fmt: skip
