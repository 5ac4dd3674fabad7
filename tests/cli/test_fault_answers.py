"""`echoloop fault` at a place where somebody else than a run answers: whatever it says, an error with a reason and a status,
no crash, no endless wait, and nothing that a terminal would obey."""

import contextlib
import json
import os
import pathlib
import socket
import subprocess
import tempfile
import threading
import time
import unittest

PROGRAM = os.environ["ECHOLOOP"]


@contextlib.contextmanager
def answering(*parts, pause=0):
    """The place of a server that says each part to one client, `pause` s apart, and then waits for it to leave."""
    with tempfile.TemporaryDirectory() as folder, socket.socket(socket.AF_UNIX) as server:
        path = str(pathlib.Path(folder) / "control")
        server.bind(path)
        server.listen(1)

        def serve():
            client, _ = server.accept()
            with client, contextlib.suppress(OSError):
                for part in parts:
                    client.sendall(part)
                    if pause:
                        gone.wait(pause)
                while client.recv(4096):
                    pass

        gone = threading.Event()
        thread = threading.Thread(target=serve)
        thread.start()
        try:
            yield "unix:" + path
        finally:
            gone.set()
            thread.join()


def ask(place, *words):
    return subprocess.run([PROGRAM, "fault", place, *(words or ("list",))], capture_output=True, timeout=60)


class Answers(unittest.TestCase):
    def said(self, answer, *words):
        with answering(answer if isinstance(answer, bytes) else json.dumps(answer).encode() + b"\n") as place:
            return ask(place, *words)

    def test_shows_what_a_run_says(self):
        result = self.said({"ok": True, "faults": [{"id": 3, "device": "a", "kind": "loss", "rate": 0.5}]})
        self.assertEqual((result.returncode, result.stdout), (0, b"   3  a loss rate=0.5 \n"))
        self.assertEqual(self.said({"ok": True, "id": 3}).stdout, b"fault 3; `clear 3` ends it\n")
        self.assertEqual(self.said({"ok": True, "faults": []}, "list", "--json").stdout, b'{"ok": true, "faults": []}\n')

    def test_survives_an_answer_that_nests_without_end(self):
        deep = b'{"ok": true, "faults": [{"id": 1, "rate": ' + b"[" * 200000 + b"]" * 200000 + b"}]}\n"
        for words in ((), ("list", "--json")):
            result = self.said(deep, *words)
            self.assertEqual(result.returncode, 74, result.stderr)
            self.assertIn(b"not from a run", result.stderr)

    def test_gives_a_terminal_nothing_to_obey(self):
        bell = "\x1b]0;owned\x07"
        for answer in ({"ok": False, "error": bell}, {"ok": True, "faults": [{"id": 1, "device": bell, bell: 2}]}, {"ok": True, "id": bell},
                       {"ok": True, "devices": [{"name": bell, bell: bell, "faults": {bell: bell}}]}):
            result = self.said(answer)
            shown = (result.stdout + result.stderr).replace(b"\n", b"")
            self.assertTrue(shown and min(shown) >= 32 and 127 not in shown, shown)

    def test_names_what_is_no_answer(self):
        for answer in (b"SSH-2.0-OpenSSH_9.2\n", b"[]\n", b'{"ok": 1}\n', b'{"ok": true, "cleared": "all"}\n',
                       b'{"ok": true, "faults": 3}\n', b'{"ok": true, "devices": [{}]}\n', b'{"ok": true, "faults": [null]}\n'):
            result = self.said(answer)
            self.assertEqual(result.returncode, 74, (answer, result))
            self.assertIn(b"not from a run", result.stderr)

    def test_does_not_wait_for_ever(self):
        began = time.monotonic()
        with answering(*[b"{"] * 40, pause=1) as drip, answering() as silent:
            drip_asked = subprocess.Popen([PROGRAM, "fault", drip, "list"], stderr=subprocess.PIPE)
            result = ask(silent)
            self.assertIn(b"says nothing", drip_asked.communicate(timeout=60)[1])
        self.assertEqual((result.returncode, drip_asked.returncode), (74, 74))
        self.assertIn(b"says nothing", result.stderr)
        self.assertLess(time.monotonic() - began, 30)


if __name__ == "__main__":
    unittest.main()
