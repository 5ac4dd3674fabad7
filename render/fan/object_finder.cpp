#include "render/fan/object_finder.h"

#include <algorithm>
#include <limits>

namespace echoloop {
namespace {

constexpr std::size_t lines_per_piece = 32;
constexpr std::size_t last_number = std::numeric_limits<std::uint16_t>::max();

const View& view_with(const FanPlan& plan, std::size_t image_line) {
    const auto after = std::ranges::upper_bound(plan.views, image_line, {}, &View::first_line);
    return *(after - 1);
}

}  // namespace

void ObjectFinder::list_sightings(const BinningInput& in, std::span<const std::uint32_t> object_of_surface) {
    constexpr auto never = static_cast<std::size_t>(-1);
    sightings_.clear();
    std::vector<std::size_t> seen_in(1 + *std::ranges::max_element(object_of_surface),
                                     never);  // last line, by object
    for (const View& view : in.plan.views)
        for (std::size_t line = view.first_line; line < view.first_line + view.lines; ++line)
            for (const Pixel& pixel : in.pixels.subspan(line * in.plan.samples, view.samples)) {
                if (pixel.surface == 0) continue;
                const std::uint32_t object = object_of_surface[static_cast<std::size_t>(pixel.surface) - 1];
                if (std::exchange(seen_in[object], line) != line) sightings_.emplace_back(object, line);
            }
    std::ranges::sort(sightings_);
}

void ObjectFinder::sum_object(BinningInput in, const BinGain& gain, std::span<const Sighting> lines,
                              std::span<const std::uint32_t> object_of_surface) {
    wanted_.clear();
    for (const std::uint32_t object : object_of_surface)
        wanted_.push_back(object == lines.front().first ? 1 : 0);
    in.wanted = wanted_;
    sums_.resize(in.plan.lines, in.plan.sectors, in.bins);
    const auto level_end = std::ranges::lower_bound(lines, in.plan.lines, {}, &Sighting::second);
    const auto level = lines.first(static_cast<std::size_t>(level_end - lines.begin()));
    workers_.run((level.size() + lines_per_piece - 1) / lines_per_piece, [&](std::size_t piece) {
        LineReader reader;
        for (std::size_t i = piece * lines_per_piece; i < std::min((piece + 1) * lines_per_piece, level.size());
             ++i) {
            const std::size_t line = level[i].second;
            const View& view = view_with(in.plan, line);
            add_level_line(in, gain, Amount::wanted_echo, view, line - view.first_line, reader,
                           sums_.line(line));
        }
    });
    LineReader reader;
    for (const auto& [object, line] : lines.subspan(level.size())) {
        const View& view = view_with(in.plan, line);
        add_surround_line(in, gain, true, in.plan.part_of(view), view, line - view.first_line, reader, sums_);
    }
    beams_.sum(in.plan, in.offset, in.bins, sums_, gain.values(), workers_, power_);
}

void ObjectFinder::find(const BinningInput& input, std::span<const std::uint32_t> object_of_surface,
                        double least, std::vector<std::uint16_t>& objects) {
    const BinGain gain(input);
    const std::size_t values = input.plan.beams.size() * input.bins;
    strongest_.assign(values, static_cast<float>(least));
    objects.assign(values, 0);
    if (object_of_surface.empty()) return;
    list_sightings(input, object_of_surface);
    for (auto first = sightings_.begin(); first != sightings_.end();) {
        const auto last =
            std::find_if(first, sightings_.end(), [&](const Sighting& s) { return s.first != first->first; });
        sum_object(input, gain, {first, last}, object_of_surface);
        const auto number = static_cast<std::uint16_t>(std::min<std::size_t>(first->first + 1, last_number));
        for (std::size_t i = 0; i < values; ++i)
            if (power_[i] > strongest_[i]) {
                strongest_[i] = power_[i];
                objects[i] = number;
            }
        first = last;
    }
}

}  // namespace echoloop
