"""Dictionaries: words that the field tables (docs/messages-*.md) call constant or give a name, and words that the sources of a
reader of text compare with."""
import pathlib
import re
import struct

ROOT = pathlib.Path(__file__).resolve().parents[2]

# Readers of text: what their dictionaries are made of.
SOURCES = {
    "control": ["emulator/faults/control_line.cpp", "emulator/scenario/fault*.cpp"],
    "scenario": ["emulator/scenario/*.cpp"],
    "set": ["emulator/scenario/*.cpp"],
    "places": ["emulator/contract/endpoint.cpp", "emulator/contract/network.cpp", "emulator/scenario/control_place.cpp"],
    "fault_answers": ["emulator/run/answers.cpp", "tools/echoloop/fault*.cpp"],
    "scene": ["render/scene/*.cpp"],
    "world": ["tools/import/*.cpp"],
    "pose": ["emulator/pose/*.cpp"],
    "steps": ["emulator/pose/*.cpp"],
    "http": ["protocols/http/*.cpp"],
    "poses_rosbridge": ["tools/poses/rosbridge/*.cpp"],
    "poses_truth": ["tools/poses/truth/ping.cpp"],
    "devices-norbit-wbms": ["emulator/devices/norbit-wbms/*", "protocols/norbit/*"],
    "devices-kongsberg-kmall": ["emulator/devices/kongsberg-kmall/*", "protocols/kmall/*"],
    "devices-dvl-a50": ["emulator/devices/waterlinked-dvl/*", "protocols/waterlinked/*", "protocols/http/*.cpp"],
    "devices-dvl-a125": ["emulator/devices/waterlinked-dvl/*", "protocols/waterlinked/*", "protocols/http/*.cpp"],
    "devices-dvl-pathfinder": ["emulator/devices/teledyne-dvl/*"],
    "devices-dvl-explorer": ["emulator/devices/teledyne-dvl/*"],
    "devices-dvl-navigator": ["emulator/devices/teledyne-dvl/*"],
    "devices-dvl-wayfinder": ["emulator/devices/dvl-wayfinder/*"],
    "devices-nortek-nucleus": ["emulator/devices/nortek-nucleus/*", "emulator/devices/family/nortek/*"],
    "devices-nortek-dvl500": ["emulator/devices/nortek-dvl/*", "emulator/devices/family/nortek/*"],
    "devices-nortek-dvl1000": ["emulator/devices/nortek-dvl/*", "emulator/devices/family/nortek/*"],
    "devices-sonar-3d-15": ["emulator/devices/sonar-3d-15/*", "protocols/http/*.cpp"],
}


def quoted(word):
    return '"' + "".join(f"\\x{byte:02x}" for byte in word) + '"'


def words_of_tables():
    """Characters that are always the same, and numbers that have a name, in the byte order of their family."""
    for path in sorted((ROOT / "docs").glob("messages-*.md")):
        order = ">" if path.stem == "messages-r2sonic" else "<"
        for kind, meaning in re.findall(r"^\| *\d* *\| ([\w\[\]]+) \| `\w+` \|[^|]*\| (.*) \|$", path.read_text(), re.M):
            if kind.startswith("char["):
                yield from (word.encode() for word in re.findall(r'"([^"]+)"', meaning))
            size = {"u8": "B", "u16": "H", "u32": "I"}.get(kind)
            if size and size != "B":
                for number in re.findall(r"; (\d+) [A-Z]\w+", meaning):
                    yield struct.pack(order + size, int(number))


def words_of_sources(patterns):
    for pattern in patterns:
        for path in sorted(ROOT.glob(pattern)):
            text = re.sub(r"^#include.*$", "", path.read_text(errors="replace"), flags=re.M)
            yield from (word.encode() for word in re.findall(r'"([A-Za-z_$#/][\w.$#:/=-]{1,30})"', text))


def dictionaries(messages):
    """{"dictionary": words} for readers of bytes, {"TARGET.dict": words} for readers of text."""
    begins = [message[:size] for message in messages.values() for size in (2, 4, 8, 16)]
    of_messages = [*begins, *words_of_tables()]
    yield "dictionary", of_messages
    for name, patterns in SOURCES.items():  # devices hear messages of several families beside their texts
        yield f"{name}.dict", [*words_of_sources(patterns), *(of_messages if name.startswith("devices-") else [])]
