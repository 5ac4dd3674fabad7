"""A test double of a rosbridge server, since Debian and PyPI have none: written from ROSBRIDGE_PROTOCOL.md (version 2.1),
with Debian's websockets. It knows "subscribe" and "publish" only, in the words of either generation of ROS, and as the
real one it stays silent when it cannot tell a topic's type. tools/poses/README.md says what was tried against the real
one.
"""

import asyncio
import json
import threading

from poses_programs import need

try:
    import websockets
except ImportError:
    websockets = None


def message(kind, stamp, position, orientation=(1, 0, 0, 0), generation=2, frame="map", child="base_link"):
    """The JSON of a message that tells a pose; `stamp` in nanoseconds."""
    w, x, y, z = orientation
    rotation = {"x": x, "y": y, "z": z, "w": w}
    place = dict(zip("xyz", position))
    names = ("sec", "nanosec") if generation == 2 else ("secs", "nsecs")
    header = {"stamp": dict(zip(names, divmod(stamp, 10**9))), "frame_id": frame}
    if generation == 1:
        header["seq"] = 7
    pose = {"position": place, "orientation": rotation}
    shapes = {
        "Odometry": {"header": header, "child_frame_id": child, "pose": {"pose": pose, "covariance": [0.0] * 36}},
        "PoseStamped": {"header": header, "pose": pose},
        "PoseWithCovarianceStamped": {"header": header, "pose": {"pose": pose, "covariance": [0.0] * 36}},
        "TransformStamped": {"header": header, "child_frame_id": child,
                             "transform": {"translation": place, "rotation": rotation}},
        "Pose": pose,
        # a fix: latitude and longitude in degrees, altitude in m
        "NavSatFix": {"header": header, "status": {"status": 0, "service": 1}, "latitude": position[0],
                      "longitude": position[1], "altitude": position[2], "position_covariance": [0.0] * 9,
                      "position_covariance_type": 0},
    }
    return shapes[kind]


class Double:
    """Listens on a port of loopback that the system chooses; `topics` are those whose type it can tell."""

    def __init__(self, test, topics=(), port=0):
        need(websockets, "python3-websockets is missing (tools/install test)")
        self.topics, self.port = set(topics), port
        self.requests, self.clients = [], {}
        self.changed = threading.Condition()
        self.loop = asyncio.new_event_loop()
        ready = threading.Event()
        self.thread = threading.Thread(target=self._run, args=(ready,))
        self.thread.start()
        test.addCleanup(self.close)
        if not ready.wait(20):
            raise AssertionError("the double does not start")
        self.url = f"ws://127.0.0.1:{self.port}"

    def _run(self, ready):
        asyncio.set_event_loop(self.loop)
        self.server = self.loop.run_until_complete(self._listen())
        self.port = self.server.sockets[0].getsockname()[1]
        ready.set()
        self.loop.run_forever()
        self.server.close()
        self.loop.run_until_complete(self.server.wait_closed())
        self.loop.close()

    async def _listen(self):
        return await websockets.serve(self._serve, "127.0.0.1", self.port)

    async def _serve(self, client, _path=None):
        try:
            async for text in client:
                self._asked(client, json.loads(text))
        except websockets.ConnectionClosedError:
            pass

    def _asked(self, client, request):
        with self.changed:
            self.requests.append(request)
            if request["op"] == "subscribe" and (request["topic"] in self.topics or "type" in request):
                self.clients.setdefault(request["topic"], set()).add(client)
            self.changed.notify_all()

    def wait_for(self, condition, what):
        with self.changed:
            if not self.changed.wait_for(condition, 30):
                raise AssertionError(f"{what}; requests: {self.requests}")

    def wait_for_subscriber(self, topic):
        self.wait_for(lambda: self.clients.get(topic), f"nobody subscribes to {topic}")

    def next_answer(self, topic):
        """The time in nanoseconds of the next Clock that the program publishes on that topic."""
        self.wait_for(lambda: any(r["op"] == "publish" for r in self.requests), f"nobody publishes {topic}")
        with self.changed:
            request = next(r for r in self.requests if r["op"] == "publish")
            self.requests.remove(request)
        assert request["topic"] == topic
        return request["msg"]["clock"]["secs"] * 10**9 + request["msg"]["clock"]["nsecs"]

    def publish(self, topic, message):
        self.send(topic, json.dumps({"op": "publish", "topic": topic, "msg": message}))

    def send(self, topic, text):
        """Whatever text to the subscribers of a topic."""
        async def send():
            for client in list(self.clients.get(topic, ())):
                try:
                    await client.send(text)
                except websockets.ConnectionClosed:
                    self.clients[topic].discard(client)

        asyncio.run_coroutine_threadsafe(send(), self.loop).result(20)

    def close(self):
        if self.thread.is_alive():
            self.loop.call_soon_threadsafe(self.loop.stop)
            self.thread.join(20)
