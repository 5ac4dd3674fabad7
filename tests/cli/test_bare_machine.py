"""Machines that lack something: Mesa or a part of it, pseudo-terminals, a /tmp that can be written. What is missing is
hidden from the program alone, in a folder of libraries before the system's or in a mount namespace of its own."""
import json
import os
import subprocess
import unittest

from program import DEMO, PROGRAM, TANK, ProgramTest

OSMESA, MESA_EGL, ANY_EGL = ("libOSMesa.so.8", "libOSMesa.so"), ("libEGL_mesa.so.0",), ("libEGL.so.1",)
OPENGL = ("--set", "render.sampler=raster")
PACKAGES = "install Mesa: apt-get install libosmesa6 or, where there is none, libegl-mesa0 libgl1-mesa-dri"


class WithoutMesa(ProgramTest):
    def without(self, *libraries):
        """The environment of a program that finds broken files in place of these libraries."""
        folder = self.folder / "broken"
        folder.mkdir(exist_ok=True)
        for name in sum(libraries, ()):
            (folder / name).write_bytes(b"")
        return {"LD_LIBRARY_PATH": str(folder)}

    def test_egl_alone_draws_the_same_picture(self):
        usual, alone = self.folder / "usual.npy", self.folder / "alone.npy"
        picture = ("render", TANK, *OPENGL, "--device", "micron", "--out")
        self.good(*picture, usual)
        self.good(*picture, alone, **self.without(OSMESA))
        self.assertEqual(usual.read_bytes(), alone.read_bytes())

    def test_a_run_says_what_draws(self):
        run = ("run", TANK, "--duration", "0.2", "--set", f"devices.micron.endpoints=['pty:{self.folder}/micron']")
        self.assertIn("EGL surfaceless", self.good(*run, *OPENGL, **self.without(OSMESA)))
        self.assertIn("own rasteriser", self.good(*run, "--set", "render.sampler=native"))

    def test_no_scene_needs_mesa(self):
        """Our own rasteriser draws the 1,500 triangles of the tank and the 56,520 of the manifold, even where a GPU might
        draw and there is no OpenGL to ask it."""
        for scenario, device in ((TANK, "micron"), (DEMO, "sonar")):
            picture = ("render", scenario, "--device", device, "--out")
            with_mesa, bare = self.folder / "with.npy", self.folder / "bare.npy"
            self.good(*picture, with_mesa, "--set", "render.sampler=native")
            self.good(*picture, bare, **self.without(OSMESA, MESA_EGL, ANY_EGL))
            self.assertEqual(with_mesa.read_bytes(), bare.read_bytes())

    def test_the_doctor_is_content_with_either(self):
        usual = {f["name"]: f for f in self.json("doctor")["findings"]}["OpenGL"]["text"]
        for missing in ((OSMESA,), (MESA_EGL, ANY_EGL) if "OSMesa" in usual else ()):
            found = {f["name"]: f for f in self.json("doctor", **self.without(*missing))["findings"]}
            self.assertEqual(found["OpenGL"]["state"], "good", found["OpenGL"])
            for name in sum(missing, ()):
                (self.folder / "broken" / name).unlink()

    def test_without_any_one_sentence_names_the_packages(self):
        bare = self.without(OSMESA, MESA_EGL, ANY_EGL)
        micron = ("--set", f"devices.micron.endpoints=['pty:{self.folder}/micron']")
        for arguments in (("render", TANK, *OPENGL, "--device", "micron", "--out", self.folder / "x.png"),
                          ("run", TANK, *OPENGL, "--duration", "0.2", *micron)):
            text = self.bad(69, *arguments, **bare)
            self.assertEqual(text.count("\n"), 1, text)
            self.assertIn(PACKAGES, text)
        self.assertEqual([f.name for f in self.folder.iterdir()], ["broken"])

    def test_the_doctor_says_what_opengl_is_missing_for(self):
        found = {f["name"]: f for f in self.json("doctor", **self.without(OSMESA, MESA_EGL, ANY_EGL))["findings"]}["OpenGL"]
        self.assertEqual((found["state"], found["remedy"]), ("weak", "our own rasteriser draws without it"))
        self.assertIn(PACKAGES, found["text"])


@unittest.skipIf(os.getuid() != 0, "only root can mount something for a program alone")
class WithoutFiles(ProgramTest):
    def setUp(self):
        super().setUp()
        tried = subprocess.run(["unshare", "--mount", "true"], capture_output=True, text=True, check=False)
        if tried.returncode != 0 and os.environ.get("CI") != "true":
            self.skipTest(f"no mount namespace can be made, as in a chroot: {tried.stderr.strip()}")

    def run_after(self, mounts, *arguments):
        command = f'{mounts} && exec "$@"'
        return subprocess.run(["unshare", "--mount", "sh", "-c", command, "sh", PROGRAM, *arguments],
                              capture_output=True, text=True, timeout=60, check=False)

    def assert_refused(self, done, status, *words):
        self.assertEqual(done.returncode, status, done.stderr)
        self.assertRegex(done.stderr, r"\Aecholoop: error: [^\n]*\n\Z")
        for word in words:
            self.assertIn(word, done.stderr)

    def test_without_pseudo_terminals_a_run_says_what_else_to_use(self):
        line = f"devices.micron.endpoints=['pty:{self.folder}/micron']"
        (self.folder / "file").touch()
        for no_ptmx in (f"mount --bind {self.folder}/file /dev/ptmx", "mount -t tmpfs none /dev"):
            done = self.run_after(no_ptmx, "run", TANK, "--duration", "0.2", "--set", line)
            self.assert_refused(done, 69, "/dev/ptmx", "mount -t devpts", "tcp-listen://")
        self.assertFalse((self.folder / "micron").is_symlink())

    def test_a_tmp_that_cannot_be_written_is_named_with_another_place(self):
        read_only = "mount --bind /tmp /tmp && mount -o remount,bind,ro /tmp"
        done = self.run_after(read_only, "run", TANK, "--duration", "0.2")
        self.assert_refused(done, 77, "/tmp/echoloop", "Read-only file system", "e.g. pty:/")
        done = self.run_after(read_only, "run", TANK, "--duration", "0.2", "--json", "--set",
                              "devices.micron.endpoints=['pty:/run/echoloop-test/micron']")
        os.rmdir("/run/echoloop-test")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        json.loads(done.stdout.splitlines()[-1])


if __name__ == "__main__":
    unittest.main()
