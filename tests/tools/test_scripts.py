#!/usr/bin/env python3
"""tools/install, tools/demo and tools/fuzz, run with made-up system commands: what they install, and how they refuse."""
import ast
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]

FAKES = {
    # Everything is installed but what stands in the file "missing".
    "dpkg-query": 'name=${!#}; if grep -qx "$name" "$STATE/missing"; then exit 1; fi; printf installed',
    "apt-get": 'echo "apt-get $*" >>"$STATE/log"\n'
               'case "$*" in *install*) n=$(cat "$STATE/failures"); echo $((n - 1)) >"$STATE/failures"\n'
               '[ "$n" -le 0 ] ;; esac',
    # Apt knows everything but what stands in the file "unknown"; nothing at all if its lists are missing.
    "apt-cache": '[ ! -e "$STATE/stale" ] || exit 100\n'
                 'for name; do grep -qx -- "$name" "$STATE/unknown" || echo "Package: $name"; done',
    "sudo": 'echo "sudo $*" >>"$STATE/log"; [ ! -e "$STATE/no_sudo" ] || exit 1\n'
            'while [ "${1#-}" != "$1" ]; do shift; done; exec "$@"',
    "id": 'cat "$STATE/uid"',
}
# Of Debian, which of them a Python module comes with.
IN_PACKAGE = {"pynmea2": "python3-nmea2", "websockets": "python3-websockets"}
REAL = ("bash", "sed", "tr", "env", "grep", "cat", "dirname", "readlink", "true")


class Script(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.state = pathlib.Path(folder.name)
        self.bin = self.state / "bin"
        self.bin.mkdir()
        for name in REAL:
            (self.bin / name).symlink_to(shutil.which(name))
        for name, text in FAKES.items():
            (self.bin / name).write_text(f"#!{shutil.which('bash')}\n{text}\n")
            (self.bin / name).chmod(0o755)
        self.put("missing", "libcairo2-dev\nlibgtest-dev\n")
        self.put("unknown")
        self.put("failures", "0")
        self.put("os-release", 'VERSION_ID="13"\nVERSION="13 (trixie)"\nID=debian\n')
        self.put("uid", "0")
        self.put("log", "")

    def put(self, name, text=""):
        (self.state / name).write_text(text)

    def run_script(self, *command):
        result = subprocess.run([ROOT / "tools" / command[0], *command[1:]], capture_output=True, text=True,
                                stdin=subprocess.DEVNULL, cwd="/", env={
            "PATH": str(self.bin), "STATE": str(self.state), "OS_RELEASE": str(self.state / "os-release")})
        self.output = result.stdout + result.stderr
        self.log = (self.state / "log").read_text().splitlines()
        return result.returncode

    def installs(self):
        return [line.split("--no-install-recommends ")[1] for line in self.log
                if line.startswith("apt-get") and " install " in line]

    def updates(self):
        return [line for line in self.log if line.startswith("apt-get") and " update" in line]


class Install(Script):
    def test_installs_only_what_is_missing_and_says_why(self):
        self.assertEqual(self.run_script("install", "build"), 0, self.output)
        self.assertEqual(self.installs(), ["libcairo2-dev"])
        self.assertEqual(self.updates(), [])
        self.assertRegex(self.output, r"libcairo2-dev +pictures")
        self.assertNotIn("libgtest-dev", self.output)

    def test_adds_what_the_tests_need(self):
        self.assertEqual(self.run_script("install", "test"), 0, self.output)
        self.assertEqual(self.installs(), ["libcairo2-dev libgtest-dev"])

    def test_adds_less_for_the_tests_of_sonars(self):
        self.put("missing", "libcairo2-dev\nlibgtest-dev\numockdev\nlibroscpp-dev\n")
        self.assertEqual(self.run_script("install", "devices"), 0, self.output)
        self.assertEqual(self.installs(), ["libcairo2-dev libgtest-dev"])

    def test_what_the_tests_of_sonars_import_is_among_their_packages(self):
        """With what their own modules import. On a machine with nothing else they would fail at the first line."""
        runs = re.search(r"set\(tests_of_runs ([^)]*)\)", (ROOT / "tests" / "e2e" / "CMakeLists.txt").read_text())[1].split()
        modules = {path.stem: path for folder in ("e2e", "hosts", "cli") for path in (ROOT / "tests" / folder).glob("*.py")}
        modules |= {path.stem: path for path in (ROOT / "tools").glob("*.py")}
        # test_serial.py runs a program that comes with the packages of all tests.
        todo = {name for name, path in modules.items() if path.parent.name in ("e2e", "hosts") and name.startswith("test_")}
        todo -= {f"test_{run}" for run in runs} | {"test_serial"}
        seen, foreign = set(), set()
        while todo:
            seen.add(name := todo.pop())
            for node in ast.walk(ast.parse(modules[name].read_text())):
                imported = [node.module] if isinstance(node, ast.ImportFrom) else [
                    alias.name for alias in node.names] if isinstance(node, ast.Import) else []
                for module in (path.split(".")[0] for path in imported):
                    if module in modules:
                        todo |= {module} - seen
                    elif module not in sys.stdlib_module_names and not (ROOT / "tools" / module).is_dir():
                        foreign.add(module)
        packages = re.search(r"(?s)\ndevice_packages='(.*?)'", (ROOT / "tools" / "install").read_text())[1]
        self.assertLessEqual({"pynmea2", "websockets"}, foreign)
        for module in foreign:
            self.assertRegex(packages, rf"(?m)^{IN_PACKAGE.get(module)} ", module)

    def test_adds_what_fuzzing_needs(self):
        self.put("missing", "libcairo2-dev\nlibgtest-dev\nclang-16\nclang-19\n")
        self.assertEqual(self.run_script("install", "fuzz"), 0, self.output)
        self.assertEqual(self.installs(), ["libcairo2-dev libgtest-dev clang-16"])

    def test_says_and_does_nothing_when_all_is_there(self):
        self.put("missing")
        self.assertEqual(self.run_script("install", "test"), 0)
        self.assertEqual((self.output, self.log), ("", []))

    def test_updates_the_lists_only_when_they_do_not_know_a_package(self):
        self.put("stale")
        self.assertEqual(self.run_script("install", "build"), 0)
        self.assertEqual([" update" in line for line in self.log], [True, False])

    def test_tries_again_with_new_lists_then_gives_up(self):
        self.put("failures", "1")
        self.assertEqual(self.run_script("install", "build"), 0)
        self.assertEqual((len(self.installs()), len(self.updates())), (2, 1))
        self.put("failures", "9")
        self.assertEqual(self.run_script("install", "build"), 69)
        self.assertIn("could not install: libcairo2-dev", self.output)

    def test_without_permission_names_the_command_for_an_administrator(self):
        self.put("uid", "1000")
        self.put("no_sudo")
        self.assertEqual(self.run_script("install", "build"), 77)
        self.assertIn("apt-get install -y libcairo2-dev", self.output)
        self.assertEqual(self.installs(), [])

    def test_without_sudo_names_it_too(self):
        self.put("uid", "1000")
        (self.bin / "sudo").unlink()
        self.assertEqual(self.run_script("install", "build"), 77)
        self.assertIn("apt-get install -y libcairo2-dev", self.output)

    def test_as_a_user_goes_through_sudo(self):
        self.put("uid", "1000")
        self.assertEqual(self.run_script("install", "build"), 0, self.output)
        self.assertTrue(any(line.startswith("sudo ") and "install" in line for line in self.log))
        self.assertEqual(self.installs(), ["libcairo2-dev"])

    def test_elsewhere_than_on_debian_lists_the_packages(self):
        (self.bin / "dpkg-query").unlink()
        self.assertEqual(self.run_script("install", "build"), 69)
        self.assertIn("libembree-dev", self.output)
        self.assertIn("cmake --preset release", self.output)

    def test_of_alternatives_one_is_enough_and_the_first_that_the_release_has_is_installed(self):
        self.put("missing", "clang-16\n")
        self.assertEqual(self.run_script("install", "fuzz"), 0, self.output)
        self.assertEqual(self.log, [])
        self.put("missing", "clang-16\nclang-19\n")
        self.put("unknown", "clang-16\n")
        self.assertEqual(self.run_script("install", "fuzz"), 0, self.output)
        self.assertEqual(self.installs(), ["clang-19"])

    def test_what_the_release_lacks_is_left_out_and_named_where_only_a_helper_needs_it(self):
        self.put("missing", "libignition-transport-dev\nshellcheck\n")
        self.put("unknown", "libignition-transport-dev\n")
        self.assertEqual(self.run_script("install", "test"), 0, self.output)
        self.assertEqual((self.installs(), self.updates()), (["shellcheck"], []))
        self.assertRegex(self.output, "Left out.* no libignition-transport-dev: echoloop-pose-gz")
        self.put("missing", "libignition-transport-dev\n")
        self.put("log")
        self.assertEqual(self.run_script("install", "test"), 0, self.output)
        self.assertEqual(self.log, [])

    def test_another_release_gets_the_list_of_what_is_missing(self):
        self.put("os-release", 'NAME="Ubuntu"\nVERSION_ID="22.04"\nID=ubuntu\nID_LIKE=debian\n')
        self.assertEqual(self.run_script("install", "build"), 69)
        self.assertEqual(self.log, [])
        for words in ("this is the system ubuntu-22.04", "Debian 13", "libcairo2-dev", "cmake --preset release"):
            self.assertIn(words, self.output)
        self.put("missing", "libosmesa6\n")
        self.assertEqual(self.run_script("install", "build"), 0, self.output)

    def test_wants_to_know_what_for(self):
        for arguments in ((), ("all",)):
            self.assertEqual(self.run_script("install", *arguments), 64)
        self.assertEqual(self.log, [])


class Demo(Script):
    def test_refuses_a_wrong_argument_before_it_installs_anything(self):
        for arguments in (("--duration",), ("--duration", "long"), ("--nonsense",)):
            self.assertEqual(self.run_script("demo", *arguments), 64, arguments)
            self.assertIn("tools/demo [--duration SECONDS]", self.output)
        self.assertEqual(self.log, [])

    def test_explains_itself(self):
        self.assertEqual(self.run_script("demo", "--help"), 0)
        self.assertIn("until Ctrl-C", self.output)


class Fuzz(Script):
    def test_refuses_a_wrong_argument_before_it_installs_anything(self):
        for arguments in (("--forever",), ("1m",), ("--table", "1m")):
            self.assertEqual(self.run_script("fuzz", *arguments), 64, arguments)
            self.assertIn("tools/fuzz [SECONDS] [NAME...]", self.output)
        self.assertEqual(self.log, [])

    def test_its_compiler_gets_no_switch_that_only_gcc_knows(self):
        found = 0
        for path in (ROOT / "CMakeLists.txt", *ROOT.glob("*/**/CMakeLists.txt")):
            for line in path.read_text().splitlines():
                if re.search(r"-ftree-|-Wno-subobject-linkage", line) and "build" not in path.parts:
                    self.assertIn("CXX_COMPILER_ID:GNU", line, path)
                    found += 1
        self.assertGreater(found, 1)

    def test_explains_itself(self):
        self.assertEqual(self.run_script("fuzz", "--help"), 0)
        self.assertIn("devices/MODEL", self.output)


if __name__ == "__main__":
    unittest.main()
