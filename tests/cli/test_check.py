"""echoloop check and list."""
import json
import re
import tempfile
import unittest
from pathlib import Path

from program import DEMO, ROOT, TANK, ProgramTest, run


class Check(ProgramTest):
    def test_each_material_is_told_once(self):
        """Also steel, which is flat in the tank's lattice and curved in its ball."""
        names = [material["name"] for material in self.json("check", TANK)["scene"]["materials"]]
        self.assertEqual(sorted(names), ["concrete", "steel"])

    def test_a_scene_is_no_scenario(self):
        scene = ROOT / "config" / "scenes" / "tank.glb"
        text = self.bad(78, "check", scene)
        self.assertIn(f"{scene}: a scene is no scenario; write one that names it, with scene: {scene}", text)

    def test_a_good_scenario(self):
        text = self.good("check", DEMO)
        self.assertRegex(text, r"scenario +\S+demo.yaml: good")
        self.assertRegex(text, r"(?m)^device +micron +tritech-micron +pty:/tmp/echoloop/micron$")
        self.assertRegex(text, r"sound speed 14\d\d\.\d m/s \(Mackenzie 1981\)")

    def test_json_tells_the_same(self):
        report = self.json("check", TANK)
        self.assertTrue(report["ok"])
        self.assertGreater(report["scene"]["triangles"], 12)
        self.assertEqual(report["devices"][0]["name"], "micron")
        self.assertEqual(report["devices"][0]["endpoints"], ["pty:/tmp/echoloop/micron"])
        # The tank is 12 x 8 m; walls may be thicker outwards.
        bounds = report["scene"]["bounds"]
        self.assertLessEqual(bounds["min"][0], -6)
        self.assertGreaterEqual(bounds["max"][1], 4)

    def test_set_changes_the_scenario(self):
        report = self.json("check", TANK, "--set", "water.sound_speed=1450", "--set", "seed=7",
                           "--set", "devices.micron.name=front")
        self.assertEqual(report["water"]["sound_speed"], 1450)
        self.assertEqual(report["seed"], 7)
        self.assertEqual(report["devices"][0]["name"], "front")

    def test_effects_that_are_off_are_named(self):
        self.assertRegex(self.good("check", DEMO), r"(?m)^effects +all on$")
        text = self.good("check", DEMO, "--set", "effects.speckle=off", "--set", "effects.tvg=false")
        self.assertRegex(text, r"(?m)^effects +off: speckle, tvg$")
        report = self.json("check", DEMO, "--set", "effects={all: off, noise: on}")
        self.assertEqual([name for name, on in report["effects"].items() if on], ["noise"])
        self.assertRegex(self.good("check", DEMO, "--set", "render.rule=cerqueira2016"),
                         r"(?m)^effects +none; the rule cerqueira2016")

    def test_layered_water_prints_how_far_off_straight_rays_are(self):
        self.assertNotIn("rays", self.good("check", TANK))
        # Constant gradient of -0.5 /s: a level ray drops by 0.067 m at 20 m, on an arc of 3000 m.
        layers = ("--set", "water.profile=[[0, 1501], [300, 1351]]", "--set", "water.sound_speed=1500",
                  "--set", "effects.refraction=off")
        self.assertRegex(self.good("check", TANK, *layers),
                         r"(?m)^rays +micron: straight; an echo is shown at most 0\.0\d+ m from its true place")
        bound = self.json("check", TANK, *layers)["straight_rays"][0]
        self.assertEqual(bound["device"], "micron")
        self.assertAlmostEqual(bound["range_m"], 20, delta=0.1)
        self.assertAlmostEqual(bound["error_m"], 0.067, delta=0.01)

    def test_rays_that_bend_are_no_error_and_a_sound_speed_beside_a_profile_is_told_of(self):
        layers = ("--set", "water={profile: [[0, 1501], [300, 1351]]}")
        text = self.good("check", TANK, *layers)
        self.assertNotRegex(text, r"(?m)^(rays|warning)")
        self.assertEqual(self.json("check", TANK, *layers)["straight_rays"], [])
        text = self.good("check", TANK, *layers, "--set", "water.sound_speed=1500")
        self.assertRegex(text, r"(?m)^warning +water\.sound_speed times no echo, since rays bend by water\.profile")
        self.assertRegex(self.good("check", TANK, *layers, "--set", "render.rule=cerqueira2016"), r"(?m)^rays +micron: straight")

    def test_a_sound_speed_that_is_not_the_profiles_counts_among_what_straight_rays_are_off(self):
        layers = ("--set", "water.profile=[[0, 1450]]", "--set", "water.sound_speed=1600", "--set", "effects.refraction=off")
        bound = self.json("check", TANK, *layers)["straight_rays"][0]
        self.assertAlmostEqual(bound["error_m"], bound["range_m"] * (1 - 1450 / 1600), delta=0.01)

    def test_a_disc_that_is_not_round_is_refused(self):
        text = self.bad(78, "check", TANK, "--set", "devices.micron.profile.vertical_aperture=piston")
        self.assertIn("devices.micron.profile: horizontal_aperture and vertical_aperture: one of them is a piston", text)
        both = ("--set", "devices.micron.profile={horizontal_aperture: piston, vertical_aperture: piston, beam_width: 9}")
        self.assertIn("devices.micron.profile: beam_width and fan_height differ, but a piston's beam is round; give both "
                      "the same width", self.bad(78, "check", TANK, *both))
        self.good("check", TANK, *both, "--set", "devices.micron.profile.fan_height=9")

    def test_absorption_beyond_its_fit_is_a_warning(self):
        self.assertNotIn("warning", self.good("check", TANK))
        text = self.good("check", TANK, "--set", "devices.micron.profile.frequency=2.25e6")
        self.assertRegex(text, r"(?m)^warning +micron: absorption at 2250 kHz is extrapolated")

    def test_figures_of_the_profile_can_be_set(self):
        report = self.json("check", TANK, "--set", "devices.micron.profile={source_level: 200}")
        self.assertEqual(report["devices"][0]["profile"]["source_level"], 200)
        self.assertIn("did you mean 'source_level'?",
                      self.bad(78, "check", TANK, "--set", "devices.micron.profile.sorce_level=200"))
        self.assertIn("is a figure of the device's profile; write profile: {source_level: ...}",
                      self.bad(78, "check", TANK, "--set", "devices.micron.options.source_level=200"))

    def test_an_option_may_have_the_name_of_a_figure(self):
        self.good("check", ROOT / "config" / "oculus.yaml", "--set", "devices.oculus.options.part_number=1042")

    def test_every_problem_is_reported_with_its_place(self):
        file = self.scenario("scene: TANK\nwater: {temprature: 4}\ndevices:\n"
                             "  - {name: a, model: tritech-micro}\n  - {name: a, model: r2sonic-2024}\n")
        text = self.bad(78, "check", file)
        self.assertIn(f"error: {file}:2:9: unknown key 'temprature' in water; did you mean 'temperature'?", text)
        self.assertIn(f"error: {file}:4:22: devices.a.model: unknown model 'tritech-micro'; did you mean "
                      "'tritech-micron'?", text)
        self.assertIn(f"error: {file}:5:12: a device named 'a' exists already", text)

    def test_problems_as_json(self):
        file = self.scenario("scene: TANK\nsede: 1\ndevices: [{name: a, model: r2sonic-2024}]\n")
        done = run("check", file, "--json")
        self.assertEqual(done.returncode, 78)
        report = json.loads(done.stdout)
        self.assertFalse(report["ok"])
        self.assertEqual([(p["line"], p["column"]) for p in report["problems"]], [(2, 1)])

    def test_the_files_by_which_objects_move_are_read(self):
        way = self.folder / "way.csv"
        way.write_text("t,x,y,z\n0,0,0,0\n")
        text = self.bad(65, "check", TANK, "--set", f"objects=[{{node: ball, trajectory: {way}}}]")
        self.assertIn(f"{way}:1: the header must name the columns t,x,y,z,qw,qx,qy,qz", text)

    def test_a_fault_in_a_set_argument_names_the_argument(self):
        self.assertIn("error: --set water.ph=70: water.ph: 70 is out of range; allowed is 5 to 10",
                      self.bad(78, "check", TANK, "--set", "water.ph=70"))

    def test_missing_files_end_with_66(self):
        self.assertIn("none.yaml: no such file", self.bad(66, "check", self.folder / "none.yaml"))
        file = self.scenario("scene: none.glb\ndevices: [{name: a, model: r2sonic-2024}]\n")
        self.assertIn(f"{file}:1:8: scene: ", self.bad(66, "check", file))
        self.assertIn("not a regular file", self.bad(66, "check", self.folder))

    def test_a_hostile_scene_ends_with_65(self):
        (self.folder / "bad.glb").write_bytes(b"glTF" + bytes(range(200)))
        file = self.scenario("scene: bad.glb\ndevices: [{name: a, model: r2sonic-2024}]\n")
        self.assertIn("bad.glb", self.bad(65, "check", file))
        self.assertFalse(json.loads(run("check", file, "--json").stdout)["ok"])

    def test_text_that_is_hostile_is_refused_quickly(self):
        bomb = "a0: &a0 [x, x, x, x, x, x, x, x, x]\n" + "".join(
            f"a{i}: &a{i} [" + ", ".join([f"*a{i - 1}"] * 9) + "]\n" for i in range(1, 40))
        for text in (bomb, "[" * 900_000, "{" * 900_000, "- " * 450_000, "? " * 450_000, "a: " * 300_000,
                     "&a " * 300_000, "!a " * 300_000, "'" + "a" * 900_000, "\x00" * 1000, "\xff\xfe" * 1000,
                     "a:\n" + "".join(" " * i + "a:\n" for i in range(1, 1200)), "#" * 1_000_000,
                     "|\n" * 400_000, "a: >\n" + " b\n" * 300_000, "*a " * 300_000, "%YAML 1.2\n" * 90_000):
            file = self.scenario(text)
            self.assertEqual(run("check", file).returncode, 78, text[:20])


class List(ProgramTest):
    def test_a_line_per_model_and_the_way_to_more(self):
        lines = self.good("list").splitlines()
        names = [m["name"] for m in self.json("list")["models"]]
        self.assertEqual([line.split()[0] for line in lines[: len(names)]], names)
        self.assertRegex(lines[names.index("tritech-micron")], r"^tritech-micron +Tritech Micron.* {2,}SeaNet")
        self.assertEqual(len(lines), len(names) + 2)
        self.assertIn("echoloop list MODEL", lines[-1])

    def test_all_models_with_their_options(self):
        text = self.good("list", "--all")
        self.assertRegex(text, r"(?m)^tritech-micron +Tritech Micron")
        self.assertIn("udp-listen://127.0.0.1:65500", text)
        self.assertIn(self.good("list", "tritech-micron"), text)

    def test_json_gives_type_unit_default_and_source_of_every_option(self):
        models = {m["name"]: m for m in self.json("list")["models"]}
        self.assertEqual(sorted(models), list(models))
        for name in ("tritech-micron", "r2sonic-2024"):
            for option in models[name]["options"]:
                self.assertIn(option["type"], ("boolean", "integer", "number", "text"))
                self.assertTrue({"unit", "default", "help", "source"} <= set(option), option)
                self.assertTrue(option["help"], option)
                if "choices" in option:
                    self.assertIn(option["default"], option["choices"])
                elif option["type"] in ("integer", "number"):
                    self.assertLessEqual(option.get("minimum", option["default"]), option["default"])
                    self.assertGreaterEqual(option.get("maximum", option["default"]), option["default"])

    def test_acoustic_figures_have_units_and_sources(self):
        self.assertRegex(self.good("list", "tritech-micron"), r"source_level +206 +dB re 1 uPa at 1 m")
        for model in self.json("list")["models"]:
            self.assertGreater(len(model["profile"]), 5 if model["name"] == "nmea-ins" else 10)  # it is no sonar
            for figure in model["profile"]:
                self.assertTrue({"name", "value", "unit", "help", "source"} <= set(figure))
                self.assertGreater(len(figure["source"]), 8, figure)

    def test_one_model(self):
        self.assertEqual([m["name"] for m in self.json("list", "r2sonic-2024")["models"]], ["r2sonic-2024"])
        self.assertIn("did you mean 'r2sonic-2024'?", self.bad(64, "list", "r2sonic-2204"))


    def test_sonars_in_one_place_deafen_each_other(self):
        two = """
        - {name: port, model: omniscan450, endpoints: ["tcp-listen://127.0.0.1:51200"], mount: {position: [%s, 0, 0]}}
        - {name: starboard, model: omniscan450, endpoints: ["tcp-listen://127.0.0.2:51200"]}
"""
        scene = Path(TANK).parent / "scenes" / "tank.glb"
        head = f"scene: {scene}\nvehicle: {{pose: {{position: [0, 0, -2]}}}}\n"
        with tempfile.TemporaryDirectory() as folder:
            for apart, warned in (("0.03", True), ("0.3", False)):
                file = Path(folder) / "two.yaml"
                file.write_text(head + "devices:" + two % apart)
                said = self.good("check", str(file))
                pattern = r"warning +port and starboard: 0\.03 m apart in the same band.*mounts.*cross_talk off"
                self.assertEqual(bool(re.search(pattern, said)), warned, said)
            quiet = self.good("check", str(file), "--set", "devices.port.mount.position=[0, 0, 0]",
                              "--set", "effects.cross_talk=off")
            self.assertNotIn("warning", quiet)


if __name__ == "__main__":
    unittest.main()
