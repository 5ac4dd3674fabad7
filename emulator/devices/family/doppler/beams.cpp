#include "emulator/devices/family/doppler/beams.h"

#include <algorithm>
#include <cmath>

namespace echoloop::doppler {
namespace {

double determinant(const Covariance& m) {
    return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
           m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
           m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

/// Of a symmetric matrix, by its cofactors.
Covariance inverted(const Covariance& m) {
    const double scale = 1 / determinant(m);
    Covariance out{};
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) {
            const std::size_t a = (j + 1) % 3, b = (j + 2) % 3, c = (i + 1) % 3, d = (i + 2) % 3;
            out[i][j] = scale * (m[a][c] * m[b][d] - m[a][d] * m[b][c]);
        }
    return out;
}

Vec3 times(const Covariance& m, Vec3 v) {
    const auto row = [&](std::size_t i) { return m[i][0] * v.x + m[i][1] * v.y + m[i][2] * v.z; };
    return {row(0), row(1), row(2)};
}

/// Two pairs of opposite beams measure the same vertical velocity; scaled so that noise makes as much of it
/// as of a horizontal velocity (Teledyne's error velocity).
double error_velocity(const Axes& axes, const BeamSpeeds& beams) {
    double sum = 0;
    for (std::size_t i = 0; i < axes.size(); ++i) {
        const Vec3 a = axes[0], b = axes[i];
        const double across = a.x * b.y - a.y * b.x, along = a.x * b.x + a.y * b.y;
        sum += (std::abs(along) > std::abs(across) ? 1 : -1) * beams[i]->velocity;
    }
    return sum / (2 * std::sqrt(2) * std::hypot(axes[0].x, axes[0].y));
}

}  // namespace

Axes beam_axes(double tilt, const std::vector<double>& azimuths) {
    Axes axes;
    for (const double azimuth : azimuths)
        axes.push_back(
            {std::sin(tilt) * std::cos(azimuth), std::sin(tilt) * std::sin(azimuth), std::cos(tilt)});
    return axes;
}

std::optional<Solution> solve(const Axes& axes, const BeamSpeeds& beams) {
    constexpr double least = 1e-7;  // m/s, for sensors without noise
    Covariance normal{};
    Vec3 right;
    std::size_t heard = 0;
    for (std::size_t i = 0; i < axes.size(); ++i) {
        if (!beams[i]) continue;
        ++heard;
        const Vec3 axis = axes[i];
        const double weight = 1 / std::pow(std::max(beams[i]->deviation, least), 2);
        const std::array<double, 3> u{axis.x, axis.y, axis.z};
        for (std::size_t r = 0; r < 3; ++r)
            for (std::size_t c = 0; c < 3; ++c) normal[r][c] += weight * u[r] * u[c];
        right = right + weight * beams[i]->velocity * axis;
    }
    if (heard < 3) return std::nullopt;
    Solution solution;
    solution.covariance = inverted(normal);
    solution.velocity = times(solution.covariance, right);
    if (heard == 4 && axes.size() == 4) solution.error = error_velocity(axes, beams);
    return solution;
}

/// By power iteration: the matrix is small, symmetric and positive.
double figure_of_merit(const Covariance& covariance) {
    Vec3 v{1, 0.9, 0.8};
    double largest = 0;
    for (int step = 0; step < 60; ++step) {
        v = times(covariance, v);
        largest = norm(v);
        if (largest <= 0) return 0;
        v = 1 / largest * v;
    }
    return std::sqrt(largest);
}

Vec3 turned(Vec3 v, double angle) {
    const double c = std::cos(angle), s = std::sin(angle);
    return {c * v.x - s * v.y, s * v.x + c * v.y, v.z};
}

/// R C R^T, column by column and then row by row.
Covariance turned(const Covariance& covariance, double angle) {
    Covariance half{}, out{};
    for (std::size_t j = 0; j < 3; ++j) {
        const Vec3 v = turned(Vec3{covariance[0][j], covariance[1][j], covariance[2][j]}, angle);
        half[0][j] = v.x, half[1][j] = v.y, half[2][j] = v.z;
    }
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec3 v = turned(Vec3{half[i][0], half[i][1], half[i][2]}, angle);
        out[i] = {v.x, v.y, v.z};
    }
    return out;
}

}  // namespace echoloop::doppler
