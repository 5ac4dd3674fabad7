// From a survey's own coordinates to the world's metres east and north.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "render/geographic.h"
#include "tools/import/terrain/survey.h"

namespace echoloop::worlds {

class Placing {
  public:
    /// `origin`: of the world; empty: the middle of the survey, or no place on the globe for local
    /// coordinates. `file` is for messages. Throws TerrainError.
    Placing(const std::filesystem::path& file, const Survey& survey, std::optional<GeoPlace> origin);
    ~Placing();

    const std::optional<GeoPlace>& origin() const { return origin_; }
    /// ENU, with the heights of the samples, from the origin's. Throws TerrainError for samples that are
    /// beyond 100 km.
    std::vector<Vec3> place(const Heights& heights, std::span<const GridPoint> points) const;
    /// Samples between corners that keep all between them within `error` m of where they are: the globe is
    /// round, and triangles are flat. 0: as many as there are.
    std::int32_t lattice(double error) const;

  private:
    struct Projection;
    struct Sample {
        double column, row;
    };
    std::vector<Vec3> east_and_north(std::span<const Sample> samples) const;
    double bend(double step) const;
    Sample middle() const;

    const std::filesystem::path& file_;
    const Survey& survey_;
    std::unique_ptr<Projection> projection_;  ///< nullptr: local
    std::optional<GeoPlace> origin_;
};

}  // namespace echoloop::worlds
