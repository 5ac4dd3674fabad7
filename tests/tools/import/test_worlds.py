"""What `echoloop import` makes of worlds: places, names, materials."""
import os
import shutil
import subprocess
import unittest

from worlds import BOX, TETRAHEDRON, ImportTest, mesh, model, script, sdf, visual


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

    def test_joints_of_a_urdf_that_are_fixed_keep_their_links(self):
        def link(name, inner=True):
            box = '<visual><geometry><box size="1 1 1"/></geometry></visual>' if inner else ""
            return f'<link name="{name}">{box}</link>'
        def joint(name, parent, child, x):
            return (f'<joint name="{name}" type="fixed"><origin xyz="{x} 0 0"/><parent link="{parent}"/>'
                    f'<child link="{child}"/></joint>')
        urdf = ('<robot name="rov">' + link("base_link", False) + link("frame") + link("mount", False) + link("sonar") +
                joint("j1", "base_link", "frame", 1) + joint("j2", "frame", "mount", 2) + joint("j3", "mount", "sonar", 4) +
                "</robot>")
        scene, report = self.convert(self.write("rov.urdf", urdf))
        for name, x in {"rov::frame": 1, "rov::mount": 3, "rov::sonar": 7, "rov::j1": 1, "rov::j2": 3, "rov::j3": 7}.items():
            self.assertEqual(scene.position(name), (x, 0, 0), name)
        self.assertEqual(report["meshes"], 2)
        self.assertEqual({name for name in scene.places if name.startswith("rov::sonar::")}, {"rov::sonar::sonar_visual"})

    def test_every_version_of_the_format(self):
        for version in ("1.4", "1.5", "1.6", "1.7", "1.8", "1.9", "1.10", "1.11"):
            scene, report = self.convert(self.write("w.sdf", sdf(model("b", visual(BOX)), version)))
            self.assertEqual(scene.position("b"), (0, 0, 0))
            self.assertEqual(bool(report["notes"]), version in ("1.10", "1.11"))

    def test_where_on_earth_it_is(self):
        scene, _ = self.convert("<spherical_coordinates><surface_model>EARTH_WGS84</surface_model>"
                                "<latitude_deg>59.5</latitude_deg><longitude_deg>10.25</longitude_deg>"
                                "<elevation>12</elevation></spherical_coordinates>" + model("b", visual(BOX)))
        origin = scene.json["scenes"][0]["extras"]["sonar"]["origin"]
        self.assertEqual([round(origin[key], 9) for key in ("latitude", "longitude", "height")], [59.5, 10.25, 12])


    def test_a_heading_turns_the_world_as_gazebo_has_it(self):
        world = ("<spherical_coordinates><surface_model>EARTH_WGS84</surface_model><latitude_deg>45.8</latitude_deg>"
                 "<longitude_deg>11.5</longitude_deg><elevation>0</elevation><heading_deg>30</heading_deg>"
                 "</spherical_coordinates>" + model("b", visual(BOX), more="<pose>100 0 -3 0 0 0</pose>"))
        scene, report = self.convert(world)
        # ignition-math 6.15, LOCAL2 of SphericalCoordinates: x = 100 lies 86.6 m to the east and 50.0 m to the north.
        for mine, gazebos in zip(scene.position("b"), (86.603, 50.0, -3)):
            self.assertAlmostEqual(mine, gazebos, 2)
        self.assertEqual(scene.json["scenes"][0]["extras"]["sonar"]["origin"]["latitude"], 45.8)
        self.assertIn("turned by its heading of 30 deg", report["notes"][0])
        scene, report = self.convert(world, "--heading", "0")
        self.assertEqual((scene.position("b"), report["notes"]), ((100, 0, -3), []))
        self.assertIn("--heading: expected degrees", self.refused(world, "--heading", "north", status=64))


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
            if os.environ.get("CI") == "true":
                self.fail("assimp-utils is not installed")
            self.skipTest("assimp-utils is not installed")
        self.convert(model("a", visual(BOX)) + model("b", visual("<sphere><radius>1</radius></sphere>")))
        done = subprocess.run(["assimp", "info", self.out], capture_output=True, text=True, timeout=60, check=False)
        self.assertRegex(done.stdout, r"Meshes:\s+2\n")
        self.assertRegex(done.stdout, r"Faces:\s+2220\n")


if __name__ == "__main__":
    unittest.main()
