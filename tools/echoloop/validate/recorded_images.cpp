// R2, R3: an Oculus and an Imagenex 852 under the settings of recorded pings, above a flat floor or, for
// noise, in open water. What is compared is the receiver: what it hears of nothing, of its own pulse, and the
// texture of an echo that fills it.
#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "protocols/imagenex/codec.h"
#include "protocols/oculus/codec.h"
#include "tools/echoloop/validate/driven.h"
#include "tools/echoloop/validate/groups.h"
#include "tools/echoloop/validate/statistics.h"
#include "tools/echoloop/validate/world.h"

namespace echoloop::validation {
namespace {

/// Rows [first, last) of an image.
Grid rows_of(const Grid& image, std::size_t first, std::size_t last) {
    const auto at = [&](std::size_t row) {
        return image.words.begin() + static_cast<std::ptrdiff_t>(row * image.columns);
    };
    return {image.columns, {at(std::min(first, image.rows())), at(std::min(last, image.rows()))}};
}

double variation(const std::vector<double>& words) {
    const Moments m = moments(words);
    return std::sqrt(m.variance) / m.mean;
}

double rms(std::span<const double> ours, std::span<const double> wanted) {
    double squares = 0;
    for (std::size_t i = 0; i < wanted.size(); ++i)
        squares += std::pow(ours[i] - wanted[i], 2) / static_cast<double>(wanted.size());
    return std::sqrt(squares);
}

Grid image_of(const inspect::Message& result) {
    const auto& tail = numbers_in(result, "tail");
    const auto size = static_cast<std::size_t>(number_in(result, "image_size"));
    Grid image{static_cast<std::size_t>(number_in(result, "beams")), {}};
    image.words.assign(tail.end() - static_cast<std::ptrdiff_t>(std::min(size, tail.size())), tail.end());
    return image;
}

/// High frequency, 2 m, 50 %, as recorded, looking aslant at what is in the scene.
Grid our_oculus(std::shared_ptr<const Scene> scene) {
    Setup setup;
    setup.model = "oculus-m1200d";
    setup.options = {
        {"gain_echo", std::string("plain")}};  // the file's gain is taken for that of the receiver
    const oculus::Fire fire{.mode = oculus::Mode::high_frequency,
                            .network_speed = 25,
                            .gamma = 127,
                            .flags = 0x19,
                            .range = 2,
                            .gain = 50,
                            .sound_speed = 1490.658551265436};
    setup.asks = {oculus::encode(oculus::Message(fire))};
    setup.water = water_of(fire.sound_speed);
    setup.scene = std::move(scene);
    setup.pose = [](double) { return Pose{{}, {std::cos(deg_to_rad(30)), 0, std::sin(deg_to_rad(30)), 0}}; };
    Driven sonar(setup);
    for (const auto& message : sonar.ping())
        if (message.name == "Result") return image_of(message);
    throw std::runtime_error("validate: an Oculus sent no image");
}

/// <I^2> / <I>^2 of intensities, the fourth power of words, in windows of 25 x 15: their median.
double scintillation(const Grid& image) {
    constexpr std::size_t high = 25, wide = 15;
    std::vector<double> all;
    for (std::size_t row = 0; row + high <= image.rows(); row += high)
        for (std::size_t column = 0; column + wide <= image.columns; column += wide) {
            double sum = 0, squares = 0;
            for (std::size_t i = 0; i < high; ++i)
                for (std::size_t k = 0; k < wide; ++k) {
                    const double power = std::pow(image.words[(row + i) * image.columns + column + k], 4);
                    sum += power, squares += power * power;
                }
            if (sum > 0) all.push_back(high * wide * squares / (sum * sum));
        }
    const auto median = all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2);
    std::nth_element(all.begin(), median, all.end());
    return all.empty() ? 0 : *median;
}

Bytes sounder_command() {
    imagenex::SwitchCommand command;
    command.head_id = 0x11, command.range = 50, command.mode = imagenex::mode::all, command.start_gain = 12;
    command.absorption = 20, command.pulse_length = 4, command.data_points = 50;
    return imagenex::encode(imagenex::Message(command));
}

std::vector<std::vector<double>> our_852(std::size_t shots, std::shared_ptr<const Scene> scene) {
    Setup setup;
    setup.model = "imagenex-852";
    setup.asks = {sounder_command()};
    setup.water = water_of(1500);
    setup.scene = std::move(scene);
    setup.pose = [](double t) {  // a boat that heaves
        return Pose{{0.2 * t, 0, 0.9 * std::sin(t * 1.46)}, {std::sqrt(0.5), 0, std::sqrt(0.5), 0}};
    };
    Driven sonar(setup);
    std::vector<std::vector<double>> all;
    for (std::size_t shot = 0; shot < shots; ++shot)
        for (const auto& message : sonar.ping())
            if (has_field(message, "data")) all.push_back(numbers_in(message, "data"));
    return all;
}

std::vector<double> bins_of(const std::vector<std::vector<double>>& shots, std::size_t first,
                            std::size_t last) {
    std::vector<double> all;
    for (const auto& shot : shots)
        for (std::size_t bin = first; bin < std::min(last, shot.size()); ++bin) all.push_back(shot[bin]);
    return all;
}

/// From the bottom's edge on, the first word above half of the scale, 12 words of each shot.
Grid bottoms_of(const std::vector<std::vector<double>>& shots) {
    constexpr std::size_t first = 11, length = 12;
    Grid all{length, {}};
    for (const auto& shot : shots) {
        const auto edge = std::find_if(shot.begin() + first, shot.end(), [](double w) { return w > 63; });
        if (static_cast<std::size_t>(shot.end() - edge) >= length)
            all.words.insert(all.words.end(), edge, edge + length);
    }
    return all;
}

std::vector<double> column_of(const Grid& grid, std::size_t column) {
    std::vector<double> words;
    for (std::size_t row = 0; row < grid.rows(); ++row)
        words.push_back(grid.words[row * grid.columns + column]);
    return words;
}

/// Mean over the bins 4 to 11 behind the bottom's edge.
double variation_behind_edge(const Grid& bottoms) {
    double sum = 0;
    for (std::size_t bin = 4; bin < bottoms.columns; ++bin) sum += variation(column_of(bottoms, bin)) / 8;
    return sum;
}

}  // namespace

void check_oculus(Findings& find) {
    find.aims();
    const Grid open_water = our_oculus(scene_of({})), noise = rows_of(open_water, 600, 700),
               lit = rows_of(our_oculus(scene_of({floor_at(-0.8, 20)})), 260, 420);
    const Grid noise_texture = texture(noise), lit_texture = texture(lit);
    find.source("a ping of an M1200d, 2.1 MHz, 2 m, 50 %: rows 600-699, 1.7 to 2 m", Kind::recording);
    find.within("noise, mean word", "", 56, 5.6, moments(noise.words).mean);
    find.within("noise, coefficient of variation", "", 0.283, 0.028,
                std::sqrt(moments(noise_texture.words).variance) / moments(noise.words).mean);
    find.within("noise, correlation of neighbouring beams", "", 0.53, 0.1, likeness(noise_texture, 0, 1));
    find.within("noise, two beams apart", "", 0.10, 0.1, likeness(noise_texture, 0, 2));
    find.within("noise, three beams apart", "", 0.01, 0.1, likeness(noise_texture, 0, 3));
    find.within("noise, correlation of neighbouring rows", "", 0.04, 0.1, likeness(noise_texture, 1, 0));
    find.source(
        "the same ping, rows 260-419; here a flat floor, whose rows are alike as the receiver's band makes "
        "them; the "
        "tank's own shapes, which leave 0.09 over two rows there, are not in it",
        Kind::recording);
    find.within("lit echo, coefficient of variation", "", 0.316, 0.0316,
                std::sqrt(moments(lit_texture.words).variance) / moments(lit.words).mean);
    find.within("lit echo, correlation of neighbouring beams", "", 0.62, 0.1, likeness(lit_texture, 0, 1));
    find.within("lit echo, two beams apart", "", 0.28, 0.1, likeness(lit_texture, 0, 2));
    find.within("lit echo, three beams apart", "", 0.16, 0.1, likeness(lit_texture, 0, 3));
    find.within("lit echo, correlation of neighbouring rows", "", 0.22, 0.1, likeness(lit_texture, 1, 0));
    find.within("lit echo, scintillation, median of windows", "", 2.6, 0.26, scintillation(lit));
    find.source("the same ping", Kind::recording);
    find.within("mean of rows 20 to 119", "", 9.1, 0.91, moments(rows_of(open_water, 20, 120).words).mean);
    constexpr std::array<double, 8> first_rows{40, 42, 12, 17, 19, 19, 14, 10};
    std::vector<double> means;
    for (std::size_t row = 0; row < first_rows.size(); ++row)
        means.push_back(moments(rows_of(open_water, row, row + 1).words).mean);
    find.at_most("mean of rows 0 to 7, rms distance", "", 8, rms(means, first_rows));
    if (find.recordings().empty()) return;
    const auto file = find.recordings() / "oculus" / "three_pings_8bit.raw";
    const Grid real = image_of(recorded(file, "Result").front());
    const Grid real_texture = texture(rows_of(real, 600, 700));
    find.source("the same figure of " + file.filename().string(), Kind::recording);
    find.within("noise of the file, neighbouring beams", "", likeness(real_texture, 0, 1), 0.1,
                likeness(noise_texture, 0, 1));
    find.source(file.filename().string() + ": Jensen-Shannon distance of the words, classes of 4",
                Kind::recording);
    find.at_most("distance of noise", "", 0.25,
                 histogram_distance(noise.words, rows_of(real, 600, 700).words, 4));
    find.at_most("distance of lit rows", "", 0.25,
                 histogram_distance(lit.words, rows_of(real, 260, 420).words, 4));
}

void check_852(Findings& find) {
    find.aims();
    const auto ours = our_852(100, scene_of({floor_at(-8.3, 200)}));
    // A flat floor comes back to there by way of the surface, five times and more; the lake's did not.
    const auto noise = bins_of(our_852(100, scene_of({})), 420, 500);
    find.source("177 shots over 50 m, 12 dB, 4 us: bins 420-499; here open water", Kind::recording);
    find.within("noise, coefficient of variation", "", 0.385, 0.0385, variation(noise));
    find.within("noise, skewness", "", 0.74, 0.1, moments(noise).skewness);
    find.source("the same shots", Kind::recording);
    constexpr std::array<double, 7> first_bins{14, 15, 8, 39, 41, 16, 5};
    std::vector<double> means;
    for (std::size_t bin = 0; bin < first_bins.size(); ++bin)
        means.push_back(moments(bins_of(ours, bin, bin + 1)).mean);
    find.at_most("mean of bins 0 to 6, rms distance", "", 8, rms(means, first_bins));
    const Grid bottoms = bottoms_of(ours);
    find.source("the same shots, a rough bottom at 7.4 to 9.4 m; here a flat one", Kind::recording);
    find.within("coefficient of variation behind the bottom's edge", "", 0.55, 0.055,
                variation_behind_edge(bottoms));
    if (find.recordings().empty()) return;
    const auto file = find.recordings() / "imagenex852" / "hydroball.852";
    std::vector<std::vector<double>> real;
    for (const auto& shot : recorded(file, "Shot852")) real.push_back(numbers_in(shot, "reply.data"));
    find.source(file.filename().string() + ": Jensen-Shannon distance of the words, classes of 4",
                Kind::recording);
    find.at_most("distance of noise, bins 420-499", "", 0.25,
                 histogram_distance(noise, bins_of(real, 420, 500), 4));
    const Grid recorded_bottoms = bottoms_of(real);
    find.at_most("distance of the bottom, 12 bins from its edge", "", 0.25,
                 histogram_distance(bottoms.words, recorded_bottoms.words, 4));
    find.source("the same figure of " + file.filename().string(), Kind::recording);
    find.within("variation behind the bottom's edge of the file", "", variation_behind_edge(recorded_bottoms),
                0.1 * variation_behind_edge(recorded_bottoms), variation_behind_edge(bottoms));
}

}  // namespace echoloop::validation
