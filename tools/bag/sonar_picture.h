// A sonar's picture in colours, as the page of a run draws it (tools/view/page: card.ts, sketch.ts): a fan, a
// full circle, an echogram, a side-scan's waterfall or a range image.
#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "tools/bag/levels.h"

namespace echoloop::bag {

class SonarPicture {
  public:
    static constexpr std::size_t width = 480, height = 360;

    /// The next ping. A head turns once its pings do.
    void take(Levels levels);
    /// width x height dots from the upper left, red, green, blue.
    std::string draw();

  private:
    enum class Kind { fan, circle, echogram, side_scan, range_image };
    using FanKey = std::tuple<std::size_t, std::size_t, double, double, double, double, double, bool>;

    void sketch_fan();
    void sketch_circle();
    void draw_fan(std::string& out) const;
    void draw_circle(std::string& out) const;
    void draw_echogram(std::string& out) const;
    void draw_side_scan(std::string& out) const;
    void draw_range_image(std::string& out) const;
    std::uint8_t colour(const Levels& of, std::uint8_t byte) const;
    const Levels* line_at(std::size_t direction) const;

    Kind kind_ = Kind::fan;
    std::optional<Levels> last_{};
    std::set<long> pans_{};                            ///< mrad; what it has looked at
    std::vector<std::optional<Levels>> directions_{};  ///< of a circle
    std::vector<Levels> lines_{};                      ///< of an echogram or a waterfall, the last at the end
    double top_ = 0;                                   ///< dB
    double began_ = 0;                                 ///< m, range of the first of the lines
    FanKey key_{};
    std::vector<std::int32_t> fan_{};  ///< of each dot: its byte of the levels, -1 for none
    std::vector<std::pair<std::uint16_t, float>> circle_{};  ///< of each dot: direction, share of the range
};

}  // namespace echoloop::bag
