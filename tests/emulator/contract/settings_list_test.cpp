// One list of options and figures: the rows that come of it, and the settings that it fills.
#include "emulator/contract/settings_list.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "emulator/contract/options.h"

namespace echoloop::test {

using testing::ElementsAre;

enum class HangUp { never, first, always };

struct Settings {
    bool quiet = true;
    std::string serial = "1001";
    double turn_time = 2.4;
    double sector = deg_to_rad(120.1);
    std::uint8_t gain = 3;
    HangUp hang_up = HangUp::never;
    bool clockwise = true;
    unsigned beams = 240;
    std::string law = "A";
    double width = 0, level = 0;
    std::size_t rows = 0;
    AxisPattern horizontal, vertical;
    Receiver receiver;
};

void describe(Settings& s, OptionList& o, FigureList& f) {
    o.flag(s.quiet, "quiet", "says nothing", "own");
    o.text(s.serial, "serial", "of the head", "own");
    o.number(s.turn_time, "turn_time", "s", 0.01, 60, "of the motor", "own");
    o.degrees(s.sector, "sector", 10, 150, "of the fan", "own");
    o.whole(s.gain, "gain", "dB", 0, 6, "at power-up", "spec");
    o.choice(s.hang_up, "hang_up", {"never", "first", "always"}, "on a fire", "spec");
    o.words(s.clockwise, "rotation", {{"clockwise", true}, {"back", false}}, "seen from above", "spec");
    o.words(s.beams, "beams", {{"120", 120}, {"240", 240}}, "of a fan", "own");
    o.choice(s.law, "law", {"A", "B"}, "of the period", "own");
    f.degrees(s.width, "width", 0.1, 60, "of the beam");
    f.number(s.level, "level", "dB", 100, 240, "on the axis");
    f.whole(s.rows, "rows", 16, 4096, "of an image");
    f.common(s.horizontal, s.vertical, s.receiver);
}

namespace {

Model model() {
    Model m;
    list_settings<Settings>(m);
    return m;
}

DeviceConfig config() {
    DeviceConfig c;
    c.options = default_options(model());
    for (const FigureRow& row : model().figures)
        if (row.check != nullptr)
            c.profile[row.name].value = "none";
        else if (row.choices.empty())
            c.profile[row.name].value = 2.0;
        else
            c.profile[row.name].value = row.name == "bin_rule" ? "mean" : "hamming";
    return c;
}

const Option& option_row(const Model& model, std::string_view name) {
    return *std::ranges::find(model.options, name, &Option::name);
}

TEST(SettingsList, MakesRowsInItsOrder) {
    const Model m = model();
    std::vector<std::string> names;
    for (const Option& option : m.options) names.push_back(option.name);
    EXPECT_THAT(names, ElementsAre("quiet", "serial", "turn_time", "sector", "gain", "hang_up", "rotation",
                                   "beams", "law"));
    const Option& gain = option_row(m, "gain");
    EXPECT_EQ(gain.unit, "dB");
    EXPECT_EQ(gain.help, "at power-up");
    EXPECT_EQ(gain.source, "spec");
    EXPECT_EQ(gain.minimum, 0);
    EXPECT_EQ(gain.maximum, 6);
    EXPECT_THAT(option_row(m, "rotation").choices, ElementsAre("clockwise", "back"));
    EXPECT_EQ(m.figures[0].unit, "deg");
    EXPECT_EQ(m.figures[1].minimum, 100);
    EXPECT_TRUE(m.figures[2].whole);
    EXPECT_THAT(m.figures[3].choices, ElementsAre("line", "hamming", "piston"));
    EXPECT_EQ(m.figures.size(), 15);
}

TEST(SettingsList, TakesDefaultsFromTheMembers) {
    const Model m = model();
    EXPECT_EQ(option_row(m, "quiet").default_value, OptionValue(true));
    EXPECT_EQ(option_row(m, "serial").default_value, OptionValue(std::string("1001")));
    EXPECT_EQ(option_row(m, "turn_time").default_value, OptionValue(2.4));
    EXPECT_EQ(option_row(m, "gain").default_value, OptionValue(std::int64_t{3}));
    EXPECT_EQ(option_row(m, "hang_up").default_value, OptionValue(std::string("never")));
    EXPECT_EQ(option_row(m, "rotation").default_value, OptionValue(std::string("clockwise")));
    EXPECT_EQ(option_row(m, "beams").default_value, OptionValue(std::string("240")));
    EXPECT_EQ(option_row(m, "law").default_value, OptionValue(std::string("A")));
}

TEST(SettingsList, ShowsDegreesAsTheyWereWritten) {
    EXPECT_EQ(option_row(model(), "sector").default_value, OptionValue(120.1));
    for (int tenths = 1; tenths < 3600; ++tenths) {
        OptionList list;
        double angle = deg_to_rad(tenths / 10.0);
        list.degrees(angle, "angle", 0, 360, "", "");
        EXPECT_EQ(list.take_rows()[0].default_value, OptionValue(tenths / 10.0));
        EXPECT_EQ(angle, deg_to_rad(tenths / 10.0));
    }
}

TEST(SettingsList, FillsTheMembers) {
    DeviceConfig c = config();
    c.options["quiet"] = false;
    c.options["serial"] = std::string("7");
    c.options["turn_time"] = 5.0;
    c.options["sector"] = 90.0;
    c.options["gain"] = std::int64_t{6};
    c.options["hang_up"] = std::string("always");
    c.options["rotation"] = std::string("back");
    c.options["beams"] = std::string("120");
    c.options["law"] = std::string("B");
    const auto s = fill_settings<Settings>(c);
    EXPECT_FALSE(s.quiet);
    EXPECT_EQ(s.serial, "7");
    EXPECT_EQ(s.turn_time, 5);
    EXPECT_EQ(s.sector, deg_to_rad(90));
    EXPECT_EQ(s.gain, 6);
    EXPECT_EQ(s.hang_up, HangUp::always);
    EXPECT_FALSE(s.clockwise);
    EXPECT_EQ(s.beams, 120);
    EXPECT_EQ(s.law, "B");
}

TEST(SettingsList, FillsFiguresFromTheProfile) {
    const auto s = fill_settings<Settings>(config());
    EXPECT_EQ(s.width, deg_to_rad(2));
    EXPECT_EQ(s.level, 2);
    EXPECT_EQ(s.rows, 2);
    EXPECT_EQ(s.horizontal, (AxisPattern{ApertureShape::hamming, 2}));
    EXPECT_EQ(s.vertical, (AxisPattern{ApertureShape::hamming, 2}));
    EXPECT_EQ(s.receiver, (Receiver{0, 2, 2, 2, 2, 2}));
}

TEST(SettingsList, RefusesAWordThatIsNoChoice) {
    DeviceConfig c = config();
    c.options["hang_up"] = std::string("often");
    EXPECT_THROW(fill_settings<Settings>(c), std::invalid_argument);
}

}  // namespace
}  // namespace echoloop::test
