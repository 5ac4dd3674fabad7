// When a fault is on, and what the table of kinds promises.
#include "emulator/scenario/fault.h"

#include <gtest/gtest.h>

#include <set>

#include "emulator/faults/dice.h"
#include "protocols/inspect.h"

namespace echoloop {
namespace {

using namespace std::chrono_literals;

TEST(FaultTable, IsInTheOrderOfTheKindsWithNamesOfTheirOwn) {
    std::set<std::string> names;
    for (std::size_t i = 0; i < fault_table().size(); ++i) {
        const FaultRow& row = fault_table()[i];
        EXPECT_EQ(static_cast<std::size_t>(row.kind), i) << row.name;
        EXPECT_TRUE(names.insert(row.name).second) << row.name;
        EXPECT_FALSE(row.help.empty()) << row.name;
        EXPECT_EQ(find_fault(row.name), &row);
    }
    EXPECT_EQ(names.size(), fault_kinds);
    EXPECT_EQ(find_fault("rust"), nullptr);
}

TEST(Fault, WithoutTimesIsAlwaysOn) {
    const Fault fault;
    EXPECT_EQ(fault.on_until(0s), Time::max());
    EXPECT_FALSE(fault.next_change(0s));
}

TEST(Fault, LastsFromItsBeginningToJustBeforeItsEnd) {
    Fault fault;
    fault.from = 5s;
    fault.length = 2s;
    EXPECT_FALSE(fault.on_until(4999ms));
    EXPECT_EQ(fault.next_change(0s), Time(5s));
    EXPECT_EQ(fault.on_until(5s), Time(7s));
    EXPECT_EQ(fault.next_change(5s), Time(7s));
    EXPECT_FALSE(fault.on_until(7s));
    EXPECT_FALSE(fault.next_change(7s));
}

TEST(Fault, ComesAgain) {
    Fault fault;
    fault.from = 1s;
    fault.length = 500ms;
    fault.every = 3s;
    EXPECT_EQ(fault.on_until(4200ms), Time(4500ms));
    EXPECT_FALSE(fault.on_until(4500ms));
    EXPECT_EQ(fault.next_change(4200ms), Time(4500ms));
    EXPECT_EQ(fault.next_change(4500ms), Time(7s));
}

TEST(Fault, OfAMomentHasItsBeginningsOnly) {
    Fault fault;
    fault.from = 1s;
    fault.length = {};
    EXPECT_EQ(fault.next_change(0s), Time(1s));
    EXPECT_FALSE(fault.next_change(1s));
    fault.every = 2s;
    EXPECT_EQ(fault.next_change(1s), Time(3s));
    EXPECT_EQ(fault.next_change(2999ms), Time(3s));
}

TEST(Dice, AreEvenAndIndependentOfEachOther) {
    const Dice one(1), two(2);
    double sum = 0, product = 0;
    constexpr int n = 100'000;
    for (int i = 0; i < n; ++i) {
        const double a = one.uniform(i), b = two.uniform(i);
        ASSERT_GE(a, 0);
        ASSERT_LT(a, 1);
        sum += a;
        product += (a - 0.5) * (b - 0.5);
    }
    EXPECT_NEAR(sum / n, 0.5, 0.005);
    EXPECT_NEAR(product / n, 0, 0.002);
    EXPECT_EQ(one.uniform(7), Dice(1).uniform(7));
    EXPECT_NE(one.of(1).word(), one.of(2).word());
}

TEST(EveryModel, NamesAFamilyThatInspectKnows) {
    for (const Model& model : models())
        EXPECT_NE(inspect::find_family(model.family), nullptr) << model.name << ": " << model.family;
    EXPECT_TRUE(find_model("ping1d")->has_checksums);
    EXPECT_FALSE(find_model("tritech-micron")->has_checksums);
}

}  // namespace
}  // namespace echoloop
