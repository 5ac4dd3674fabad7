// The messages of an ARIS: golden bytes, truncations, round trips, noise on the stream of commands, and the
// order of samples.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <random>
#include <set>

#include "protocols/aris/beams.h"
#include "protocols/aris/framer.h"
#include "protocols/aris/layouts.h"
#include "tests/protocols/data.h"
#include "tests/protocols/fill.h"

namespace echoloop::aris {
namespace {

wire::Bytes golden(const char* name) {
    for (const auto& path : hex_files("aris"))
        if (path.stem() == name) return read_hex_file(path).bytes;
    ADD_FAILURE() << name;
    return {};
}

struct Source {
    template <class T>
    T number() {
        return *rc::gen::arbitrary<T>();
    }
    std::size_t size() { return *rc::gen::inRange<std::size_t>(0, 40); }
};

TEST(ArisBeacon, OfASonarThatIsFreeSaysSoWithItsZeros) {
    Availability beacon;
    beacon.serial = 1001;
    EXPECT_EQ(to_hex(encode(beacon)), to_hex(from_hex("08e907 1000 2000")));
}

TEST(ArisProtobuf, SkipsWhatItDoesNotKnowAndTakesTheLastOfTwo) {
    // Field 99 of each kind of wire, then a serial number twice.
    const auto beacon = parse_availability(from_hex(
        "98 06 96 01  9d 06 01 02 03 04  99 06 01 02 03 04 05 06 07 08  9a 06 02 aa bb  08 05 08 07"));
    ASSERT_TRUE(beacon);
    EXPECT_EQ(beacon->serial, 7U);
}

TEST(ArisProtobuf, RefusesWhatIsNone) {
    for (const char* bytes :
         {"08", "0a", "1a 05 08", "45 00 00", "0b", "00 01", "08 ff ff ff ff ff ff ff ff ff ff 01",
          "1a 02 08 ff", "2a ff ff ff ff 0f", "2a ff ff ff ff ff ff ff ff ff 01 00"})
        EXPECT_FALSE(parse_availability(from_hex(bytes))) << bytes;
}

TEST(ArisCommand, CutShortIsNone) {
    for (const char* name : {"set_acoustics", "set_receiver", "set_date_time", "fresh_water", "ping"}) {
        const wire::Bytes whole = golden(name);
        for (std::size_t size = 0; size < whole.size(); ++size) {
            Framer framer;
            framer.feed(wire::ByteView(whole).first(size));
            EXPECT_FALSE(framer.next()) << name << ' ' << size;
            EXPECT_EQ(framer.skipped_bytes(), 0U) << name << ' ' << size << ": the rest may come";
            framer.feed(wire::ByteView(whole).subspan(size));
            EXPECT_TRUE(framer.next()) << name << ' ' << size;
        }
    }
}

TEST(ArisCommand, WithoutThePartOfItsTypeIsNone) {
    EXPECT_FALSE(parse_command(from_hex("08 04")));
    EXPECT_FALSE(parse_command(from_hex("08 04 2a 00"))) << "the part of another type";
    EXPECT_FALSE(parse_command(from_hex("08 10"))) << "power down is the maker's";
    EXPECT_TRUE(parse_command(from_hex("08 0e")));
}

TEST(ArisFrameHeader, StandsWhereTheNotesSay) {
    const wire::Bytes part = golden("frame_first");
    // The header begins behind two numbers, a key and a length.
    const wire::ByteView header = wire::ByteView(part).subspan(9, header_bytes);
    const auto read = parse_frame_header(header);
    ASSERT_TRUE(read);
    EXPECT_EQ(read->samples, 1014U);
    EXPECT_EQ(to_hex(encode(*read)), to_hex(header));
    for (std::size_t size = 0; size < header_bytes; ++size)
        EXPECT_FALSE(parse_frame_header(header.first(size)));
    wire::Bytes padded(header.begin(), header.end());
    padded.resize(1024);
    EXPECT_EQ(parse_frame_header(padded), read) << "as in files";
}

RC_GTEST_PROP(ArisRoundTrip, OfAFrameHeader, ()) {
    Source source;
    FrameHeader header;
    wire::Filler<Source>(source).message(header);
    RC_ASSERT(parse_frame_header(encode(header)) == header);
}

RC_GTEST_PROP(ArisRoundTrip, OfAPartAndABeacon,
              (std::uint32_t a, std::uint32_t b, std::vector<std::uint8_t> data, std::string text,
               bool held)) {
    const FramePart part{a, b, data, data, b, a};
    RC_ASSERT(parse_frame_part(encode(part)) == part);
    Availability beacon;
    beacon.serial = a;
    beacon.version = {a, 0, b};
    beacon.capabilities = {{text, "", "KA"}};
    beacon.cpu_temperature = static_cast<float>(b) / 16;
    beacon.diver_held = held;
    RC_ASSERT(parse_availability(encode(beacon)) == beacon);
}

RC_GTEST_PROP(ArisRoundTrip, OfCommands, (std::uint32_t a, std::uint32_t b, std::string text, bool on)) {
    Command command;
    command.type = static_cast<std::uint32_t>(CommandType::set_acoustics);
    command.acoustics = {a, 1.5F, b, a, b, a, b, a, on, b, !on, -0.0F};
    command.receiver = {a, text.substr(0, 40)};
    command.stream = {{{on, b}}, a};
    command.focus = {a, 2.5F};
    command.velocity = {b, -1};
    command.ping.emplace();
    Framer framer;
    framer.feed(encode(command));
    const auto frame = framer.next();
    RC_ASSERT(frame.has_value());
    RC_ASSERT(*frame == command);
}

TEST(ArisFramer, FindsTheNextCommandBehindNoise) {
    std::mt19937 random(3);
    const wire::Bytes whole = golden("set_acoustics"), ping = golden("ping");
    for (int round = 0; round < 500; ++round) {
        Framer framer;
        wire::Bytes noise = whole;
        for (std::uint8_t& byte : noise)
            if (random() % 20 == 0) byte ^= static_cast<std::uint8_t>(1 + random() % 255);
        framer.feed(noise);
        while (framer.next()) {
        }
        framer.feed(ping);
        bool found = false;
        while (const auto frame = framer.next())
            found = found || frame->type == static_cast<std::uint32_t>(CommandType::ping);
        EXPECT_TRUE(found) << "round " << round;
    }
}

TEST(ArisFramer, KeepsNoMoreThanACommand) {
    Framer framer;
    for (int i = 0; i < 1000; ++i) {
        framer.feed(from_hex("000000ff"));
        while (framer.next()) {
        }
        ASSERT_LE(framer.pending_bytes(), length_bytes + longest_command);
    }
}

TEST(ArisBeams, HaveTheOuterAnglesOfTheNotesAndAscend) {
    struct Row {
        std::size_t beams;
        bool telephoto;
        double first, last;
    };
    for (const Row& row :
         {Row{48, false, -13.57, 13.57}, Row{48, true, -7.34, 7.34}, Row{96, false, -13.75, 13.88},
          Row{96, true, -7.42, 7.42}, Row{64, false, -14.89, 14.89}, Row{128, false, -15.01, 15.02}}) {
        const auto angles = centre_angles(row.beams, row.telephoto);
        ASSERT_EQ(angles.size(), row.beams);
        EXPECT_NEAR(angles.front(), row.first, 0.006);
        EXPECT_NEAR(angles.back(), row.last, 0.006);
        EXPECT_TRUE(std::is_sorted(angles.begin(), angles.end(), std::less_equal<>()));
    }
    EXPECT_TRUE(centre_angles(47, false).empty());
}

TEST(ArisBeams, OfAllPingsAndChannelsAreAllBeams) {
    for (const std::uint32_t number : {1U, 3U, 6U, 9U}) {
        const PingMode& mode = *find_ping_mode(number);
        EXPECT_EQ(mode.beams, mode.pings * channels);
        std::set<std::size_t> beams;
        for (std::size_t ping = 0; ping < mode.pings; ++ping)
            for (const std::size_t at : channel_map) beams.insert(ping + at * mode.pings);
        EXPECT_EQ(beams.size(), mode.beams);
        EXPECT_EQ(*beams.rbegin(), mode.beams - 1);
    }
    EXPECT_EQ(find_ping_mode(2), nullptr);
}

}  // namespace
}  // namespace echoloop::aris
