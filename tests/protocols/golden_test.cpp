// Frames worked out from the specifications: tests/data/<family>/*.hex, each with the fields to find in it.
#include <gtest/gtest.h>

#include <algorithm>

#include "protocols/altimeter/line.h"
#include "protocols/imagenex/delta_t_codec.h"
#include "protocols/inspect.h"
#include "protocols/kmall/codec.h"
#include "protocols/oculus/codec.h"
#include "protocols/oculus/framer.h"
#include "protocols/nmea/sentence.h"
#include "protocols/norbit/codec.h"
#include "protocols/norbit/framer.h"
#include "protocols/ping/codec.h"
#include "protocols/ping/framer.h"
#include "protocols/r2sonic/codec.h"
#include "protocols/seanet/codec.h"
#include "protocols/seanet/framer.h"
#include "protocols/sonar3d/codec.h"
#include "tests/protocols/aris_rewritten.h"
#include "tests/protocols/cerulean_rewritten.h"
#include "tests/protocols/data.h"
#include "tests/protocols/imagenex_rewritten.h"
#include "tests/protocols/reson7k_rewritten.h"

namespace echoloop {
namespace {

struct Golden {
    std::string family;
    std::filesystem::path path;
};
void PrintTo(const Golden& golden, std::ostream* out) { *out << golden.path.filename(); }

std::vector<Golden> golden_files() {
    std::vector<Golden> out;
    for (const auto& family : inspect::families()) {
        for (const auto& path : hex_files(std::string(family.name)))
            out.push_back({std::string(family.name), path});
    }
    return out;
}

/// The bytes parsed and written back.
wire::Bytes rewritten(const std::string& family, const wire::Bytes& bytes) {
    if (family == "r2sonic") {
        const auto packet = r2sonic::parse(bytes);
        return packet ? r2sonic::serialise(*packet) : wire::Bytes{};
    }
    if (family == "ping") {
        ping::Framer framer;
        framer.feed(bytes);
        const auto frame = framer.next();
        const auto message = frame ? ping::parse(*frame) : wire::Result<ping::Message>(wire::Error{});
        return message ? ping::encode(*message, frame->header.source) : wire::Bytes{};
    }
    if (family == "oculus") {
        oculus::Framer framer;
        framer.feed(bytes);
        const auto frame = framer.next();
        const auto message = frame ? oculus::parse(*frame) : wire::Result<oculus::Message>(wire::Error{});
        if (!message) return {};
        return oculus::encode(*message, frame->header.source, frame->header.destination);
    }
    if (family == "deltat") {
        const auto message = imagenex::parse_delta_t(bytes);
        return message ? imagenex::encode(*message) : wire::Bytes{};
    }
    if (family == "reson7k") return reson7k::rewritten(bytes);
    if (family == "kmall") {
        const auto datagram = kmall::parse(bytes);
        return datagram ? kmall::serialise(*datagram) : wire::Bytes{};
    }
    if (family == "norbit") {
        norbit::Framer framer;
        framer.feed(bytes);
        const auto frame = framer.next();
        const auto message = frame ? norbit::parse(*frame) : wire::Result<norbit::Message>(wire::Error{});
        return message ? norbit::encode(*message, frame->header.version, frame->header.type) : wire::Bytes{};
    }
    if (family == "aris") return aris::rewritten(bytes);
    if (family == "imagenex") return imagenex::rewritten(bytes);
    if (family == "cerulean") return cerulean::rewritten(bytes);
    if (family == "altimeter") {
        const auto reading = altimeter::read_line(std::string(bytes.begin(), bytes.end()));
        const std::string text = reading ? altimeter::write_line(*reading) : "";
        return {text.begin(), text.end()};
    }
    if (family == "nmea") {
        const std::string line(bytes.begin(), bytes.end());
        const auto sentence = nmea::read_sentence(line.substr(0, line.size() - 2));
        const std::string text = sentence ? nmea::write_sentence(*sentence) : "";
        return {text.begin(), text.end()};
    }
    if (family == "sonar3d") {
        const auto packet = sonar3d::parse(bytes);
        return packet ? sonar3d::serialise(*packet) : wire::Bytes{};
    }
    seanet::Framer framer;
    framer.feed(bytes);
    const auto frame = framer.next();
    const auto message = frame ? seanet::parse(*frame) : wire::Result<seanet::Message>(wire::Error{});
    return message ? seanet::encode(*message) : wire::Bytes{};
}

class GoldenFile : public ::testing::TestWithParam<Golden> {};

TEST_P(GoldenFile, HasTheFieldsThatTheFileSays) {
    const HexFile file = read_hex_file(GetParam().path);
    const auto messages = inspect::find_family(GetParam().family)->decode(file.bytes);
    ASSERT_EQ(messages.size(), 1U);
    EXPECT_EQ(messages[0].reason, "");
    EXPECT_EQ(messages[0].name, file.message);
    EXPECT_FALSE(file.fields.empty());
    for (const auto& expected : file.fields) {
        const auto& fields = messages[0].fields;
        const auto found = std::find_if(fields.begin(), fields.end(),
                                        [&](const auto& field) { return field.name == expected.first; });
        ASSERT_NE(found, fields.end()) << expected.first;
        EXPECT_EQ(found->text, expected.second) << expected.first;
    }
}

TEST_P(GoldenFile, IsWrittenBackByteForByte) {
    const wire::Bytes bytes = read_hex_file(GetParam().path).bytes;
    EXPECT_EQ(to_hex(rewritten(GetParam().family, bytes)), to_hex(bytes));
}

TEST_P(GoldenFile, IsRecognisedAsItsFamily) {
    const auto* family = inspect::guess_family(read_hex_file(GetParam().path).bytes);
    ASSERT_NE(family, nullptr);
    EXPECT_EQ(family->name, GetParam().family);
}

INSTANTIATE_TEST_SUITE_P(Data, GoldenFile, ::testing::ValuesIn(golden_files()), [](const auto& golden) {
    return golden.param.family + '_' + golden.param.path.stem().string();
});

TEST(GoldenFile, EveryFamilyHasSome) {
    for (const auto& family : inspect::families()) EXPECT_FALSE(hex_files(std::string(family.name)).empty());
}

}  // namespace
}  // namespace echoloop
