// SeaNet heads on a line that flips bytes: whatever was damaged before, the next good request is answered.
#include "tests/emulator/devices/micron_bench.h"
#include "tests/emulator/devices/noisy_line.h"

namespace echoloop::test {
namespace {

/// Asks for the version, which comes at once.
NoisyHost host_that_says(std::vector<std::string> words, std::uint8_t node) {
    const std::string own = to_hex(Bytes{node});
    const std::string request = changed(changed(send_version, 8, own), 12, own);
    words.push_back(request);
    return {std::move(words), request,
            [node](const Send& send) { return send.bytes.size() == 25 && send.bytes[7] == node; }};
}

TEST(MicronOnANoisyLine, ServesItsHostAgainWithinOneRequest) {
    Bench bench = scanning(clockwise, {{"aux_echosounder", true}});
    expect_no_wedge(bench,
                    host_that_says({clockwise, four_bit, send_data, reverse, gain_block, send_bb_user}, 2));
}

TEST(MicronOnANoisyLine, StillScans) {
    Bench bench = scanning(clockwise);
    // No word of 14 bytes: a damaged one may be an mtReBoot, and a head that restarts has no lines.
    NoisyHost host{{clockwise, four_bit, sector, send_data, gain_block},
                   clockwise + send_data,
                   [](const Send& send) { return send.bytes.size() == 445 && send.bytes[10] == 2; }};
    host.patience = 2s;
    expect_no_wedge(bench, host, 500);
}

TEST(SeaKingOnANoisyLine, ServesItsHostAgainWithinOneRequest) {
    Bench bench = scanning(clockwise, {}, "tritech-seaking");
    expect_no_wedge(bench, host_that_says({clockwise, sector, send_data, gain_block}, 2), 500);
}

TEST(ProfilerOnANoisyLine, ServesItsHostAgainWithinOneRequest) {
    Bench bench = scanning(profiler_command, {}, "tritech-profiler");
    expect_no_wedge(bench, host_that_says({profiler_command, "40303030430c00ff1407198014000000000a"}, 20),
                    500);
}

}  // namespace
}  // namespace echoloop::test
