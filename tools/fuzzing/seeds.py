#!/usr/bin/env python3
"""Writes what tools/fuzz begins with: for each target a folder of inputs that its reader takes, made from the golden messages,
the scenes and scenarios of this repository and the recordings in ../shared/data where they are; and dictionaries.
    seeds.py FOLDER"""
import os
import pathlib
import re
import subprocess
import sys
import tempfile

from captures import captures, packet_inputs, pcapng, recordings_of_makers, text_log, udp
from lines import lines, mavlink, mavlink_messages, poses
from scenes import scenes
from words import dictionaries, quoted
from worlds import worlds

ROOT = pathlib.Path(__file__).resolve().parents[2]
SHARED = ROOT.parent / "shared" / "data"
LONGEST = 1 << 16  # bytes of a recording: libFuzzer takes inputs that are as long as its longest seed


def golden():
    """{"ping-nack": bytes} of tests/data/FAMILY/NAME.hex."""
    messages = {}
    for path in sorted((ROOT / "tests" / "data").glob("*/*.hex")):
        lines = (line.split("#")[0] for line in path.read_text().splitlines() if not re.match(r"(message|field) ", line))
        messages[f"{path.parent.name}-{path.stem}"] = bytes.fromhex("".join(lines))
    return messages


def recordings():
    files = [path for path in sorted(SHARED.rglob("*")) if path.suffix in (".852", ".raw", ".pcap", ".sonar")]
    return {f"recorded-{path.stem.replace(' ', '_')}": path.read_bytes()[:LONGEST] for path in files}


def own_recordings():
    """The beginning of what the program records of sonars that speak first, where it is built."""
    program = pathlib.Path(os.environ.get("ECHOLOOP", ROOT / "build" / "release" / "bin" / "echoloop"))
    if not program.exists():
        print(f"seeds.py: {program} is not built, so there is no recording of our own among the seeds", file=sys.stderr)
        return
    with tempfile.TemporaryDirectory() as folder:
        for name in ("kmall", "r2sonic-2026", "deltat"):
            file = pathlib.Path(folder) / f"{name}.pcapng"
            words = [program, "run", ROOT / "config" / f"{name}.yaml", "--duration", "1", "--record", file]
            ran = subprocess.run(words, capture_output=True, text=True)
            if ran.returncode != 0:
                print(f"seeds.py: no recording of {name}: {ran.stderr.strip()}", file=sys.stderr)
            elif file.exists():
                yield f"run-{name}", file.read_bytes()[:LONGEST]


def families():
    """In the order of protocols/inspect.cpp, by which the first byte of some inputs chooses."""
    return re.findall(r'Family\{\.name = "(\w+)"', (ROOT / "protocols" / "inspect.cpp").read_text())


def cut(message, head):
    """Pieces of 255 bytes at most, each behind `head(length)`."""
    return b"".join(head(len(message[at:at + 255])) + message[at:at + 255] for at in range(0, len(message), 255))


def framed_inputs(messages):
    """Those that begin with bytes of the target's own: what they mean stands in the target."""
    order = families()
    for name, message in messages.items():
        family = name.split("-")[0]
        if len(message) <= 255:
            yield "devices", name, b"\x00\x00\x71\x00\x10" + bytes([len(message)]) + message
            yield "uart", name, b"\x21" + message
        yield "diff", name, cut(message, lambda n: bytes([0, n])) + cut(message, lambda n: bytes([5, n])) * 2
        if len(message) <= 4000:
            for way in (0x01, 0x22, 0x43):
                yield "replay_source", f"{name}-{way:02x}", bytes([way]) + text_log(message)
                yield "replay_source", f"{name}-{way:02x}-pcapng", bytes([way]) + pcapng(101, [udp(message), udp(message)])
        if family not in order:
            continue
        number = order.index(family)
        yield "checksums", name, bytes([number]) + message
        if len(message) <= 8000:
            yield "stream_windows", name, bytes([number, 3]) + message + bytes(16)
        if len(message) <= 255:
            yield "replay", name, bytes([number]) + b"".join(bytes([time, len(message)]) + message for time in (2, 3, 4, 5))


def text_commands():
    """What the Norbit obeys, by its names, each as a device is told it 160 ms after its start."""
    source = (ROOT / "emulator" / "devices" / "norbit-wbms").glob("*.cpp")
    for name in sorted({name for path in source for name in re.findall(r'\{"([a-z_]+)",', path.read_text())}):
        line = f"{name} 1 2\r\n".encode()
        yield "devices", f"norbit-{name}", b"\x00\x00\x71" + b"".join(bytes([0, 16, len(text)]) + text for text in (b"set_power 1\r\n", line))


def inputs():
    """(folder, name, bytes) of all."""
    messages, recorded = golden(), {**recordings(), **dict(own_recordings())}
    for name, message in messages.items():
        yield "bytes", name, message
        yield "bytes", f"{name}-stream", b"\xff" + message
        yield "said", name, message
        if name.startswith("http-"):
            yield "http", name, b"\xff" + message
    for name, data in [*captures(messages), *recorded.items()]:
        yield "capture_file", name, data
        if data[:4] in (b"\x0a\x0d\x0d\x0a",):
            yield "pcapng", name, data
    yield from ((kind, "whole", rest) for kind, (_, rest) in recordings_of_makers(messages).items())
    for name, data in recorded.items():
        yield "replay_source", name, b"\x22" + data
        yield "said", name, data
    yield from (("packet", name, data) for name, data in packet_inputs(messages))
    yield from framed_inputs(messages)
    yield from text_commands()
    yield from (("scene", name, data) for name, data in scenes())
    yield from worlds()
    yield from (("scenario", path.stem, path.read_bytes()) for path in sorted((ROOT / "config").glob("*.yaml")))
    yield from ((folder, name, text.encode("latin-1")) for folder, name, text in lines())
    yield from poses()
    for number, message, payload, seed in mavlink_messages():
        for version in (1, 2) if message < 256 else (2,):
            frame = mavlink(message, payload, seed, version)
            yield "mavlink", f"{message}-{version}", b"\xff" + 2 * frame
            yield "steps", f"mavlink-{message}-{version}", b"@" + frame
        yield "mavlink_pose", str(message), 2 * (bytes([number, 1, 1, len(payload)]) + payload)


def main(folder):
    for part, name, data in inputs():
        (folder / part).mkdir(parents=True, exist_ok=True)
        (folder / part / name).write_bytes(data)
    for name, words in dictionaries(golden()):
        (folder / name).write_text("".join(quoted(word) + "\n" for word in sorted(set(words)) if word))


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    main(pathlib.Path(sys.argv[1]))
