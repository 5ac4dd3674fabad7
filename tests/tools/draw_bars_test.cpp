#include <gtest/gtest.h>

#include <stdexcept>

#include "tools/draw/bars.h"

namespace echoloop::draw {
namespace {

/// Pixels of the n-th bar's middle line that have the colour of a part: those of the key, in its order.
int length(const Image& image, std::size_t bar, Color color) {
    const int y = 84 + 26 * static_cast<int>(bar) + 13;
    int count = 0;
    for (int x = 0; x < image.width; ++x) count += image.at(x, y) == color;
    return count;
}

TEST(Bars, are_as_long_as_their_parts) {
    const Bars bars{
        "title", "ms", {"a", "b"}, "aim", {{"one", {1, 2}}, {"two", {4, 0}, 2.0}, {"none", {0, 0}}}};
    const Image image = bars_picture(bars);
    const Color a{240, 170, 60}, b{110, 190, 250};
    const int unit = length(image, 0, a);
    EXPECT_GT(unit, 100);
    EXPECT_NEAR(length(image, 0, b), 2 * unit, 3);
    EXPECT_NEAR(length(image, 1, a), 4 * unit, 8) << "but for the mark across it";
    EXPECT_EQ(length(image, 1, b), 0);
    EXPECT_EQ(length(image, 2, a), 0);
}

TEST(Bars, leave_room_for_labels_and_values) {
    const Bars bars{"", "ms", {"a"}, "", {{std::string(300, 'w'), {1}}, {"short", {0.5}}}};
    const Image image = bars_picture(bars, 600);
    EXPECT_GT(length(image, 0, {240, 170, 60}), 150) << "a long label takes half of the width at most";
}

TEST(Bars, refuse_to_draw_nothing) {
    EXPECT_THROW(bars_picture({}), std::invalid_argument);
    EXPECT_THROW(bars_picture({"", "", {"a"}, "", {{"one", {0}}}}), std::invalid_argument);
}

}  // namespace
}  // namespace echoloop::draw
