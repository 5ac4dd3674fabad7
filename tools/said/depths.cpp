// Echosounders, altimeters and Doppler logs: a depth in a message, or the ranges of a log's beams and the
// echo of each cell of the water.
#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "tools/said/fields.h"

namespace echoloop::said {
namespace {

using inspect::Message;

/// Numbers of this many beams: three of a Nucleus, four of the others.
constexpr std::size_t fewest_beams = 3, most_beams = 4;

/// m of one of the field's units; 0 of none that is a length.
double metres_of(std::string_view unit) {
    if (unit == "m") return 1;
    if (unit == "cm") return 0.01;
    return unit == "mm" ? 0.001 : 0;
}

Picture empty(const Message& message) {
    Picture picture;
    picture.name = message.name;
    picture.down = true;
    return picture;
}

std::optional<Picture> of_beams(const Message& message, const std::vector<double>& metres) {
    if (metres.size() < fewest_beams || metres.size() > most_beams) return std::nullopt;
    Picture picture = empty(message);
    picture.numbered = true;
    picture.bearings.clear();
    for (const double one : metres) {
        picture.bearings.push_back(static_cast<double>(picture.bearings.size()));
        picture.ranges.push_back(range_or_none(one));
    }
    return checked(std::move(picture));
}

std::optional<Picture> of_depth(const Message& message, double metres) {
    Picture picture = empty(message);
    picture.ranges = {range_or_none(metres)};
    return checked(std::move(picture));
}

/// A Water Linked log's: its JSON names the distance of each transducer.
std::vector<double> of_transducers(const Message& message) {
    const auto text = std::ranges::find(message.fields, "transducers", &inspect::Field::name);
    std::vector<double> metres;
    if (text == message.fields.end()) return metres;
    const auto all = nlohmann::json::parse(text->text, nullptr, false);
    if (!all.is_array()) return metres;
    for (const auto& one : all) {
        const auto distance = one.is_object() ? one.find("distance") : one.end();
        if (distance == one.end() || !distance->is_number()) return {};
        metres.push_back(distance->get<double>());
    }
    return metres;
}

/// One that has a range for each beam in one field, or in four.
std::vector<double> of_fields(const Message& message) {
    const Fields f(message);
    std::vector<double> metres;
    if (std::isfinite(f.number("distance_1"))) {
        for (const char* name : {"distance_1", "distance_2", "distance_3", "distance_4"})
            metres.push_back(f.number(name));
        return metres;
    }
    for (const auto& field : message.fields) {
        const bool is_range =
            field.name == "BottomTrack.range" || field.name == "range" || field.name == "distance";
        if (!is_range || field.numbers.size() < fewest_beams) continue;
        for (const double one : field.numbers) metres.push_back(one * metres_of(field.unit));
        const auto& high = f.numbers("BottomTrack.range_high");
        constexpr double one_more = 655.36;  // m
        for (std::size_t i = 0; i < std::min(high.size(), metres.size()); ++i)
            metres[i] += one_more * high[i];
        break;
    }
    return metres;
}

/// Of PD0: counts of 0.61 dB, four a cell.
std::optional<Picture> of_water_profile(const Message& message) {
    constexpr std::size_t beams = 4;
    const Fields f(message);
    const std::vector<double>& counts = f.numbers("Intensity.values");
    if (counts.size() < beams) return std::nullopt;
    Picture picture = empty(message);
    picture.name += " intensity";
    picture.numbered = true;
    picture.bearings = {0, 1, 2, 3};
    picture.unit = "counts";
    picture.bins = counts.size() / beams;
    picture.bin_size = 0.01 * f.number("FixedLeader.cell_size");
    picture.first_range = 0.01 * f.number("FixedLeader.first_cell") - picture.bin_size / 2;
    for (std::size_t beam = 0; beam < beams; ++beam)
        for (std::size_t cell = 0; cell < picture.bins; ++cell)
            picture.levels.push_back(static_cast<float>(counts[beams * cell + beam]));
    return checked(std::move(picture));
}

/// Of one number. A vehicle's own depth is none below it, nor is an altitude above the sea.
bool is_depth(std::string_view message, std::string_view field) {
    if (field == "depth") return message.ends_with("DPT");
    if (field == "distance") return message == "Altimeter";
    if (field == "altitude") return !message.ends_with("GGA");
    return field == "range" || field == "metres";
}

class Depths final : public Maker {
  public:
    std::optional<Picture> take(const Message& message, wire::ByteView, bool sent) override {
        profile_.reset();
        if (!sent) return std::nullopt;
        if (auto beams = of_beams(message, of_transducers(message))) return beams;
        profile_ = of_water_profile(message);
        if (auto beams = of_beams(message, of_fields(message))) return beams;
        if (profile_) return also();
        for (const auto& field : message.fields) {
            const double unit = metres_of(field.unit);
            if (!field.number || unit == 0) continue;
            if (is_depth(message.name, field.name)) return of_depth(message, *field.number * unit);
        }
        return std::nullopt;
    }

    std::optional<Picture> also() override { return std::exchange(profile_, std::nullopt); }

  private:
    std::optional<Picture> profile_;
};

}  // namespace

std::unique_ptr<Maker> make_depths() { return std::make_unique<Depths>(); }

}  // namespace echoloop::said
