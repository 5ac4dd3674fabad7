// The chain's loops over the bins of one beam. No keys, no geometry, no memory of their own.
#pragma once

#include <cstddef>
#include <utility>

namespace echoloop::kernels {

/// power[i] becomes sqrt(power) times the field, as its two parts.
void modulate(const float* power, const float* field_real, const float* field_imaginary, std::size_t count,
              float* real, float* imaginary);
/// real += scale * a, imaginary += scale * b.
void add(float scale, const float* a, const float* b, std::size_t count, float* real, float* imaginary);
/// out = weight a + other_weight b.
void blend(float weight, const float* a, float other_weight, const float* b, std::size_t count, float* out);
/// power = real^2 + imaginary^2.
void intensity(const float* real, const float* imaginary, std::size_t count, float* power);
/// power += real^2 + imaginary^2.
void add_intensity(const float* real, const float* imaginary, std::size_t count, float* power);
/// power *= factor.
void multiply(const float* factor, std::size_t count, float* power);
void square_root(const float* power, std::size_t count, float* amplitude);
/// power = |a + b|^2 of two fields of scale * power and other_scale * other in intensity, whose phases differ
/// by the angle of that cosine, as the mean over so many looks: a + b + 2 sqrt(a b / looks) cosine.
void interfere(float scale, float* power, float other_scale, const float* other, const float* cosine,
               float looks, std::size_t count);
/// Whether one of two powers is anywhere more than `ratio` times the other and `least`.
bool differ(const float* a, const float* b, float ratio, float least, std::size_t count);
/// out += scale ln(a / b); powers below 1e-12 uPa^2 count as that.
void add_log_ratio(float scale, const float* a, const float* b, std::size_t count, float* out);
/// Brings what is beyond +-most back to it.
void limit(float most, std::size_t count, float* values);
/// Adds `by` to places, and says within which cells they lie: the least and the greatest whole number below.
std::pair<int, int> shift(float by, std::size_t count, float* places);
/// Speckle between cells: out += (1 - |place - cell|) field, where that is positive. Each bin has a `place`
/// of its own, in cells.
void add_cell(const float* place, float cell, const float* field, std::size_t count, float* out);
/// What add_cell() has added up for two cells becomes of mean square 1: out /= hypot(1 - share, share),
/// `share` the places' fraction.
void even_out(const float* place, std::size_t count, float* real, float* imaginary);
/// As interfere(), of the mean powers `a` in cell `cell` and `b` in the next, written where the place lies
/// between them.
void interfere_between(const float* place, float cell, const float* a, const float* b, const float* cosine,
                       float looks, std::size_t count, float* out);
/// power = min(power, limit).
void receive(float limit, std::size_t count, float* power);

}  // namespace echoloop::kernels
