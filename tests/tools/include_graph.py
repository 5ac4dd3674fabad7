"""Reads the includes of a source tree and names those that break its module graph. Compiles nothing.

    tools ----> emulator ----> protocols        protocols   standard library only
      |            '---------> render           render      knows no protocol and no emulator
      '--> protocols, render                    emulator    rooms with arrows of their own, see ROOMS

    run -> {dataset, faults, pose, replay, truth, water} -> {capture, machine, scenario, transport} -> {clock, contract}
    devices -> contract, protocols

A rule says which of the project's files and which libraries a file may include; the first rule that fits counts.
"""
import pathlib
import re
from dataclasses import dataclass

MODULES = ("protocols", "render", "emulator", "tools", "tests")
INCLUDE = re.compile(r'^\s*#\s*include\s*(["<])([^">]+)[">]', re.MULTILINE)

PURE = r"render/(echogram|effects|geographic|motion|pose|simd|acoustics/(ring_down|interference))\.h"
STANDARD = r"[a-z0-9_]+"  # <vector>; any other library has a slash or a suffix
GRAPHICS = r"(GL|EGL|glvnd|glm|embree\d?)/.*|tiny_gltf\.h"
NETWORK = r"boost/.*|libserialport\.h|pcap.*"
USER_INTERFACE = r"CLI/.*|yaml-cpp/.*|cairo\.h"
SYSTEM = r"(sys/)?(dlfcn|fcntl|link|mman|resource|sched|sendfile|stat|unistd)\.h"
RENDER_ROOT = r"render/(?!renderer)[a-z_]+\.h"  # what all rooms of render may see


@dataclass
class Rule:
    files: str                 # pattern of the including file
    allowed: str               # pattern of the project's files that it may include
    libraries: str = ".*"      # pattern of other headers that it may include
    forbidden: str = r"(?!)"   # pattern of any header that it must not include all the same


def render_room(name, below="", libraries=STANDARD):
    """A room of render: what it may include of those below it, separated by |, and its libraries."""
    rooms = f"{name}|{below}" if below else name
    return Rule(rf"render/{name}/.*", rf"{RENDER_ROOT}|render/({rooms})/.*", f"{STANDARD}|{libraries}")


# What a room of the emulator may include beside itself: other rooms, the project's other modules, libraries that are
# not for everybody.
ROOMS = {
    "contract": ((), PURE, STANDARD),
    "clock": (("contract",), "", NETWORK),
    "machine": (("contract",), "", ""),
    "scenario": (("contract",), "render/.*", "yaml-cpp/.*|boost/(math|random)/.*"),
    "transport": (("contract", "clock"), "", NETWORK),
    "capture": (("contract", "clock", "transport"), r"render/motion\.h", ""),
    "truth": (("contract", "capture"), "render/.*", ""),
    "dataset": (("contract", "capture", "truth"), "render/.*", ""),
    "faults": (("contract", "clock", "scenario", "transport", "capture"), "protocols/.*", ""),
    "pose": (("contract", "clock", "scenario", "transport"), "(render|protocols)/.*", ""),
    "replay": (("contract", "clock", "transport", "capture"), "protocols/.*", ""),
    "water": (("contract", "clock", "machine"), "render/.*", ""),
    "run": (("contract", "clock", "machine", "scenario", "transport", "capture", "truth", "dataset", "faults", "pose",
             "water"),
            "render/.*", NETWORK),
}


def room_rule(room):
    others, modules, libraries = ROOMS[room]
    allowed = "|".join([rf"emulator/({'|'.join((room, *others))})/.*", *([modules] if modules else [])])
    if libraries == STANDARD:
        return Rule(rf"emulator/{room}/.*", allowed, STANDARD)
    special = f"{GRAPHICS}|{NETWORK}|{USER_INTERFACE}"
    return Rule(rf"emulator/{room}/.*", allowed, forbidden=rf"(?!{libraries or '(?!)'})({special})")


RULES = [
    Rule(r"protocols/.*", r"protocols/.*", STANDARD),
    Rule(r"render/(echogram|effects|geographic|pose|simd)\.h", r"render/pose\.h", STANDARD),
    Rule(r"render/(?!renderer|shot_check)[a-z_]+\.(h|cpp)", RENDER_ROOT, f"{STANDARD}|{SYSTEM}"),
    render_room("scene", libraries=rf"{SYSTEM}|(glm|nlohmann)/.*|tiny_gltf\.h"),
    render_room("gl", "scene", rf"{SYSTEM}|(GL|EGL|glvnd)/.*"),
    render_room("acoustics", "scene", r"boost/math/.*"),
    render_room("paths", "acoustics|scene", r"embree[34]/.*"),
    render_room("rays", "gl|paths|scene"),
    render_room("raster", "rays|gl|paths|scene", r"embree[34]/.*"),
    render_room("fan", "paths|acoustics|scene"),
    render_room("grid", "fan|paths|acoustics|scene"),
    Rule(r"render/(renderer[a-z_]*|shot_check)\.(h|cpp)", r"render/.*", STANDARD),
    Rule(r"emulator/devices/(sonar-3d-15|waterlinked-dvl)/(?:api|json_commands|pages)\.cpp",
         rf"{PURE}|protocols/.*|emulator/contract/.*|emulator/devices/(\1|family)/.*", rf"{STANDARD}|nlohmann/json\.hpp"),
    Rule(r"emulator/devices/models\.cpp", rf"{PURE}|protocols/.*|emulator/(contract|devices)/.*", STANDARD),
    Rule(r"emulator/devices/family/([^/]+)/.*", rf"{PURE}|protocols/.*|emulator/contract/.*|emulator/devices/family/.*",
         STANDARD),
    Rule(r"emulator/devices/([^/]+)/.*", rf"{PURE}|protocols/.*|emulator/contract/.*|emulator/devices/(\1|family)/.*",
         STANDARD),
    *(room_rule(room) for room in ROOMS),
    Rule(r"tools/.*", r"(tools|emulator|render|protocols)/.*"),
    Rule(r"tests/.*", r".*"),
]


def sources(root):
    """Paths of all headers and sources of the modules, relative to the root."""
    return sorted(path.relative_to(root).as_posix() for module in MODULES for path in (root / module).rglob("*")
                  if path.suffix in (".h", ".hpp", ".cpp", ".cc", ".inc"))


def without_comments(text):
    return re.sub(r"//[^\n]*|/\*.*?\*/", "", text, flags=re.DOTALL)


def includes(root, name):
    """(header, whether it belongs to the project) for each include of a file."""
    for quote, header in INCLUDE.findall(without_comments((root / name).read_text(errors="replace"))):
        yield header, quote == '"' or header.split("/")[0] in MODULES


def rule_faults(name, header, own):
    for rule in RULES:
        match = re.fullmatch(rule.files, name)
        if match:
            allowed = match.expand(rule.allowed) if match.groups() and r"\1" in rule.allowed else rule.allowed
            good = re.fullmatch(allowed if own else rule.libraries, header)
            if not good or re.fullmatch(rule.forbidden, header):
                yield f"{name} must not include {header} (rule for {rule.files})"
            return
    yield f"{name}: no rule for its folder"


def cycle(graph):
    """One cycle of headers as a list of names, or an empty list."""
    done, path = set(), []

    def visit(name):
        if name in path:
            return path[path.index(name):] + [name]
        if name in done:
            return []
        path.append(name)
        for header in graph.get(name, ()):
            found = visit(header)
            if found:
                return found
        path.pop()
        done.add(name)
        return []

    for name in sorted(graph):
        found = visit(name)
        if found:
            return found
    return []


def faults(root):
    """One sentence for each include that the module graph does not allow, in order of files."""
    root, result, graph = pathlib.Path(root), [], {}
    for name in sources(root):
        graph[name] = []
        for header, own in includes(root, name):
            result += rule_faults(name, header, own)
            if own and not (root / header).is_file():
                result.append(f"{name} includes {header}, which does not exist (paths start at the root)")
            elif own:
                graph[name].append(header)
    ring = cycle(graph)
    return result + ([f"headers include each other: {' -> '.join(ring)}"] if ring else [])
