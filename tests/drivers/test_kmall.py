"""themachinethatgoesping, a public package that evaluates Kongsberg's files, reads the datagrams of a KMALL multibeam as
they come from the wire: the floor of the scene is where it says, and what the controller is told shows in the next ones."""

import socket
import struct
import tempfile
import time
import unittest
from pathlib import Path

from public_driver import ROOT, use

use("kmall", "themachinethatgoesping")

import sys

sys.path.insert(0, str(ROOT / "tests" / "hosts"))

import kmall_wire
import numpy as np
from ports import free_port
from program import Emulator
from themachinethatgoesping.echosounders_nanopy.kmall import KMALLFileHandler
from themachinethatgoesping.echosounders_nanopy.kmall import datagrams as public

SCENARIO = """
scene: "{scenes}/flat.glb"
seed: 5
water: {temperature: 10, salinity: 35, ph: 8, sound_speed: 1500}
effects: {sensor_noise: off, ping_jitter: off}
vehicle: {pose: {position: [0, 0, -12], rpy_deg: [0, 0, 0]}}
devices:
  - name: multibeam
    model: kongsberg-kmall
    mount: {rpy_deg: [0, 90, 0]}
    endpoints: ["udp-listen://127.0.0.1:%d", "udp://127.0.0.1:%d"]
    options: {range: 25, water_column: true, latitude: 59.4, longitude: 10.5}
"""


def in_one(head, parts):
    """The parts of a ping's #MWC as one datagram, as they stand in a file once they are joined."""
    body = b"".join(part[kmall_wire.COMMON : -4] for part in parts)
    size = kmall_wire.COMMON + len(body) + 4
    return struct.pack("<I", size) + head[4:20] + struct.pack("<HH", 1, 1) + body + struct.pack("<I", size)


class TheMachineThatGoesPing(unittest.TestCase):
    def setUp(self):
        self.commands = free_port(8)
        self.socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.addCleanup(self.socket.close)
        self.socket.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4 << 20)
        self.socket.bind(("127.0.0.1", 0))
        emulator = Emulator(SCENARIO % (self.commands, self.socket.getsockname()[1]))
        self.addCleanup(emulator.__exit__, None, None, None)
        emulator.__enter__()

    def say(self, text):
        self.socket.sendto(text.encode(), ("127.0.0.1", self.commands))

    def next(self, kind, seconds=20):
        """The next datagram of a kind, its parts joined, as bytes."""
        end, parts = time.monotonic() + seconds, []
        while True:
            self.socket.settimeout(max(0.01, end - time.monotonic()))
            datagram = self.socket.recv(65536)
            head = kmall_wire.header(datagram)
            if head["kind"] != kind:
                continue
            if not kind.startswith("#M"):
                return datagram  # these have no parts
            if head["part"] == 1:
                parts.clear()
            parts.append(datagram)
            if len(parts) == head["parts"]:
                return in_one(parts[0], parts) if len(parts) > 1 else datagram

    def range_and_depth(self):
        return public.MRangeAndDepth.from_binary(self.next("#MRZ"))

    def test_soundings_lie_on_the_floor(self):
        ping = self.range_and_depth()
        angle = np.asarray(ping.soundings.get_beam_angle_re_rx_deg_tensor())
        depth = np.asarray(ping.soundings.get_z_re_ref_point_m_tensor())
        across = np.asarray(ping.soundings.get_y_re_ref_point_m_tensor())
        travel = np.asarray(ping.soundings.get_two_way_travel_time_sec_tensor())
        self.assertEqual(ping.soundings.get_number_of_soundings(), 400)
        self.assertLess(np.abs(depth / 8 - 1).max(), 0.005)
        self.assertLess(np.abs(travel * 750 * np.cos(np.radians(angle)) / 8 - 1).max(), 0.005)
        self.assertLess(np.abs(across + depth * np.tan(np.radians(angle))).max(), 0.02, "starboard is positive")
        self.assertTrue((np.asarray(ping.soundings.get_detection_type_tensor()) == 0).all(), "a bottom at every beam")
        info = ping.ping_info
        self.assertAlmostEqual(info.get_latitude_deg(), 59.4, delta=1e-9)
        self.assertAlmostEqual(info.get_tx_transducer_depth_m(), 12, delta=1e-3)
        self.assertEqual(info.get_sound_speed_at_tx_depth_m_per_sec(), 1500)
        self.assertEqual(info.get_frequency_mode_hz(), 300e3)

    def test_the_water_column_has_its_bottom_at_the_samples_it_names(self):
        column = public.MWaterColumn.from_binary(self.next("#MWC"))
        beams, rate = column.beam_data, column.rx_info.get_sample_freq_hz()
        self.assertEqual(beams.get_number_of_beams(), 400)
        angle = np.asarray(beams.get_beam_pointing_angle_re_vertical_deg_tensor())
        bottom = np.asarray(beams.get_detected_range_in_samples_high_resolution_tensor())
        depth = bottom / rate * column.rx_info.get_sound_velocity_m_per_sec() / 2 * np.cos(np.radians(angle))
        self.assertLess(np.abs(depth / 8 - 1).max(), 0.01)

    def test_the_seabed_image_and_what_varies_are_read(self):
        ping = self.range_and_depth()
        self.assertEqual(ping.get_datagram_version(), 3)
        counts = np.asarray(ping.soundings.get_si_num_samples_tensor()).astype(int)
        image = np.asarray(ping.get_seabed_image_samples_db())
        self.assertEqual(len(image), counts.sum())
        level = np.asarray(ping.soundings.get_reflectivity_1_db_tensor())
        first = np.concatenate([[0], np.cumsum(counts)[:-1]])
        mean = 10 * np.log10(np.add.reduceat(10 ** (image / 10), first) / counts)
        self.assertLess(np.abs(mean - level).max(), 0.2, "samples of a sounding have its reflectivity")
        for tensor in ("quality_factor", "detection_uncertainty_ver_m", "detection_uncertainty_hor_m", "reflectivity_2_db"):
            self.assertGreater(len(set(np.asarray(getattr(ping.soundings, f"get_{tensor}_tensor")()))), 100, tensor)

    def test_a_file_of_what_came_has_the_pings_where_the_datagrams_are(self):
        self.say("$KSSIS,454,EM2040_40")
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "floor.kmall"
            pings = [self.next(kind) for kind in ("#IIP", "#IOP", "#MRZ", "#MWC", "#MRZ", "#MWC")]
            file.write_bytes(b"".join(pings))
            told = [public.MRangeAndDepth.from_binary(pings[2]), public.MRangeAndDepth.from_binary(pings[4])]
            read = KMALLFileHandler([str(file)], show_progress=False).get_pings()
            self.assertEqual(len(read), 2)
            for ping, datagram in zip(read, told):
                xyz = ping.bottom.get_xyz()
                self.assertEqual(len(np.asarray(xyz.z)), 400)
                np.testing.assert_allclose(np.asarray(xyz.y), datagram.soundings.get_y_re_ref_point_m_tensor(), atol=1e-5)
                self.assertLess(np.abs((np.asarray(xyz.z)) / 8 - 1).max(), 0.005)

    def test_installation_and_runtime_tell_what_was_set(self):
        self.say("$KSSIS,262,EM2040_40,RUNT_PARAM_PU_ANGLE_PORT_RX1=45,RUNT_PARAM_PU_BEAM_SPACING=Equidistance")
        while True:
            ping = self.range_and_depth()
            if ping.ping_info.get_port_sector_edge_deg() == 45:
                break
        self.assertAlmostEqual(float(np.asarray(ping.soundings.get_beam_angle_re_rx_deg_tensor())[0]), 45, delta=0.01)
        self.say("$KSSIS,454,EM2040_40")
        installation = public.IInstallationParam.from_binary(self.next("#IIP"))
        self.assertEqual(installation.get_system_name(), "EM2040")
        self.assertEqual(installation.get_available_transducer_keys(), ["TRAI_TX1", "TRAI_RX1"])
        self.assertEqual(installation.get_active_position_system_number(), 1)
        self.assertAlmostEqual(installation.get_water_line_vertical_location_in_meters(), -12, delta=1e-3)
        self.assertEqual(installation.get_pu_serial_number(), 10140)
        runtime = public.IOpRuntime.from_binary(self.next("#IOP")).get_runtime_txt_decoded()
        self.assertEqual(runtime["Sector coverage|Max angle Port"], "45.0")
        self.assertEqual(runtime["Sector coverage|Beam spacing"], "Equidistance")
        profile = public.SSoundVelocityProfile.from_binary(self.next("#SVP"))
        self.assertEqual(list(np.asarray(profile.get_svp_sound_velocities())), [1500, 1500])


class RollingVessel(unittest.TestCase):
    """What a host makes of raw soundings and the motion that came with them: a vessel that rolls by 5 deg within 4 s."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        track = Path(folder.name) / "rolling.csv"
        times = np.arange(0, 60, 0.05)
        half = np.radians(5 * np.sin(2 * np.pi * times / 4)) / 2
        north = np.sqrt(0.5)  # a yaw of 90 deg
        rows = [f"{t:.2f},0,0,-12,{north * np.cos(h):.9f},{north * np.sin(h):.9f},{north * np.sin(h):.9f},"
                f"{north * np.cos(h):.9f}" for t, h in zip(times, half)]
        track.write_text("\n".join(["t,x,y,z,qw,qx,qy,qz", *rows]) + "\n")
        self.socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.addCleanup(self.socket.close)
        self.socket.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4 << 20)
        self.socket.bind(("127.0.0.1", 0))
        scenario = SCENARIO.replace("pose: {position: [0, 0, -12], rpy_deg: [0, 0, 0]}", f"trajectory: {track}")
        scenario = scenario.replace("water_column: true", "water_column: false, ping_rate: 10")
        emulator = Emulator(scenario % (free_port(8), self.socket.getsockname()[1]))
        self.addCleanup(emulator.__exit__, None, None, None)
        emulator.__enter__()

    def heard(self, motions):
        """(pings, motion) until there are so many #SKM."""
        found = {"#MRZ": [], "#SKM": [], "#SPO": []}
        self.socket.settimeout(20)
        while len(found["#SKM"]) < motions:
            datagram = self.socket.recv(65536)
            found.get(kmall_wire.header(datagram)["kind"], []).append(datagram)
        return ([public.MRangeAndDepth.from_binary(one) for one in found["#MRZ"]],
                [public.SKMBinary.from_binary(one) for one in found["#SKM"]],
                [public.SPosition.from_binary(one) for one in found["#SPO"]])

    def test_soundings_reduced_with_its_motion_lie_on_the_floor_and_with_a_wrong_one_do_not(self):
        pings, motions, fixes = self.heard(3)
        time = np.concatenate([one.get_sensor_data().get_sensor_timestamp_tensor() for one in motions])
        roll = np.concatenate([one.get_sensor_data().get_roll_deg_tensor() for one in motions])
        heading = np.concatenate([one.get_sensor_data().get_heading_deg_tensor() for one in motions])
        self.assertEqual(len(time), 3 * 102)
        np.testing.assert_allclose(np.diff(time), 0.01, atol=1e-6)
        self.assertLess(heading.max(), 360)
        self.assertLess(np.abs((heading + 180) % 360 - 180).max(), 1e-3, "a yaw of 90 deg is north")
        for fix in fixes:
            self.assertAlmostEqual(fix.get_corrected_lat_deg(), 59.4, delta=1e-8)
            self.assertRegex(fix.get_pos_data_from_sensor_str(), r"^\$GPGGA,\d{6}\.\d\d,5924\.0000000,N,01030\.0000000,E,4,")

        def worst(sign, latency):
            worst = 0
            for ping in (p for p in pings if time[0] + 0.3 < p.get_timestamp() < time[-1] - 0.3):
                angle = np.asarray(ping.soundings.get_beam_angle_re_rx_deg_tensor())
                travel = np.asarray(ping.soundings.get_two_way_travel_time_sec_tensor())
                valid = np.asarray(ping.soundings.get_detection_type_tensor()) == 0
                at = np.interp(ping.get_timestamp() + latency, time, sign * roll)
                depth = travel * 750 * np.cos(np.radians(angle + at))  # both are positive to port and port up
                worst = max(worst, np.quantile(np.abs(depth / 8 - 1)[valid], 0.95))
            return worst

        self.assertLess(worst(1, 0), 0.005)
        self.assertGreater(worst(-1, 0), 0.05, "with a swapped sign")
        self.assertGreater(worst(1, 0.2), 0.02, "with a latency of 0.2 s")


if __name__ == "__main__":
    unittest.main()
