#include "tools/echoloop/bench/cases.h"

#include <algorithm>
#include <cmath>

#include "emulator/contract/error.h"
#include "emulator/scenario/problems.h"

namespace echoloop::bench {
namespace {

constexpr double sound_speed = 1500;
constexpr auto twice = "twice big100k's";

/// What the code of the paper's authors takes for the same scene on two cores without GPU, in ms; a tenth of
/// it is the aim.
std::string authors(const char* milliseconds) { return std::string("the authors' code: ") + milliseconds; }

/// `beams` beams evenly over `aperture_deg`, and `bins` bins from 0 to `range` m with a pulse as long as a
/// bin. The receiver is that of a high-frequency imaging sonar, so that no effect is idle.
Shot fan(double aperture_deg, double height_deg, std::size_t beams, std::size_t bins, double range) {
    Shot shot;
    shot.beam_width = deg_to_rad(aperture_deg) / static_cast<double>(beams);
    for (std::size_t i = 0; i < beams; ++i)
        shot.bearings.push_back(deg_to_rad(-aperture_deg / 2) +
                                (static_cast<double>(i) + 0.5) * shot.beam_width);
    shot.fan_height = deg_to_rad(height_deg);
    shot.bins = bins;
    shot.bin_interval = 2 * range / sound_speed / static_cast<double>(bins);
    shot.pulse_length = shot.bin_interval;
    shot.interval = 2 * range / sound_speed + 0.005;
    shot.frequency = 720e3;
    shot.source_level = 205;
    shot.vertical = {ApertureShape::line, 2};
    shot.horizontal = {ApertureShape::hamming, 1};
    shot.receiver = {0, 30, 25, 190, 16};
    shot.random_key = 1;
    return shot;
}

/// Cerqueira et al. 2016, table 1.
Shot forward_looking() {
    Shot shot = fan(120, 20, 256, 500, 50);
    shot.tilt = deg_to_rad(-20);
    return shot;
}

/// One beam of a mechanically scanned head, which transmits and receives with the same aperture.
Shot scanning(double height_deg, std::size_t bins) {
    Shot shot = fan(3, height_deg, 1, bins, 50);
    shot.horizontal = shot.vertical = {ApertureShape::line, 2};
    return shot;
}

Shot imaging() {
    Shot shot = fan(130, 20, 512, 1000, 30);
    shot.frequency = 1.2e6;
    shot.tilt = deg_to_rad(-15);
    return shot;
}

/// A beam to either side: narrow along the track, and from below the sonar to above the horizon.
Shot side_scan() {
    Shot shot = fan(1, 100, 1, 2000, 75);
    shot.bearings = {deg_to_rad(-90), deg_to_rad(90)};
    shot.beam_width = deg_to_rad(0.5);
    shot.frequency = 450e3;
    return shot;
}

Case forward_looking_case(std::string scene, std::optional<Target> target = {}) {
    return {"fls", std::move(scene), forward_looking(), 0, std::move(target)};
}
Case scanning_case(std::string scene, std::optional<Target> target = {}) {
    return {"scanning", std::move(scene), scanning(35, 500), deg_to_rad(1.8), std::move(target)};
}
Case imaging_case(std::string scene) {
    return {"imaging512", std::move(scene), imaging(), 0, Target{10, 20, "50 pings a second"}};
}
Case long_scan_case(std::string scene) {
    return {"scanning1200", std::move(scene), scanning(35, 1200), deg_to_rad(0.9)};
}
Case side_scan_case(std::string scene) { return {"sidescan", std::move(scene), side_scan(), 0}; }

/// V35's thermocline with the sonar right above it, where it bends rays most: level ones drop by 2 m in 60.
Case behind_thermocline(Case of) {
    of.profile = {{0, 1515}, {10, 1515}, {20, 1485}};
    of.target.reset();
    return of;
}

std::string no_such_case(const std::vector<Case>& cases, const std::string& word) {
    std::vector<std::string> names;
    for (const Case& c : cases) names.push_back(c.name());
    return "--cases: there is no case " + scenario::in_quotes(word) +
           scenario::suggestion(word, {names.begin(), names.end()});
}

bool fits(const Case& c, std::string_view word) {
    return word == c.name() || word == c.sonar || word == c.scene;
}

bool tells_growth(const Case& c) {
    static constexpr std::string_view scenes[] = {"simple", "big100k", "big2m", "one2m"};
    return c.profile.empty() && std::ranges::find(scenes, c.scene) != std::end(scenes);
}

}  // namespace

std::vector<Case> all_cases() {
    return {forward_looking_case("simple", Target{2, 4, authors("18-22")}),
            forward_looking_case("big100k", Target{4, 8, authors("26-50")}),
            forward_looking_case("big2m", Target{8, 16, twice}),
            forward_looking_case("one1m", Target{8, 16, twice}),
            forward_looking_case("one2m", Target{8, 16, twice}),
            forward_looking_case("terrain"),
            forward_looking_case("stones"),
            scanning_case("simple", Target{0.2, 0.4, authors("1.8-3")}),
            scanning_case("big100k", Target{0.4, 0.8, authors("3.9-5.7")}),
            scanning_case("big2m", Target{0.8, 1.6, twice}),
            scanning_case("one1m", Target{0.8, 1.6, twice}),
            scanning_case("one2m", Target{0.8, 1.6, twice}),
            scanning_case("terrain"),
            scanning_case("stones"),
            imaging_case("big100k"),
            long_scan_case("big100k"),
            side_scan_case("big100k"),
            behind_thermocline(forward_looking_case("simple")),
            behind_thermocline(forward_looking_case("big100k")),
            behind_thermocline(scanning_case("simple")),
            behind_thermocline(scanning_case("big100k")),
            behind_thermocline(imaging_case("big100k")),
            behind_thermocline(long_scan_case("big100k")),
            behind_thermocline(side_scan_case("big100k"))};
}

std::vector<Case> cases_of_scene(const std::string& scene) {
    std::vector<Case> cases{forward_looking_case(scene), scanning_case(scene), imaging_case(scene),
                            long_scan_case(scene), side_scan_case(scene)};
    for (Case& c : cases) c.target.reset();
    return cases;
}

std::vector<Case> chosen(const std::vector<Case>& cases, const std::string& words) {
    if (words.empty()) return cases;
    std::vector<bool> wanted(cases.size());
    for (std::size_t begin = 0; begin <= words.size();) {
        const std::size_t end = std::min(words.find(',', begin), words.size());
        const std::string word = words.substr(begin, end - begin);
        bool found = false;
        for (std::size_t i = 0; i < cases.size(); ++i)
            if (fits(cases[i], word)) found = wanted[i] = true;
        if (!found) throw StartError(Exit::usage, no_such_case(cases, word));
        begin = end + 1;
    }
    std::vector<Case> result;
    for (std::size_t i = 0; i < cases.size(); ++i)
        if (wanted[i]) result.push_back(cases[i]);
    return result;
}

std::vector<std::vector<std::size_t>> groups_of(std::span<const Case> cases) {
    std::vector<std::vector<std::size_t>> groups;
    for (std::size_t i = 0; i < cases.size(); ++i) {
        const auto same = std::ranges::find_if(groups, [&](const auto& group) {
            const Case& first = cases[group.front()];
            return tells_growth(first) && tells_growth(cases[i]) && first.sonar == cases[i].sonar;
        });
        same == groups.end() ? groups.push_back({i}) : same->push_back(i);
    }
    return groups;
}

Shot shot_of(const Case& the_case, std::uint64_t number) {
    Shot shot = the_case.shot;
    shot.ping = number;
    shot.pan = std::remainder(the_case.turn * static_cast<double>(number), 2 * std::numbers::pi);
    return shot;
}

Pose pose_of(std::uint64_t number) {
    const auto t = 0.1 * static_cast<double>(number);
    return {{std::sin(0.7 * t), std::sin(0.5 * t), 0.2 * std::sin(0.3 * t)},
            from_rpy(0.02 * std::sin(0.9 * t), 0.02 * std::sin(1.1 * t), 0.1 * std::sin(0.4 * t))};
}

}  // namespace echoloop::bench
