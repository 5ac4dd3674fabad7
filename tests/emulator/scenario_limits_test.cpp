// No file and no bytes can hurt the loader of scenarios.
#include <gmock/gmock.h>
#include <rapidcheck/gtest.h>

#include <filesystem>
#include <fstream>

#include "tests/emulator/scenario_texts.h"

namespace echoloop {
namespace {

using namespace test;
using testing::HasSubstr;

TEST(ScenarioLimits, an_alias_may_be_used_and_is_read_each_time) {
    const auto scenario = parse(
        "scene: s.glb\ndevices:\n- {name: a, model: tritech-micron, options: &o {gain: 1}}\n"
        "- {name: b, model: tritech-micron, options: *o, endpoints: ['pty:/tmp/b']}\n");
    EXPECT_EQ(std::get<double>(scenario.devices[1].config.options.at("gain")), 1);
}

TEST(ScenarioLimits, an_alias_bomb_is_refused_early) {
    std::string bomb = "a0: &a0 [x, x, x, x, x, x, x, x, x, x]\n";
    for (int i = 1; i < 30; ++i) {
        const auto last = "*a" + std::to_string(i - 1);
        bomb += "a" + std::to_string(i) + ": &a" + std::to_string(i) + " [" + last;
        for (int k = 0; k < 9; ++k) bomb += ", " + last;
        bomb += "]\n";
    }
    EXPECT_THAT(refusal(bomb), HasSubstr("more than 20000 values, aliases counted"));
}

TEST(ScenarioLimits, long_text_behind_many_aliases_is_refused) {
    std::string text = "a: &a " + std::string(500'000, 'x') + "\nb: [*a";
    for (int i = 0; i < 10'000; ++i) text += ", *a";
    EXPECT_THAT(refusal(text + "]\n"), HasSubstr("too much text, aliases counted"));
}

TEST(ScenarioLimits, deep_nesting_is_refused) {
    EXPECT_THAT(refusal("a: " + std::string(100, '[') + std::string(100, ']')),
                HasSubstr("nested deeper than 64"));
    EXPECT_NE(refusal(std::string(500'000, '[')), "accepted");
    EXPECT_NE(refusal(std::string(500'000, '{')), "accepted");
    EXPECT_NE(refusal(std::string(200'000, '-')), "accepted");
}

TEST(ScenarioLimits, a_value_that_contains_itself_is_refused) {
    EXPECT_THAT(refusal("a: &a [*a]\n"), HasSubstr("t.yaml:1:8: an alias to a value that contains it"));
}

TEST(ScenarioLimits, so_many_faults_that_nobody_reads_them_are_cut) {
    std::string text(smallest);
    for (int i = 0; i < 5000; ++i) text += "key" + std::to_string(i) + ": 1\n";
    try {
        parse(text);
        FAIL() << "accepted";
    } catch (const ScenarioError& error) {
        EXPECT_EQ(error.problems().size(), 101);
    }
}

TEST(ScenarioFile, says_what_is_wrong_with_the_file_itself) {
    in_scenario_folder();
    const auto exit_and_text = [](const std::filesystem::path& file) {
        try {
            load_scenario(file, {}, test_models());
        } catch (const ScenarioError& error) {
            return std::to_string(static_cast<int>(error.exit())) + " " + error.what();
        }
        return std::string("accepted");
    };
    std::filesystem::create_directories("folder");
    std::ofstream("large.yaml") << std::string((1 << 20) + 1, '#');
    EXPECT_EQ(exit_and_text("none.yaml"), "66 none.yaml: no such file");
    EXPECT_EQ(exit_and_text("folder"), "66 folder: not a regular file");
    EXPECT_EQ(exit_and_text("/dev/zero"), "66 /dev/zero: not a regular file");
    EXPECT_EQ(exit_and_text("large.yaml"), "78 large.yaml: larger than 1 MiB; this is not a scenario");
}

RC_GTEST_PROP(ScenarioBytes, random_bytes_are_refused_or_read_and_never_crash, (const std::string& bytes)) {
    refusal(bytes);
    refusal(smallest + bytes);
    refusal(smallest, {bytes, "devices.micron." + bytes});
}

RC_GTEST_PROP(ScenarioBytes, a_scenario_with_one_changed_byte_is_refused_or_read, ()) {
    std::string text(complete);
    text[*rc::gen::inRange<std::size_t>(0, text.size())] = *rc::gen::arbitrary<char>();
    refusal(text);
    refusal(text.substr(0, *rc::gen::inRange<std::size_t>(0, text.size())));
}

}  // namespace
}  // namespace echoloop
