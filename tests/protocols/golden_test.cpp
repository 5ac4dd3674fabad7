// Frames worked out from the specifications: tests/data/<family>/*.hex, each with the fields to find in it.
#include <gtest/gtest.h>

#include <algorithm>

#include "protocols/inspect.h"
#include "tests/protocols/data.h"

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
    EXPECT_EQ(to_hex(inspect::find_family(GetParam().family)->rewritten(bytes)), to_hex(bytes));
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
