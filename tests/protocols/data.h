// Where tests find their bytes: hex files of this repository, and recordings that may lie beside it. Reads
// only.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "protocols/wire/bytes.h"

namespace echoloop {

/// Bytes of "40 30 30 .."; spaces are optional. Throws std::invalid_argument if there is anything else.
wire::Bytes from_hex(std::string_view text);
std::string to_hex(wire::ByteView bytes);

/// A golden file: '#' starts a comment, `message NAME` and `field NAME VALUE` lines say what to expect, all
/// other lines are hex.
struct HexFile {
    std::string message;
    std::vector<std::pair<std::string, std::string>> fields;
    wire::Bytes bytes;
};
HexFile read_hex_file(const std::filesystem::path& path);
/// All *.hex files of tests/data/<family>, sorted by name.
std::vector<std::filesystem::path> hex_files(const std::string& family);

/// A recording beside the repository, e.g. "tritech/vectors.json". Without it the calling test is skipped, or
/// fails where CI is set.
std::optional<std::filesystem::path> shared_data(const std::string& name);

/// UDP payloads of a little-endian pcap of Ethernet frames with IPv4, unfragmented.
std::vector<wire::Bytes> read_pcap(const std::filesystem::path& path);

}  // namespace echoloop

/// Skips or fails the test if the recording is not there.
#define ECHOLOOP_NEED_DATA(variable, name)                                                                \
    const auto variable = echoloop::shared_data(name);                                                    \
    if (!variable && std::getenv("CI") != nullptr) GTEST_FAIL() << "no " << name << " in ../shared/data"; \
    if (!variable) GTEST_SKIP() << "no " << name << " in ../shared/data"
