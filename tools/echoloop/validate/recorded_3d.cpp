// R6: a Sonar 3D-15 beside three shots of a ship. The ship is not known: here it looks down at a flat floor
// that fills its view, and texture is that of the pixels that have a return.
#include <algorithm>
#include <cmath>
#include <limits>

#include "tools/echoloop/validate/driven.h"
#include "tools/echoloop/validate/groups.h"
#include "tools/echoloop/validate/statistics.h"
#include "tools/echoloop/validate/world.h"

namespace echoloop::validation {
namespace {

struct Shots {
    std::vector<Grid> metres, strengths;  ///< 0: no return
};

/// Takes a message in, if it is an image.
void keep(Shots& shots, const inspect::Message& message) {
    const bool range = message.name == "RangeImage";
    if (!range && message.name != "BitmapImageGreyscale8") return;
    Grid image{static_cast<std::size_t>(number_in(message, "width")),
               numbers_in(message, "image_pixel_data")};
    if (range)
        for (double& word : image.words) word *= number_in(message, "image_pixel_scale");
    (range ? shots.metres : shots.strengths).push_back(std::move(image));
}

Shots our_shots(std::size_t count) {
    Setup setup;
    setup.model = "sonar-3d-15";
    setup.options = {{"acoustics", true}};
    setup.water = water_of(1500);
    setup.scene = scene_of({floor_at(-4, 40)});
    setup.pose = [](double t) {  // a boat that drifts, so that speckle is new at every shot
        return Pose{{0.3 * t, 0, 0}, {std::cos(deg_to_rad(25)), 0, std::sin(deg_to_rad(25)), 0}};
    };
    Driven sonar(setup);
    Shots shots;
    while (shots.metres.size() < count)
        for (const auto& message : sonar.ping()) keep(shots, message);
    return shots;
}

/// Shots 0 to 2.
Shots recorded_shots(const std::filesystem::path& file) {
    Shots shots;
    for (const char* name : {"RangeImage", "BitmapImageGreyscale8"})
        for (const auto& message : recorded(file, name)) keep(shots, message);
    shots.metres.resize(std::min<std::size_t>(3, shots.metres.size()));
    shots.strengths.resize(std::min<std::size_t>(3, shots.strengths.size()));
    return shots;
}

double without_return(const Shots& shots) {
    double none = 0, all = 0;
    for (const Grid& image : shots.metres)
        none += static_cast<double>(std::ranges::count(image.words, 0.0)),
            all += static_cast<double>(image.words.size());
    return none / all;
}

/// Of the returns, those that none of the four pixels around lies within 5 cm of.
double isolated(const Shots& shots) {
    double alone = 0, all = 0;
    for (const Grid& image : shots.metres) {
        const auto& m = image.words;
        for (std::size_t i = 0; i < m.size(); ++i) {
            if (m[i] == 0) continue;
            const auto near = [&](bool there, std::size_t other) {
                return there && m[other] != 0 && std::abs(m[other] - m[i]) < 0.05;
            };
            const std::size_t column = i % image.columns;
            ++all;
            alone += !near(column > 0, i - 1) && !near(column + 1 < image.columns, i + 1) &&
                     !near(i >= image.columns, i - image.columns) &&
                     !near(i + image.columns < m.size(), i + image.columns);
        }
    }
    return alone / all;
}

/// Pixels that have a return in one shot and none in the next.
double flips(const Shots& shots) {
    double flipped = 0, all = 0;
    for (std::size_t shot = 1; shot < shots.metres.size(); ++shot)
        for (std::size_t i = 0; i < shots.metres[shot].words.size(); ++i, ++all)
            flipped += (shots.metres[shot].words[i] == 0) != (shots.metres[shot - 1].words[i] == 0);
    return flipped / all;
}

/// dB, of the returns' strengths about those within four pixels, of all shots; their columns as one image.
Grid strength_texture(const Shots& shots) {
    Grid all;
    for (Grid image : shots.strengths) {
        for (double& word : image.words)
            word = word == 0 ? std::numeric_limits<double>::quiet_NaN() : word / 5;
        const Grid one = texture(image, 4);
        all.columns = one.columns;
        all.words.insert(all.words.end(), one.words.begin(), one.words.end());
    }
    return all;
}

double texture_std(const Grid& grid) {
    std::vector<double> there;
    std::ranges::copy_if(grid.words, std::back_inserter(there), [](double w) { return !std::isnan(w); });
    return std::sqrt(moments(there).variance);
}

}  // namespace

void check_sonar_3d(Findings& find) {
    find.aims();
    const Shots ours = our_shots(3);
    const Grid texture = strength_texture(ours);
    find.source(
        "shots 0 to 2 of a 3D-15 at a ship; here a flat floor 4 m below, 50 deg aslant, which bounds these "
        "rows: over "
        "the ship's own ranges (tests/e2e/test_recordings.py) correlations are .54 .12 along rows, .39 -.08 "
        "along "
        "columns, .32 without a return and .25 flip",
        Kind::recording);
    find.within("pixels without a return", "", 0.38, 0.1, without_return(ours));
    find.within("isolated returns", "", 0.038, 0.0095, isolated(ours));
    find.within("pixels that flip from shot to shot", "", 0.23, 0.0575, flips(ours));
    find.within("std of strengths", "dB", 3.06, 0.306, texture_std(texture));
    find.within("strengths, correlation of neighbouring columns", "", 0.51, 0.1, likeness(texture, 0, 1));
    find.within("strengths, two columns apart", "", 0.13, 0.1, likeness(texture, 0, 2));
    find.within("strengths, correlation of neighbouring rows", "", 0.47, 0.1, likeness(texture, 1, 0));
    find.within("strengths, two rows apart", "", 0.10, 0.1, likeness(texture, 2, 0));
    if (find.recordings().empty()) return;
    const auto file = find.recordings() / "sonar-3d-15" / "ship_short.sonar";
    const Shots real = recorded_shots(file);
    const Grid theirs = strength_texture(real);
    find.source("the same figure of " + file.filename().string(), Kind::recording);
    find.within("isolated returns of the file", "", isolated(real), 0.25 * isolated(real), isolated(ours));
    find.within("flips of the file", "", flips(real), 0.25 * flips(real), flips(ours));
    find.within("std of strengths of the file", "dB", texture_std(theirs), 0.1 * texture_std(theirs),
                texture_std(texture));
    find.within("neighbouring columns of the file", "", likeness(theirs, 0, 1), 0.1, likeness(texture, 0, 1));
}

}  // namespace echoloop::validation
