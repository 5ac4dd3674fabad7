"""What the page of a run is told, met by clients of another make: http.client and websockets."""

import asyncio
import http.client
import json
import socket
import struct
import unittest

from ports import free_port
from view_case import TANK, ViewCase, picture

import seanet_wire

IMAGING = """
scene: {scenes}/tank.glb
water: {temperature: 15, salinity: 0, ph: 7, sound_speed: 1500}
vehicle: {pose: {position: [0, 0, -2]}}
devices:
  - {name: imaging, model: sonar-3d-15, endpoints: ["tcp-listen://127.0.0.1:%d"]}
"""


class View(ViewCase):
    def test_an_echosounders_line_shows_the_floor_at_its_depth_and_names_it(self):
        self.start()

        async def look(viewer):
            def floor(message, text):
                if text is None:
                    head, levels, objects = picture(message)
                    wanted = head["type"] == "ping" and head["device"] == "bottom" and objects
                    return wanted and (head, levels, objects)

            return await self.until(viewer, floor)

        head, levels, objects = self.see(look)
        loudest = max((b for b, level in enumerate(levels) if level), key=lambda b: levels[b])
        self.assertAlmostEqual(head["first_range"] + (loudest + 0.5) * head["bin_size"], 2, delta=0.1)
        scene = self.get("/scene", Authorization="Bearer " + self.token)[1]
        names = json.loads(scene[4 : 4 + struct.unpack_from("<I", scene)[0]])["objects"]
        self.assertIn("floor", names[objects[loudest] - 1].lower())

    def test_what_a_driver_says_is_told_with_its_fields_and_what_is_refused_with_the_reason(self):
        micron = free_port()
        self.start(scenario=TANK % (micron, free_port()))

        async def look(viewer):
            await viewer.recv()  # hello
            with socket.create_connection(("127.0.0.1", micron)) as driver:
                driver.sendall(b"\x00\x01garbage")  # no message of the sonar's
                driver.sendall(seanet_wire.build(seanet_wire.SEND_VERSION))

                def told(_, text):
                    if text and text["type"] == "messages":
                        for one in text["messages"]:
                            if one["device"] == "micron" and not one["sent"]:
                                seen.append(one)
                        return any(one["reason"] for one in seen) and any(one["name"] for one in seen)

                seen = []
                await self.until(viewer, told)
                return seen

        seen = self.see(look)
        self.assertTrue(any(one["fields"] for one in seen if one["name"]), seen)

    def test_what_a_driver_has_set_before_anybody_looked_is_told(self):
        micron = free_port()
        self.start(scenario=TANK % (micron, free_port()))
        with socket.create_connection(("127.0.0.1", micron)) as driver:
            driver.sendall(seanet_wire.build(seanet_wire.SEND_VERSION))
            driver.recv(100)  # the head has heard it

            async def look(viewer):
                def told(_, text):
                    set_ = [one["name"] for one in text.get("set", [])] if text else []
                    return "SendVersion" in set_

                return await self.until(viewer, told)

            self.assertTrue(self.see(look))

    def test_a_fault_stands_on_the_message_that_it_was_made_on(self):
        self.start("--view-control")

        async def look(viewer):
            fault = {"device": "bottom", "kind": "bit_flips", "rate": 0.02, "for": 60}
            await viewer.send(json.dumps({"ask": {"fault": fault}, "id": 1}))

            def told(_, text):
                rows = text["messages"] if text and text["type"] == "messages" else []
                return [one for one in rows if "bit_flips" in one.get("fault", "")]

            marked = await self.until(viewer, told)
            await viewer.send(json.dumps({"ask": {"clear": "all"}, "id": 2}))
            await viewer.send(json.dumps({"ask": {"fault": {**fault, "kind": "loss", "rate": 1}}, "id": 3}))

            def lost(_, text):
                rows = text["messages"] if text and text["type"] == "messages" else []
                return [one for one in rows if "loss" in one.get("fault", "")]

            return marked[0], (await self.until(viewer, lost))[0]

        marked, lost = self.see(look)
        self.assertEqual((marked["device"], marked["sent"]), ("bottom", True))
        self.assertGreater(marked["size"], 20)
        self.assertNotEqual(marked["name"], "fault")
        self.assertEqual((lost["device"], lost["name"], lost["size"]), ("bottom", "fault", 0), "what is lost is on no message")

    def test_what_is_asked_by_http_is_told_with_its_values(self):
        port = free_port()
        self.start(scenario=IMAGING % port)

        async def look(viewer):
            await viewer.recv()  # hello
            body = json.dumps({"min": 0.5, "max": 4.5})

            def ask():
                sonar = http.client.HTTPConnection("127.0.0.1", port, timeout=20)
                sonar.request("POST", "/api/v1/integration/acoustics/range", body, {"Content-Type": "application/json"})
                return sonar.getresponse().status

            self.assertEqual(await asyncio.get_running_loop().run_in_executor(None, ask), 204)

            def told(_, text):
                rows = text["set"] if text and text["type"] == "messages" else []
                return next((one for one in rows if one["name"].endswith("/acoustics/range")), None)

            return await self.until(viewer, told)

        setting = self.see(look)
        self.assertEqual(setting["name"], "POST /api/v1/integration/acoustics/range")
        self.assertEqual([field[:2] for field in setting["fields"]], [["min", "0.5"], ["max", "4.5"]])

    def test_the_queue_of_the_render_threads_is_told(self):
        self.start()

        async def look(viewer):
            return await self.until(viewer, lambda _, text: text and text["type"] == "status" and text["status"])

        rendering = self.see(look)["rendering"]
        self.assertGreaterEqual(rendering["threads"], 1)
        self.assertLessEqual(rendering["drawing"], rendering["threads"])

    def test_the_scene_is_the_one_that_is_run(self):
        self.start()
        self.assertEqual(self.get("/scene")[0], 401)
        status, body, _ = self.get("/scene", Authorization="Bearer " + self.token)
        self.assertEqual(status, 200)
        length = struct.unpack_from("<I", body)[0]
        head = json.loads(body[4 : 4 + length])
        corners = sum(part["corners"] for part in head["parts"])
        self.assertEqual(corners, 3 * head["triangles"])
        numbers = struct.unpack(f"<{3 * corners}f", body[4 + length :])
        for axis in range(3):
            self.assertAlmostEqual(min(numbers[axis::3]), head["bounds"][0][axis], places=4)
            self.assertAlmostEqual(max(numbers[axis::3]), head["bounds"][1][axis], places=4)


if __name__ == "__main__":
    unittest.main()
