// What a receiver hears where there is no echo: noise of the water, of its electronics, of its converters.
// Pure functions of a shot.
#pragma once

#include "render/echogram.h"

namespace echoloop {

/// Mellen's thermal noise, -15 + 20 log10 f[kHz] dB re 1 uPa^2/Hz (JASA 24 (1952) 478; 750 kHz: 42.5).
double thermal_noise_level(double frequency);

/// Hz: of the noise that the receiver lets through, its own where given. Else what a filter matched to the
/// pulse does, 1 / T also for a chirp, whose compression raises the echo over the noise by the sweep times T.
double noise_bandwidth(const Shot& shot);

/// uPa^2: thermal and self noise in the receiver's band, less what the array's directivity keeps out.
double received_noise(const Shot& shot);

/// Staves that make as much noise as all of them with their shading: staves for a line, 0.734 staves for
/// Hamming weights, (sum w)^2 / sum w^2 (Van Trees, Optimum Array Processing, 2002, chapter 2).
double effective_staves(const Shot& shot);

/// uPa^2: the square of the step in which a beam's amplitude comes, that of a stave's converter over
/// effective_staves(); 0: no steps. One bit is the sign; the others count up to where the input clips.
double converter_step(const Shot& shot);

/// uPa^2: what the converters add to a beam's noise. An error that is even over a step has step^2 / 12: the
/// noise itself is the dither that makes it so, as long as a stave's is not far below its step.
double converter_noise(const Shot& shot);

}  // namespace echoloop
