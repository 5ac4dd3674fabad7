"""What an R2Sonic host reads from its datagrams: soundings, images, lost pings. It opens no socket."""

import math
import time

import r2sonic_control as control
import r2sonic_wire as wire
from r2sonic_water import WaterReader


def soundings(ping):
    """[{angle, range, x, depth, quality}] of a Bathymetry: metres across (starboard positive) and down.

    Angles are those of the array; roll is not taken out. Bad points (neither detection flag) are left in.
    """
    half_speed = ping.header["sound_speed"] / 2
    return [
        {
            "angle": angle,
            "range": t * half_speed,
            "x": t * half_speed * math.sin(angle),
            "depth": t * half_speed * math.cos(angle),
            "quality": quality,
        }
        for angle, t, quality in zip(ping.angles, ping.times, ping.quality)
    ]


class Image:
    """One AID0 ping under way: beams x bins, filled part by part."""

    def __init__(self, header, part):
        self.header, self.shape = header, (part.total_beams, part.total_bins)
        self.samples, self.rows = (
            part.total_samples,
            [bytearray(part.total_bins) for _ in range(part.total_beams)],
        )
        self.seen = [bytearray(part.total_bins) for _ in range(part.total_beams)]
        self.missing, self.datagrams = part.total_beams * part.total_bins, 0

    def add(self, part):
        """Faults of the part against the rest of the image."""
        if (part.total_beams, part.total_bins) != self.shape or part.total_samples != self.samples:
            return ["M0 disagrees with the image's first part"]
        self.datagrams += 1
        for beam in range(part.beams):
            row, at = part.first_beam + beam, slice(part.first_bin, part.first_bin + part.bins)
            if any(self.seen[row][at]):
                return ["M0 covers bins that came before"]
            self.rows[row][at] = part.data[beam * part.bins : (beam + 1) * part.bins]
            self.seen[row][at] = b"\1" * part.bins
            self.missing -= part.bins
        return []

    def bin_metres(self):
        """Range of one bin."""
        samples_a_bin = self.samples / self.shape[1]
        return samples_a_bin / self.header["sample_rate"] * self.header["sound_speed"] / 2


class Reader:
    """Takes datagrams by the offset of their port from the GUI base; returns events as dictionaries.

    Keys of every event: event, faults. Ping events carry "ping" (a Bathymetry), image events "image", those of
    the water column, snippets and TruePix "gathered".
    """

    MOST_IMAGE_CELLS = 4096 * 32768

    def __init__(self, clock=time.time):
        self._clock, self._last, self._header, self._image, self._image_ping = clock, {}, None, None, None
        self.datagrams, self.faults, self.lost, self.stale = {}, 0, 0, 0
        self._water = WaterReader()

    def datagram(self, offset, data):
        """Events of one datagram that came to GUI base + offset."""
        name = data[:4].decode("latin-1")
        self.datagrams[f"{name}+{offset}"] = self.datagrams.get(f"{name}+{offset}", 0) + 1
        reader = {
            (0, "BTH0"): self._bathymetry,
            (3, "AID0"): self._part_of_image,
            (5, "WCD0"): self._water.column,
            (6, "SNI0"): self._water.snippets,
            (1, "TPX0"): self._water.truepix,
            (2, "R2DS"): self._alive,
            (2, "STH0"): self._status,
            (2, "STS0"): self._status,
        }.get((offset, name))
        events = (
            reader(data)
            if reader
            else [
                {
                    "event": "unknown",
                    "name": name,
                    "bytes": len(data),
                    "faults": [f"{name!r} at base + {offset}"],
                }
            ]
        )
        self.faults += sum(len(event["faults"]) for event in events)
        return events

    def _bathymetry(self, data):
        ping, faults = wire.read_bth0(data)
        if ping is None:
            return [{"event": "bad", "name": "BTH0", "bytes": len(data), "faults": faults}]
        last, self._last["BTH0"] = self._last.get("BTH0"), ping.header
        if last is not None:
            step = (ping.header["ping"] - last["ping"]) & 0xFFFFFFFF
            self.lost += step - 1 if 1 < step < 1000 else 0
            if not 1 <= step < 1000:
                faults.append(f"ping {ping.header['ping']} after {last['ping']}")
            apart, period = ping.header["time"] - last["time"], ping.header["period"]
            if step == 1 and abs(apart - period) > 0.005:
                faults.append(f"period {period:.5f} s, times {apart:.5f} s apart")
        return [{"event": "ping", "bytes": len(data), "ping": ping, "faults": faults}]

    def _part_of_image(self, data):
        got, faults = wire.read_aid0(data)
        if got is None:
            return [{"event": "bad", "name": "AID0", "bytes": len(data), "faults": faults}]
        kind, value = got
        if kind == "header":
            if self._image is not None and self._image.missing:
                faults.append(f"image {self._header['ping']} lacks {self._image.missing} bins")
            self._header, self._image = value, None
            return [
                {"event": "image_header", "ping": value["ping"], "beams": value["points"], "faults": faults}
            ]
        if self._header is None or value.ping != self._header["ping"]:
            self.stale += 1
            return [{"event": "stale", "ping": value.ping, "faults": faults}]
        return self._grow(value, faults)

    def _grow(self, part, faults):
        if part.total_beams * part.total_bins > self.MOST_IMAGE_CELLS or faults:
            return [
                {
                    "event": "bad",
                    "name": "M0",
                    "bytes": len(part.data),
                    "faults": faults or ["image too large"],
                }
            ]
        if self._image is None:
            self._image = Image(self._header, part)
            if part.total_beams != self._header["points"]:
                faults.append(f"M0 has {part.total_beams} beams, H0 {self._header['points']}")
        faults += self._image.add(part)
        if self._image.missing:
            return [{"event": "part", "ping": part.ping, "faults": faults}]
        if part.first_bin + part.bins != part.total_bins:
            faults.append("the last part is not the one with the last bins: known readers publish too early")
        return [{"event": "image", "image": self._image, "faults": faults}]

    @staticmethod
    def _alive(data):
        value, faults = control.read_r2ds(data)
        return [{"event": "R2DS", **(value or {}), "faults": faults}]

    @staticmethod
    def _status(data):
        value, faults = control.read_status(data)
        texts = {
            name: words.partition(b"\0")[0].decode("latin-1")
            for name, words in (value or {}).items()
            if name in ("SER3", "PRT3", "MDL3", "FWV6", "FWT6")
        }
        return [{"event": data[:4].decode(), "sections": sorted(value or {}), **texts, "faults": faults}]
