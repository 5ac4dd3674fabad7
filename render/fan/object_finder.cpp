#include "render/fan/object_finder.h"

#include <algorithm>
#include <limits>

namespace echoloop {

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

void ObjectFinder::take_loudest(std::uint32_t object, const WantedPower& power,
                                std::vector<std::uint16_t>& objects) {
    constexpr std::uint32_t last_number = std::numeric_limits<std::uint16_t>::max();
    const auto number = static_cast<std::uint16_t>(std::min(object + 1, last_number));
    for (const auto& [begin, end] : power.stretches)
        for (std::size_t i = begin; i < end; ++i) {
            const bool louder = power.values[i] > strongest_[i];
            strongest_[i] = louder ? power.values[i] : strongest_[i];
            objects[i] = louder ? number : objects[i];
        }
}

void ObjectFinder::find(Summing& summing, BinningInput in, std::span<const std::uint32_t> object_of_surface,
                        double least, std::vector<std::uint16_t>& objects) {
    strongest_.assign(objects.size(), static_cast<float>(least));
    if (object_of_surface.empty()) return;
    list_sightings(in, object_of_surface);
    for (auto first = sightings_.begin(); first != sightings_.end();) {
        const std::uint32_t object = first->first;
        lines_.clear();
        for (; first != sightings_.end() && first->first == object; ++first) lines_.push_back(first->second);
        wanted_.clear();
        for (const std::uint32_t other : object_of_surface) wanted_.push_back(other == object ? 1 : 0);
        in.wanted = wanted_;
        take_loudest(object, summing.sum_wanted(in, lines_), objects);
    }
}

}  // namespace echoloop
