#include "tools/import/terrain/placing.h"

#include <ogr_spatialref.h>

#include <algorithm>

#include "render/scene/limits.h"
#include "tools/import/terrain/raster.h"

namespace echoloop::worlds {

/// To longitude and latitude of WGS 84, in degrees.
struct Placing::Projection {
    OGRSpatialReference crs, globe;
    std::unique_ptr<OGRCoordinateTransformation> to_globe;
};

Placing::Placing(const std::filesystem::path& file, const Survey& survey, std::optional<GeoPlace> origin)
    : file_(file), survey_(survey), origin_(origin) {
    if (survey.crs.empty()) return;
    projection_ = std::make_unique<Projection>();
    projection_->crs.importFromWkt(survey.crs.c_str());
    projection_->globe.importFromEPSG(4326);
    for (auto* const crs : {&projection_->crs, &projection_->globe})
        crs->SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
    projection_->to_globe.reset(OGRCreateCoordinateTransformation(&projection_->crs, &projection_->globe));
    if (!projection_->to_globe)
        throw TerrainError(
            file,
            "has coordinates that cannot be turned into latitude and longitude (" + Raster::complaint() + ")",
            "say which they are with --crs");
    if (origin_) return;
    origin_ = GeoPlace{};
    const auto [x, y] = std::pair{middle().column, middle().row};
    const auto& a = survey.affine;
    double longitude = a[0] + a[1] * x + a[2] * y, latitude = a[3] + a[4] * x + a[5] * y;
    if (!projection_->to_globe->Transform(1, &longitude, &latitude))
        throw TerrainError(file, "has its middle at no place on the globe", "say where it is with --crs");
    constexpr double digits = 1e6;  // a decimetre: what a person can type again
    origin_->latitude = std::round(latitude * digits) / digits;
    origin_->longitude = std::round(std::remainder(longitude, 360) * digits) / digits;
}

Placing::~Placing() = default;

Placing::Sample Placing::middle() const {
    return {survey_.heights.width / 2.0, survey_.heights.height / 2.0};
}

std::vector<Vec3> Placing::east_and_north(std::span<const Sample> samples) const {
    std::vector<double> x(samples.size()), y(samples.size());
    const auto& a = survey_.affine;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const double column = samples[i].column + 0.5, row = samples[i].row + 0.5;
        x[i] = a[0] + a[1] * column + a[2] * row, y[i] = a[3] + a[4] * column + a[5] * row;
    }
    std::vector<Vec3> out(samples.size());
    if (projection_) {
        std::vector<int> good(samples.size());
        projection_->to_globe->Transform(static_cast<int>(samples.size()), x.data(), y.data(), nullptr,
                                         good.data());
        for (std::size_t i = 0; i < samples.size(); ++i)
            out[i] =
                good[i] != 0 ? enu_from_place(*origin_, {y[i], x[i], origin_->height}) : Vec3{NAN, NAN, NAN};
        return out;
    }
    for (std::size_t i = 0; i < samples.size(); ++i)
        out[i] = {x[i] * survey_.metres, y[i] * survey_.metres, 0};
    return out;
}

std::vector<Vec3> Placing::place(const Heights& heights, std::span<const GridPoint> points) const {
    std::vector<Sample> samples;
    samples.reserve(points.size());
    for (const GridPoint p : points) samples.push_back({double(p.x), double(p.y)});
    auto out = east_and_north(samples);
    for (std::size_t i = 0; i < out.size(); ++i) {
        out[i].z = heights.at(points[i]) - (origin_ ? origin_->height : 0);
        if (std::hypot(out[i].x, out[i].y) <= scene_limits::extent) continue;
        throw TerrainError(
            file_, "lies beyond 100 km from the world's origin",
            survey_.crs.empty()
                ? "say which coordinates it has with --crs, or shift it with gdal_translate -a_ullr"
                : "choose --origin nearer, or cut out what is needed with gdal_translate -projwin");
    }
    return out;
}

/// m, by how much the middle of steps of so many samples is off the line between their ends, at most, as
/// tried in nine places.
double Placing::bend(double step) const {
    const double right = survey_.heights.width - 1, bottom = survey_.heights.height - 1;
    std::vector<Sample> tried;
    for (const double u : {0.0, 0.5, 1.0})
        for (const double v : {0.0, 0.5, 1.0}) {
            const double x = u * std::max(right - step, 0.0), y = v * std::max(bottom - step, 0.0);
            for (const double part : {0.0, 0.5, 1.0}) {
                const double dx = part * std::min(step, right), dy = part * std::min(step, bottom);
                for (const Sample s : {Sample{x + dx, y}, {x, y + dy}, {x + dx, y + dy}}) tried.push_back(s);
            }
        }
    const auto at = east_and_north(tried);
    double most = 0;
    for (std::size_t i = 0; i < at.size(); i += 9)
        for (std::size_t way = 0; way < 3; ++way)
            most = std::max(most, norm(at[i + 3 + way] - 0.5 * (at[i + way] + at[i + 6 + way])));
    return most;
}

std::int32_t Placing::lattice(double error) const {
    constexpr std::int32_t finest = 4;
    if (!projection_) return 0;
    const std::int32_t side = std::max(survey_.heights.width, survey_.heights.height);
    if (bend(side) <= error) return 0;
    std::int32_t step = finest;
    while (step * 2 < side && bend(step * 2) <= error) step *= 2;
    return step;
}

}  // namespace echoloop::worlds
