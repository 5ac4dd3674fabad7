#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "emulator/replay/answering.h"
#include "emulator/replay/stepped.h"
#include "emulator/replay/timed.h"
#include "tests/emulator/replay/spoken.h"

namespace echoloop::replay {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::Pair;

std::unique_ptr<Spoken> spoken(std::vector<Said> all) { return std::make_unique<Spoken>(std::move(all)); }
const std::vector<DriverPort> text_port{{nullptr, true}};

TEST(Timed, BeginsWithTheDriverAndKeepsTheGaps) {
    TimedPlayer player(spoken({driver(0, "go"), device(30, "a"), device(80, "b")}), 1, false);
    EXPECT_FALSE(player.due());
    player.arrived(ms(1000));
    EXPECT_FALSE(player.ended());
    EXPECT_THAT(said_until(player, 1e6), ElementsAre("1030 a", "1080 b"));
    EXPECT_TRUE(player.ended());
}

TEST(Timed, AnotherDriverDoesNotBeginItAnew) {
    TimedPlayer player(spoken({device(0, "a"), device(80, "b")}), 2, false);
    player.arrived(ms(0));
    player.arrived(ms(10));
    EXPECT_THAT(said_until(player, 1e6), ElementsAre("0 a", "40 b"));
}

TEST(Timed, LapsFollowAfterTheLastGap) {
    TimedPlayer player(spoken({device(10, "a"), device(80, "b")}), 1, true);
    player.arrived(ms(0));
    EXPECT_THAT(said_until(player, 300), ElementsAre("10 a", "80 b", "150 a", "220 b", "290 a"));
    EXPECT_EQ(player.counts().laps, 2U);
}

TEST(Timed, ALapOfACaptureThatTakesNoTimeTakesAMillisecond) {
    TimedPlayer player(spoken({device(5, "a"), device(5, "b")}), 1, true);
    player.arrived(ms(0));
    EXPECT_THAT(said_until(player, 7), ElementsAre("5 a", "5 b", "6 a", "6 b", "7 a", "7 b"));
}

TEST(Timed, NothingToSayEndsEvenInALoop) {
    TimedPlayer player(spoken({driver(0, "go")}), 1, true);
    player.arrived(ms(0));
    EXPECT_TRUE(player.ended());
}

TEST(Stepped, OneMessageForEachRequestAndEachLine) {
    SteppedPlayer player(spoken({device(0, "a"), device(500, "b"), device(501, "c")}), text_port, false);
    player.arrived(ms(0));
    EXPECT_THAT(said_until(player, 1e6), IsEmpty());
    player.heard(0, bytes_of("ask"), ms(7));
    EXPECT_THAT(said_until(player, 1e6), ElementsAre("7 a"));
    player.stepped(ms(9));
    player.stepped(ms(9));
    EXPECT_THAT(said_until(player, 1e6), ElementsAre("9 b", "9 c"));
    EXPECT_TRUE(player.ended());
}

/// Three kinds of requests, each answered once or twice.
std::vector<Said> conversation() {
    return {driver(0, "get range"), device(40, "range 1"),    driver(100, "get gain"), device(120, "gain 1"),
            device(130, "gain 2"),  driver(200, "get range"), device(260, "range 2")};
}

TEST(Answering, InAnotherOrderEachAtItsOwnDelayAndRoundAgain) {
    Spoken source(conversation());
    AnsweringPlayer player(source, text_port, 1);
    player.arrived(ms(0));
    EXPECT_THAT(said_until(player, 1e6), IsEmpty()) << "nothing is said unasked";
    player.heard(0, bytes_of("get gain"), ms(1000));
    player.heard(0, bytes_of("get range"), ms(1005));
    EXPECT_THAT(said_until(player, 1e6), ElementsAre("1020 gain 1", "1030 gain 2", "1045 range 1"));
    player.heard(0, bytes_of("get range"), ms(2000));
    EXPECT_THAT(said_until(player, 1e6), ElementsAre("2060 range 2"));
    player.heard(0, bytes_of("get range"), ms(3000));
    EXPECT_THAT(said_until(player, 1e6), ElementsAre("3040 range 1"));
    EXPECT_EQ(player.counts().answered, 4U);
}

TEST(Answering, WhatTheCaptureDoesNotHoldIsCounted) {
    Spoken source(conversation());
    AnsweringPlayer player(source, text_port, 1);
    player.heard(0, bytes_of("get voltage"), ms(0));
    EXPECT_THAT(said_until(player, 1e6), IsEmpty());
    EXPECT_EQ(player.counts().requests, 1U);
    EXPECT_EQ(player.counts().answered, 0U);
    EXPECT_THAT(player.counts().unanswered, ElementsAre(Pair("bytes of no known message", 1)));
}

TEST(Answering, NumbersNeedNotBeTheSame) {
    Spoken source(
        {driver(0, "ping 10 750"), device(5, "ten"), driver(100, "ping 20 750"), device(105, "twenty")});
    AnsweringPlayer player(source, text_port, 1);
    for (const auto& [asked, answered] : {std::pair{"ping 20 750", "5 twenty"},
                                          {"ping 19 740", "5 twenty"},
                                          {"ping 10 750", "5 ten"},
                                          {"ping 11 750", "5 ten"}}) {
        player.heard(0, bytes_of(asked), ms(0));
        EXPECT_THAT(said_until(player, 1e6), ElementsAre(answered)) << asked;
    }
}

TEST(Answering, WhatIsSaidUnaskedGoesOnAtItsGapsBesideTheAnswers) {
    std::vector<Said> all{device(0, "alive 1", "alive"), device(1000, "alive 2", "alive"),
                          driver(1500, "get"), device(1600, "got"), device(2000, "alive 3", "alive")};
    Spoken source(std::move(all));
    AnsweringPlayer player(source, text_port, 1);
    player.arrived(ms(0));
    player.heard(0, bytes_of("get"), ms(300));
    EXPECT_THAT(said_until(player, 3000),
                ElementsAre("0 alive 1", "400 got", "1000 alive 2", "2000 alive 3", "3000 alive 1"));
}

/// A stream that a request begins and another one ends.
std::vector<Said> streamed() {
    std::vector<Said> all{driver(0, "start"), device(20, "ack", "ack")};
    for (int i = 0; i < 6; ++i) all.push_back(device(100 + 100 * i, "data " + std::to_string(i), "data"));
    all.push_back(driver(650, "stop"));
    all.push_back(device(660, "ack", "ack"));
    all.push_back(driver(5000, "get"));
    all.push_back(device(5010, "got", "got"));
    return all;
}

TEST(Answering, AStreamBeginsAndEndsWithItsRequestsOnly) {
    Spoken source(streamed());
    AnsweringPlayer player(source, text_port, 1);
    player.arrived(ms(0));
    EXPECT_THAT(said_until(player, 900), IsEmpty());
    player.heard(0, bytes_of("start"), ms(1000));
    EXPECT_THAT(said_until(player, 1250), ElementsAre("1020 ack", "1100 data 0", "1200 data 1"));
    player.heard(0, bytes_of("get"), ms(1255));
    EXPECT_THAT(said_until(player, 1750), ElementsAre("1265 got", "1300 data 2", "1400 data 3", "1500 data 4",
                                                      "1600 data 5", "1700 data 0"));
    player.heard(0, bytes_of("stop"), ms(1755));
    EXPECT_THAT(said_until(player, 1e5), ElementsAre("1765 ack"));
}

TEST(Answering, PartsOfAPingComeTogetherInEveryLap) {
    std::vector<Said> all{driver(0, "start")};
    for (int ping = 1; ping <= 3; ++ping)
        for (int part = 0; part < 3; ++part)
            all.push_back(
                device(100 * ping + part, std::to_string(ping) + "." + std::to_string(part), "part"));
    all.push_back(driver(310, "stop"));
    all.push_back(driver(60'000, "start"));
    all.push_back(device(60'100, "late", "part"));
    Spoken source(std::move(all));
    AnsweringPlayer player(source, text_port, 1);
    player.heard(0, bytes_of("start"), ms(0));
    EXPECT_THAT(said_until(player, 410),
                ElementsAre("100 1.0", "101 1.1", "102 1.2", "200 2.0", "201 2.1", "202 2.2", "300 3.0",
                            "301 3.1", "302 3.2", "400 1.0", "401 1.1", "402 1.2"));
}

TEST(Answering, AnotherDriverBeginsWithoutTheStreamOfTheLastOne) {
    Spoken source(streamed());
    AnsweringPlayer player(source, text_port, 1);
    player.arrived(ms(0));
    player.heard(0, bytes_of("start"), ms(0));
    player.reconnected(0);
    EXPECT_THAT(said_until(player, 1e5), IsEmpty());
}

TEST(Answering, FasterThanTheCapture) {
    Spoken source(conversation());
    AnsweringPlayer player(source, text_port, 4);
    player.heard(0, bytes_of("get range"), ms(100));
    EXPECT_THAT(said_until(player, 1e6), ElementsAre("110 range 1"));
}

TEST(Store, GivesBackWhatLiesInMemoryAndWhatLiesInTheFile) {
    Store store(100);
    std::vector<std::pair<Store::Handle, Bytes>> kept;
    for (std::size_t size : {40U, 0U, 50U, 60U, 5U, 3000U}) {
        const Bytes bytes(size, static_cast<std::uint8_t>(size));
        kept.emplace_back(store.keep(bytes), bytes);
    }
    for (const auto& [handle, bytes] : kept) EXPECT_EQ(store.read(handle), bytes);
}

}  // namespace
}  // namespace echoloop::replay
