"""Small worlds for the tests of `echoloop import`, and what they become. Standard library only."""
import json
import os
import pathlib
import struct
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[3]
PROGRAM = os.environ.get("ECHOLOOP", str(ROOT / "build" / "release" / "bin" / "echoloop"))


def sdf(content, version="1.7"):
    return f'<?xml version="1.0"?>\n<sdf version="{version}">\n<world name="w">\n{content}\n</world>\n</sdf>\n'


def model(name, visuals, static=True, more=""):
    return (f'<model name="{name}"><static>{str(static).lower()}</static>{more}'
            f'<link name="link">{visuals}</link></model>')


def visual(geometry, name="visual", more=""):
    return f'<visual name="{name}"><geometry>{geometry}</geometry>{more}</visual>'


def script(name):
    return f"<material><script><uri>file://x.material</uri><name>{name}</name></script></material>"


def mesh(uri, more=""):
    return f"<mesh><uri>{uri}</uri>{more}</mesh>"


BOX = "<box><size>2 4 6</size></box>"

# A tetrahedron with a right angle at the origin, edges of 1, outsides outwards.
TETRAHEDRON = """o part
v 0 0 0
v 1 0 0
v 0 1 0
v 0 0 1
f 1 3 2
f 1 2 4
f 1 4 3
f 2 3 4
"""


class Scene:
    """The scene file, read by its specification: positions in world coordinates, ENU."""

    def __init__(self, path):
        data = path.read_bytes()
        magic, version, total, size = struct.unpack_from("<4sIII", data)
        assert (magic, version, total) == (b"glTF", 2, len(data))
        self.json = json.loads(data[20:20 + size])
        self.binary = data[28 + size:]
        self.places = {}
        for root in self.json["scenes"][0]["nodes"]:
            self.walk(root, lambda p: p)

    def walk(self, index, place):
        node = self.json["nodes"][index]
        x, y, z, w = node.get("rotation", (0, 0, 0, 1))
        shift = node.get("translation", (0, 0, 0))

        def here(v):
            t = (2 * (y * v[2] - z * v[1]), 2 * (z * v[0] - x * v[2]), 2 * (x * v[1] - y * v[0]))
            turned = (v[0] + w * t[0] + y * t[2] - z * t[1], v[1] + w * t[1] + z * t[0] - x * t[2],
                      v[2] + w * t[2] + x * t[1] - y * t[0])
            return place(tuple(a + b for a, b in zip(turned, shift)))

        self.places[node["name"]] = (node, here)
        for child in node.get("children", []):
            self.walk(child, here)

    def position(self, name):
        return self.enu(self.places[name][1]((0, 0, 0)))

    @staticmethod
    def enu(p):
        return tuple(round(v, 5) + 0.0 for v in (p[0], -p[2], p[1]))

    def primitives(self, name):
        """(material, positions, triangles) of a node."""
        node, place = self.places[name]
        for primitive in self.json["meshes"][node["mesh"]]["primitives"]:
            points = self.values(primitive["attributes"]["POSITION"], "f", 3)
            indices = [i for i, in self.values(primitive["indices"], "I", 1)]
            yield (self.json["materials"][primitive["material"]], [self.enu(place(p)) for p in points],
                   list(zip(*[iter(indices)] * 3)))

    def values(self, accessor, code, width):
        accessor = self.json["accessors"][accessor]
        view = self.json["bufferViews"][accessor["bufferView"]]
        flat = struct.unpack_from(f"<{accessor['count'] * width}{code}", self.binary, view["byteOffset"])
        return list(zip(*[iter(flat)] * width))

    def bounds(self, name):
        points = [p for _, positions, _ in self.primitives(name) for p in positions]
        return tuple(min(c) for c in zip(*points)), tuple(max(c) for c in zip(*points))

    def volume(self, name):
        """Of a closed body whose outsides are outwards; negative where they are inwards."""
        total = 0
        for _, p, triangles in self.primitives(name):
            for i, j, k in triangles:
                a, b, c = p[i], p[j], p[k]
                total += (a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
                          a[2] * (b[0] * c[1] - b[1] * c[0])) / 6
        return total

    def material(self, name):
        return next(self.primitives(name))[0]


def needs_worlds(test):
    """Skips the test where this build cannot import worlds, and fails in CI."""
    done = subprocess.run([PROGRAM, "import", __file__, "--out", "none.glb"], capture_output=True, text=True, check=False)
    if done.returncode == 69:  # unavailable; else this file is refused, which is no world
        if os.environ.get("CI") == "true":
            test.fail(done.stderr)
        test.skipTest(done.stderr.strip())


class ImportTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="echoloop-worlds-")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.out = self.folder / "out" / "scene.glb"
        self.out.parent.mkdir()
        needs_worlds(self)

    def write(self, name, content):
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content if isinstance(content, bytes) else content.encode())
        return path

    def run_import(self, world, *arguments, **environment):
        settings = {key: value for key, value in os.environ.items() if not key.endswith(("RESOURCE_PATH", "MODEL_PATH"))}
        settings.update(HOME=str(self.folder / "home"), TMPDIR=str(self.folder / "out"), **environment)
        return subprocess.run([PROGRAM, "import", str(world), "--out", str(self.out), *map(str, arguments)],
                              capture_output=True, timeout=120, env=settings, check=False)

    def convert(self, world, *arguments, **environment):
        """(scene, report) of a world that must be read."""
        if not isinstance(world, pathlib.Path):
            world = self.write("w.world", sdf(world))
        done = self.run_import(world, *arguments, "--json", **environment)
        self.assertEqual((done.returncode, done.stderr.decode()), (0, ""))
        self.assertEqual([path.name for path in self.out.parent.iterdir()], ["scene.glb"], "nothing else is left")
        return Scene(self.out), json.loads(done.stdout)

    def refused(self, world, *arguments, status=65, **environment):
        """What is said of a world that must not be read; nothing may be left behind."""
        if not isinstance(world, pathlib.Path):
            world = self.write("w.world", sdf(world))
        self.out.unlink(missing_ok=True)
        done = self.run_import(world, *arguments, **environment)
        text = done.stderr.decode()
        self.assertEqual(done.returncode, status, text)
        for line in text.splitlines():
            self.assertTrue(line.startswith("echoloop: error: "), line)
        self.assertEqual(list(self.out.parent.iterdir()), [], "nothing is left")
        return text
