// What wind makes of the water's surface: how strongly it scatters back, and what its bubbles take from waves
// that it mirrors. Pure functions.
//
// APL-UW High-Frequency Ocean Environmental Acoustic Models Handbook (TR 9407, 1994), part II, after
// McDaniel. The model is fitted to 10..100 kHz; above it extrapolates. `frequency` in Hz; `wind` in m/s, 10 m
// above the water; `sine` of the angle of grazing, 0..1. Strengths are linear, m^2 per m^2.
#pragma once

namespace echoloop {

/// Of the bubbles that breaking waves leave below the surface.
double bubble_backscatter(double frequency, double wind, double sine);

/// rms slope of its facets in one direction: 2 s^2 = 0.0046 ln(2.1 U^2), which a wind below 0.7 m/s does not
/// have; 0.02 at least.
double surface_slope(double wind);

/// m, rms height of the waves of a wind that has blown for long over open water (Pierson & Moskowitz, J.
/// Geophys. Res. 69 (1964) 5181): 0.0053 U^2.
double wave_height(double wind);

/// Loss in dB of a wave that the surface mirrors, and of what its waves scatter back: that of one straight up
/// over the sine, which counts as least_bubble_sine at least.
inline constexpr double least_bubble_sine = 1e-3;
double surface_bubble_loss_db(double frequency, double wind, double sine);

/// Of bubbles, facets (a mirror of amplitude 1) and small waves, those two behind the bubbles' loss. 0
/// without wind.
double surface_backscatter(double frequency, double wind, double sine);

}  // namespace echoloop
