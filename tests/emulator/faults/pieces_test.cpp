// What each fault makes of messages, byte by byte, and that the events say exactly that.
#include "emulator/faults/pieces.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "emulator/contract/options.h"
#include "emulator/transport/uart.h"
#include "protocols/ping/codec.h"

namespace echoloop {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;

/// One device with faults, and one direction of its port "line".
class PiecesTest : public testing::Test {
  protected:
    void ask(const std::string& kind, const std::map<std::string, OptionValue>& given = {},
             Time length = Time::max()) {
        const FaultRow* row = find_fault(kind);
        ASSERT_NE(row, nullptr) << kind;
        Fault fault;
        fault.device = "sonar";
        fault.kind = row->kind;
        fault.length = length;
        for (const Option& parameter : row->parameters)
            fault.parameters[parameter.name] = parameter.default_value;
        for (const auto& [name, value] : given) {
            ASSERT_TRUE(fault.parameters.contains(name)) << name;
            fault.parameters[name] = value;
        }
        faults_.add(fault);
    }
    void add(const Bytes& bytes, Time now = {}) { pieces_.add(bytes, {}, now); }
    std::vector<Piece> all(Time now) {
        std::vector<Piece> taken;
        while (auto piece = pieces_.take(now)) taken.push_back(std::move(*piece));
        return taken;
    }
    static std::vector<Bytes> bytes_of(const std::vector<Piece>& pieces) {
        std::vector<Bytes> bytes;
        for (const Piece& piece : pieces)
            if (!piece.bytes.empty()) bytes.push_back(piece.bytes);
        return bytes;
    }
    static Bytes row(std::size_t size, std::uint8_t first = 0) {
        Bytes bytes(size);
        for (std::size_t i = 0; i < size; ++i) bytes[i] = static_cast<std::uint8_t>(first + i);
        return bytes;
    }

    Faults faults_{7, "test.yaml", nullptr};
    DeviceFaults& device_ = faults_.of("sonar");
    Pieces pieces_{device_, {"sonar", "line", Towards::to_driver}, {true, find_checksums("ping"), 115200}};
};

TEST_F(PiecesTest, WithoutFaultsBytesPassAsTheyAre) {
    add(row(5));
    const auto pieces = all({});
    ASSERT_EQ(pieces.size(), 1u);
    EXPECT_EQ(pieces[0].bytes, row(5));
    EXPECT_TRUE(pieces[0].events.empty());
    EXPECT_TRUE(pieces_.idle());
}

TEST_F(PiecesTest, APieceKeepsTheRateThatItsMessageLeavesAt) {
    ask("split", {{"rate", 1.0}, {"parts", std::int64_t{2}}, {"gap", 0.0}});
    ask("merge", {{"messages", std::int64_t{3}}});
    pieces_.add(row(3), {}, {}, 9600);
    pieces_.add(row(3), {}, {}, 9600);
    pieces_.add(row(3), {}, {}, 57600);
    std::map<double, std::size_t> bytes_at;
    for (const Piece& piece : all(1h)) bytes_at[piece.line_rate] += piece.bytes.size();
    EXPECT_EQ(bytes_at, (std::map<double, std::size_t>{{9600, 6}, {57600, 3}})) << "no write has two rates";
}

TEST_F(PiecesTest, AWrongRateIsAsWrongAsItIsFromTheRateOfTheMessage) {
    ask("baud_mismatch", {{"baud", 9600.0}});
    pieces_.add(row(3), {}, {}, 9600);
    pieces_.add(row(3), {}, {});
    const auto pieces = all({});
    ASSERT_EQ(pieces.size(), 2u);
    EXPECT_EQ(pieces[0].bytes, row(3)) << "the driver has set what it asked for";
    EXPECT_EQ(pieces[1].bytes, uart::as_heard(row(3), 9600, {115200}));
}

TEST_F(PiecesTest, LossTakesItsShareOfWholeMessagesAndSaysWhich) {
    ask("loss", {{"rate", 0.3}});
    std::size_t lost = 0;
    for (std::uint8_t i = 0; i < 200; ++i) {
        add(row(3, i));
        const auto pieces = all({});
        ASSERT_EQ(pieces.size(), 1u);
        if (pieces[0].events.empty()) {
            EXPECT_EQ(pieces[0].bytes, row(3, i));
            continue;
        }
        ++lost;
        EXPECT_TRUE(pieces[0].bytes.empty());
        EXPECT_EQ(pieces[0].events[0].message, i);
        EXPECT_EQ(pieces[0].events[0].length, 3u);
    }
    EXPECT_NEAR(static_cast<double>(lost), 60, 20);
}

TEST_F(PiecesTest, EveryFlippedBitHasItsEventAndNoOther) {
    ask("bit_flips", {{"rate", 0.01}});
    const Bytes clean(1000, 0xA5);
    std::size_t flipped = 0;
    for (int message = 0; message < 10; ++message) {
        add(clean);
        const auto pieces = all({});
        Bytes mended = pieces.at(0).bytes;
        for (const FaultEvent& event : pieces[0].events) {
            const auto bit = std::get<std::int64_t>(event.details.at(0).second);
            EXPECT_EQ(event.message, message);
            mended[event.offset] ^= static_cast<std::uint8_t>(1U << bit);
            ++flipped;
        }
        EXPECT_EQ(mended, clean);
    }
    EXPECT_NEAR(static_cast<double>(flipped), 80000 * 0.01, 100);
}

TEST_F(PiecesTest, ChanceIsTheSameForTheSameSeedAndIndependentOfOtherFaults) {
    ask("bit_flips", {{"rate", 0.01}});
    Faults again(7, "", nullptr), other(8, "", nullptr);
    for (Faults* faults : {&again, &other}) {
        Fault loss = device_.asked().front().fault;
        loss.kind = FaultKind::loss;
        loss.parameters = {{"rate", 0.0}};
        faults->add(loss);
        faults->add(device_.asked().front().fault);
    }
    const FaultPlace place{"sonar", "line", Towards::to_driver};
    Pieces same(again.of("sonar"), place, {}), different(other.of("sonar"), place, {});
    const Bytes clean(10'000, 0);
    add(clean);
    same.add(clean, {}, 5s);
    different.add(clean, {}, {});
    const Bytes first = all({}).at(0).bytes;
    EXPECT_EQ(first, same.take(5s)->bytes) << "at another time, beside another fault";
    EXPECT_NE(first, different.take({})->bytes) << "of another seed";
}

TEST_F(PiecesTest, WhatADriverSaysIsDamagedByItsPlaceInTheStream) {
    ask("bit_flips", {{"rate", 0.01}});
    device_.asked().front().fault.direction = Towards::both;
    const FaultPlace place{"sonar", "line", Towards::from_driver};
    Pieces at_once(device_, place, {}), in_parts(device_, place, {});
    at_once.add(Bytes(3000, 0), {}, {});
    Bytes joined;
    for (const std::size_t part : {1u, 999u, 1500u, 500u}) {
        in_parts.add(Bytes(part, 0), {}, {});
        const Bytes bytes = in_parts.take({})->bytes;
        joined.insert(joined.end(), bytes.begin(), bytes.end());
    }
    EXPECT_EQ(at_once.take({})->bytes, joined);
}

TEST_F(PiecesTest, TruncationLeavesABeginning) {
    ask("truncation", {{"rate", 1.0}});
    for (int i = 0; i < 50; ++i) {
        add(row(20));
        const Piece piece = all({}).at(0);
        ASSERT_GE(piece.bytes.size(), 1u);
        ASSERT_LT(piece.bytes.size(), 20u);
        EXPECT_EQ(piece.bytes, row(piece.bytes.size()));
        EXPECT_EQ(piece.events.at(0).offset, piece.bytes.size());
        EXPECT_EQ(piece.events.at(0).length, 20 - piece.bytes.size());
    }
}

TEST_F(PiecesTest, TruncationLeavesWhatItIsToldTo) {
    ask("truncation", {{"rate", 1.0}, {"keep", std::int64_t{4}}});
    add(row(20));
    add(row(3));
    EXPECT_THAT(bytes_of(all({})), ElementsAre(row(4), row(3)));
}

TEST_F(PiecesTest, AWrongChecksumIsAllThatIsWrong) {
    ask("wrong_checksum", {{"rate", 1.0}});
    const Bytes frame = ping::encode(ping::Message(ping::Ack{5}));
    Bytes two = frame;
    two.insert(two.end(), frame.begin(), frame.end());
    add(two);
    const Piece piece = all({}).at(0);
    ASSERT_EQ(piece.events.size(), 2u);
    std::vector<std::size_t> changed;
    for (std::size_t i = 0; i < two.size(); ++i)
        if (piece.bytes[i] != two[i]) changed.push_back(i);
    EXPECT_THAT(changed, ElementsAre(piece.events[0].offset, piece.events[1].offset));
    EXPECT_GE(changed[0], frame.size() - 2);
    EXPECT_LT(changed[0], frame.size());
    EXPECT_GE(changed[1], two.size() - 2);
}

TEST_F(PiecesTest, ABadNumberHasASignBeforeItsDecimals) {
    ask("bad_numbers", {{"rate", 1.0}});
    const auto spoiled = [&](const std::string& line) {
        add(Bytes(line.begin(), line.end()));
        const Bytes bytes = all({}).at(0).bytes;
        return std::string(bytes.begin(), bytes.end());
    };
    // Checksums by another program.
    EXPECT_EQ(spoiled("$SDDPT,1.4,*7C\r\n"), "$SDDPT,-1.-4,*7C\r\n");
    EXPECT_EQ(spoiled("$SDDPT,-1.4,*51\r\n"), "$SDDPT,-1.-4,*7C\r\n");
    EXPECT_EQ(spoiled("-0.52m\r\n"), "-0.-52m\r\n");
    EXPECT_EQ(spoiled("$SDDPT,,*57\r\n"), "$SDDPT,,*57\r\n") << "no number";
    const std::string one = spoiled("$SDDBT,98.42,f,30.00,M,16.40,F*01\r\n");
    EXPECT_EQ(std::ranges::count(one, '-'), 2) << one;
}

TEST_F(PiecesTest, AnotherBaudRateArrivesAsAUartMakesIt) {
    ask("baud_mismatch", {{"baud", 57600.0}});
    add({0x00, 0xFF});
    const Piece piece = all({}).at(0);
    // Half the rate: a start bit and eight zeros last 18 bits, which is a break; ones are one more low pulse.
    EXPECT_EQ(piece.bytes, uart::as_heard(Bytes{0x00, 0xFF}, 57600, {115200}));
    EXPECT_NE(piece.bytes, (Bytes{0x00, 0xFF}));
    EXPECT_EQ(piece.events.at(0).length, piece.bytes.size());
    faults_.clear_all();
    ask("baud_mismatch", {{"baud", 115200.0}});
    add(row(3));
    EXPECT_THAT(bytes_of(all({})), ElementsAre(row(3))) << "the same rate";
}

TEST_F(PiecesTest, CopiesFollowTheirOriginal) {
    ask("duplication", {{"rate", 1.0}, {"copies", std::int64_t{2}}});
    add(row(4));
    add(row(2));
    const auto pieces = all({});
    EXPECT_THAT(bytes_of(pieces), ElementsAre(row(4), row(4), row(4), row(2), row(2), row(2)));
    EXPECT_TRUE(pieces[0].events.empty());
    EXPECT_EQ(pieces[1].events.at(0).message, 0u);
    EXPECT_EQ(pieces[5].events.at(0).length, 2u);
}

TEST_F(PiecesTest, MergedMessagesAreOneWrite) {
    ask("merge", {{"messages", std::int64_t{3}}, {"within", 1.0}});
    for (std::uint8_t i = 0; i < 7; ++i) add(row(2, i));
    auto pieces = all({});
    EXPECT_THAT(bytes_of(pieces), ElementsAre(Bytes{0, 1, 1, 2, 2, 3}, Bytes{3, 4, 4, 5, 5, 6}));
    EXPECT_EQ(pieces[0].events.at(0).length, 6u);
    EXPECT_EQ(pieces_.next_due(), Time(1s)) << "the seventh waits for others no longer than a second";
    pieces = all(1s);
    EXPECT_THAT(bytes_of(pieces), ElementsAre(Bytes{6, 7}));
    EXPECT_TRUE(pieces[0].events.empty()) << "it was merged with nothing";
}

TEST_F(PiecesTest, AnOvertakenMessageComesBehindTheNextOnes) {
    ask("reordering", {{"rate", 1.0}, {"by", std::int64_t{2}}, {"within", 1.0}}, 1ms);
    add(row(1, 10), {});
    for (std::uint8_t i = 11; i <= 13; ++i) add(row(1, i), 2ms);
    const auto pieces = all(2ms);
    EXPECT_THAT(bytes_of(pieces), ElementsAre(Bytes{11}, Bytes{12}, Bytes{10}, Bytes{13}));
    EXPECT_EQ(std::get<std::int64_t>(pieces[2].events.at(0).details.at(0).second), 2);
}

TEST_F(PiecesTest, AMessageThatNothingFollowsComesInTheEnd) {
    ask("reordering", {{"rate", 1.0}, {"within", 1.0}}, 1ms);
    add(row(3), {});
    EXPECT_EQ(pieces_.next_due(), Time(1s));
    EXPECT_TRUE(all(999ms).empty());
    const auto pieces = all(1s);
    EXPECT_THAT(bytes_of(pieces), ElementsAre(row(3)));
    EXPECT_TRUE(pieces[0].events.empty()) << "nothing has overtaken it";
}

TEST_F(PiecesTest, PartsComeOneAfterTheOtherAndMakeTheWhole) {
    ask("split", {{"parts", std::int64_t{4}}, {"gap", 0.01}});
    add(row(100));
    EXPECT_EQ(all({}).size(), 1u) << "the first at once";
    const auto rest = all(30ms);
    ASSERT_GE(rest.size(), 1u);
    std::size_t sum = 0;
    for (const Piece& part : rest) {
        EXPECT_EQ(part.events.at(0).length, part.bytes.size());
        sum += part.bytes.size();
    }
    EXPECT_EQ(rest.back().bytes.back(), 99);
    EXPECT_EQ(rest.front().bytes.front() + sum, 100u);
}

TEST_F(PiecesTest, EventsKeepTheirBytesWhenPartsAreCut) {
    ask("bit_flips", {{"rate", 0.02}});
    ask("split", {{"parts", std::int64_t{5}}, {"gap", 0.0}});
    add(Bytes(500, 0));
    Bytes joined;
    std::set<std::size_t> said, seen;
    for (const Piece& part : all({})) {
        for (const FaultEvent& event : part.events)
            if (event.kind == FaultKind::bit_flips) said.insert(joined.size() + event.offset);
        joined.insert(joined.end(), part.bytes.begin(), part.bytes.end());
    }
    for (std::size_t i = 0; i < joined.size(); ++i)
        if (joined[i] != 0) seen.insert(i);
    EXPECT_EQ(said, seen);
    EXPECT_EQ(joined.size(), 500u);
    EXPECT_GT(seen.size(), 20u);
}

TEST_F(PiecesTest, LatencyAndJitterDelayButDoNotReorder) {
    ask("latency", {{"delay", 0.1}});
    ask("jitter", {{"delay", 0.05}});
    Time last{};
    for (std::uint8_t i = 0; i < 50; ++i) {
        const Time now = i * 1ms;
        add(row(1, i), now);
    }
    for (std::uint8_t i = 0; i < 50; ++i) {
        const Time due = *pieces_.next_due();
        EXPECT_GE(due, last);
        EXPECT_GE(due, i * 1ms + 100ms);
        EXPECT_LE(due, 49ms + 150ms);
        last = due;
        EXPECT_EQ(pieces_.take(due)->bytes, row(1, i));
    }
}

TEST_F(PiecesTest, ANarrowLineCarriesWhatItCan) {
    ask("bandwidth", {{"bits_per_second", 8000.0}});
    add(row(100));
    add(row(100));
    std::size_t bytes = 0;
    for (int ms = 1; ms <= 200; ++ms) {
        for (const Piece& piece : all(ms * 1ms)) bytes += piece.bytes.size();
        EXPECT_LE(bytes, static_cast<std::size_t>(ms));
        EXPECT_GE(bytes + 10, static_cast<std::size_t>(ms));
    }
    EXPECT_EQ(bytes, 200u);
}

TEST_F(PiecesTest, StaleMessagesComeAllAtOnceAtTheEnd) {
    ask("stale_burst", {}, 2s);
    add(row(1, 1), 500ms);
    add(row(1, 2), 1s);
    EXPECT_TRUE(all(1999ms).empty());
    EXPECT_EQ(all(2s).size(), 2u);
}

TEST_F(PiecesTest, ClearedFaultsLetGoWhatWaits) {
    ask("latency", {{"delay", 60.0}});
    add(row(2));
    faults_.clear_all();
    pieces_.hurry(1s);
    EXPECT_THAT(bytes_of(all(1s)), ElementsAre(row(2)));
}

TEST_F(PiecesTest, FaultsOfOtherPortsAndDirectionsAreNotMadeHere) {
    ask("loss", {{"rate", 1.0}});
    device_.asked().front().fault.port = "aux";
    add(row(2));
    device_.asked().front().fault.port = "line";
    device_.asked().front().fault.direction = Towards::from_driver;
    add(row(3));
    EXPECT_THAT(bytes_of(all({})), ElementsAre(row(2), row(3)));
}

}  // namespace
}  // namespace echoloop
