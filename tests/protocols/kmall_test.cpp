// KMALL datagrams: round trips, truncations, lying counts, versions, division, texts.
#include "protocols/kmall/codec.h"
#include "protocols/kmall/inspect.h"
#include "protocols/kmall/water_layouts.h"
#include "tests/protocols/arbitrary.h"
#include "tests/protocols/data.h"

namespace echoloop::kmall {
namespace {

wire::Bytes golden(const std::string& name) {
    for (const auto& path : hex_files("kmall"))
        if (path.filename() == name + ".hex") return read_hex_file(path).bytes;
    throw std::runtime_error("no " + name);
}

template <class T>
std::vector<T> some() {
    std::vector<T> all(*rc::gen::inRange<std::size_t>(0, 4));
    for (T& one : all) one = arbitrary<T>();
    return all;
}

Header header_of(const char* type) {
    auto header = arbitrary<Header>();
    header.type = type;
    return header;
}

TEST(Kmall, BathymetrySurvivesARoundTrip) {
    EXPECT_TRUE(rc::check([] {
        Mrz m{header_of("#MRZ"),      {1, 1},           arbitrary<Body>(),
              arbitrary<PingInfo>(),  some<TxSector>(), arbitrary<RxInfo>(),
              some<DetectionClass>(), some<Sounding>(), {}};
        m.body.size = 12;
        m.ping.size = 152;
        m.ping.tx_sectors = static_cast<std::uint16_t>(m.sectors.size());
        m.ping.bytes_per_sector = 48;
        m.rx.size = 32;
        m.rx.soundings = static_cast<std::uint16_t>(m.soundings.size());
        m.rx.extra_detections = 0;
        m.rx.bytes_per_sounding = 120;
        m.rx.classes = static_cast<std::uint16_t>(m.classes.size());
        m.rx.bytes_per_class = 4;
        for (Sounding& sounding : m.soundings) m.image.resize(m.image.size() + (sounding.image_samples %= 9));
        const wire::Bytes bytes = serialise(m);
        m.header.size = static_cast<std::uint32_t>(bytes.size());
        const auto parsed = parse(bytes);
        RC_ASSERT(parsed.has_value());
        RC_ASSERT(std::get<Mrz>(*parsed) == m);
    }));
}

TEST(Kmall, EveryTruncationIsRejected) {
    for (const char* name :
         {"mrz_v0", "mrz_v2", "mwc", "mwc_phase1", "mwc_phase2", "mwc_part", "iip", "svp"}) {
        const wire::Bytes whole = golden(name);
        ASSERT_TRUE(parse(whole)) << name;
        for (std::size_t size = 0; size < whole.size(); ++size)
            EXPECT_FALSE(parse(wire::ByteView(whole).first(size))) << name << " cut to " << size;
        // Nor is a shorter body in a frame whose sizes fit.
        const std::size_t least = std::string(name) == "mwc_part" ? whole.size() : 28;
        for (std::size_t size = least; size < whole.size(); ++size) {
            wire::Bytes cut(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size));
            wire::store<wire::ByteOrder::little>(static_cast<std::uint32_t>(size), cut.data());
            wire::store<wire::ByteOrder::little>(static_cast<std::uint32_t>(size), cut.data() + size - 4);
            EXPECT_FALSE(parse(cut)) << name << " at " << size;
        }
    }
}

TEST(Kmall, ALyingSizeOfTextOrProfileIsRefused) {
    for (const int lie : {0, 5, 7, 255}) {
        wire::Bytes bytes = golden("iip");
        bytes.at(20) = static_cast<std::uint8_t>(lie);
        EXPECT_FALSE(parse(bytes)) << lie;
    }
    wire::Bytes bytes = golden("svp");
    bytes.at(22) = 3;
    EXPECT_EQ(parse(bytes).error().reason, wire::Reason::truncated);
}

TEST(Kmall, ALyingCountIsRefused) {
    wire::Bytes bytes = golden("mrz_v0");
    constexpr std::size_t rx = 36 + 144 + 36;  // behind header, partition, body, ping info, one sector
    bytes.at(rx + 2) = bytes.at(rx + 3) = 0xFF;
    EXPECT_EQ(parse(bytes).error().reason, wire::Reason::truncated);
    bytes.at(rx + 6) = 0;  // bytes of a sounding
    EXPECT_EQ(parse(bytes).error().reason, wire::Reason::wrong_size);
}

TEST(Kmall, StructsOfALaterVersionAreSteppedOverByTheirSizes) {
    wire::Bytes bytes = golden("mrz_v0");
    const auto expected = std::get<Mrz>(*parse(bytes));
    constexpr std::size_t ping = 36;
    bytes.insert(bytes.begin() + ping + 144, 20, 0xEE);
    bytes.at(ping) = 164;
    const auto size = static_cast<std::uint32_t>(bytes.size());
    wire::store<wire::ByteOrder::little>(size, bytes.data());
    wire::store<wire::ByteOrder::little>(size, bytes.data() + size - 4);
    const auto parsed = parse(bytes);
    ASSERT_TRUE(parsed) << parsed.error().what();
    EXPECT_EQ(std::get<Mrz>(*parsed).soundings, expected.soundings);
    EXPECT_EQ(std::get<Mrz>(*parsed).ping.height, expected.ping.height);
}

TEST(Kmall, ABigDatagramIsDividedAndItsPartsMakeItAgain) {
    Mwc m;
    m.header.type = "#MWC";
    m.header.seconds = 1609459200;
    WaterBeam beam;
    for (int i = 0; i < 1000; ++i) beam.amplitude.push_back(static_cast<std::int8_t>(i));
    m.beams.assign(150, beam);
    const wire::Bytes whole = serialise(m);
    const auto parts = divided(whole);
    ASSERT_EQ(parts.size(), 3U);
    wire::Bytes body;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        EXPECT_LE(parts[i].size(), 65507U) << "a datagram of UDP holds it";
        const auto part = parse(parts[i]);
        ASSERT_TRUE(part) << part.error().what();
        EXPECT_EQ(std::get<Part>(*part).partition, (Partition{3, static_cast<std::uint16_t>(i + 1)}));
        EXPECT_EQ(std::get<Part>(*part).header.seconds, 1609459200U);
        body.insert(body.end(), parts[i].begin() + 24, parts[i].end() - 4);
    }
    EXPECT_EQ(to_hex(body), to_hex(wire::ByteView(whole).subspan(24, whole.size() - 28)));
    EXPECT_EQ(divided(golden("mwc")), std::vector<wire::Bytes>(1, golden("mwc")));
}

TEST(Kmall, JoinTakesPartsInOrderOnlyAndOnlyOfOneDatagram) {
    Mwc m;
    m.header.type = "#MWC";
    WaterBeam beam;
    beam.amplitude.assign(1000, 7);
    m.beams.assign(150, beam);
    const wire::Bytes whole = serialise(m);
    const auto parts = divided(whole);
    wire::Bytes held;
    EXPECT_FALSE(join(held, parts[0]));
    EXPECT_FALSE(join(held, golden("mwc"))) << "a whole one between them";
    EXPECT_FALSE(join(held, parts[1]));
    EXPECT_TRUE(join(held, parts[2]));
    wire::Bytes expected = whole;
    expected[20] = expected[22] = 1;
    EXPECT_EQ(to_hex(held), to_hex(expected));
    held.clear();
    for (const std::size_t order : {0, 2, 1, 2}) EXPECT_FALSE(join(held, parts[order])) << "one is missing";
    wire::Bytes other = parts[1];
    other[12] ^= 1;  // another time
    held.clear();
    EXPECT_FALSE(join(held, parts[0]));
    EXPECT_FALSE(join(held, other));
    EXPECT_FALSE(join(held, parts[2]));
    wire::Bytes file;
    for (const auto& part : parts) file.insert(file.end(), part.begin(), part.end());
    const auto messages = decode(file);
    ASSERT_EQ(messages.size(), 3U);
    EXPECT_EQ(messages[1].name, "MWC part");
    EXPECT_EQ(messages[2].name, "MWC");
    EXPECT_EQ(messages[0].size + messages[1].size + messages[2].size, file.size());
}

TEST(Kmall, DividedIsCutAtEvenPlacesAndNoLongerThanAsked) {
    Mrz m;
    m.header.type = "#MRZ";
    m.soundings.resize(512);
    const wire::Bytes whole = serialise(m);
    for (const std::size_t most : {1000U, 1001U, 65000U}) {
        wire::Bytes held;
        const auto parts = divided(whole, most);
        EXPECT_EQ(parts.size(), (whole.size() - 28 + most / 2 * 2 - 29) / ((most - 28) / 2 * 2)) << most;
        for (const auto& part : parts) EXPECT_LE(part.size(), most);
        for (const auto& part : parts)
            EXPECT_EQ(join(held, part), &part == &parts.back() && parts.size() > 1);
        EXPECT_EQ(parts[0].size() % 2, 0U);
    }
}

// 22 of 22 datagrams of two real systems.
TEST(Kmall, AProfileMayHaveOnePointMoreThanItCounts) {
    wire::Bytes bytes = golden("svp");
    bytes.insert(bytes.end() - 4, 20, 0xA5);
    bytes.at(0) = bytes.at(bytes.size() - 4) = static_cast<std::uint8_t>(bytes.size());
    const auto profile = parse(bytes);
    ASSERT_TRUE(profile) << profile.error().what();
    EXPECT_EQ(std::get<SoundProfile>(*profile).points.size(), 2U);
    EXPECT_EQ(to_hex(serialise(*profile)), to_hex(bytes));
}

TEST(Kmall, AFileIsDatagramsBackToBack) {
    wire::Bytes file = golden("mrz_v2");
    for (const char* name : {"mwc", "mrz_v0"}) {
        const auto more = golden(name);
        file.insert(file.end(), more.begin(), more.end());
    }
    const auto messages = decode(file);
    ASSERT_EQ(messages.size(), 3U);
    EXPECT_EQ(messages[1].name, "MWC");
    EXPECT_EQ(messages[2].offset, golden("mrz_v2").size() + golden("mwc").size());
    EXPECT_EQ(messages[2].reason, "");
}

TEST(Kmall, TextsOfTheControllerAreRead) {
    const auto text = [](const std::string& t) { return parse(wire::Bytes(t.begin(), t.end())); };
    EXPECT_EQ(std::get<Command>(*text("$KSSIS,458,2040")), (Command{458, "2040", ""}));
    EXPECT_EQ(std::get<Command>(*text("$KSSIS,457,712\r\n")), (Command{457, "712", "\r\n"}));
    EXPECT_EQ(std::get<Command>(*text("$KSSIS,262,EM2040_40,RUNT_PARAM=1")),
              (Command{262, "EM2040_40", ",RUNT_PARAM=1"}));
    EXPECT_EQ(std::get<Command>(*text("$KSSIS,12,IP=10.0.0.1~~SYSTEM_DESC=EM 2040, END!~~$$$")),
              (Command{12, "", "IP=10.0.0.1~~SYSTEM_DESC=EM 2040, END!~~$$$"}));
    for (const char* bad : {"$KSSIS,", "$KSSIS,458", "$KSSIS,458,", "$KSSIS,x,2040", "$KSSIS,99999999999,1",
                            "$KSSIS,-1,2040", "$KSSI,458,2040", "$KSSIS,458,20 40", "$KSSIS,458, 2040"})
        EXPECT_FALSE(text(bad)) << bad;
}

}  // namespace
}  // namespace echoloop::kmall
