// Any bytes at any time to every model: it must not crash, hang, or ask for a ping that cannot be rendered.
// The first byte picks the model, each further record is {port, pause in 10 ms, length, bytes}.
#include <cstdlib>

#include "tests/emulator/devices/driver.h"

using namespace echoloop;

namespace {

void require(bool good) {
    if (!good) std::abort();
}

void check(const Shot& shot) {
    require(shot.bins > 0 && shot.bins * shot.bearings.size() <= (std::size_t{16} << 20));
    require(std::isfinite(shot.bin_interval) && shot.bin_interval > 0);
    require(static_cast<double>(shot.bins) * shot.bin_interval <= 60);
    require(std::isfinite(shot.pan) && std::isfinite(shot.tilt) && std::isfinite(shot.source_level));
    require(shot.beam_width > 0 && shot.fan_height > 0 && shot.frequency > 0 && shot.pulse_length >= 0);
    for (std::size_t n = 1; n < shot.bearings.size(); ++n) require(shot.bearings[n] > shot.bearings[n - 1]);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    ByteView input(data, size);
    if (input.empty()) return 0;
    const Model& model = models()[input[0] % models().size()];
    input = input.subspan(1);
    // A multibeam that runs freely would spend the time on silent echograms.
    Options changes;
    if (model.name.starts_with("r2sonic")) changes["trigger"] = std::string("command");
    test::Bench bench(test::make_device(model.name, {}, changes));
    const std::size_t ports = bench.device().ports().size();
    bench.run_to(std::chrono::seconds(4));
    while (input.size() >= 3) {
        const std::size_t port = input[0] % ports, length = std::min<std::size_t>(input[2], input.size() - 3);
        bench.run_to(bench.now + input[1] * std::chrono::milliseconds(10));
        bench.say(input.subspan(3, length), port, {0x7F000001, 40000});
        input = input.subspan(3 + length);
        if (bench.ping) check(bench.ping->shot);
        bench.sent();
        bench.shots.clear();
    }
    return 0;
}
