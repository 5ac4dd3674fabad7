"""What `echoloop import` says of worlds that are broken, missing or mean. It may never crash, hang, read what was not
named, or leave half a file."""
import os
import random
import unittest

from worlds import BOX, TETRAHEDRON, ImportTest, mesh, model, sdf, visual


class Missing(ImportTest):
    def test_all_that_is_missing_is_named_at_once(self):
        world = (model("a", visual(mesh("model://rock/rock.dae"))) +
                 "<include><uri>https://fuel.gazebosim.org/1.0/OpenRobotics/models/Coast Waves</uri></include>" +
                 "<include><uri>model://wreck</uri></include>")
        text = self.refused(world, "--model-path", self.folder)
        self.assertIn(f"w.world:4: mesh model://rock/rock.dae is in none of {self.folder}", text)
        self.assertIn('fetch it: gz fuel download -u "https://fuel.gazebosim.org/1.0/OpenRobotics/models/Coast Waves"',
                      text)
        self.assertIn("model model://wreck is in none of", text)
        self.assertIn("3 things of the world cannot be had; or leave them out with --allow-missing", text)

    def test_or_left_out_when_asked(self):
        scene, report = self.convert(model("a", visual(mesh("x.dae")) + visual(BOX, "b")), "--allow-missing")
        self.assertEqual(sorted(scene.places), ["a", "a::link", "a::link::b"])
        self.assertIn("mesh x.dae is in none of", report["left_out"][0])

    def test_fuel_models_are_taken_from_local_caches(self):
        place = "home/.gz/fuel/fuel.gazebosim.org/openrobotics/models/mud anchor/"
        for version in "2", "10":
            self.write(place + version + "/model.config", "<model><sdf>model.sdf</sdf></model>")
            self.write(place + version + "/model.sdf", f'<sdf version="1.7"><model name="v{version}"><static>true</static>'
                       '<link name="l">' + visual(mesh(
                           "https://fuel.gazebosim.org/1.0/OpenRobotics/models/mud anchor/2/files/meshes/a.obj")) +
                       "</link></model></sdf>")
        self.write(place + "2/meshes/a.obj", TETRAHEDRON)
        scene, _ = self.convert("<include><uri>https://fuel.ignitionrobotics.org/1.0/OpenRobotics/models/Mud%20Anchor"
                                "</uri></include>")
        self.assertIn("v10", scene.places)

    def test_unknown_geometry(self):
        self.assertIn("<torus> is a geometry that is not known; make a mesh of it",
                      self.refused(model("a", visual("<torus><radius>1</radius></torus>"))))

    def test_nothing_to_hear(self):
        text = self.refused(model("lake", visual(BOX, "water")))
        self.assertIn("left out: lake::link::water: water, by visual \"water\"", text)
        self.assertIn("nothing is left that a sonar could hear; keep what was left out", text)

    def test_usage(self):
        world = self.write("w.world", sdf(model("a", visual(BOX))))
        self.assertIn("no file that can be read", self.refused(self.folder / "none.sdf", status=66))
        self.assertIn("is no folder; name one", self.refused(world, "--model-path", self.folder / "none"))
        self.out = self.folder / "out" / "scene.gltf"
        self.assertIn("does not end in .glb", self.refused(world, status=64))


class Mean(ImportTest):
    def include(self, uri):
        return f'<include><uri>{uri}</uri></include>'

    def model_file(self, name, content):
        self.write(f"models/{name}/model.config", "<model><sdf>model.sdf</sdf></model>")
        return self.write(f"models/{name}/model.sdf", f'<sdf version="1.7"><model name="{name}">{content}</model></sdf>')

    def refused_include(self, name):
        return self.refused(self.include(f"model://{name}"), "--model-path", self.folder / "models")

    def test_models_that_include_themselves(self):
        self.model_file("a", self.include("model://a"))
        self.model_file("b", self.include("model://c"))
        self.model_file("c", self.include("model://b"))
        self.assertIn("a model cannot hold itself", self.refused_include("a"))
        self.assertRegex(self.refused_include("b"), "b/model.sdf includes .*c/model.sdf includes .*b/model.sdf")

    def test_long_chains_and_avalanches_of_includes(self):
        for i in range(40):
            self.model_file(f"chain{i}", self.include(f"model://chain{i + 1}"))
            many = "".join(f"<include><uri>model://flood{i + 1}</uri><name>m{k}</name></include>" for k in range(20))
            self.model_file(f"flood{i}", many if i < 5 else '<link name="l"/>')
        self.assertIn("is included over more than 32 files", self.refused_include("chain0"))
        self.assertIn("includes more than 20,000 models", self.refused_include("flood0"))

    def test_nothing_outside_the_folders_is_read(self):
        secret = self.write("secret/mesh.obj", TETRAHEDRON)
        self.write("secret/model.sdf", '<sdf version="1.7"><model name="m"><link name="l"/></model></sdf>')
        (self.folder / "here").mkdir()
        (self.folder / "here" / "link.obj").symlink_to(secret)
        (self.folder / "here" / "folder").symlink_to(self.folder / "secret")
        for uri in (secret, f"file://{secret}", "../secret/mesh.obj", "link.obj", "folder/mesh.obj",
                    "model://../secret/mesh.obj", f"model://{secret}", "model://folder/mesh.obj"):
            world = self.write("here/w.world", sdf(model("a", visual(mesh(uri)))))
            self.assertIn("out of the folders of models; name that folder with --model-path", self.refused(world), uri)
            self.convert(world, "--model-path", self.folder / "secret")
        for uri in ("../secret/model.sdf", "folder", f"file://{self.folder}/secret/model.sdf"):
            world = self.write("here/w.world", sdf(self.include(uri)))
            self.assertIn("out of the folders of models", self.refused(world), uri)
        os.mkfifo(self.folder / "here" / "fifo.obj")
        self.assertIn("is in none of", self.refused(self.write("here/w.world", sdf(model("a", visual(mesh("fifo.obj")))))))

    def test_meshes_open_no_other_files(self):
        secret = self.write("secret/data.bin", b"\0" * 60)
        gltf = ('{"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],"meshes":[{"primitives":'
                '[{"attributes":{"POSITION":0}}]}],"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3",'
                '"min":[0,0,0],"max":[0,0,0]}],"bufferViews":[{"buffer":0,"byteLength":36}],"buffers":[{"byteLength":60,'
                f'"uri":"../secret/{secret.name}"}}]}}')
        self.write("here/a.gltf", gltf)
        self.assertIn("a.gltf: cannot be read", self.refused(self.write("here/w.world", sdf(model("a", visual(mesh("a.gltf")))))))

    def test_files_that_are_no_worlds(self):
        for content, said in {"": "is no XML", "<sdf": "is no XML", "<html/>": "is neither SDF nor URDF",
                              "<sdf version='9'/>": "", "<sdf version='1.7'/>": "",
                              "<sdf version='1.7'><world name='w'/></sdf>": "nothing is left",
                              "<sdf version='1.7'>" + "<a>" * 5000 + "</a>" * 5000 + "</sdf>": "is no XML",
                              "<robot name='r'/>": "", "\0\1\2": "is no XML"}.items():
            self.assertIn(said, self.refused(self.write("w.world", content)))

    def test_poses_that_are_none(self):
        for pose in ("<pose>nan 0 0 0 0 0</pose>", "<pose>1e300 1e300 1e300 0 0 0</pose>",
                     '<pose relative_to="nowhere">0 0 0 0 0 0</pose>'):
            self.refused(f'<model name="m">{pose}<link name="l">{visual(BOX)}</link></model>')
        frames = ('<frame name="a"><pose relative_to="b"/></frame><frame name="b"><pose relative_to="a"/></frame>'
                  + model("m", visual(BOX)))
        self.refused(frames)

    def test_meshes_that_lie(self):
        for name, content in {"a.obj": "v 0 0 0\nf 1 2 3\n", "b.obj": TETRAHEDRON.replace("v 1 0 0", "v nan 0 0"),
                              "c.stl": b"\0" * 80 + b"\xff\xff\xff\x7f", "d.ply": "ply\nformat ascii 1.0\nelement vertex 9999999999\n",
                              "e.dae": "<COLLADA>", "f.obj": "", "g.obj": TETRAHEDRON.replace("v 1 0 0", "v 1e30 0 0"),
                              "h.gltf": "{}", "i.glb": b"glTF\2\0\0\0\xff\xff\xff\xff", "j.obj": "v 0 0 0\nv 1 1 1\nl 1 2\n"}.items():
            self.write(name, content)
            self.refused(model("m", visual(mesh(name))))
            self.convert(model("m", visual(mesh(name)) + visual(BOX, "b")), "--allow-missing")
        self.write("x.blend", "")
        self.assertIn("is a kind of mesh that is not read", self.refused(model("m", visual(mesh("x.blend")))))

    def test_damaged_worlds_are_refused_or_read(self):
        """Bytes flipped, lines doubled and left out: any status that is meant, and no other."""
        self.write("a.obj", TETRAHEDRON)
        good = sdf(model("a", visual(mesh("a.obj")), more="<pose>1 2 3 0 0 0</pose>") + self.include("sub") +
                   '<frame name="f" attached_to="a"/>')
        self.write("sub/model.config", "<model><sdf>model.sdf</sdf></model>")
        self.write("sub/model.sdf", '<sdf version="1.6"><model name="s"><link name="l">' + visual(BOX) +
                   "</link><joint name='j' type='fixed'><parent>world</parent><child>l</child></joint></model></sdf>")
        self.convert(self.write("w.world", good))
        self.out.unlink()
        dice = random.Random(33)
        for _ in range(int(os.environ.get("ECHOLOOP_IMPORT_ROUNDS", "40"))):
            data = bytearray(good.encode())
            for _ in range(dice.randint(1, 4)):
                at = dice.randrange(len(data))
                piece = data[at:at + dice.randint(1, 60)]
                choice = dice.randrange(4)
                if choice == 0:
                    data[at] = dice.randrange(256)
                elif choice == 1:
                    del data[at:at + len(piece)]
                elif choice == 2:
                    data[at:at] = piece
                else:
                    data[at:at + 1] = dice.choice([b"1e999", b"-1", b"</model>", b"<model name='a'>", b"..", b"\0", b"&#0;"])
            done = self.run_import(self.write("w.world", bytes(data)))
            self.assertIn(done.returncode, (0, 65), (bytes(data), done.stderr))
            self.assertNotIn(b"broke the library", done.stderr, bytes(data))
            self.assertNotIn(b"internal", done.stderr, bytes(data))
            for file in self.out.parent.iterdir():
                self.assertEqual((file.name, done.returncode), ("scene.glb", 0))
                file.unlink()


if __name__ == "__main__":
    unittest.main()
