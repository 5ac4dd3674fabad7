// What `echoloop bench` says of its figures. Measures nothing.
#include "tools/echoloop/bench/report.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace echoloop::bench {
namespace {

Row row(const std::string& name, std::vector<Turn> turns) {
    const auto cases = all_cases();
    const auto found = std::ranges::find(cases, name, &Case::name);
    EXPECT_NE(found, cases.end()) << name;
    Row row{*found, EchoRule::radiometric, {}, std::move(turns)};
    return row;
}

const Limit* find(const std::vector<Limit>& limits, const std::string& what) {
    const auto found = std::ranges::find(limits, what, &Limit::what);
    return found == limits.end() ? nullptr : &*found;
}

/// The machine becomes twice as slow at the third turn and has one hiccup. Medians of all pings, 1 and 2.9,
/// would say 2.9.
TEST(BenchReport, GrowthIsToldByTurnsAtTheSameTime) {
    const Report report{{},
                        {row("scanning-simple", {{0, 1}, {0, 1}, {0, 1}, {0, 2}, {0, 2}}),
                         row("scanning-one2m", {{0, 1.5}, {0, 1.4}, {0, 9}, {0, 3}, {0, 2.9}}),
                         row("scanning-big100k", {{1, 0}, {1, 0}, {2, 0}, {2, 0}, {2, 0}}),
                         row("scanning-big2m", {{1.2, 3}, {1.1, 3}, {2.4, 3}, {2.2, 3}, {2.5, 3}})}};
    const auto limits = limits_of(report);
    const Limit* one = find(limits, "scanning: CPU, two million triangles in one mesh");
    ASSERT_NE(one, nullptr);
    EXPECT_DOUBLE_EQ(one->ours, 1.5);
    EXPECT_TRUE(one->met());
    const Limit* many = find(limits, "scanning: CPU, two million triangles in two meshes");
    ASSERT_NE(many, nullptr);
    EXPECT_DOUBLE_EQ(many->ours, 3);
    EXPECT_FALSE(many->met());
    const Limit* twenty = find(limits, "scanning: time with twenty times the triangles");
    ASSERT_NE(twenty, nullptr);
    EXPECT_DOUBLE_EQ(twenty->ours, 1.2);
}

TEST(BenchReport, WithoutTurnsTogetherThereIsNoGrowth) {
    const auto limits = limits_of({{}, {row("fls-simple", {{1, 1}}), row("fls-one2m", {})}});
    EXPECT_EQ(find(limits, "fls: CPU, two million triangles in one mesh"), nullptr);
}

/// Those that are compared are measured together; one after the other they would tell the machine's mood.
TEST(BenchReport, CasesOfOneSonarThatGrowthIsToldByTakeTurns) {
    const auto cases = all_cases();
    std::vector<std::string> together;
    std::size_t all = 0;
    for (const auto& group : groups_of(cases)) {
        all += group.size();
        if (group.size() == 1) continue;
        std::string names;
        for (const std::size_t i : group) names += cases[i].name() + " ";
        together.push_back(names);
    }
    EXPECT_EQ(all, cases.size());
    EXPECT_EQ(together,
              (std::vector<std::string>{"fls-simple fls-big100k fls-big2m fls-one2m ",
                                        "scanning-simple scanning-big100k scanning-big2m scanning-one2m "}));
}

}  // namespace
}  // namespace echoloop::bench
