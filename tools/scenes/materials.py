"""Acoustic materials of the scenes: what `extras.sonar` of the file says of each.

Demo scenes of the first days give 10 log10 of the Lambert scattering constant mu, in dB. -27 dB is Mackenzie's constant
for the seabed; the ceiling for a surface that scatters all it receives is 10 log10(1/pi) = -4.97 dB. The others are
plausible steps between, not measurements. The rest name a row of the emulator's own table (render/scene/materials.cpp).
"""
SONAR = {
    "sand": {"mu_db": -27.0},
    "gravel": {"mu_db": -21.0},
    "rock": {"mu_db": -17.0},
    "concrete": {"mu_db": -15.0},
    "aluminium": {"mu_db": -12.0},
    "steel": {"mu_db": -10.0},
    # Of basin, harbour, deep and pipe.
    "mud": {"material": "mud"},
    "stone": {"material": "rock"},
    "seabed_sand": {"material": "sand"},
    "gravel_bed": {"material": "gravel"},
    "rough_concrete": {"material": "concrete"},
    # Own choice: cast against steel and painted; at 700 kHz a mirror loses 0.4 dB by it.
    "painted_concrete": {"material": "concrete", "roughness": 0.00005},
    "metal": {"material": "steel"},
    "plastic": {"material": "plastic"},
    "rubber": {"material": "rubber"},
}
