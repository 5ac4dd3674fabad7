// What waits for a client of Foxglove's protocol that never reads.
#include "tools/view/foxglove.h"

#include <gtest/gtest.h>

#include <map>

namespace echoloop::view {
namespace {

bag::Ping ping_of(std::uint64_t number) {
    bag::Ping ping;
    ping.device = "fan";
    ping.number = number;
    ping.unix_time = 1e9 + 0.2 * static_cast<double>(number);
    Shot& shot = ping.echogram.shot;
    for (int beam = -64; beam < 64; ++beam) shot.bearings.push_back(0.01 * beam);
    shot.bins = 400;
    shot.bin_interval = 1e-5;
    ping.echogram.sound_speed = 1500;
    ping.echogram.values.assign(shot.beams() * shot.bins, 1e6F);
    return ping;
}

TEST(AFoxgloveClientThatNeverReads, HoldsALittleOverAMegabyteAndTheLatestOfEachTopic) {
    Foxglove foxglove(bag::About{});
    const auto client = foxglove.join();
    std::string wanted = R"({"op": "subscribe", "subscriptions": [)";
    for (int n = 1; n <= 20; ++n)
        wanted += (n > 1 ? "," : "") + std::string(R"({"id": )") + std::to_string(n) + R"(, "channelId": )" +
                  std::to_string(n) + "}";
    Foxglove::hear(*client, wanted + "]}");
    for (std::uint64_t number = 0; number < 100; ++number) foxglove.ping(ping_of(number));
    std::size_t held = 0, largest = 0;
    std::map<std::uint32_t, std::string> last;
    while (const auto frame = client->next()) {
        held += frame->bytes->size();
        if (!frame->binary) continue;
        largest = std::max(largest, frame->bytes->size());
        last[frame->channel] = *frame->bytes;
    }
    EXPECT_GT(largest, 100'000U) << "or this says nothing";
    EXPECT_LT(held, (1U << 20) + last.size() * largest);
    Foxglove again(bag::About{});
    const auto reader = again.join();
    Foxglove::hear(*reader, wanted + "]}");
    again.ping(ping_of(99));
    std::size_t compared = 0;
    while (const auto frame = reader->next())
        if (frame->binary) {
            EXPECT_EQ(last[frame->channel].size(), frame->bytes->size());
            ++compared;
        }
    EXPECT_GE(compared, 5U);
}

}  // namespace
}  // namespace echoloop::view
