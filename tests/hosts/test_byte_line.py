"""Self-test of the byte pipe on a real TCP connection and a real pty."""

import os
import socket
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

import byte_line


class Pipes(unittest.TestCase):
    def test_tcp_line_reads_writes_and_ends(self):
        with socket.create_server(("127.0.0.1", 0)) as server:
            line = byte_line.open_line("tcp://127.0.0.1:%d" % server.getsockname()[1])
            peer, _ = server.accept()
            line.write(b"abc")
            self.assertEqual(peer.recv(3), b"abc")
            self.assertEqual(line.read(0), b"")
            peer.sendall(b"xyz")
            self.assertEqual(line.read(5), b"xyz")
            peer.close()
            with self.assertRaises(byte_line.LineClosed):
                line.read(5)
            line.close()

    def test_tty_line_is_raw_and_fast(self):
        master, slave = os.openpty()
        line = byte_line.open_line(os.ttyname(slave))
        os.write(master, b"@\n\r\x03\x11")
        self.assertEqual(line.read(5), b"@\n\r\x03\x11")
        line.close()
        os.close(slave)
        os.close(master)

    def test_a_file_is_no_terminal(self):
        with self.assertRaises(OSError):
            byte_line.open_line(str(Path(__file__)))
