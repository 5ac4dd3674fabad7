#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "tools/draw/canvas.h"
#include "tools/draw/levels.h"
#include "tools/draw/palette.h"
#include "tools/draw/ticks.h"

namespace echoloop::draw {
namespace {

constexpr int frame_left = 70, frame_right = 150, frame_top = 120, frame_bottom = 60;
constexpr int least_height = 300, most_height = 3000;  ///< px, of the lines

/// Mean over the part first..last m of a beam, or the bin at its middle.
double mean_between(const Ray& ray, double first, double last) {
    const auto count = static_cast<double>(ray.values.size());
    const double low = (first - ray.first) / ray.step + 0.5, high = (last - ray.first) / ray.step + 0.5;
    if (!((low + high) / 2 >= 0 && (low + high) / 2 < count)) return 0;
    if (high - low < 1) return ray.values[static_cast<std::size_t>((low + high) / 2)];
    const auto begin = static_cast<std::size_t>(std::max(low, 0.0)),
               end = static_cast<std::size_t>(std::min(high, count));
    double sum = 0;
    for (std::size_t i = begin; i < end; ++i) sum += ray.values[i];
    return sum / static_cast<double>(std::max<std::size_t>(end - begin, 1));
}

/// Every beam of every ping, and what the axes reach.
class Lines {
  public:
    explicit Lines(const Waterfall& waterfall) : waterfall_(waterfall) {
        const auto require = [](bool good, const char* what) {
            if (!good) throw std::invalid_argument(what);
        };
        require(!waterfall.pings.empty() && waterfall.times.size() == waterfall.pings.size(),
                "waterfall: there must be pings, and a time for each");
        beams_ = waterfall.to_port.size();
        require(beams_ == 1 || (beams_ == 2 && waterfall.to_port[0] != waterfall.to_port[1]),
                "waterfall: there must be one beam, or one to each side");
        for (const Echogram& ping : waterfall.pings) {
            const Shot& shot = ping.shot;
            require(ping.rule == waterfall.pings.front().rule, "waterfall: the pings differ in their rule");
            require(ping.beams() == beams_ && shot.bins > 0 && ping.values.size() == beams_ * shot.bins,
                    "waterfall: the sizes of an echogram do not fit together");
            const double step = ping.bin_range(1) - ping.bin_range(0);
            for (std::size_t beam = 0; beam < beams_; ++beam)
                rays_.push_back({0, 0, ping.bin_range(0), step, 0, ping.beam(beam), 0});
            range_ = std::max(range_, ping.bin_range(shot.bins - 1) + step / 2);
        }
    }

    std::size_t count() const { return waterfall_.pings.size(); }
    const std::vector<Ray>& rays() const { return rays_; }
    double range() const { return range_; }  ///< m
    bool has(bool port) const {
        return std::ranges::find(waterfall_.to_port, port) != waterfall_.to_port.end();
    }

    /// Mean over the lines first..last and the ranges near..far m of the beam to that side.
    double mean(double first, double last, bool port, double near, double far) const {
        const std::size_t beam = beams_ == 2 && waterfall_.to_port[1] == port ? 1 : 0;
        const auto begin = std::min(static_cast<std::size_t>(first), count() - 1);
        const auto end = std::clamp(static_cast<std::size_t>(std::ceil(last - 1e-9)), begin + 1, count());
        double sum = 0;
        for (std::size_t line = begin; line < end; ++line)
            sum += mean_between(rays_[line * beams_ + beam], near, far);
        return sum / static_cast<double>(end - begin);
    }

  private:
    const Waterfall& waterfall_;
    std::size_t beams_ = 0;
    std::vector<Ray> rays_;
    double range_ = 0;
};

/// The box of the lines, and what its pixels stand for.
struct Frame {
    Frame(const Lines& lines, bool across, int picture_width) : echogram(across) {
        width = picture_width - frame_left - frame_right;
        const auto wished = static_cast<int>(std::min<std::size_t>(lines.count(), most_height));
        height = echogram ? std::max(width / 2, least_height) : std::clamp(wished, least_height, most_height);
        first_range = lines.has(true) ? -lines.range() : 0;
        last_range = lines.has(false) ? lines.range() : 0;
        count = static_cast<double>(lines.count());
    }

    /// Of a place in px from the upper left corner; negative ranges are to port.
    double line_at(double x, double y) const { return echogram ? x / width * count : y / height * count; }
    double range_at(double x, double y) const {
        if (echogram) return y / height * std::max(last_range, -first_range);
        return first_range + x / width * (last_range - first_range);
    }

    bool echogram;
    int width, height;  ///< px
    double first_range, last_range, count;
};

void draw_pixels(Image& image, const Frame& frame, const Lines& lines, const Levels& levels) {
    for (int y = 0; y < frame.height; ++y)
        for (int x = 0; x < frame.width; ++x) {
            const double a = frame.range_at(x, y), b = frame.range_at(x + 1, y + 1);
            const bool port = frame.echogram ? lines.has(true) : a + b < 0;
            const double near = std::min(std::abs(a), std::abs(b)), far = std::max(std::abs(a), std::abs(b));
            const double value =
                lines.mean(frame.line_at(x, y), frame.line_at(x + 1, y + 1), port, near, far);
            image.at(frame_left + x, frame_top + y) = palette(levels.shade(value, (near + far) / 2));
        }
}

void name_ranges(Canvas& canvas, const Frame& frame) {
    const double first = frame.echogram ? 0 : frame.first_range,
                 last = frame.echogram ? std::max(frame.last_range, -frame.first_range) : frame.last_range;
    for (const double range : ticks(first, last, round_step(last - first, 8))) {
        const double part = (range - first) / (last - first);
        const std::string label = tick_label(std::abs(range)) + " m";
        if (frame.echogram)
            canvas.text({frame_left - 8.0, frame_top + part * frame.height}, label, ink, text_size,
                        Anchor::right);
        else
            canvas.text({frame_left + part * frame.width, frame_top + frame.height + 18.0}, label, ink,
                        text_size, Anchor::middle);
    }
}

/// A time stands beside the first line that is not earlier.
void name_times(Canvas& canvas, const Frame& frame, std::span<const double> times) {
    const double length = std::max(times.back() - times.front(), 1e-3);
    for (const double time : ticks(times.front(), times.back(), round_step(length, 8))) {
        const auto line = std::ranges::lower_bound(times, time - 1e-9) - times.begin();
        const double part = (static_cast<double>(line) + 0.5) / frame.count;
        const std::string label = tick_label(time) + " s";
        if (frame.echogram)
            canvas.text({frame_left + part * frame.width, frame_top + frame.height + 18.0}, label, ink,
                        text_size, Anchor::middle);
        else
            canvas.text({frame_left - 8.0, frame_top + part * frame.height}, label, ink, text_size,
                        Anchor::right);
    }
}

}  // namespace

Picture waterfall_picture(const Waterfall& waterfall, const Style& style) {
    const Lines lines(waterfall);
    const Echogram& first = waterfall.pings.front();
    const Levels levels = levels_for(lines.rays(), first.rule, style);
    const Frame frame(lines, waterfall.echogram, style.width);
    Chart chart;
    chart.width = style.width, chart.height = frame.height + frame_top + frame_bottom;
    Image image(chart.width, chart.height, background);
    draw_pixels(image, frame, lines, levels);
    const std::string subtitle = text("%.3g m, %g kHz, %zu pings x %zu bins", lines.range(),
                                      first.shot.frequency / 1000, lines.count(), first.shot.bins);
    const Legend legend = legend_of(style, subtitle, levels);
    const std::vector<double> times(waterfall.times.begin(), waterfall.times.end());
    return {std::move(image), [=](Canvas& canvas) {
                name_ranges(canvas, frame);
                name_times(canvas, frame, times);
                draw_legend(canvas, chart, legend);
            }};
}

}  // namespace echoloop::draw
