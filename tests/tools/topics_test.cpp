// Pictures of several kinds that one sonar makes have topics of their own in a bag.
#include "tools/bag/topics.h"

#include <gtest/gtest.h>

#include <map>

namespace echoloop::bag {
namespace {

/// What a sonar's pings of these frequencies are offered as: the topic of each ping's levels, and messages by
/// topic.
struct Offered {
    std::vector<std::string> raw;
    std::map<std::string, int> pictures;
};

Offered offered(const std::string& family, const std::vector<double>& frequencies) {
    Offered all;
    Topics topics({.families = {{"head", family}}}, [&](const Topics::Offer& offer, const Topics::Make&) {
        if (offer.topic.ends_with("/raw")) all.raw.push_back(offer.topic);
        if (offer.topic.ends_with("/picture")) ++all.pictures[offer.topic];
    });
    Ping ping;
    ping.device = "head";
    for (const double frequency : frequencies) {
        ping.unix_time = 1e9 + static_cast<double>(++ping.number);
        Shot& shot = ping.echogram.shot;
        shot.bearings = {0};
        shot.bins = 100;
        shot.bin_interval = 1e-4;
        shot.frequency = frequency;
        ping.echogram.sound_speed = 1500;
        ping.echogram.values.assign(shot.bins, 1e6F);
        topics.ping(ping);
    }
    return all;
}

TEST(TopicsOfPings, StayWhereADriverSetsAnotherFrequency) {
    const Offered all = offered("seanet", {325e3, 325e3, 675e3, 675e3, 675e3, 325e3, 325e3});
    EXPECT_EQ(all.raw, std::vector<std::string>(7, "/head/raw"));
    EXPECT_EQ(all.pictures, (std::map<std::string, int>{{"/head/picture", 7}}));
}

TEST(TopicsOfPings, AreOfEachFrequencyWhereTheyComeInTurn) {
    const Offered all = offered("seanet", {325e3, 675e3, 325e3, 675e3, 325e3, 675e3});
    EXPECT_EQ(all.raw, (std::vector<std::string>{"/head/raw", "/head/raw", "/head/at_325_kHz/raw",
                                                 "/head/at_675_kHz/raw", "/head/at_325_kHz/raw",
                                                 "/head/at_675_kHz/raw"}));
    EXPECT_EQ(all.pictures.size(), 3U);
}

TEST(TopicsOfPings, AreOfEachFrequencyOfAnEdgetechFromTheFirstOn) {
    const Offered all = offered("edgetech", {410e3, 410e3, 410e3, 120e3});
    EXPECT_EQ(all.raw, (std::vector<std::string>{"/head/at_410_kHz/raw", "/head/at_410_kHz/raw",
                                                 "/head/at_410_kHz/raw", "/head/at_120_kHz/raw"}));
}

/// A SeaKing's line, as far as a picture needs it.
inspect::Message line_of(double control, double transmitter) {
    const auto field = [](const char* name, double value) {
        return inspect::Field{.name = name, .text = "", .number = value};
    };
    inspect::Message message{.name = "HeadData"};
    message.fields = {field("head_status", 0x10), field("hd_ctrl", control), field("tx_n", transmitter),
                      field("ad_low", 0),         field("ad_span", 255),     field("bearing", 3200),
                      field("ad_interval", 40)};
    message.fields.push_back({.name = "bins", .text = "", .numbers = std::vector<double>(50, 100)});
    return message;
}

TEST(SaidPictures, OfASeakingInPingPongAreNamedByTheFrequency) {
    const double low = 0x02999999, high = 0x05666666;
    constexpr double ping_pong = 0x800, adc8on = 1;
    const auto maker = said::maker_of("seanet");
    EXPECT_EQ(maker->take(line_of(adc8on, low), {}, true)->name, "HeadData");
    EXPECT_EQ(maker->take(line_of(adc8on + ping_pong, low), {}, true)->name, "HeadData 325 kHz");
    EXPECT_EQ(maker->take(line_of(adc8on + ping_pong, high), {}, true)->name, "HeadData 675 kHz");
}

}  // namespace
}  // namespace echoloop::bag
