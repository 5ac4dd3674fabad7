// Large pictures of what is on no screen: seldom, but whole, and of each frequency.
#include "tools/view/ticker.h"

#include <gtest/gtest.h>

#include <set>

#include "protocols/edgetech/codec.h"

namespace echoloop::view {
namespace {

constexpr std::size_t samples = 6000;  // of a side: two are a large picture
constexpr double period = 0.06;        // s, between pings
constexpr std::uint8_t sides[] = {0, 1};

/// What an EdgeTech says of one side.
Passed side_of(std::uint8_t subsystem, std::uint8_t channel, std::uint32_t ping, double time) {
    edgetech::SonarData data;
    data.ping = ping;
    data.interval = 10'000;
    data.sound_speed = 1500;
    data.data.assign(2 * samples, 1);
    edgetech::set_sample_count(data, samples);
    edgetech::Header header;
    header.subsystem = subsystem;
    header.channel = channel;
    Passed passed;
    passed.device = "side", passed.port = "data";
    passed.sent = true;
    passed.unix_time = time;
    passed.bytes = edgetech::encode({header, data});
    passed.size = passed.bytes.size();
    return passed;
}

struct Seen {
    std::set<std::string> names;
    std::size_t pictures = 0, empty_sides = 0;
};

/// Of `pings` of each frequency in turn, ten times a second.
Seen seen(bool shown, double seconds, std::vector<std::uint8_t> subsystems) {
    Ticker ticker(std::map<std::string, std::string>{{"side", "edgetech"}});
    Seen all;
    std::vector<Passed> waiting;
    double told = 0;
    std::uint32_t ping = 0;
    for (double t = 0; t < seconds; t += period, ++ping) {
        const std::uint8_t subsystem = subsystems[ping % subsystems.size()];
        for (const std::uint8_t channel : sides)
            waiting.push_back(side_of(subsystem, channel, ping, 1e9 + t + 1e-4 * channel));
        if (t < told + 0.1) continue;
        told = t;
        for (const std::string& one : ticker
                                          .take(std::exchange(waiting, {}), {}, 0, false,
                                                [shown](const std::string&) { return shown; })
                                          .pictures) {
            std::uint32_t length = 0;
            for (std::size_t i = 4; i-- > 0;) length = length << 8 | static_cast<std::uint8_t>(one[i]);
            const auto head = nlohmann::json::parse(one.substr(4, length));
            all.names.insert(head["name"]);
            ++all.pictures;
            const std::size_t bins = head["bins"];
            for (const std::size_t side : {0, 1})
                all.empty_sides +=
                    one.find_first_not_of('\0', 4 + length + side * bins) >= 4 + length + (side + 1) * bins;
        }
    }
    return all;
}

TEST(ATicker, ShowsBothFrequenciesWholeOnceASecondWhereTheyAreOnNoScreen) {
    const Seen found = seen(false, 20, {edgetech::low_frequency, edgetech::high_frequency});
    EXPECT_EQ(found.names, (std::set<std::string>{"SonarData low", "SonarData high"}));
    EXPECT_GE(found.pictures, 2U * 15);
    EXPECT_LE(found.pictures, 2U * 21);
    EXPECT_EQ(found.empty_sides, 0U);
}

TEST(ATicker, ShowsOneFrequencyOnceASecond) {
    const Seen found = seen(false, 20, {edgetech::high_frequency});
    EXPECT_GE(found.pictures, 15U);
    EXPECT_LE(found.pictures, 21U);
    EXPECT_EQ(found.empty_sides, 0U);
}

TEST(ATicker, ShowsEachOfAScreen) {
    const Seen found = seen(true, 5, {edgetech::low_frequency, edgetech::high_frequency});
    EXPECT_EQ(found.names.size(), 2U);
    EXPECT_GE(found.pictures, 60U);
    EXPECT_EQ(found.empty_sides, 0U);
}

/// A viewer that comes between the two sides of a ping, and each second again.
TEST(ATicker, ShowsNoHalfOfAPingWhoseOtherHalfItSkipped) {
    Ticker ticker(std::map<std::string, std::string>{{"side", "edgetech"}});
    std::vector<Passed> all;
    for (std::uint32_t ping = 0; ping < 200; ++ping)
        for (const std::uint8_t channel : sides)
            all.push_back(
                side_of(edgetech::high_frequency, channel, ping, 1e9 + 0.0503 * (2 * ping + channel)));
    std::size_t pictures = 0;
    for (const Passed& one : all)
        for (const std::string& picture :
             ticker.take({one}, {}, 0, false, [](const auto&) { return false; }).pictures) {
            const std::size_t tail = picture.find('}') + 1;
            const std::size_t bins = (picture.size() - tail) / 2;
            for (const std::size_t side : {0, 1})
                EXPECT_LT(picture.find_first_not_of('\0', tail + side * bins), tail + (side + 1) * bins);
            ++pictures;
        }
    EXPECT_GE(pictures, 12U);
}

}  // namespace
}  // namespace echoloop::view
