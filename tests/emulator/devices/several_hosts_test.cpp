// Several hosts at one UDP port of a device: what one says by halves, or as noise, costs another nothing.
#include <gtest/gtest.h>

#include "tests/emulator/devices/driver.h"

namespace echoloop::test {
namespace {

using namespace std::chrono_literals;

struct Case {
    const char* model;
    const char* request;  ///< answered by one message at least within a second
    Time ready{};         ///< after power-up
};

/// One request of each protocol that is a stream of bytes behind a datagram port, as its public definition
/// has it.
const Case cases[] = {{"ping360", "42520200060000000500a100"},
                      {"ping1d", "42520200060000000500a100"},
                      {"s500", "42520200060000000500a100"},
                      {"omniscan450", "42520200060000000500a100"},
                      {"surveyor240", "42520200060000000500a100"},
                      {"tritech-micron", "40303030380800ff02031780020a", 5s},  // mtSendVersion
                      {"tritech-seaking", "40303030380800ff02031780020a", 5s},
                      {"tritech-profiler", "40303030380800ff14031780140a", 5s},
                      {"imagenex-852", "fe441105000043001401143c1408060000000032080600000064fd"},
                      {"imagenex-881a", "fe441005000043001401143c1408060000000032080600000064fd"}};

TEST(SeveralHosts, ShareNoHalfMessageAndNoReply) {
    const Address host{0x7F000001, 50000}, other{0x7F000001, 50001};
    for (const Case& c : cases) {
        const Bytes request = from_hex(c.request);
        for (const std::string noise : {"55", "ff00", "425202", "4030303038", "fe4410", ""}) {
            Bench bench(make_device(c.model, {"udp-listen://127.0.0.1:9100"}));
            bench.run_to(c.ready);
            bench.sent();
            bench.say(ByteView(request).first(5), 0, host);
            bench.say(noise, 0, other);
            bench.say(ByteView(request).subspan(5), 0, host);
            bench.say(noise, 0, other);
            bench.run_to(bench.now + 1s);
            bool answered = false;
            for (const Send& send : bench.sent()) answered |= send.to == host;
            EXPECT_TRUE(answered) << c.model << " beside " << noise;
        }
    }
}

TEST(SeveralHosts, CountAllNoiseThoughHostsAreForgotten) {
    Bench bench(make_device("ping1d", {"udp-listen://127.0.0.1:9100"}));
    for (std::uint16_t port = 1; port <= 1000; ++port) bench.say("00ff00", 0, {0x7F000001, port});
    EXPECT_EQ(bench.device().counters().skipped_bytes, 3000u);
}

}  // namespace
}  // namespace echoloop::test
