// Messages of several datagrams: however a driver quickens the pings, the parts of one leave whole, in order
// and with nothing of another one between them, as a reader that joins them expects. Times are those at which
// the session hands datagrams over.
#include <gtest/gtest.h>

#include <map>

#include "protocols/kmall/codec.h"
#include "tests/emulator/devices/r2sonic_bench.h"

namespace echoloop::test {
namespace {

/// What leaves a device, in the order of the session: by `not_before`, equal times as they came.
class Wire {
  public:
    explicit Wire(Bench& bench) : bench_(bench) { take(); }

    void run_to(Time end) {
        while (true) {
            const Time ping_due = bench_.ping ? bench_.ping->due : Time::max();
            bench_.run_to(std::min({bench_.wake, ping_due, end}));
            take();
            if (bench_.now >= end) return;
        }
    }
    void say(ByteView bytes, std::size_t port = 0, Address from = {}) {
        bench_.say(bytes, port, from);
        take();
    }
    /// The next ping's echoes are heard.
    void hear() {
        const std::size_t heard = bench_.shots.size();
        while (bench_.shots.size() == heard)
            run_to(std::min(bench_.wake, bench_.ping ? bench_.ping->due : Time::max()));
    }
    /// Datagrams to one place, by its port.
    std::map<std::uint16_t, std::vector<Bytes>> datagrams() const {
        std::map<std::uint16_t, std::vector<Bytes>> of_places;
        for (const auto& [time, send] : sends_) of_places[send.to.port].push_back(send.bytes);
        return of_places;
    }
    bool waits() const { return !sends_.empty() && sends_.rbegin()->first > bench_.now; }

  private:
    void take() {
        for (Send& send : bench_.sent())
            sends_.emplace(std::max(send.not_before, bench_.now), std::move(send));
    }

    Bench& bench_;
    std::multimap<Time, Send> sends_;
};

/// The numbers of the pings whose parts a reader gets whole: it begins anew with each head, and drops parts
/// of another ping. Offsets of M0 and M1.
std::vector<std::uint32_t> whole_pings(const std::vector<Bytes>& datagrams, bool image) {
    std::vector<std::uint32_t> whole;
    std::uint32_t ping = 0, next = 0;
    for (const Bytes& b : datagrams) {
        if (name(b, 12, 2) == "H0") {
            ping = u32(b, 12 + 36), next = 0;
            continue;
        }
        if (u32(b, 12 + 4) != ping || u32(b, 12 + (image ? 20 : 16)) != next) continue;
        next += u16(b, 12 + (image ? 24 : 20));
        if (next == u32(b, 12 + (image ? 16 : 12))) whole.push_back(ping);
    }
    return whole;
}

TEST(Parts, OfASonicsPingsDoNotMixWhenTheRangeIsShortened) {
    Bench bench = head({{"range", 300.0},
                        {"image_height", std::int64_t{1000}},
                        {"snippets", true},
                        {"water_column", std::string("magnitude")},
                        {"datagram_gap", 1e-3}});
    bench.echo_bin = 1500, bench.echo_power = 1e14F;
    Wire wire(bench);
    wire.hear();
    wire.say(command("RNG0", 5.0F));
    ASSERT_TRUE(wire.waits()) << "else it shows nothing";
    for (int ping = 2; ping <= 4; ++ping) wire.hear();
    const std::vector<std::uint32_t> all{1, 2, 3, 4};
    const auto datagrams = wire.datagrams();
    EXPECT_EQ(whole_pings(datagrams.at(gui.port + 3), true), all) << "images";
    EXPECT_EQ(whole_pings(datagrams.at(gui.port + 5), false), all) << "water columns";
    std::uint32_t last = 0;
    for (const Bytes& b : datagrams.at(gui.port + 6)) {
        const std::uint32_t ping = u32(b, 12 + (name(b, 12, 2) == "H0" ? 36 : 4));
        EXPECT_GE(ping, last) << "snippets";
        last = ping;
    }
}

/// Words in little-endian order, as 7k and KMALL have them.
std::uint32_t word(const Bytes& b, std::size_t at) {
    return b.at(at) | b.at(at + 1) << 8 | b.at(at + 2) << 16 | std::uint32_t{b.at(at + 3)} << 24;
}

/// 7500 in one packet, its parameters words.
Bytes control_7k(std::uint32_t number, const std::vector<std::uint32_t>& parameters) {
    Bytes b(36 + 64 + 24);
    const auto put = [&b](std::size_t at, std::uint32_t value, std::size_t size = 4) {
        if (b.size() < at + size) b.resize(at + size);
        for (std::size_t i = 0; i < size; ++i) b[at + i] = static_cast<std::uint8_t>(value >> 8 * i);
    };
    for (const std::uint32_t parameter : parameters) put(b.size(), parameter);
    const auto size = static_cast<std::uint32_t>(b.size() + 4 - 36);
    put(0, 5, 2), put(2, 36, 2), put(4, 1), put(8, 1, 2), put(10, 9, 2), put(12, size + 36), put(16, size);
    put(36, 5, 2), put(38, 60, 2), put(40, 0xFFFF), put(44, size), put(66, 1, 2), put(68, 7500);
    put(72, 7125), put(84, 1, 2), put(100, number), put(104, 77);
    std::uint32_t sum = 0;
    for (std::size_t i = 36; i < b.size(); ++i) sum += b[i];
    put(b.size(), sum);
    return b;
}

TEST(Parts, OfA7kRecordLetNoAnswerBetweenThem) {
    Bench bench(make_device("reson-7k", {}, {{"range", 200.0}}));
    Wire wire(bench);
    const Address host{0x7F000001, 40000};
    constexpr std::size_t udp = 1;
    wire.say(control_7k(1051, {2, 7018, 7027}), udp, host);
    std::size_t answers = 1;
    for (int ping = 0; ping < 4; ++ping) {
        wire.hear();
        ASSERT_TRUE(ping > 0 || wire.waits()) << "else it shows nothing";
        wire.say(control_7k(1003, {std::bit_cast<std::uint32_t>(5.0F)}), udp, host);  // range
        wire.run_to(bench.now + 2ms);
        wire.say(control_7k(1050, {7503}), udp, host);
        answers += 3;
    }
    std::map<std::uint32_t, std::size_t> whole;  // by type of record
    std::uint32_t next = 0, type = 0;
    const auto datagrams = wire.datagrams();
    for (const Bytes& b : datagrams.at(host.port)) {
        ASSERT_EQ(word(b, 20), next) << "packet of the record";
        if (next == 0) type = word(b, 36 + 32);
        next = next + 1 == word(b, 4) ? 0 : next + 1;
        if (next == 0) ++whole[type];
    }
    EXPECT_EQ(whole[7018], 4U);
    EXPECT_EQ(whole[7027], 4U);
    EXPECT_EQ(whole[7501] + whole[7503], answers);
}

TEST(Parts, OfAKmallDatagramsLetNoOtherDatagramBetweenThem) {
    Bench bench(
        make_device("kongsberg-kmall", {},
                    {{"largest_part", std::int64_t{20000}}, {"water_column", true}, {"datagram_gap", 5e-3}}));
    bench.echo_bin = 300, bench.echo_power = 1e14F;
    Wire wire(bench);
    const std::string again = "$KSSIS,454,2040";
    for (int ping = 0; ping < 4; ++ping) {
        wire.hear();
        ASSERT_TRUE(ping > 0 || wire.waits()) << "else it shows nothing";
        wire.say(Bytes(again.begin(), again.end()));  // #IIP, #IOP, #SVP
    }
    std::map<std::string, std::size_t> whole;
    std::size_t parts = 0;
    Bytes held;
    const auto datagrams = wire.datagrams();
    for (const Bytes& b : datagrams.at(6020)) {
        const std::string type(b.begin() + 4, b.begin() + 8);
        const std::uint32_t count = word(b, 20) & 0xFFFF, number = word(b, 20) >> 16;
        if (type != "#MRZ" && type != "#MWC") {
            EXPECT_EQ(parts, 0U) << type << " between the parts of another";
            continue;
        }
        EXPECT_EQ(number, ++parts) << type;
        if (kmall::join(held, b)) ++whole[type];
        if (number == count) parts = 0;
    }
    EXPECT_EQ(whole["#MRZ"], 4U);
    EXPECT_EQ(whole["#MWC"], 4U);
}

}  // namespace
}  // namespace echoloop::test
