// Where a view sees the corners of triangles, in the widest vectors of the processor.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "render/ray_table.h"
#include "render/scene/scene.h"
#include "render/simd.h"
#include "render/view.h"

namespace echoloop::raster {

inline constexpr float near_end = 0.01F;  ///< m along the axis of a view, as gl/fan_shader

/// How a view looks at a part of the scene: its axes starboard, up and forward, in the frame of that part;
/// and the world's upward direction, in those axes.
struct PartPlace {
    std::array<float, 9> rows;
    std::array<float, 3> eye, up_seen;

    PartPlace(const View& view, const Pose& frame_from_fan, Vec3 up);
};

/// Where the samples of a view are on the image plane: line l at x = first_x + l / lines_per_x, sample s at
/// y = first_y - s / samples_per_y.
struct SampleGrid {
    float first_x, lines_per_x, first_y, samples_per_y;
    int lines, samples;
};

class SeenCorners {
  public:
    /// As straight rays show them, or where bent ones do: as gl/fan_shader says.
    void find(std::span<const SceneVertex> vertices, const PartPlace& place, const SampleGrid& grid,
              const RayTable* rays);

    std::size_t behind() const { return behind_; }  ///< of them are not in front of the near end
    std::size_t count() const { return count_; }
    /// m: along starboard, up and forward.
    const float* x() const { return row(0); }
    const float* y() const { return row(1); }
    const float* z() const { return row(2); }
    const float* line() const { return row(3); }    ///< of those in front of the near end
    const float* sample() const { return row(4); }  ///< the same
    /// Where rays bend: as of RayTable::Move.
    const float* bow() const { return row(5); }
    const float* clearance() const { return row(6); }

  private:
    static constexpr std::size_t rows = 7;  ///< what is behind the corners repeats the last one
    const float* row(std::size_t i) const { return numbers_.data() + i * stride_; }
    float* row(std::size_t i) { return numbers_.data() + i * stride_; }

    std::size_t count_ = 0, stride_ = 0, behind_ = 0;
    std::vector<float> numbers_;
    std::vector<std::int32_t> cells_;  ///< of a ray table, of each
    std::vector<float> moves_;         ///< what it says of each
};

}  // namespace echoloop::raster
