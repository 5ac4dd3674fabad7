// A Teledyne log on the bench, and words read at the offsets of the makers' guides.
#pragma once

#include <string>

#include "tests/emulator/devices/doppler_echo.h"

namespace echoloop::test {

inline unsigned u16(const Bytes& b, std::size_t at) { return b.at(at) + 256U * b.at(at + 1); }
inline int i16(const Bytes& b, std::size_t at) { return static_cast<std::int16_t>(u16(b, at)); }

struct TeledyneBench {
    explicit TeledyneBench(const Options& changes = {}, const std::string& model = "dvl-pathfinder")
        : bench(make_device(model, {}, changes)) {}

    /// What it says until `end`, all of it in a row.
    Bytes heard(Time end) {
        bottom.run(bench, end);
        Bytes all;
        for (const Send& send : bench.sent()) all.insert(all.end(), send.bytes.begin(), send.bytes.end());
        return all;
    }
    /// The last ensemble until then; its sum is right.
    Bytes ensemble(Time end) {
        bottom.run(bench, end);
        Bytes last;
        for (const Send& send : bench.sent())
            if (send.bytes.size() > 20 && send.bytes[0] == 0x7F) last = send.bytes;
        unsigned total = 0;
        for (std::size_t i = 0; i + 2 < last.size(); ++i) total += last[i];
        if (last.empty() || u16(last, 2) != last.size() - 2 || (total & 0xFFFF) != u16(last, last.size() - 2))
            return {};
        return last;
    }
    std::string ask(const std::string& line) {
        bench.sent();
        bench.say(Bytes(line.begin(), line.end()));
        const Bytes all = heard(bench.now);
        return {all.begin(), all.end()};
    }

    Bench bench;
    OverBottom bottom;
};

/// Turned to port from east by `yaw`, then the bow up and starboard down; deg.
inline Quat lying(double yaw, double pitch = 0, double roll = 0) {
    return axis_angle({0, 0, 1}, deg_to_rad(yaw)) * axis_angle({0, 1, 0}, -deg_to_rad(pitch)) *
           axis_angle({1, 0, 0}, deg_to_rad(roll));
}

}  // namespace echoloop::test
