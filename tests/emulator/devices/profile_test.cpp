// The profiles that are built into the program, and what they make of the pings.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "tests/emulator/devices/driver.h"

namespace echoloop::test {
namespace {

TEST(OwnProfiles, AreCompleteAndEveryFigureHasASource) {
    for (const Model& model : models()) {
        const Profile profile = own_profile(model);
        EXPECT_EQ(profile.size(), model.figures.size()) << model.name;
        EXPECT_GT(profile.size(), is_sonar(model) ? 10u : 5u) << model.name;
        for (const auto& [name, figure] : profile) EXPECT_GT(figure.source.size(), 8u) << model.name << name;
    }
}

/// 10 log10 (4 pi L H / lambda^2) of a rectangle, from its one-way -3 dB widths: 0.886 lambda / L.
double directivity_index(double width, double height) {
    const auto length = [](double angle) { return 0.443 / std::sin(angle / 2); };
    return 10 * std::log10(4 * std::numbers::pi * length(width) * length(height));
}

TEST(OwnProfiles, DirectivityOfTheMicronFollowsFromItsBeam) {
    const Profile profile = own_profile(*find_model("tritech-micron"));
    // Two-way: sinc^4 is 1/2 at 0.319 lambda / L, sinc^2 at 0.443.
    const double one_way = 0.443 / 0.319;
    const double index = directivity_index(deg_to_rad(figure(profile, "beam_width")) * one_way,
                                           deg_to_rad(figure(profile, "fan_height")) * one_way);
    EXPECT_NEAR(figure(profile, "directivity_index"), index, 0.5);
}

TEST(Profiles, FiguresReachThePing) {
    const Model& model = *find_model("tritech-micron");
    DeviceConfig config = make_config(model);
    const Shot shot = model.default_shot(config, 0, 10);
    EXPECT_EQ(shot.source_level, 206);
    EXPECT_EQ(shot.horizontal, (AxisPattern{ApertureShape::line, 2}));
    EXPECT_EQ(shot.vertical, (AxisPattern{ApertureShape::line, 2}));
    EXPECT_EQ(shot.receiver.directivity_index, 22);
    EXPECT_EQ(shot.receiver.self_noise, 53.7);
    EXPECT_EQ(shot.receiver.saturation_level, 190);
    EXPECT_EQ(shot.receiver.converter_bits, 24);
    EXPECT_EQ(shot.receiver.bandwidth, 0) << "that of the filter matched to the pulse";
    config.profile["source_level"].value = 190.0;
    config.profile["beam_width"].value = 6.0;
    config.profile["vertical_aperture"].value = std::string("piston");
    const Shot other = model.default_shot(config, 0, 10);
    EXPECT_EQ(other.source_level, 190);
    EXPECT_DOUBLE_EQ(other.beam_width, deg_to_rad(6));
    EXPECT_EQ(other.vertical.shape, ApertureShape::piston);
}

/// The option that holds the serial number of a model's units, or what it follows from.
std::string serial_option(const Model& model) {
    for (const char* name : {"serial", "device_id", "system_id"})
        if (std::ranges::find(model.options, name, &Option::name) != model.options.end()) return name;
    return "";
}

TEST(Profiles, StavesAreThoseOfTheUnitWithThatSerialNumber) {
    int arrays = 0;
    for (const Model& model : models()) {
        if (std::ranges::find(model.figures, "stave_phase_error", &FigureRow::name) == model.figures.end())
            continue;
        ++arrays;
        const auto unit = [&](DeviceConfig config) { return model.default_shot(config, 0, 0).errors.unit; };
        const DeviceConfig config = make_config(model);
        DeviceConfig elsewhere = config, other = config;
        elsewhere.name = "another", elsewhere.random_key = 4711;
        auto& serial = other.options.at(serial_option(model));
        if (auto* text = std::get_if<std::string>(&serial))
            *text += "1";
        else
            serial = std::get<std::int64_t>(serial) + 1;
        EXPECT_NE(unit(config), 0U) << model.name
                                    << ": the scenario's seed and the device's name would count";
        EXPECT_EQ(unit(config), unit(elsewhere)) << model.name;
        EXPECT_NE(unit(config), unit(other)) << model.name;
    }
    EXPECT_GE(arrays, 14);
}

TEST(Profiles, TheSonicHearsWithTheArrayAndSendsWithTheProjector) {
    const Model& model = *find_model("r2sonic-2024");
    DeviceConfig config = make_config(model);
    const Shot shot = model.default_shot(config, 0, 0);
    EXPECT_EQ(shot.horizontal, (AxisPattern{ApertureShape::hamming, 1}));
    EXPECT_EQ(shot.vertical, (AxisPattern{ApertureShape::line, 1}));
    EXPECT_DOUBLE_EQ(shot.beam_width, deg_to_rad(0.5));
    EXPECT_DOUBLE_EQ(shot.fan_height, deg_to_rad(1));
    EXPECT_EQ(shot.receiver.bandwidth, 30e3);
    EXPECT_NEAR(shot.interval, 2 * 20 / 1500.0 + 0.01, 1e-12) << "free running";
    config.options["frequency"] = 200e3;
    config.options["projector"] = std::string("wide");
    const Shot low = model.default_shot(config, 0, 0);
    EXPECT_DOUBLE_EQ(low.beam_width, deg_to_rad(1)) << "half the frequency, twice the width";
    EXPECT_DOUBLE_EQ(low.fan_height, deg_to_rad(40));
    EXPECT_NEAR(shot.receiver.directivity_index - low.receiver.directivity_index, 6.02, 0.01);
}

}  // namespace
}  // namespace echoloop::test
