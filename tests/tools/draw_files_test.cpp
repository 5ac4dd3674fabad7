#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstring>
#include <fstream>
#include <sstream>

#include "tests/tools/made_up_echograms.h"
#include "tools/draw/canvas.h"
#include "tools/draw/draw.h"

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

    const Surface read(cairo_image_surface_create_from_png(file("a.png").c_str()), cairo_surface_destroy);
    ASSERT_EQ(cairo_image_surface_get_width(read.get()), 5);
    ASSERT_EQ(cairo_image_surface_get_height(read.get()), 3);
    for (int y = 0; y < 3; ++y) {
        const auto* row =
            cairo_image_surface_get_data(read.get()) + y * cairo_image_surface_get_stride(read.get());
        for (int x = 0; x < 5; ++x)
            EXPECT_EQ(Color(row[4 * x + 2], row[4 * x + 1], row[4 * x]), image.at(x, y)) << x << ' ' << y;
    }
}

TEST_F(DrawFiles, svg_and_pdf_keep_lines_and_letters_as_such) {
    const Echogram ping = small_ping(0);
    Style style;
    style.title = "a title";
    const Picture picture = polar_picture({&ping, 1}, style);
    write_picture(file("a.svg"), PictureFormat::svg, picture);
    const std::string svg = content(file("a.svg"));
    EXPECT_THAT(svg, testing::HasSubstr("width=\"1000"));
    EXPECT_THAT(svg, testing::HasSubstr("<image"));
    EXPECT_THAT(svg, testing::HasSubstr("<path"));
    EXPECT_THAT(svg, testing::HasSubstr("glyph"));
    EXPECT_THAT(svg, testing::HasSubstr("</svg>"));
    write_picture(file("a.pdf"), PictureFormat::pdf, picture);
    const std::string pdf = content(file("a.pdf"));
    EXPECT_EQ(pdf.substr(0, 5), "%PDF-");
    EXPECT_THAT(pdf, testing::HasSubstr("/FontFile"));
    EXPECT_THAT(pdf, testing::HasSubstr("%%EOF"));
    EXPECT_EQ(picture_format_of("x/a.pdf"), PictureFormat::pdf);
    EXPECT_EQ(picture_format_of("a.gif"), std::nullopt);
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
    for (const PictureFormat format : {PictureFormat::svg, PictureFormat::pdf})
        EXPECT_THAT(
            [&] {
                write_picture("/dev/full", format, polar_picture({&ping, 1}, {}));
            },
            testing::ThrowsMessage<std::runtime_error>(testing::HasSubstr("/dev/full")));
    EXPECT_THAT(
        [&] {
            write_csv("/dev/full", {&ping, 1});
        },
        testing::ThrowsMessage<std::runtime_error>(testing::HasSubstr("No space")));
}

int inked(const std::string& text) {
    Image image(400, 30, {});
    Canvas(image).text({2, 15}, text, {255, 255, 255}, 16);
    return static_cast<int>(
        std::count_if(image.pixels.begin(), image.pixels.end(), [](Color c) { return c != Color(); }));
}

TEST(Text, has_the_characters_that_captions_use) {
    for (const std::string letter : {"A", "z", "0", "9", "-", "+", ".", ",", ":", "/", "(", ")", "\u00B0",
                                     "\u00B5", "m", "k", "H", "d", "B"})
        EXPECT_NE(inked(letter), 0) << letter;
    EXPECT_EQ(inked(" "), 0);
    EXPECT_NE(inked("\u00B0"), inked("\u00B5")) << "a font without them has a box for each";
}

TEST(Text, stands_where_its_anchor_says) {
    Image image(400, 30, {});
    Canvas canvas(image);
    const auto columns = [&](Anchor anchor) {
        std::fill(image.pixels.begin(), image.pixels.end(), Color());
        canvas.text({200, 15}, "HHHH", {255, 255, 255}, 16, anchor);
        int first = 400, last = 0;
        for (int i = 0; i < 400 * 30; ++i)
            if (image.pixels[i] != Color()) first = std::min(first, i % 400), last = std::max(last, i % 400);
        return std::pair{first, last};
    };
    const double width = canvas.text_width("HHHH", 16);
    EXPECT_NEAR(columns(Anchor::left).first, 200, 3);
    EXPECT_NEAR(columns(Anchor::middle).first, 200 - width / 2, 3);
    EXPECT_NEAR(columns(Anchor::middle).second, 200 + width / 2, 3);
    EXPECT_NEAR(columns(Anchor::right).second, 200, 3);
}

TEST(Text, takes_any_bytes_and_does_not_spoil_what_comes_after_them) {
    EXPECT_EQ(inked("a\xFF\x80z"), inked("a??z"));
    Image image(30, 10, {});
    Canvas canvas(image);
    canvas.text({-20, 3}, "\xC2\xFF\x80 long text that runs out on both sides", {255, 255, 255}, 16);
    canvas.rectangle({4, 5}, 2, 2, {1, 2, 3});
    EXPECT_EQ(image.at(4, 5), Color(1, 2, 3));
}

}  // namespace
}  // namespace echoloop::draw
