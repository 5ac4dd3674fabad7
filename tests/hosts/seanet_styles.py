"""How known hosts turn a user's settings into mtHeadCommand, each with its own constants and rounding."""

import math
from dataclasses import dataclass, replace

import seanet_wire as wire

TX_675_KHZ, RX_675_KHZ = 0x05666666, 0x090A3D70
TX_325_KHZ, RX_325_KHZ = 0x02999999, 0x063D70A3


@dataclass(frozen=True)
class Settings:
    """What a user chooses. Angles and step in 1/16 gradian, levels in dB, gain 0..1, range in metres."""

    range: float = 10.0
    bins: int = 200
    step: int = 32
    left: int = 2400
    right: int = 4000
    gain: float = 0.4
    low_db: float = 0.0
    span_db: float = 80.0
    adc8on: bool = True
    continuous: bool = True
    scan_right: bool = True
    invert: bool = False
    sound_speed: float = 1500.0

    def control(self, extra=0):
        """HdCtrl with the flags that the user chose."""
        return (
            wire.USUAL_CONTROL
            | extra
            | (wire.ADC8ON if self.adc8on else 0)
            | (wire.CONTINUOUS if self.continuous else 0)
            | (wire.SCAN_RIGHT if self.scan_right else 0)
            | (wire.INVERT if self.invert else 0)
        )

    def intervals(self):
        """Two-way time of one bin in units of 640 ns, not rounded."""
        return 2 * self.range / self.sound_speed / self.bins / 640e-9


def _common(settings):
    gain = int(settings.gain * 210)
    return wire.HeadCommand(
        control=settings.control(),
        range_scale=int(settings.range * 10),
        left=settings.left,
        right=settings.right,
        ad_span=int(255 * settings.span_db / 80),
        ad_low=int(255 * settings.low_db / 80),
        gain=(gain, gain),
        step=settings.step,
        ad_interval=int(settings.intervals()),
        bins=settings.bins,
    )


def rock(settings):
    """Type 0x1D, V3B zero, chan2 set, scanright never; the level window is fixed; limits 0 if continuous."""
    limits = {"left": 0, "right": 0} if settings.continuous else {}
    return replace(
        _common(settings),
        control=settings.control(wire.CHAN2) & ~wire.SCAN_RIGHT,
        head_type=2,
        ad_span=81,
        ad_low=8,
        lockout_us=13333,
        v3b=bytes(16),
        **limits,
    )


def mcgill(settings):
    """Type 0x01, HdType 0x11; in 4-bit mode the level window is scaled by 15 and not by 255."""
    exact, full = settings.intervals(), 255 if settings.adc8on else 15
    return replace(
        _common(settings),
        ad_span=int(full * settings.span_db / 80),
        ad_low=int(full * settings.low_db / 80),
        max_ad_buffer=500,
        ad_interval=int(exact + 1 if exact % 2 else exact),
    )


def host_a(settings):
    """Type 0x1D with V3B filled and two channels, limits given raw even where they are no angles."""
    command = _common(settings)
    v3b = bytes(
        [
            command.ad_span - 1,
            command.ad_span,
            command.ad_low + 1,
            command.ad_low,
            *command.gain,
            0,
            0,
            90,
            0,
            125,
            0,
            0,
            0,
            0,
            0,
        ]
    )
    return replace(
        command,
        control=command.control & ~wire.SCAN_RIGHT & ~wire.CONTINUOUS,
        head_type=2,
        tx_number=(TX_325_KHZ, TX_675_KHZ),
        rx_number=(RX_325_KHZ, RX_675_KHZ),
        pulse_us=40,
        slope=(90, 125),
        lockout_us=919,
        v3b=v3b,
    )


def host_b(settings):
    """Type 0x01 of a DST-aware host: pulse from the range, limits 0 in continuous mode."""
    limits = {"left": 0, "right": 0} if settings.continuous else {}
    return replace(
        _common(settings),
        tx_number=(TX_675_KHZ,) * 2,
        rx_number=(RX_675_KHZ,) * 2,
        pulse_us=_pulse(settings.range),
        slope=(100, 100),
        ad_interval=math.ceil(settings.intervals()),
        **limits,
    )


def host_c(settings):
    """Type 0x01 of a MiniKing host: HdType 2 and slopes that count."""
    limits = {"left": 0, "right": 0} if settings.continuous else {}
    return replace(
        _common(settings),
        head_type=2,
        tx_number=(TX_675_KHZ,) * 2,
        rx_number=(RX_675_KHZ + 1,) * 2,
        pulse_us=_pulse(settings.range),
        slope=(125, 125),
        **limits,
    )


def delphin(settings):
    """Type 0x01 with node copy 255, HdType 0x0B and RangeScale in whole metres."""
    return replace(
        _common(settings),
        head_type=0x0B,
        node_copy=0xFF,
        tx_number=(TX_675_KHZ,) * 2,
        rx_number=(RX_675_KHZ,) * 2,
        pulse_us=40,
        slope=(125, 125),
        range_scale=int(settings.range),
    )


def _pulse(range_m):
    return max(50, min(350, int((range_m + 10) * 25 / 10)))


HEAD_COMMANDS = {
    "rock": rock,
    "rock-main": rock,
    "mcgill": mcgill,
    "hostA": host_a,
    "hostB": host_b,
    "hostC": host_c,
    "delphin": delphin,
}
