"""Acoustic materials of the scenes: 10 log10 of the Lambert scattering constant mu, in dB.

-27 dB is Mackenzie's constant for the seabed; the ceiling for a surface that scatters all it receives is
10 log10(1/pi) = -4.97 dB. The others are plausible steps between, not measurements.
"""
MU_DB = {
    "sand": -27.0,
    "gravel": -21.0,
    "rock": -17.0,
    "concrete": -15.0,
    "aluminium": -12.0,
    "steel": -10.0,
}
