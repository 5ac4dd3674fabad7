// What motion sensors say: the examples of manuals, strictness, and messages among noise.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "protocols/motion/inspect.h"
#include "protocols/motion/reading.h"

namespace echoloop::motion {
namespace {

wire::Bytes bytes_of(const std::string& text) { return {text.begin(), text.end()}; }

/// The messages of a stream, written again.
std::string found_in(const std::string& stream, std::size_t piece = 4096) {
    Framer framer;
    std::string found;
    const auto drain = [&] {
        while (const auto reading = framer.next())
            for (const std::uint8_t byte : write(*reading)) found += static_cast<char>(byte);
    };
    for (std::size_t at = 0; at < stream.size(); at += piece) {
        framer.feed(bytes_of(stream.substr(at, piece)));
        drain();
        EXPECT_LE(framer.pending_bytes(), 27u);
    }
    framer.finish();
    drain();
    EXPECT_EQ(framer.pending_bytes(), 0u);
    return found;
}

const std::string line = ":00FFCA -0003F-0325  0319\r\n";
const std::string binary("\x90\x90\xBB\xFE\x3F\x01\xCE\xFF\x0E\x6A", 10);

TEST(Motion, Tss1IsThatOfItsManual) {
    const auto reading = read(bytes_of(line));
    ASSERT_TRUE(reading);
    EXPECT_EQ(reading->roll, -3.25);
    EXPECT_EQ(reading->pitch, 3.19);
    EXPECT_EQ(reading->heave, -0.03);
    EXPECT_NEAR(reading->vertical, -54 * 0.000625, 1e-12);
    EXPECT_EQ(reading->status, 'F');
    EXPECT_EQ(write(*reading), bytes_of(line));
}

TEST(Motion, ValuesBeyondTheFormatAreCut) {
    EXPECT_EQ(write({.roll = 150, .pitch = -150, .heave = 1e9, .horizontal = 20, .vertical = -100}),
              bytes_of(":FF8000  9999F 9999 -9999\r\n"));
    const Reading far{.format = Format::em3000,
                      .roll = 200,
                      .pitch = -200,
                      .heave = -1e9,
                      .heading = 359.996,
                      .status = 0x90};
    const auto again = read(write(far));
    ASSERT_TRUE(again);
    EXPECT_EQ(again->roll, 179.99);
    EXPECT_EQ(again->heave, -9.99);
    EXPECT_EQ(again->heading, 0);
    EXPECT_EQ(write({.roll = -0.001}), bytes_of(":000000  0000F 0000  0000\r\n")) << "no minus before zero";
}

TEST(Motion, IsStrict) {
    for (const char* bad :
         {"", ":", "00FFCA -0003F-0325  0319\r\n", ":00FFCA -0003F-0325  0319\n",
          ":00ffca -0003F-0325  0319\r\n", ":00FFCA +0003F-0325  0319\r\n", ":00FFCA -0003X-0325  0319\r\n",
          ":00FFCA -00 3F-0325  0319\r\n", ":00FFCA -0003F-0325 0319\r\n", ":0GFFCA -0003F-0325  0319\r\n"})
        EXPECT_FALSE(read(bytes_of(bad))) << bad;
    for (std::size_t size = 0; size < line.size(); ++size) EXPECT_FALSE(read(bytes_of(line.substr(0, size))));
    const auto with = [](std::size_t at, const std::string& bytes) {
        std::string changed = binary;
        return bytes_of(changed.replace(at, bytes.size(), bytes));
    };
    EXPECT_TRUE(read(with(0, "\xAF")));
    EXPECT_FALSE(read(with(0, "\xB0"))) << "no status";
    EXPECT_FALSE(read(with(1, "\x91"))) << "no sync byte";
    EXPECT_FALSE(read(with(2, "\x50\x46"))) << "roll of 180 deg";
    EXPECT_FALSE(read(with(6, "\xE8\x03"))) << "heave of 10 m";
    EXPECT_FALSE(read(with(8, "\xA0\x8C"))) << "heading of 360 deg";
}

TEST(MotionFramer, FindsMessagesInNoiseWhateverThePieces) {
    const std::string stream =
        "\x90x:00" + line + "noise" + line + binary + binary + line + ":00FF\r\n" + binary;
    const std::string expected = line + line + binary + binary + line + binary;
    EXPECT_EQ(found_in(stream), expected);
    for (std::size_t piece = 1; piece < 30; ++piece) EXPECT_EQ(found_in(stream, piece), expected) << piece;
    EXPECT_EQ(found_in("\x90" + binary + binary), binary + binary) << "a stray byte takes none along";
    EXPECT_EQ(found_in(binary + "x" + binary), binary) << "another message or nothing follows";
}

RC_GTEST_PROP(Motion, MakesItsRoundTrip, ()) {
    Reading made{.format = *rc::gen::element(Format::tss1, Format::em3000)};
    const bool text = made.format == Format::tss1;
    const int most = text ? 9999 : 17999, heave = text ? 9999 : 999;
    made.roll = *rc::gen::inRange(-most, most) / 100.0;
    made.pitch = *rc::gen::inRange(-most, most) / 100.0;
    made.heave = *rc::gen::inRange(-heave, heave) / 100.0;
    if (text) {
        made.horizontal = *rc::gen::inRange(0, 256) * horizontal_step;
        made.vertical = *rc::gen::inRange(-32768, 32768) * vertical_step;
        made.status = static_cast<std::uint8_t>(*rc::gen::elementOf(std::string("uUgGhHfF")));
    } else {
        made.heading = *rc::gen::inRange(0, 36000) / 100.0;
        made.status = static_cast<std::uint8_t>(*rc::gen::inRange(0x90, 0xB0));
    }
    const auto again = read(write(made));
    RC_ASSERT(again.has_value());
    RC_ASSERT(again->roll == made.roll && again->pitch == made.pitch && again->heave == made.heave);
    RC_ASSERT(again->heading == made.heading && again->status == made.status);
    RC_ASSERT(std::abs(again->horizontal - made.horizontal) < 1e-9);
    RC_ASSERT(std::abs(again->vertical - made.vertical) < 1e-9);
}

TEST(MotionInspect, CoversEveryByteAndIsSure) {
    const std::string stream = "noise" + line + binary + "rest";
    const auto messages = decode(bytes_of(stream));
    ASSERT_EQ(messages.size(), 3u) << "what follows the ten bytes is no message, so they are none";
    EXPECT_EQ(messages[1].name, "Tss1");
    EXPECT_EQ(messages[2].offset + messages[2].size, stream.size());
    EXPECT_TRUE(recognise(bytes_of(stream)));
    EXPECT_TRUE(recognise(bytes_of(binary + binary)));
    EXPECT_FALSE(recognise(bytes_of(std::string(20, 'x') + binary))) << "ten bytes may be anybody's";
}

}  // namespace
}  // namespace echoloop::motion
