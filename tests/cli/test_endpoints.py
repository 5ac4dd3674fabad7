"""echoloop endpoints: what is printed is what a driver needs."""
import configparser
import re
import shlex
import unittest
from pathlib import Path

import yaml
from program import DEMO, TANK, ProgramTest

ECHOSOUNDER = str(Path(DEMO).with_name("echosounder.yaml"))
MICRON = "devices.micron.endpoints="
COMMAND = r"(rosrun|roslaunch|rosparam|ros2|socat|sim_vehicle\.py|param|\./connect|python3) "
NO_DRIVER = {"reson-7k", "valeport-va500", "tritech-pa500", "tritech-pa200", "benthos-psa916", "imagenex-863"}


class Endpoints(ProgramTest):
    seen = set()

    def test_plain_addresses(self):
        text = self.good("endpoints", DEMO)
        self.assertRegex(text, r"line +/tmp/echoloop/micron, 115200 bit/s 8N1")
        self.assertRegex(text, r"listens for commands +127\.0\.0\.1:65502")
        self.assertRegex(text, r"sends bathymetry to +127\.0\.0\.1:65400")
        self.assertRegex(text, r"sends status to +127\.0\.0\.1:65402")
        self.assertRegex(text, r"sends images to +127\.0\.0\.1:65403")
        self.assertRegex(text, r"sends TruePix to +127\.0\.0\.1:65401")
        self.assertRegex(text, r"sends water column to +127\.0\.0\.1:65405")
        self.assertRegex(text, r"sends snippets to +127\.0\.0\.1:65406")

    def test_where_datagrams_go_that_leave_from_another_port(self):
        kmall = self.good("endpoints", str(Path(DEMO).with_name("kmall.yaml")))
        self.assertRegex(kmall, r"listens for commands +127\.0\.0\.1:14002\n +sends datagrams to +127\.0\.0\.1:6020"
                                r"\n +sends texts to +127\.0\.0\.1:4002")
        aris = self.good("endpoints", str(Path(DEMO).with_name("aris.yaml")))
        self.assertRegex(aris, r"sends beacon to +127\.255\.255\.255:56124")
        self.assertRegex(aris, r"sends frames to +the controller, or the receiver that it names")

    def test_a_device_that_only_sends(self):
        line = self.good("endpoints", ECHOSOUNDER)
        self.assertRegex(line, r"line +/tmp/echoloop/echosounder, 4800 bit/s 8N1")
        fast = self.good("endpoints", ECHOSOUNDER, "--set", "devices.echosounder.options.baud=38400")
        self.assertRegex(fast, r"line +/tmp/echoloop/echosounder, 38400 bit/s 8N1")
        datagrams = self.good("endpoints", ECHOSOUNDER, "--set", "devices.echosounder.endpoints=[udp://127.0.0.1:10110]")
        self.assertRegex(datagrams, r"sends datagrams to +127\.0\.0\.1:10110")

    def test_a_device_that_broadcasts(self):
        text = self.good("endpoints", str(Path(DEMO).with_name("oculus.yaml")))
        self.assertRegex(text, r"data +TCP, connect to 127\.0\.0\.1:52100")
        self.assertRegex(text, r"sends status to +127\.255\.255\.255:52102")

    def test_a_profiler_is_no_imaging_head(self):
        profiler = str(Path(DEMO).with_name("profiler.yaml"))
        text = self.good("endpoints", profiler, "--format", "ros1")
        self.assertIn("no driver of ROS 1 for tritech-profiler is known", text)
        rock = yaml.safe_load(self.good("endpoints", profiler, "--format", "rock"))
        self.assertEqual(rock, {"io_port": "serial:///tmp/echoloop/profiler:115200"})

    def test_ros1(self):
        text = self.good("endpoints", DEMO, "--format", "ros1")
        self.assertIn("\nrosrun tritech_micron scan.py _port:=/tmp/echoloop/micron _frame:=micron\n", text)
        self.assertIn("no driver of ROS 1 for r2sonic-2024 is known", text)

    def test_ros2(self):
        text = self.good("endpoints", DEMO, "--format", "ros2")
        self.assertIn("ros2 run r2sonic r2sonic_node --ros-args -p interface_ip:=127.0.0.1 -p ports.bathy:=65400 "
                      "-p ports.acoustic_image:=65403 -p sonar_ip:=127.0.0.1 -p sim_ip:=127.0.0.1\n", text)
        self.assertIn('    port: "/tmp/echoloop/micron"\n    baudrate: 115200\n', text)

    def test_rock_and_moos(self):
        rock = self.good("endpoints", TANK, "--format", "rock")
        self.assertIn("io_port: 'serial:///tmp/echoloop/micron:115200'", rock)
        tcp = self.good("endpoints", TANK, "--format", "rock", "--set", MICRON + "[tcp-listen://127.0.0.1:9090]")
        self.assertIn("io_port: 'tcp://127.0.0.1:9090'", tcp)
        moos = self.good("endpoints", TANK, "--format", "moos")
        self.assertRegex(moos, r"ProcessConfig = iSonar\n\{\n(.*\n)*  SERIAL_PORT = /tmp/echoloop/micron\n(.*\n)*\}")
        block = dict(line.strip().split(" = ") for line in re.sub(" +", " ", moos).splitlines() if line.startswith(" "))
        self.assertEqual(block["SONAR_TYPE"], "Micron")
        self.assertGreater(int(block["NBINS"]), 0)  # iSonar has no default, and shows nothing without bins
        self.assertGreater(float(block["RANGE"]) * float(block["ANGLESTEP"]) * float(block["GAIN"]), 0)
        seaking = self.good("endpoints", str(Path(DEMO).with_name("seaking.yaml")), "--format", "moos")
        self.assertIn("  SONAR_TYPE  = Miniking\n", seaking)  # the word of its Sonar.cpp

    def test_a_driver_that_opens_serial_ports_only_gets_one_made_from_tcp(self):
        text = self.good("endpoints", TANK, "--format", "ros1", "--set", MICRON + "[tcp-listen://127.0.0.1:9090]")
        self.assertIn("\nsocat PTY,link=/tmp/micron,raw,echo=0 TCP:127.0.0.1:9090\n", text)
        self.assertIn("_port:=/tmp/micron ", text)

    def test_the_controller_of_a_kmall_system(self):
        kmall = str(Path(DEMO).with_name("kmall.yaml"))
        block = yaml.safe_load(self.good("endpoints", kmall, "--format", "ros1"))
        self.assertEqual(block["kmall_connection"], {"udp_address": "127.0.0.1", "udp_rx_port": 6020, "udp_tx_port": 6021})
        self.assertEqual(block["kctrl_connection"], {"udp_address": "127.0.0.1", "udp_rx_port": 4002, "udp_tx_port": 14002})
        mute = self.good("endpoints", kmall, "--format", "ros1", "--set",
                         "devices.multibeam.endpoints=[udp-listen://127.0.0.1:14002, udp://127.0.0.1:6020]")
        self.assertIn("no driver of ROS 1 for kongsberg-kmall is known", mute)  # it waits for the controller's texts

    def test_norbit_and_3d_15(self):
        norbit = self.good("endpoints", str(Path(DEMO).with_name("norbit.yaml")), "--format", "ros1")
        self.assertIn("\nrosrun norbit norbit_node _ip:=127.0.0.1 _cmd_port:=2209 _bathy_port:=2210 "
                      "_water_column_port:=2211 _sensor_frame:=multibeam\n", norbit)
        sonar = self.good("endpoints", str(Path(DEMO).with_name("sonar-3d-15.yaml")), "--format", "ros2")
        self.assertIn("\nros2 run sonar3d sonar_publisher --ros-args -p IP:=127.0.0.1\n", sonar)
        self.assertIn("packets RIP1", sonar)

    def test_dune(self):
        for name, section, key, port in (
            ("imagenex-852", "Sensors.Imagenex852", "io port - device", "uart:///tmp/echoloop/imagenex-852"),
            ("imagenex-881a", "Sensors.Imagenex881A", "serial port - device", "/tmp/echoloop/imagenex-881a"),
            ("imagenex-872", "Sensors.Imagenex872", "io port - device", "tcp://127.0.0.1:4040"),
            ("edgetech-2205", "Sensors.Edgetech2205", "tcp port - data", "1701"),
            ("dvl-a50", "Sensors.WaterLinkedDVL", "io port - device", "tcp://127.0.0.1:16171"),
            ("dvl-a125", "Sensors.WaterLinkedDVL", "dvl model", "A125"),
        ):
            text = self.good("endpoints", str(Path(DEMO).with_name(name + ".yaml")), "--format", "dune")
            ini = configparser.ConfigParser()
            ini.read_string(text)
            self.assertEqual(ini[section][key], port)
            if name != "imagenex-881a":  # the others are drivers that refuse to start without it
                self.assertGreater(float(ini[section]["activation time"]), 0)

    def test_sample_program_of_the_maker(self):
        aris = str(Path(DEMO).with_name("aris.yaml"))
        text = self.good("endpoints", aris, "--format", "maker", "--set", "devices.aris.options.serial=24")
        self.assertIn("\n./connect 24\n", text)
        self.assertEqual(text.count("./connect "), 3)

    def test_where_no_driver_is_known_it_says_so(self):
        for name in ("dune", "sitl"):
            text = self.good("endpoints", DEMO, "--format", name)
            self.assertTrue(all(line.startswith("#") for line in text.splitlines()), text)

    def test_without_a_driver_the_addresses_are_there_as_comments(self):
        text = self.good("endpoints", DEMO, "--format", "dune")
        self.assertRegex(text, r"\n#   line +/tmp/echoloop/micron, 115200 bit/s 8N1\n")
        self.assertRegex(text, r"\n#   sends bathymetry to +127\.0\.0\.1:65400\n")

    def test_ping360_in_ros(self):
        ping360 = str(Path(DEMO).with_name("ping360.yaml"))
        self.assertIn("\nrosrun ping360_sonar ping360_node _device:=/tmp/echoloop/ping360 _baudrate:=115200\n",
                      self.good("endpoints", ping360, "--format", "ros1"))
        line = self.good("endpoints", ping360, "--format", "ros2")
        self.assertIn(" -p fallback_emulated:=false -p device:=/tmp/echoloop/ping360 -p baudrate:=115200\n", line)
        bridge = self.good("endpoints", ping360, "--format", "ros2", "--set",
                           "devices.ping360.endpoints=[udp-listen://127.0.0.1:9092]")
        self.assertIn(" -p connection_type:=udp -p udp_address:=127.0.0.1 -p udp_port:=9092\n", bridge)

    def test_range_finders_of_ardupilot(self):
        ping1d = str(Path(DEMO).with_name("ping1d.yaml"))
        text = self.good("endpoints", ping1d, "--format", "sitl")
        self.assertIn('-A "--serial5=uart:/tmp/echoloop/ping1d:115200"\n', text)
        self.assertIn("param set RNGFND1_TYPE 23\n", text)
        udp = self.good("endpoints", ping1d, "--format", "sitl", "--set", "devices.ping1d.endpoints=[udp-listen://127.0.0.1:9090]")
        self.assertIn('"--serial5=udpclient:127.0.0.1:9090"', udp)
        nmea = self.good("endpoints", ECHOSOUNDER, "--format", "sitl")
        self.assertIn('uart:/tmp/echoloop/echosounder:4800"\nparam set SERIAL5_PROTOCOL 9\nparam set SERIAL5_BAUD 4\n', nmea)
        self.assertIn("param set RNGFND1_TYPE 17\n", nmea)
        sent = self.good("endpoints", ECHOSOUNDER, "--format", "sitl", "--set", "devices.echosounder.endpoints=[udp://127.0.0.1:10110]")
        self.assertIn("no driver of ArduPilot for nmea-echosounder is known", sent)  # SITL opens no such port

    def test_every_block_that_is_printed_can_be_read(self):
        """One scenario of each model in every format: shells read commands, YAML the rest, and so on."""
        models, files = set(), set()
        for file in sorted(Path(DEMO).parent.glob("*.yaml")):
            new = {device["model"] for device in yaml.safe_load(file.read_text()).get("devices") or []} - models
            models |= new
            files |= {file} if new else set()
        for file in sorted(files):
            for format in "ros1", "ros2", "rock", "moos", "dune", "sitl", "maker", "python":
                for device in self.json("endpoints", file, "--format", format)["devices"]:
                    if device["paste"]:
                        with self.subTest(model=device["model"], format=format):
                            self.read_block(format, device["paste"])
                            self.seen.add(device["model"])
        print("models with a driver:", *sorted(self.seen))
        self.assertEqual(models - self.seen, NO_DRIVER)

    def read_block(self, format, lines):
        lines = [line for line in lines if not line.startswith("#")]
        self.assertTrue(lines)
        text = "\n".join(lines)
        self.assertNotRegex(text, r"\{[a-z]+( \d)?\}", "what was to be filled in")
        if format == "python" and not lines[0].startswith("python3 "):
            compile(text, format, "exec")
        elif format == "dune":
            configparser.ConfigParser().read_string(text)
        elif format == "moos":
            self.assertRegex(text, r"\AProcessConfig = \w+\n\{\n(  \w+ += \S+( +//.*)?\n)+\}\Z")
        else:
            commands = [line for line in lines if re.match(COMMAND, line)]
            self.assertTrue(all(len(shlex.split(line, comments=True)) > 1 for line in commands), text)
            rest = yaml.safe_load("\n".join(line for line in lines if line not in commands))
            self.assertTrue(isinstance(rest, dict) or commands and rest is None, text)

    def test_json(self):
        report = self.json("endpoints", DEMO, "--format", "ros1")
        self.assertEqual(report["format"], "ros1")
        micron, sonar = report["devices"]
        self.assertEqual(micron["endpoints"], ["pty:/tmp/echoloop/micron"])
        self.assertEqual(len(micron["paste"]), 1)
        self.assertEqual((sonar["driver"], sonar["paste"]), ("", []))
        self.assertNotIn("paste", self.json("endpoints", DEMO)["devices"][0])


if __name__ == "__main__":
    unittest.main()
