"""What `echoloop import` makes of worlds: shapes, places, names, materials."""
import shutil
import struct
import subprocess
import unittest
import zlib

from worlds import BOX, TETRAHEDRON, ImportTest, mesh, model, script, sdf, visual


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
                 "ellipsoid": ("<ellipsoid><radii>1 2 3</radii></ellipsoid>", (1, 2, 3), 25.13)}
        world = "".join(model(name, visual(shape)) for name, (shape, _, _) in cases.items())
        scene, _ = self.convert(self.write("w.sdf", sdf(world, "1.9")))
        for name, (_, half, volume) in cases.items():
            with self.subTest(name):
                node = f"{name}::link::visual"
                self.near(scene.bounds(node), ([-v for v in half], half))
                self.assertAlmostEqual(scene.volume(node) / volume, 1, delta=0.02)  # facets lie within
                self.assertNotIn("doubleSided", scene.material(node))

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


class Places(ImportTest):
    def test_poses_frames_nested_and_included_models(self):
        self.write("models/anchor/model.config", "<model><sdf version='1.6'>old.sdf</sdf>"
                   "<sdf version='1.7'>model.sdf</sdf></model>")
        self.write("models/anchor/old.sdf", "not read")
        self.write("models/anchor/meshes/a.obj", TETRAHEDRON)
        self.write("models/anchor/model.sdf", '<sdf version="1.7"><model name="anchor"><link name="link">' +
                   visual(mesh("model://anchor/meshes/a.obj")) + visual(mesh("meshes/a.obj"), "b") + "</link></model></sdf>")
        world = """<frame name="f"><pose>10 0 0 0 0 1.5707963267949</pose></frame>
            <model name="outer"><pose relative_to="f">1 0 0 0 0 0</pose><static>true</static>
              <model name="inner"><pose>0 2 0 0 0 0</pose><link name="l"><pose>0 0 3 0 0 0</pose>""" + visual(BOX) + """
              </link></model></model>
            <include><uri>model://anchor</uri><name>left</name><pose>0 0 -5 0 0 0</pose></include>"""
        scene, report = self.convert(world, "--model-path", self.folder / "models")
        self.assertEqual(scene.position("outer"), (10, 1, 0))
        self.assertEqual(scene.position("outer::inner::l::visual"), (8, 1, 3))
        self.assertEqual(scene.position("left::link::visual"), (0, 0, -5))
        self.assertEqual(scene.places["left::link::visual"][0]["mesh"], scene.places["left::link::b"][0]["mesh"])
        self.assertEqual(report["movers"], ["left"])

    def test_a_merged_model_and_the_environments_path(self):
        self.write("models/m/model.config", "<model><sdf>model.sdf</sdf></model>")
        self.write("models/m/model.sdf",
                   '<sdf version="1.9"><model name="m"><link name="arm">' + visual(BOX) + "</link></model></sdf>")
        world = '<model name="base"><include merge="true"><uri>model://m</uri><pose>0 0 1 0 0 0</pose></include></model>'
        for variable in ("GZ_SIM_RESOURCE_PATH", "GAZEBO_MODEL_PATH"):
            scene, _ = self.convert(self.write("w.sdf", sdf(world, "1.9")), **{variable: str(self.folder / "models")})
            self.assertEqual(scene.position("base::arm::visual"), (0, 0, 1))

    def test_joints_keep_their_node(self):
        world = """<model name="crane"><link name="mast">""" + visual(BOX) + """</link>
            <link name="boom"><pose>0 0 3 0 0 0</pose>""" + visual(BOX) + """</link>
            <joint name="slew" type="revolute"><pose>0 1 0 0 0 0</pose><parent>mast</parent><child>boom</child>
            <axis><xyz>0 0 1</xyz></axis></joint></model>"""
        scene, _ = self.convert(world)
        self.assertEqual(scene.position("crane::slew"), (0, 1, 3))

    def test_a_urdf_with_and_without_masses(self):
        self.write("arm_description/meshes/a.obj", TETRAHEDRON)
        urdf = """<robot name="arm"><link name="base"><visual><geometry><box size="1 1 1"/></geometry></visual></link>
            <link name="tip"><visual><origin xyz="0 0 1"/><geometry>
            <mesh filename="package://arm_description/meshes/a.obj" scale="2 2 2"/></geometry></visual></link>
            <joint name="j" type="revolute"><origin xyz="1 0 0"/><parent link="base"/><child link="tip"/>
            <axis xyz="0 0 1"/><limit lower="-1" upper="1" effort="1" velocity="1"/></joint></robot>"""
        scene, report = self.convert(self.write("arm.urdf", urdf), "--model-path", self.folder / "arm_description")
        self.assertEqual((report["meshes"], report["triangles"]), (2, 16))
        name = next(name for name in scene.places if name.startswith("arm::tip::"))
        self.assertEqual(scene.bounds(name), ((1, 0, 1), (3, 2, 3)))

    def test_every_version_of_the_format(self):
        for version in ("1.4", "1.5", "1.6", "1.7", "1.8", "1.9", "1.10", "1.11"):
            scene, report = self.convert(self.write("w.sdf", sdf(model("b", visual(BOX)), version)))
            self.assertEqual(scene.position("b"), (0, 0, 0))
            self.assertEqual(bool(report["notes"]), version in ("1.10", "1.11"))

    def test_where_on_earth_it_is(self):
        scene, _ = self.convert("<spherical_coordinates><surface_model>EARTH_WGS84</surface_model>"
                                "<latitude_deg>59.5</latitude_deg><longitude_deg>10.25</longitude_deg>"
                                "<elevation>12</elevation></spherical_coordinates>" + model("b", visual(BOX)))
        origin = scene.json["scenes"][0]["extras"]["origin"]
        self.assertEqual([round(origin[key], 9) for key in ("latitude", "longitude", "height")], [59.5, 10.25, 12])


class Materials(ImportTest):
    def materials(self, world, *arguments):
        return {row["model"]: (row["material"], row["from"].split()[0], row["guessed"])
                for row in self.convert(world, *arguments)[1]["materials"]}

    def test_from_properties_words_things_and_reflectivity(self):
        property_of = '<surface_props:material xmlns:surface_props="x">metal</surface_props:material>'
        world = (model("a", visual(BOX), more=property_of) + model("b", visual(BOX, more=script("Gazebo/WoodPallet"))) +
                 model("c", visual(BOX, "gravel_patch")) + model("pipeline", visual(BOX)) +
                 model("d", visual(BOX, more="<laser_retro>0.5</laser_retro>")) + model("e", visual(BOX)))
        self.assertEqual(self.materials(world), {
            "a": ("steel", "surface_props", False), "b": ("wood", "script", False), "c": ("gravel", "visual", False),
            "pipeline": ("steel", "model", True), "d": ("laser_retro 0.50", "laser_retro", True),
            "e": ("unknown", "nothing:", True)})

    def test_the_users_rules_come_first(self):
        rules = self.write("map.yaml", '- {model: "wr.*", visual: hull, material: wood}\n'
                           "- {script: Gazebo/Grey, mu_db: -12, reflection: 0.8}\n- {model: sand, leave_out: true}\n"
                           "- {model: nowhere, material: mud}\n")
        world = (model("wreck", visual(BOX, "hull") + visual(BOX, "steel_mast")) +
                 model("b", visual(BOX, more=script("Gazebo/Grey"))) + model("sand", visual(BOX)))
        scene, report = self.convert(world, "--materials", rules)
        self.assertEqual(scene.material("wreck::link::hull")["extras"]["sonar"], {"material": "wood"})
        self.assertEqual(scene.material("wreck::link::steel_mast")["extras"]["sonar"], {"material": "steel"})
        self.assertEqual(scene.material("b::link::visual")["extras"]["sonar"], {"mu_db": -12, "reflection": 0.8})
        self.assertNotIn("sand::link::visual", scene.places)
        self.assertEqual(report["notes"], [f"{rules}:4: the rule fits nothing"])

    def test_faults_of_rules_have_a_line_and_a_remedy(self):
        for rule, said in {"- {model: a, material: stel}": ":1: material: \"stel\" is not a known material; use one of",
                           "- {model: a, materal: steel}": ":1: materal is not a known key; did you mean material?",
                           "- {material: steel}": ":1: a rule without a condition",
                           "- {model: a}": ":1: a rule gives a material or leaves something out",
                           "- {model: a, mu_db: 3}": ":1: mu_db: must be within -120..-4.97 dB",
                           "- {model: '(', material: mud}": ":1: model is no regular expression",
                           "- {model: a, mu_db: loud}": ":1: mu_db has a value of another kind",
                           "model: a": "is no list of rules", "- {model": "is no YAML"}.items():
            self.assertIn(said, self.refused(model("a", visual(BOX)), "--materials", self.write("m.yaml", rule)))

    def test_water_robots_and_axes_are_left_out_and_told(self):
        sensor = "<sensor name='s' type='imu'/>"
        world = (model("sea", visual(BOX, "water_surface") + visual(BOX, "bottom")) +
                 model("vehicle", visual(BOX) + sensor, static=False) + model("bluerov2", visual(BOX), static=False) +
                 model("buoy", visual(BOX), static=False) + model("axes", visual(BOX)))
        scene, report = self.convert(world)
        self.assertEqual(sorted(name for name in scene.places if "::visual" in name or "::bottom" in name),
                         ["buoy::link::visual", "sea::link::bottom"])
        self.assertEqual(report["movers"], ["buoy"])
        left_out = "\n".join(report["left_out"])
        for word in ("sea::link::water_surface: water", "vehicle: the robot itself, by a sensor imu (guessed)",
                     "bluerov2: the robot itself, by its name (guessed); --keep bluerov2 keeps it", "axes: a drawing"):
            self.assertIn(word, left_out)
        scene, report = self.convert(world, "--keep", "bluerov2", "--keep", "sea", "--without", "buoy")
        self.assertIn("bluerov2::link::visual", scene.places)
        self.assertIn("sea::link::water_surface", scene.places)
        self.assertNotIn("buoy", scene.places)

    def test_a_name_that_is_no_models(self):
        self.assertIn('--without boy: no model has this name; use one of buoy',
                      self.refused(model("buoy", visual(BOX)), "--without", "boy"))

    def test_the_table(self):
        world = self.write("w.world", sdf(model("pipeline", visual(BOX) + visual(BOX, "steel_cap")) +
                                          model("buoy", visual(BOX), static=False)))
        done = self.run_import(world)
        self.assertEqual(done.returncode, 0, done.stderr)
        text = done.stdout.decode()
        for line in ('pipeline       1         12  steel     model "pipeline" (guessed)\n',
                     'pipeline       1         12  steel     visual "steel_cap"\n',
                     "can move (objects: of a scenario): buoy\n",
                     f"{self.out}: 2 models, 3 meshes, 36 triangles, 1 materials taken, 2 guessed, "):
            self.assertIn(line, text)

    def test_a_second_opinion_on_the_file(self):
        """assimp, which knows nothing of the writer, finds the same meshes and triangles."""
        if shutil.which("assimp") is None:
            self.skipTest("assimp-utils is not installed")
        self.convert(model("a", visual(BOX)) + model("b", visual("<sphere><radius>1</radius></sphere>")))
        done = subprocess.run(["assimp", "info", self.out], capture_output=True, text=True, timeout=60, check=False)
        self.assertRegex(done.stdout, r"Meshes:\s+2\n")
        self.assertRegex(done.stdout, r"Faces:\s+2220\n")


if __name__ == "__main__":
    unittest.main()
