#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <png.h>
#include <unistd.h>

#include <cstring>
#include <fstream>
#include <sstream>

#include "tests/tools/made_up_echograms.h"
#include "tools/draw/draw.h"
#include "tools/draw/font.h"

namespace echoloop::draw {
namespace {

class DrawFiles : public testing::Test {
  protected:
    DrawFiles() {
        std::string name = testing::TempDir() + "draw.XXXXXX";
        folder_ = mkdtemp(name.data());
    }
    ~DrawFiles() override { std::filesystem::remove_all(folder_); }

    std::filesystem::path file(const char* name) const { return folder_ / name; }
    static std::string content(const std::filesystem::path& path) {
        std::ostringstream text;
        text << std::ifstream(path, std::ios::binary).rdbuf();
        return text.str();
    }

    std::filesystem::path folder_;
};

Echogram small_ping(double pan) {
    Echogram ping =
        test::ping({deg_to_rad(-1), deg_to_rad(1)}, pan, deg_to_rad(2), 6, 3,
                   [](double r, double b) { return static_cast<float>(r + (b > 0 ? 0.25 : 0.0)); });
    return ping;
}

TEST_F(DrawFiles, csv_has_the_ranges_in_its_header_and_a_row_per_beam) {
    const std::vector<Echogram> pings{small_ping(0), small_ping(deg_to_rad(90))};
    write_csv(file("a.csv"), pings);
    EXPECT_EQ(content(file("a.csv")),
              "bearing_deg,1,3,5\n"
              "-1.000000,1,3,5\n"
              "1.000000,1.25,3.25,5.25\n"
              "89.000000,1.25,3.25,5.25\n"
              "91.000000,1.25,3.25,5.25\n");
}

TEST_F(DrawFiles, npy_is_a_float32_matrix_of_beams_by_bins) {
    const std::vector<Echogram> pings{small_ping(0), small_ping(deg_to_rad(90))};
    write_npy(file("a.npy"), pings);
    const std::string bytes = content(file("a.npy"));
    ASSERT_EQ(bytes.size(), 128 + 4 * 3 * sizeof(float));
    EXPECT_EQ(bytes.substr(0, 10), std::string("\x93NUMPY\x01\x00\x76\x00", 10));
    EXPECT_THAT(bytes, testing::HasSubstr("{'descr': '<f4', 'fortran_order': False, 'shape': (4, 3), }"));
    EXPECT_EQ(bytes[127], '\n');
    float values[12];
    std::memcpy(values, bytes.data() + 128, sizeof values);
    EXPECT_THAT(values, testing::ElementsAre(1, 3, 5, 1.25, 3.25, 5.25, 1.25, 3.25, 5.25, 1.25, 3.25, 5.25));
}

TEST_F(DrawFiles, tables_refuse_pings_of_different_ranges) {
    std::vector<Echogram> pings{small_ping(0), small_ping(1)};
    pings[1].shot.first_bin_time = 0.001;
    EXPECT_THROW(write_csv(file("a.csv"), pings), std::invalid_argument);
    EXPECT_THROW(write_npy(file("a.npy"), pings), std::invalid_argument);
    EXPECT_THROW(write_npy(file("a.npy"), {}), std::invalid_argument);
    EXPECT_FALSE(exists(file("a.csv"))) << "nothing is begun that cannot be finished";
}

TEST_F(DrawFiles, png_gives_the_pixels_back) {
    Image image(5, 3, {1, 2, 3});
    image.at(4, 0) = {250, 128, 7};
    image.at(0, 2) = {9, 99, 199};
    write_png(file("a.png"), image);

    png_image header{};
    header.version = PNG_IMAGE_VERSION;
    ASSERT_TRUE(png_image_begin_read_from_file(&header, file("a.png").c_str()));
    header.format = PNG_FORMAT_RGB;
    std::vector<Color> pixels(15);
    ASSERT_TRUE(png_image_finish_read(&header, nullptr, pixels.data(), 0, nullptr));
    EXPECT_EQ(header.width, 5);
    EXPECT_EQ(header.height, 3);
    EXPECT_EQ(pixels, image.pixels);
}

TEST_F(DrawFiles, name_the_path_and_the_reason_when_they_cannot_write) {
    const std::filesystem::path nowhere = file("missing") / "a.png";
    const Echogram ping = small_ping(0);
    for (const auto& write : std::vector<std::function<void()>>{
             [&] { write_png(nowhere, Image(2, 2, {})); },
             [&] {
                 write_csv(nowhere, {&ping, 1});
             },
             [&] {
                 write_npy(nowhere, {&ping, 1});
             },
         })
        EXPECT_THAT(write, testing::ThrowsMessage<std::runtime_error>(testing::AllOf(
                               testing::HasSubstr(nowhere.string()), testing::HasSubstr("No such file"))));
}

TEST_F(DrawFiles, report_a_full_disk) {
    if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "there is no /dev/full";
    EXPECT_THAT([] { write_png("/dev/full", Image(300, 300, {})); },
                testing::ThrowsMessage<std::runtime_error>(testing::HasSubstr("/dev/full")));
    const Echogram ping = small_ping(0);
    EXPECT_THAT(
        [&] {
            write_csv("/dev/full", {&ping, 1});
        },
        testing::ThrowsMessage<std::runtime_error>(testing::HasSubstr("No space")));
}

int inked(const std::string& text) {
    Image image(400, 20, {});
    draw_text(image, 2, 10, text, {255, 255, 255}, 1);
    return static_cast<int>(std::count(image.pixels.begin(), image.pixels.end(), Color{255, 255, 255}));
}

TEST(Font, has_the_characters_that_captions_use) {
    const int unknown = inked("\u00FF");
    EXPECT_EQ(unknown, inked("?"));
    for (const std::string letter : {"A", "z", "0", "9", "-", "+", ".", ",", ":", "/", "(", ")", "\u00B0",
                                     "\u00B5", "m", "k", "H", "d", "B"})
        EXPECT_NE(inked(letter), 0) << letter;
    EXPECT_EQ(inked(" "), 0);
    EXPECT_EQ(text_width("60\u00B0", 2), (6 * 3 - 1) * 2) << "a character of two bytes is one letter wide";
}

TEST(Font, takes_any_bytes_and_stays_inside_the_image) {
    Image image(30, 10, {});
    draw_text(image, -20, 3, "\xC2\xFF\x80 long text that runs out on both sides", {255, 255, 255}, 3);
    draw_text(image, 10, 200, "below", {255, 255, 255}, 3);
    EXPECT_EQ(image.pixels.size(), 300);
}

}  // namespace
}  // namespace echoloop::draw
