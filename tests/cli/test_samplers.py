"""OpenGL and our own rasteriser draw what the sonars of the demo scenarios see: the same echoes, bin by bin."""
import array
import ast
import math
import unittest

from program import ROOT, ProgramTest

SONARS = (("demo", "micron"), ("demo", "sonar"), ("basin", "oculus"), ("deep-water", "multibeam"), ("deep-water", "seaking"))


def values_of(path):
    """All numbers of a .npy file of 32-bit floats."""
    data = path.read_bytes()
    begin = 10 + int.from_bytes(data[8:10], "little")
    header = ast.literal_eval(data[10:begin].decode().strip())
    values = array.array("f", data[begin:])
    assert header["descr"] == "<f4" and len(values) == math.prod(header["shape"]), header
    return values


class Samplers(ProgramTest):
    def test_opengl_and_our_own_rasteriser_hear_the_same(self):
        for scenario, device in SONARS:
            heard = []
            for sampler in ("raster", "native"):
                out = self.folder / f"{sampler}.npy"
                self.good("render", ROOT / "config" / f"{scenario}.yaml", "--device", device, "--set",
                          f"render.sampler={sampler}", "--out", out)
                heard.append(values_of(out))
            opengl, own = heard
            off = 10 * math.log10(sum(own) / sum(opengl))
            self.assertLess(abs(off), 0.01, f"{scenario} {device}: dB")
            alike = sum(abs(a - b) <= 1e-3 * max(a, b) for a, b in zip(opengl, own)) / len(own)
            self.assertGreater(alike, 0.98, f"{scenario} {device}: bins that are the same to a thousandth")


if __name__ == "__main__":
    unittest.main()
