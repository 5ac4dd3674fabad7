// The chain's loops over the bins of one beam. No keys, no geometry, no memory of their own.
#pragma once

#include <array>
#include <cstddef>

namespace echoloop::kernels {

/// Normal variables, one a bin, and the BinLaw::root that makes intensities of them.
struct Normals {
    const float* z;
    const float* root;
};

/// Mean powers, uPa^2, whose normal variables are the noise's: that beside the echo, and in each bin that of
/// what is in the echo's.
struct NoisePowers {
    float beside;
    const float* within;
};

/// Speckle and noise are one field: mean powers become intensities. With the share s of the echo in the whole
/// mean power, z = s z_echo + sqrt(1 - s^2) z_noise, as intensities of two interfering fields have it; the
/// law lies between both by the same share. `power` lies elsewhere than `mean`.
void scatter(Normals echo, Normals noise, NoisePowers noise_powers, std::size_t count, const float* mean,
             float* power);
/// power *= the intensity by the law.
void multiply_by_law(const float* root, const float* z, std::size_t count, float* power);
/// power = |a + b|^2 of two fields of power and other in intensity, whose phases differ by the angle of that
/// cosine, as the mean over so many looks: a + b + 2 sqrt(a b / looks) cosine.
void interfere(const float* other, const float* cosine, float looks, std::size_t count, float* power);
/// out = the sum of weights[k] fields[k], of at least one.
void weighted_sum(const float* const* fields, const float* weights, std::size_t fields_count,
                  std::size_t count, float* out);
/// Whether a part of the power is anywhere more than `least` times the power and the noise.
bool is_part(const float* part, const float* power, float least, float noise, std::size_t count);
/// Normal numbers z of echoes of which the part `fresh` of the power has numbers of its own: with the rest's
/// share s, z = s z + sqrt(1 - s^2) z_fresh, as for two interfering fields.
void renew(const float* fresh, const float* power, const float* z_fresh, std::size_t count, float* z);
/// power = min(power, limit).
void receive(float limit, std::size_t count, float* power);

}  // namespace echoloop::kernels
