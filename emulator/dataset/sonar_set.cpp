#include "emulator/dataset/sonar_set.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "emulator/dataset/bytes.h"

namespace echoloop {
namespace {

constexpr std::size_t most_columns = 512;  ///< pings in one picture of a single beam
using Json = nlohmann::ordered_json;

std::string six_digits(std::size_t number) {
    std::array<char, 24> text{};
    std::snprintf(text.data(), text.size(), "%06zu", number);
    return text.data();
}

RangeAxis axis_of(const Echogram& echo) {
    const double metres = echo.sound_speed / 2;
    return {metres * echo.shot.first_bin_time, metres * echo.shot.bin_interval, echo.shot.bins};
}

std::vector<float> levels_of(const Echogram& echo) {
    std::vector<float> levels = echo.values;
    if (echo.rule == EchoRule::radiometric)
        for (float& level : levels) level = level_db(level);
    return levels;
}

/// rad, from one bearing to another, within +-pi.
double step_between(double from, double to) { return std::remainder(to - from, 2 * std::numbers::pi); }

}  // namespace

void SonarSet::begin_arrays(const PingTruth& ping) {
    const Echogram& echo = ping.echo;
    const Shot& shot = echo.shot;
    Settings settings{shot.bearings, shot.elevations, shot.first_bin_time, shot.bin_interval, shot.bins};
    if (arrays_ && arrays_->settings == settings) return;
    finish_arrays();
    kind_ = shot.rows() > 1 ? Kind::rows : shot.beams() > 1 ? Kind::fan : turns_ ? Kind::head : Kind::line;
    if (settings_ == 0) zarr::put_group(files_.place, "echogram.zarr/" + name_);
    const std::string group = "echogram.zarr/" + name_ + "/" + std::to_string(settings_++);
    zarr::put_group(files_.place, group);
    std::vector<std::size_t> shape{shot.bearings.size(), shot.bins};
    Json dimensions{"ping", "beam", "bin"};
    if (kind_ == Kind::rows)
        shape.insert(shape.begin(), shot.rows()), dimensions.insert(dimensions.begin() + 1, "row");
    Json attributes{{"_ARRAY_DIMENSIONS", dimensions},     {"bearings_rad", shot.bearings},
                    {"elevations_rad", shot.elevations},   {"first_bin_time_s", shot.first_bin_time},
                    {"bin_interval_s", shot.bin_interval}, {"sound_speed", echo.sound_speed}};
    for (std::size_t bin = 0; bin < shot.bins; ++bin) attributes["range_m"].push_back(echo.bin_range(bin));
    arrays_.emplace(Arrays{std::move(settings),
                           {group + "/levels", shape, zarr::Array::Type::float32},
                           {group + "/objects", shape, zarr::Array::Type::uint16},
                           std::move(attributes),
                           axis_of(echo)});
    rule_ = echo.rule, beam_width_ = shot.beam_width;
    map_.reset();
}

void SonarSet::finish_arrays() {
    finish_picture();
    if (!arrays_) return;
    Json attributes = arrays_->attributes;
    attributes["units"] = rule_ == EchoRule::radiometric ? "dB re 1 uPa" : "1";
    arrays_->levels.finish(files_.place, attributes);
    attributes["units"] = "object, from 1; 0: nothing";
    arrays_->objects.finish(files_.place, attributes);
    arrays_.reset();
}

void SonarSet::heard(PingTruth ping, const Look& look) {
    finish_ping();
    begin_arrays(ping);
    Pending next;
    next.levels = levels_of(ping.echo);
    next.labels = std::move(ping.echo.objects);
    ping.echo.objects.clear();
    ping.echo.values = {};
    const PictureScale scale = scale_of(rule_);
    std::vector<std::uint16_t> counts;
    counts.reserve(next.levels.size());
    for (const float level : next.levels) counts.push_back(scale.count(double{level}));
    next.line = {{"sonar", name_},
                 {"ping", ping.echo.shot.ping},
                 {"t", to_seconds(ping.transmitted)},
                 {"unix", ping.unix_time},
                 {"levels", arrays_->levels.name()},
                 {"objects", arrays_->objects.name()},
                 {"at", arrays_->levels.pings()},
                 {"pan", ping.echo.shot.pan},
                 {"tilt", ping.echo.shot.tilt},
                 {"sound_speed", ping.echo.sound_speed}};
    arrays_->levels.add(files_.place, bytes_of(std::span<const float>(next.levels)));
    arrays_->objects.add(files_.place, bytes_of(std::span<const std::uint16_t>(next.labels)));
    ping.echo.objects = std::move(next.labels);
    next.line["pictures"] = draw(ping, counts, look);
    next.labels = std::move(ping.echo.objects);
    ping.echo.objects.clear();
    next.line["truth"] = files_.truth_lines++;
    std::string truth;
    append_truth_line(ping, truth);
    files_.truth.append(truth + "\n");
    ++pings_;
    pending_ = std::move(next);
}

void SonarSet::said(std::size_t port, std::string_view bytes) {
    if (!pending_) return;
    pending_->wire += bytes;
    pending_->messages.push_back(port);
    pending_->messages.push_back(bytes.size());
}

void SonarSet::finish_ping() {
    if (!pending_) return;
    Pending& ping = *pending_;
    const std::string file = "wire/" + name_ + ".bin";
    if (!wire_) wire_ = std::make_unique<DatasetStream>(files_.place, file);
    Json wire{{"file", file}, {"offset", wire_->size()}, {"bytes", ping.wire.size()}};
    for (std::size_t i = 0; i < ping.messages.size(); i += 2)
        wire["messages"].push_back({{"port", ping.messages[i]}, {"bytes", ping.messages[i + 1]}});
    wire_->append(ping.wire);
    ping.line["wire"] = std::move(wire);
    ping.line["sha256"] = sha256(std::array{bytes_of(std::span<const float>(ping.levels)),
                                            bytes_of(std::span<const std::uint16_t>(ping.labels)),
                                            std::string_view(ping.wire)});
    files_.index.append(ping.line.dump() + "\n");
    pending_.reset();
}

void SonarSet::finish() {
    finish_ping();
    finish_arrays();
}

std::string SonarSet::file_of(const char* kind) const {
    return std::string(kind) + "/" + name_ + "/" + gathered_->number + ".png";
}

/// Where the ping is in pictures, for the index.
Json SonarSet::draw(const PingTruth& ping, const std::vector<std::uint16_t>& counts, const Look& look) {
    const bool single = kind_ == Kind::head || kind_ == Kind::line;
    if (gathered_ && (!single || !goes_on(ping.echo.shot.pan))) finish_picture();
    if (!gathered_) gathered_.emplace(Gathered{six_digits(pings_), {}, {}, ping.echo.shot.pan, 0});
    for (const ObjectInView& object : look.objects) {
        ObjectInView& all = gathered_->visible[object.object + 1];
        all.seen += object.seen, all.whole += object.whole;
    }
    const PictureScale scale = scale_of(rule_);
    Json line{{"at_0", scale.at_0}, {"per_count", scale.per_count}};
    if (kind_ == Kind::rows) {
        line.update(draw_rows(ping, counts));
    } else {
        gather(ping, counts);
        line.update(draw_scan(ping));
    }
    if (!single) gathered_.reset();
    return line;
}

bool SonarSet::goes_on(double pan) const {
    const Gathered& g = *gathered_;
    const double step = step_between(g.last_pan, pan);
    constexpr double nothing = 1e-9;
    return g.scan.bearings.size() < most_columns && step * g.travelled >= 0 &&
           std::abs(g.travelled + step) < 2 * std::numbers::pi - nothing;
}

void SonarSet::gather(const PingTruth& ping, const std::vector<std::uint16_t>& counts) {
    Gathered& g = *gathered_;
    const Shot& shot = ping.echo.shot;
    g.travelled += step_between(g.last_pan, shot.pan);
    g.last_pan = shot.pan;
    for (const double bearing : shot.bearings) g.scan.bearings.push_back(shot.pan + bearing);
    g.scan.counts.insert(g.scan.counts.end(), counts.begin(), counts.end());
    g.scan.labels.insert(g.scan.labels.end(), ping.echo.objects.begin(), ping.echo.objects.end());
}

Json SonarSet::draw_scan(const PingTruth& ping) {
    const std::size_t column = gathered_->scan.bearings.size() - ping.echo.shot.bearings.size();
    Json line{{"polar", {{"file", file_of("polar")}, {"column", column}}}};
    const bool apart = kind_ == Kind::line || !ping.echo.shot.sides.empty();  // nothing to see from above
    if (!apart) {
        const CartesianMap& from_above = map();
        line["cartesian"] = {{"file", file_of("cartesian")},
                             {"metres_per_pixel", from_above.metres_per_pixel},
                             {"origin", {from_above.origin_x, from_above.origin_y}}};
    }
    if (kind_ == Kind::fan) {
        const CountPicture polar = polar_picture(gathered_->scan, arrays_->axis.bins);
        put_picture("polar", polar, {});
        if (!apart) put_picture("cartesian", cartesian_picture(map(), gathered_->scan), {});
    }
    return line;
}

Json SonarSet::draw_rows(const PingTruth& ping, const std::vector<std::uint16_t>& counts) {
    const FrontPictures front = front_pictures(counts, ping.echo.objects, ping.echo.shot, arrays_->axis);
    put_picture("front", front.levels, {});
    files_.place.put(file_of("range"), grey_png(front.ranges, front.levels.width, front.levels.height));
    return {{"front", {{"file", file_of("front")}}},
            {"range", {{"file", file_of("range")}, {"metres_per_count", front.metres_per_count}}}};
}

/// Of a fan, for the bearings of this ping; of a head, for its beam all round.
const CartesianMap& SonarSet::map() {
    const bool head = kind_ == Kind::head;
    if (map_ && (head || map_bearings_ == gathered_->scan.bearings)) return *map_;
    map_bearings_ = gathered_->scan.bearings;
    map_ = cartesian_map(map_bearings_, beam_width_, arrays_->axis, head);
    return *map_;
}

void SonarSet::finish_picture() {
    if (gathered_ && !gathered_->scan.bearings.empty()) {
        put_picture("polar", polar_picture(gathered_->scan, arrays_->axis.bins), {});
        if (kind_ == Kind::head) {
            const CartesianMap all =
                cartesian_map(gathered_->scan.bearings, beam_width_, arrays_->axis, true);
            put_picture("cartesian", cartesian_picture(all, gathered_->scan), {});
        }
    }
    gathered_.reset();
}

void SonarSet::put_picture(const char* kind, const CountPicture& picture, Json more) {
    const std::string file = file_of(kind);
    files_.place.put(file, grey_png(picture.counts, picture.width, picture.height));
    more["sonar"] = name_, more["kind"] = kind;
    files_.coco.add({file, picture.width, picture.height, picture.labels}, gathered_->visible, more);
}

}  // namespace echoloop
