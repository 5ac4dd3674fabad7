"""What `echoloop import` makes of shapes: primitives, outlines, meshes, heightmaps."""
import shutil
import struct
import unittest
import zlib

from worlds import BOX, TETRAHEDRON, ImportTest, mesh, model, sdf, visual


def collada(unit, up):
    points = "0 0 0 1 0 0 0 1 0 0 0 1"
    return f"""<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit name="u" meter="{unit}"/><up_axis>{up}</up_axis></asset>
<library_geometries><geometry id="g" name="g"><mesh>
<source id="p"><float_array id="pa" count="12">{points}</float_array>
<technique_common><accessor source="#pa" count="4" stride="3"><param name="X" type="float"/>
<param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="4"><input semantic="VERTEX" source="#v" offset="0"/><p>0 2 1 0 1 3 0 3 2 1 2 3</p></triangles>
</mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s" name="s"><node id="n" name="n"><instance_geometry url="#g"/></node>
</visual_scene></library_visual_scenes><scene><instance_visual_scene url="#s"/></scene></COLLADA>"""


def stl(scale=1.0):
    corners = [(0, 0, 0), (scale, 0, 0), (0, scale, 0), (0, 0, scale)]
    faces = [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)]
    out = b"\0" * 80 + struct.pack("<I", len(faces))
    for face in faces:
        out += struct.pack("<12fH", 0, 0, 0, *[v for i in face for v in corners[i]], 0)
    return out


def ply():
    return ("ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
            "element face 4\nproperty list uchar int vertex_indices\nend_header\n"
            "0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n")


def png(rows):
    """A grey picture of 8 bits."""
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    raw = b"".join(b"\0" + bytes(row) for row in rows)
    head = struct.pack(">IIBBBBB", len(rows[0]), len(rows), 8, 0, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(raw)) + chunk(b"IEND", b"")


class Shapes(ImportTest):
    def near(self, pair, expected, places=4):
        for mine, theirs in zip(pair, expected):
            for a, b in zip(mine, theirs):
                self.assertAlmostEqual(a, b, places)

    def test_primitives_have_their_sizes_and_their_outsides_outwards(self):
        cases = {"box": (BOX, (1, 2, 3), 48),
                 "cylinder": ("<cylinder><radius>0.5</radius><length>3</length></cylinder>", (0.5, 0.5, 1.5), 2.356),
                 "sphere": ("<sphere><radius>2</radius></sphere>", (2, 2, 2), 33.51),
                 "capsule": ("<capsule><radius>0.5</radius><length>2</length></capsule>", (0.5, 0.5, 1.5), 2.094),
                 "ellipsoid": ("<ellipsoid><radii>1 2 3</radii></ellipsoid>", (1, 2, 3), 25.13),
                 "cone": ("<cone><radius>1</radius><length>3</length></cone>", (1, 1, 1.5), 3.1416)}
        world = "".join(model(name, visual(shape)) for name, (shape, _, _) in cases.items())
        scene, _ = self.convert(self.write("w.sdf", sdf(world, "1.9")))
        for name, (_, half, volume) in cases.items():
            with self.subTest(name):
                node = f"{name}::link::visual"
                self.near(scene.bounds(node), ([-v for v in half], half))
                self.assertAlmostEqual(scene.volume(node) / volume, 1, delta=0.02)  # facets lie within
                self.assertNotIn("doubleSided", scene.material(node))

    def test_a_cone_has_its_tip_upwards(self):
        scene, _ = self.convert(model("cone", visual("<cone><radius>1</radius><length>3</length></cone>")))
        points = next(scene.primitives("cone::link::visual"))[1]
        self.assertEqual({p[:2] for p in points if p[2] == 1.5}, {(0, 0)})

    def test_outlines_are_drawn_up_and_have_holes(self):
        def line(points, more=""):
            return "<polyline>" + "".join(f"<point>{x} {y}</point>" for x, y in points) + f"<height>2</height>{more}</polyline>"
        # An L without a square hole; its last corner repeats the first. Areas by hand: 3 x 3 - 2 x 2, and 0.5 x 0.5.
        ell = [(0, 0), (3, 0), (3, 1), (1, 1), (1, 3), (0, 3), (0, 0)]
        hole = [(0.25, 0.25), (0.75, 0.25), (0.75, 0.75), (0.25, 0.75)]
        slanted = [(0, 0), (2, 0.5), (1, 2), (0.9, 0.7)]  # area 1.25 + ..., by the shoelace below
        area = abs(sum(a[0] * b[1] - b[0] * a[1] for a, b in zip(slanted, slanted[1:] + slanted[:1]))) / 2
        scene, _ = self.convert(model("ell", visual(line(ell) + line(hole))) + model("back", visual(line(ell[::-1]))) +
                                model("slanted", visual(line(slanted))))
        for name, expected in {"ell": 5 - 0.25, "back": 5, "slanted": area}.items():
            node = f"{name}::link::visual"
            self.assertAlmostEqual(scene.volume(node), 2 * expected, 4, name)
            self.assertNotIn("doubleSided", scene.material(node))
        self.near(scene.bounds("ell::link::visual"), ((0, 0, 0), (3, 3, 2)))
        points = {p for _, positions, _ in scene.primitives("ell::link::visual") for p in positions}
        self.assertIn((0.25, 0.75, 0), points)

    def test_outlines_and_cones_that_cannot_be(self):
        def shape(points, height="1"):
            return "<polyline>" + "".join(f"<point>{p}</point>" for p in points) + f"<height>{height}</height></polyline>"
        square = ["0 0", "1 0", "1 1", "0 1"]
        many = [f"{i} {i * i}" for i in range(1200)]
        for geometry, said in ((shape(["0 0", "1 1", "1 0", "0 1"]), "crosses itself; make a mesh of it"),
                               (shape(["0 0", "1 1"]), "has fewer than 3 corners"), (shape(many), "<point> holds"),
                               (shape([f"{i} {i % 7}" for i in range(1200)]), "has more than 1000 corners"),
                               (shape(square, "-1"), "<height> is not above 0"), (shape(square, "high"), "<height> holds high"),
                               (shape(["0 0", "nan 0", "0 1"]), "<point> holds nan 0; give 2 numbers"),
                               (shape(["0 0", "1 0", "2 0"]), "encloses nothing"),
                               ("<cone><radius>1</radius></cone>", "<cone> without a <length>"),
                               ("<cone><radius>1e9</radius><length>1</length></cone>", "<radius> holds 1e9")):
            text = self.refused(model("a", visual(geometry)))
            self.assertIn(said, text)
            self.assertIn("w.world:4: ", text)

    def test_a_plane_faces_its_normal(self):
        plane = "<plane><normal>1 0 0</normal><size>4 2</size></plane>"
        scene, _ = self.convert(model("wall", visual(plane)))
        self.near(scene.bounds("wall::link::visual"), ((0, -1, -2), (0, 1, 2)))
        _, p, triangles = next(scene.primitives("wall::link::visual"))
        a, b, c = (p[i] for i in triangles[0])
        u, v = [x - y for x, y in zip(b, a)], [x - y for x, y in zip(c, a)]
        self.assertGreater(u[1] * v[2] - u[2] * v[1], 0)

    def test_meshes_of_every_kind(self):
        files = {"a.obj": TETRAHEDRON, "a.stl": stl(), "a.ply": ply(), "a.dae": collada(1, "Z_UP")}
        for name, content in files.items():
            self.write(name, content)
        world = "".join(model(name[2:], visual(mesh(name))) for name in files)
        scene, report = self.convert(world)
        self.assertEqual((report["meshes"], report["triangles"]), (4, 16))
        for name in files:
            node = f"{name[2:]}::link::visual"
            self.near(scene.bounds(node), ((0, 0, 0), (1, 1, 1)))
            self.assertAlmostEqual(scene.volume(node), 1 / 6, 4, name)

    def test_the_scene_itself_is_a_mesh(self):
        self.convert(model("box", visual(BOX)))
        shutil.move(self.out, self.folder / "again.glb")
        scene, _ = self.convert(model("box", visual(mesh("again.glb"))))
        self.near(scene.bounds("box::link::visual"), ((-1, -3, -2), (1, 3, 2)))  # y stays y, as in Gazebo

    def test_of_collada_the_unit_counts_and_the_axis_does_not(self):
        self.write("a.dae", collada(0.01, "Y_UP"))
        self.write("b.dae", collada(0.01, "X_UP"))
        scene, _ = self.convert(model("a", visual(mesh("a.dae", "<scale>200 100 300</scale>"))) +
                                model("b", visual(mesh("b.dae"))))
        self.near(scene.bounds("a::link::visual"), ((0, 0, 0), (2, 1, 3)))
        self.near(scene.bounds("b::link::visual"), ((0, 0, 0), (0.01, 0.01, 0.01)))

    def test_mirrored_and_inside_out_meshes_are_turned(self):
        self.write("a.obj", TETRAHEDRON)
        self.write("b.obj", TETRAHEDRON.replace("f 1 3 2", "f 1 2 3").replace("f 1 2 4", "f 1 4 2")
                   .replace("f 1 4 3", "f 1 3 4").replace("f 2 3 4", "f 2 4 3"))
        scene, _ = self.convert(model("a", visual(mesh("a.obj", "<scale>-1 1 1</scale>"))) +
                                model("b", visual(mesh("b.obj"))))
        for name in "ab":
            self.assertAlmostEqual(scene.volume(f"{name}::link::visual"), 1 / 6, 4, name)

    def test_open_meshes_count_on_both_sides(self):
        self.write("a.obj", TETRAHEDRON.replace("f 2 3 4\n", ""))
        scene, _ = self.convert(model("a", visual(mesh("a.obj"))))
        self.assertTrue(scene.material("a::link::visual")["doubleSided"])

    def test_a_submesh_alone_and_in_the_middle(self):
        self.write("a.obj", TETRAHEDRON + TETRAHEDRON.replace("o part", "o other").replace("v ", "v 5")
                   .replace("f 1 3 2", "f 5 7 6").replace("f 1 2 4", "f 5 6 8").replace("f 1 4 3", "f 5 8 7")
                   .replace("f 2 3 4", "f 6 7 8"))
        scene, _ = self.convert(model("a", visual(mesh(
            "a.obj", "<submesh><name>part</name><center>true</center></submesh>"))))
        self.near(scene.bounds("a::link::visual"), ((-0.5, -0.5, -0.5), (0.5, 0.5, 0.5)))

    def test_a_heightmap_has_its_brightest_pixel_at_its_height_and_its_first_row_in_the_north(self):
        self.write("h.png", png([[200, 0, 0], [0, 100, 0], [0, 0, 0]]))
        heightmap = "<heightmap><uri>h.png</uri><size>20 10 4</size><pos>1 0 -8</pos></heightmap>"
        scene, report = self.convert(model("h", visual(heightmap)))
        self.near(scene.bounds("h::link::visual"), ((-9, -5, -8), (11, 5, -4)))
        points = next(scene.primitives("h::link::visual"))[1]
        self.assertIn((-9, 5, -4), points)
        self.assertIn((1, 0, -6), points)
        self.assertEqual(report["materials"][0]["material"], "sand")


    def asc(self, name, rows, cell):
        self.write(name, f"ncols {len(rows[0])}\nnrows {len(rows)}\nxllcorner 1000\nyllcorner 2000\ncellsize {cell}\n" +
                   "".join(" ".join(map(str, row)) + "\n" for row in rows))

    def test_a_model_of_terrain_has_its_own_size_and_heights_or_those_that_are_told(self):
        self.asc("d.asc", [[-20, -20, -20], [-20, -14, -20], [-20, -20, -24]], 5)
        own = "<heightmap><uri>d.asc</uri><pos>1 0 2</pos></heightmap>"
        sized = "<heightmap><uri>d.asc</uri><size>20 30 5</size></heightmap>"
        scene, report = self.convert(model("own", visual(own)) + model("sized", visual(sized)))
        self.near(scene.bounds("own::link::visual"), ((-4, -5, -22), (6, 5, -12)))
        # As Gazebo's renderer has it: the lowest stays, and 5 m are between it and the highest.
        self.near(scene.bounds("sized::link::visual"), ((-10, -15, -24), (10, 15, -19)))
        self.assertIn((6, -5, -22), next(scene.primitives("own::link::visual"))[1])
        _, p, triangles = next(scene.primitives("own::link::visual"))
        for triangle in triangles:  # seen from above
            a, b, c = (p[i] for i in triangle)
            self.assertGreater((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]), 0)
        self.assertIn("d.asc: its heights are taken as metres", "\n".join(report["notes"]))
        self.assertEqual(report["materials"][0]["material"], "sand")
        self.write("e.asc", "no grid")
        self.assertIn("e.asc: is no grid that can be read",
                      self.refused(model("h", visual("<heightmap><uri>e.asc</uri></heightmap>"))))


if __name__ == "__main__":
    unittest.main()
