#!/usr/bin/env python3
"""The committed scenes: made by the script, valid glTF, closed and facing outwards, and with the sizes they promise."""
import math
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

from glb_reader import Glb

ROOT = pathlib.Path(__file__).resolve().parents[2]
SCENES = ROOT / "config" / "scenes"
NAMES = ("manifold", "tank", "flat", "basin", "harbour", "deep", "pipe")
sys.path.insert(0, str(ROOT / "tools"))

import make_scenes  # noqa: E402


def skip_or_fail(test, reason):
    """Something outside the tree is missing: CI must have it, a developer need not."""
    if os.environ.get("CI") == "true":
        test.fail(reason)
    test.skipTest(reason)


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def face(positions, triangle):
    a, b, c = (positions[i] for i in triangle)
    return cross([y - x for x, y in zip(a, b)], [y - x for x, y in zip(a, c)])


class CommittedFiles(unittest.TestCase):
    def test_are_what_the_script_makes(self):
        self.assertEqual(make_scenes.differing(), [], "run tools/make_scenes.py and commit the files")

    def test_are_valid(self):
        for name in NAMES:
            glb = Glb(SCENES / f"{name}.glb")
            for mesh in glb.json["meshes"]:
                for primitive in mesh["primitives"]:
                    with self.subTest(scene=name, mesh=mesh["name"]):
                        self.check_primitive(glb, primitive)

    def check_primitive(self, glb, primitive):
        positions, accessor = glb.accessor(primitive["attributes"]["POSITION"])
        normals, _ = glb.accessor(primitive["attributes"]["NORMAL"])
        indices, _ = glb.accessor(primitive["indices"])
        self.assertEqual(accessor["min"], [min(p[k] for p in positions) for k in range(3)])
        self.assertEqual(accessor["max"], [max(p[k] for p in positions) for k in range(3)])
        self.assertEqual(len(positions), len(normals))
        self.assertLess(max(indices), len(positions))
        self.assertEqual(len(indices) % 3, 0)
        self.assertTrue(all(abs(dot(n, n) - 1) < 1e-4 for n in normals), "unit normals")

    def test_have_an_acoustic_material_everywhere(self):
        table = (ROOT / "render" / "scene" / "materials.cpp").read_text()
        for name in NAMES:
            for material in Glb(SCENES / f"{name}.glb").json["materials"]:
                sonar = material["extras"]["sonar"]
                if "material" in sonar:
                    self.assertIn(f'{{"{sonar["material"]} ', table.replace('",', ' ",'), (name, material))
                else:
                    self.assertTrue(-60 <= sonar["mu_db"] <= -4.97, (name, material))

    def test_are_small(self):
        self.assertLess((SCENES / "manifold.glb").stat().st_size, 1.5e6)
        for name in NAMES[1:]:
            self.assertLess((SCENES / f"{name}.glb").stat().st_size, 250e3, name)

    def test_are_read_by_assimp(self):
        if not shutil.which("assimp"):
            skip_or_fail(self, "assimp is not installed (Debian package assimp-utils)")
        for name in NAMES:
            report = subprocess.run(["assimp", "info", SCENES / f"{name}.glb", "--raw"], capture_output=True,
                                    text=True)
            self.assertEqual(report.returncode, 0, report.stdout + report.stderr)
            made = make_scenes.triangles(make_scenes.COMMITTED[name]())
            self.assertEqual(int(re.search(r"Faces:\s+(\d+)", report.stdout)[1]), made)

    def test_are_where_the_scenarios_look(self):
        for scenario in (ROOT / "config").glob("*.yaml"):
            scene = re.search(r"^scene: (\S+)", scenario.read_text(), re.MULTILINE)
            self.assertTrue(scene and (scenario.parent / scene[1]).is_file(), scenario)


class Winding(unittest.TestCase):
    def solids(self):
        for name in NAMES:
            glb = Glb(SCENES / f"{name}.glb")
            for node in glb.nodes:
                if not node.startswith(("seabed", "flat", "floor")) or name in ("tank", "basin"):
                    for part in glb.primitives(node):
                        yield f"{name}/{node}", part

    def test_is_counter_clockwise_about_the_normals(self):
        for name, (_, positions, normals, triangles) in self.solids():
            inward = [t for t in triangles if any(dot(face(positions, t), normals[i]) < -1e-9 for i in t)]
            self.assertEqual(inward, [], name)

    def test_encloses_a_positive_volume_without_holes(self):
        for name, (_, positions, _, triangles) in self.solids():
            places = [tuple(round(v, 4) for v in p) for p in positions]
            edges = {}
            for t in triangles:
                for k in range(3):
                    edge = places[t[k]], places[t[(k + 1) % 3]]
                    edges[edge] = edges.get(edge, 0) + 1
            holes = [e for e, count in edges.items() if edges.get(e[::-1], 0) != count]
            volume = sum(dot(positions[t[0]], cross(positions[t[1]], positions[t[2]])) for t in triangles) / 6
            self.assertEqual(holes, [], name)
            self.assertGreater(volume, 0, name)


def inner_area(glb, node, axis, at, normal):
    """Area of the triangles of a node that lie in the plane axis = at and face `normal`."""
    area = 0.0
    for _, positions, _, triangles in glb.world_primitives(node):
        for t in triangles:
            f = face(positions, t)
            if all(abs(positions[i][axis] - at) < 1e-5 for i in t) and dot(f, normal) > 0:
                area += dot(f, f) ** 0.5 / 2
    return area


class Tank(unittest.TestCase):
    def setUp(self):
        self.glb = Glb(SCENES / "tank.glb")

    def test_walls_and_floor_stand_where_the_scene_says_and_face_the_water(self):
        self.assertGreaterEqual(inner_area(self.glb, "wall_east", 0, 6, (-1, 0, 0)), 8 * 4 - 1e-3)
        self.assertGreaterEqual(inner_area(self.glb, "wall_west", 0, -6, (1, 0, 0)), 8 * 4 - 1e-3)
        self.assertGreaterEqual(inner_area(self.glb, "wall_north", 1, 4, (0, -1, 0)), 12 * 4 - 1e-3)
        self.assertGreaterEqual(inner_area(self.glb, "wall_south", 1, -4, (0, 1, 0)), 12 * 4 - 1e-3)
        self.assertGreaterEqual(inner_area(self.glb, "floor", 2, -4, (0, 0, 1)), 12 * 8 - 1e-3)

    def test_things_in_it_look_different_from_every_side(self):
        places = {name: (self.glb.nodes[name]["translation"][0], -self.glb.nodes[name]["translation"][2])
                  for name in ("grid", "ball", "post")}
        self.assertTrue(all(abs(x) < 6 and abs(y) < 4 for x, y in places.values()))
        for mirrored in (lambda x, y: (-x, y), lambda x, y: (x, -y), lambda x, y: (-x, -y)):
            for x, y in places.values():
                self.assertTrue(all(abs(mirrored(x, y)[0] - u) + abs(mirrored(x, y)[1] - v) > 1
                                    for u, v in places.values()))


class Manifold(unittest.TestCase):
    def setUp(self):
        self.glb = Glb(SCENES / "manifold.glb")

    def size(self, name):
        low, high = self.glb.bounds(name)
        return [h - l for l, h in zip(low, high)]

    def test_has_the_size_of_the_papers_scene(self):
        length, width, height = self.size("manifold")
        self.assertTrue(6 <= length <= 7.5 and 4 <= width <= 5.5 and 3 <= height <= 3.8, (length, width, height))
        self.assertAlmostEqual(self.size("auv")[0], 4.0, places=2)
        self.assertAlmostEqual(self.size("seabed")[0], 60.0, places=4)
        low, high = self.glb.bounds("seabed")
        self.assertTrue(-11.5 < low[2] < high[2] < -8.5)

    def test_the_seabed_faces_up_and_goes_on_beyond_the_square(self):
        for node in ("seabed", "seabed_far"):
            for _, positions, _, triangles in self.glb.primitives(node):
                self.assertTrue(all(face(positions, t)[2] > 0 for t in triangles))
        self.assertAlmostEqual(self.size("seabed_far")[1], 300.0, places=3)


class Flat(unittest.TestCase):
    def test_is_flat_at_20_m_and_faces_up(self):
        (_, positions, normals, triangles), = Glb(SCENES / "flat.glb").primitives("floor")
        self.assertTrue(all(p[2] == -20 for p in positions) and all(n == (0, 0, 1) for n in normals))
        self.assertAlmostEqual(sum(face(positions, t)[2] for t in triangles) / 2, 400 * 400)


class Basin(unittest.TestCase):
    def test_its_inner_faces_are_where_the_scenario_says(self):
        glb = Glb(SCENES / "basin.glb")
        for wall, axis, at, normal, area in (
                ("wall_east", 0, 2.5, (-1, 0, 0), 3.6 * 2.6), ("wall_west", 0, -2.5, (1, 0, 0), 3.6 * 2.6),
                ("wall_north", 1, 1.8, (0, -1, 0), 5 * 2.6), ("wall_south", 1, -1.8, (0, 1, 0), 5 * 2.6),
                ("floor", 2, -2.6, (0, 0, 1), 5 * 3.6)):
            self.assertGreaterEqual(inner_area(glb, wall, axis, at, normal), area - 1e-3, wall)


class Harbour(unittest.TestCase):
    def setUp(self):
        self.glb = Glb(SCENES / "harbour.glb")

    def test_the_quay_and_the_sheet_piling_face_the_water(self):
        self.assertGreaterEqual(inner_area(self.glb, "quay", 1, 8, (0, -1, 0)), 80 * 11 - 1e-3)
        self.assertGreaterEqual(inner_area(self.glb, "sheet_piling", 0, -30, (1, 0, 0)), 0.24 * 58 * 11)

    def test_nothing_stands_out_of_the_water_and_everything_reaches_the_mud(self):
        for node in self.glb.nodes:
            for _, positions, _, _ in self.glb.world_primitives(node):
                self.assertLessEqual(max(p[2] for p in positions), 1e-6, node)
        for node in ("quay", "sheet_piling", "pile_1", "pile_14"):
            self.assertLess(min(p[2] for _, ps, _, _ in self.glb.world_primitives(node) for p in ps), -9, node)
        (_, positions, _, triangles), = self.glb.primitives("seabed")
        self.assertTrue(-9 < min(p[2] for p in positions) and max(p[2] for p in positions) < -4)
        self.assertTrue(all(face(positions, t)[2] > 0 for t in triangles))


class Pipe(unittest.TestCase):
    def test_its_inner_wall_is_a_circle_that_faces_the_water(self):
        inside = 0
        for _, positions, normals, _ in Glb(SCENES / "pipe.glb").primitives("wall"):
            for (_, y, z), normal in zip(positions, normals):
                if abs(normal[0]) < 0.5 and (radius := math.hypot(y, z)) < 0.35:
                    inside += 1
                    self.assertAlmostEqual(radius, 0.3, places=5)
                    self.assertLess(y * normal[1] + z * normal[2], -0.29)
        self.assertEqual(inside, 7 * 181)
        self.assertAlmostEqual(inner_area(Glb(SCENES / "pipe.glb"), "deposit", 2, -3.22, (0, 0, 1)), 0.4179 * 5.98, delta=0.01)


class Deep(unittest.TestCase):
    def setUp(self):
        self.glb = Glb(SCENES / "deep.glb")

    def test_the_bottom_lies_where_the_scenario_says_and_faces_up(self):
        for _, positions, _, triangles in self.glb.primitives("seabed"):
            self.assertTrue(all(-130 < p[2] < -108 for p in positions))
            self.assertTrue(all(face(positions, t)[2] > 0 for t in triangles))

    def test_the_fish_are_point_targets_about_their_school(self):
        fish = [node for name, node in self.glb.nodes.items() if name.startswith("fish_")]
        self.assertEqual(len(fish), 60)
        for node in fish:
            self.assertEqual(node["extras"], {"sonar": {"target_strength_db": -38.0}})
            x, z, y = node["translation"]
            self.assertTrue(abs(x) <= 3 and abs(y) <= 7 and abs(z) <= 4)


def corner_first(triangles):
    """Triangles in a common order, each from its least corner on, so that two lists can be compared."""
    return sorted(min(tuple(t[i:] + t[:i]) for i in range(3)) for t in triangles)


class Bench(unittest.TestCase):
    def test_has_the_measured_number_of_triangles(self):
        count = {name: make_scenes.triangles(make_scenes.bench.nodes(name)) for name in ("simple", "big100k")}
        self.assertEqual(count, {"simple": 1158, "big100k": 101508})

    def test_is_the_geometry_that_others_were_measured_with(self):
        script = ROOT.parent / "shared" / "scenes" / "generate.py"
        if not script.is_file():
            skip_or_fail(self, f"{script} is not there")
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run([sys.executable, script], cwd=folder, check=True, stdout=subprocess.DEVNULL)
            make_scenes.write(pathlib.Path(folder), "own", make_scenes.bench.nodes("simple"))
            own, own_count = Glb(pathlib.Path(folder, "own.glb")), 0
            vertices, measured, made = [], [], []
            for line in pathlib.Path(folder, "simple.obj").read_text().splitlines():
                kind, *rest = line.split()
                if kind == "v":
                    vertices.append(tuple(round(float(v), 3) + 0.0 for v in rest))
                elif kind == "f":
                    measured.append([vertices[int(corner.split("/")[0]) - 1] for corner in rest])
            for node in own.nodes:
                for _, positions, _, triangles in own.primitives(node):
                    own_count += len(triangles)
                    made += [[tuple(round(v, 3) + 0.0 for v in positions[i]) for i in t] for t in triangles]
        self.assertEqual(own_count, 1158)
        self.assertEqual(corner_first(made), corner_first(measured))


if __name__ == "__main__":
    unittest.main()
