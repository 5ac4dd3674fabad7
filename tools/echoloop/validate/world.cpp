#include "tools/echoloop/validate/world.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace echoloop::validation {
namespace {

/// A scene must have a triangle: one that no ping reaches.
Mesh speck() {
    return shapes::quad("speck", {-5000, 0, 0}, {-5000, 0.01, 0}, {-5000, 0.01, 0.01}, {-5000, 0, 0.01},
                        -100);
}

}  // namespace

Mesh rough_floor_at(double z, double half_x, double half_y, double cell, double height) {
    Mesh mesh;
    mesh.object = mesh.material.name = "floor";
    mesh.material.mu_db = -27;
    std::mt19937_64 random(7);
    const auto columns = static_cast<std::uint32_t>(2 * half_x / cell) + 1,
               rows = static_cast<std::uint32_t>(2 * half_y / cell) + 1;
    for (std::uint32_t row = 0; row < rows; ++row)
        for (std::uint32_t column = 0; column < columns; ++column) {
            double up = 0;  // twelve even numbers are normal enough, and the same with every library
            for (int i = 0; i < 12; ++i) up += static_cast<double>(random() >> 11) * 0x1p-53 - 0.5;
            mesh.positions.push_back({column * cell - half_x, row * cell - half_y, z + height * up});
            if (row + 1 == rows || column + 1 == columns) continue;
            const std::uint32_t first = row * columns + column, above = first + columns;
            for (const std::uint32_t corner : {first, first + 1, above + 1, first, above + 1, above})
                mesh.indices.push_back(corner);
        }
    return mesh;
}

std::shared_ptr<const Scene> scene_of(std::vector<Mesh> meshes, std::vector<PointTarget> targets) {
    if (meshes.empty()) meshes.push_back(speck());
    return Scene::from_meshes(meshes, targets);
}

Water water_of(double sound_speed) {
    Water water;
    water.sound_speed = sound_speed;
    return water;
}

Effects only(std::initializer_list<Effect> effects) {
    Effects set = Effects::none();
    for (const Effect effect : effects) set.set(effect);
    return set;
}

RendererOptions with(Effects effects) {
    RendererOptions options;
    options.effects = effects;
    return options;
}

Shot fan(double aperture_deg, double height_deg, std::size_t beams, std::size_t bins, double range) {
    Shot shot;
    shot.beam_width = deg_to_rad(aperture_deg) / static_cast<double>(beams);
    for (std::size_t i = 0; i < beams; ++i)
        shot.bearings.push_back(deg_to_rad(-aperture_deg / 2) +
                                (static_cast<double>(i) + 0.5) * shot.beam_width);
    shot.fan_height = deg_to_rad(height_deg);
    shot.bins = bins;
    shot.bin_interval = 2 * range / 1500 / static_cast<double>(bins);
    shot.pulse_length = shot.bin_interval;
    shot.frequency = 750e3;
    shot.source_level = 200;
    shot.random_key = 1;
    return shot;
}

Shot pencil(double range, double pulse_length) {
    const double bin = pulse_length / 4;
    Shot shot = fan(2, 2, 1, static_cast<std::size_t>(2 * range / 1500 / bin), range);
    shot.bin_interval = bin;
    shot.pulse_length = pulse_length;
    return shot;
}

double db(double power) { return 10 * std::log10(power); }

double total(std::span<const float> values) {
    double sum = 0;
    for (const float v : values) sum += v;
    return sum;
}

std::size_t peak_bin(std::span<const float> values) {
    return static_cast<std::size_t>(std::max_element(values.begin(), values.end()) - values.begin());
}

double peak(std::span<const float> values) { return values[peak_bin(values)]; }

std::size_t first_bin(std::span<const float> values, double share) {
    const double threshold = share * peak(values);
    const auto loud = [&](float v) { return v > threshold; };
    return static_cast<std::size_t>(std::find_if(values.begin(), values.end(), loud) - values.begin());
}

std::vector<double> mean_values(Renderer& renderer, Shot shot, std::size_t pings, Vec3 step) {
    std::vector<double> mean(shot.bearings.size() * shot.bins);
    for (std::size_t ping = 0; ping < pings; ++ping) {
        shot.ping = ping;
        const Echogram e = renderer.render(shot, {static_cast<double>(ping) * step, {}});
        for (std::size_t i = 0; i < mean.size(); ++i)
            mean[i] += static_cast<double>(e.values[i]) / static_cast<double>(pings);
    }
    return mean;
}

}  // namespace echoloop::validation
