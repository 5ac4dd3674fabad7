// KMALL datagrams of sensors, of a ping's heave and of calibration files: round trips of all kinds, and sizes
// that lie.
#include "protocols/kmall/codec.h"
#include "protocols/kmall/sensor_layouts.h"
#include "tests/protocols/arbitrary.h"

namespace echoloop::kmall {
namespace {

template <class M>
void expect_the_same(M message) {
    const wire::Bytes bytes = serialise(message);
    message.header.size = static_cast<std::uint32_t>(bytes.size());
    const auto parsed = parse(bytes);
    RC_ASSERT(parsed.has_value());
    RC_ASSERT(std::get<M>(*parsed) == message);
    for (std::size_t size = 0; size < bytes.size(); size += 7)
        RC_ASSERT(!parse(wire::ByteView(bytes).first(size)));
}

Header header_of(const char* type, std::uint8_t version = 0) {
    auto header = arbitrary<Header>();
    header.type = type;
    header.version = version;
    return header;
}

template <class Values>
void sensor(const char* type, std::uint8_t version = 0) {
    EXPECT_TRUE(rc::check([&] {
        auto info = arbitrary<SensorInfo>();
        info.size = 8;
        expect_the_same(
            Sensor{header_of(type, version), info, arbitrary<Values>(), *rc::gen::arbitrary<std::string>()});
    })) << type;
}

TEST(KmallSensors, EachKindSurvivesARoundTrip) {
    sensor<Position>("#SPO");
    sensor<Position>("#CPO");
    sensor<PositionError>("#SPE");
    sensor<Datum>("#SPD");
    sensor<Clock>("#SCL", 1);
    sensor<DepthSensor0>("#SDE", 0);
    sensor<DepthSensor>("#SDE", 1);
    sensor<Height>("#SHI");
    sensor<SoundSpeedManager>("#SSM");
}

TEST(KmallSensors, SamplesSurviveARoundTrip) {
    EXPECT_TRUE(rc::check([] {
        auto speeds = arbitrary<SoundSpeedInfo>();
        speeds.size = 20;
        speeds.samples = 2;
        speeds.bytes_per_sample = 24;
        expect_the_same(SoundSpeeds{
            header_of("#SVT"), speeds, {arbitrary<SoundSpeedSample>(), arbitrary<SoundSpeedSample>()}});
        auto motion = arbitrary<MotionInfo>();
        motion.size = 12;
        motion.samples = 2;
        motion.bytes_per_sample = 132;
        expect_the_same(
            Motion{header_of("#SKM", 1), motion, {arbitrary<MotionSample>(), arbitrary<MotionSample>()}});
        auto info = arbitrary<SensorInfo>();
        info.size = 8;
        auto about = arbitrary<HeadingsInfo>();
        about.size = 8;
        about.samples = 2;
        about.bytes_per_sample = 8 + 5;
        expect_the_same(
            Headings{header_of("#SHA"), info, about, {arbitrary<HeadingSample>(), {}}, {"$ABCD", "$EFGH"}});
        auto body = arbitrary<Body>();
        body.size = 12;
        expect_the_same(PingHeave{header_of("#CHE"), body, arbitrary<Heave>()});
        auto file = arbitrary<FileInfo>();
        file.size = 72;
        expect_the_same(CalibrationFile{header_of("#FCF"), {2, 1}, file, {1, 2, 3}});
    }));
}

TEST(KmallSensors, SizesThatLieAreRefused) {
    HeadingsInfo about;
    about.samples = 3;
    about.bytes_per_sample = 8;
    Header header;
    header.type = "#SHA";
    wire::Bytes bytes = serialise(Headings{header, {}, about, {{}, {}, {}}, {}});
    ASSERT_TRUE(parse(bytes));
    constexpr std::size_t samples_at = 20 + 8 + 2, bytes_at = samples_at + 2;
    bytes[samples_at] = 4;
    EXPECT_FALSE(parse(bytes));
    bytes[samples_at] = 3;
    bytes[bytes_at] = 7;
    EXPECT_FALSE(parse(bytes));
}

}  // namespace
}  // namespace echoloop::kmall
