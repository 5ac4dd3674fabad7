// What the tests of SeaNet heads share: commands as drivers send them and a look at replies by the offsets of
// the SeaNet notes, without the project's own codec.
#pragma once

#include <ostream>

#include "tests/emulator/devices/driver.h"

namespace echoloop::test {
using namespace std::chrono_literals;

inline const std::string send_data = "40303030430c00ff0207198002000000000a";
inline const std::string reboot = "40303030380800ff02031080020a";
inline const std::string send_version = "40303030380800ff02031780020a";
inline const std::string send_bb_user = "40303030380800ff02031880020a";
inline const std::string stop_alives = "40303030380800ff02034280020a";
inline const std::string reverse = "40303030390900ff02041380020f0a";
// 50 % gain, low 10 dB, span 30 dB
inline const std::string gain_block = "40303031391900ff02141380021e5f5f1f1f6969000064006400000000000a";
// A public driver's own bytes: 0x1D, 10 m, 200 bins, ADInterval 104, step 31, MoTime 25, continuous, 8 bit
inline const std::string continuous =
    "40303034434c00ff02471380021d8323020000000000000000000000000000000000006400000000005108545400000000191f68"
    "00c800"
    "e8031534400601000000000000000000000000000000000000000a";
inline const std::string four_bit =
    "40303034434c00ff02471380021d8223020000000000000000000000000000000000006400000000005108545400000000191f68"
    "00c800"
    "e8031534400601000000000000000000000000000000000000000a";
// The same in a sector from 2399 to 3999 (+45 to -45 deg)
inline const std::string sector =
    "40303034434c00ff02471380021d81230200000000000000000000000000000000000064005f099f0f5108545400000000191f68"
    "00c800"
    "e8031534400601000000000000000000000000000000000000000a";
// Another driver's 0x01: 10 m, 400 bins, step 32, clockwise
inline const std::string clockwise =
    "40303033433c00ff023713800201072311000000000000000000000000000000000000640060099f0fff00696900000000192035"
    "009001"
    "f40164004006010000000a";
inline const std::string profiler_command =
    "40303034434c00ff14471380141d822305cccccc0499999909d7a37008a3703d0d3e0096005f099f0f32146b64720096001958cb"
    "000000"
    "00004c05400601000000323201146b6b64646e009600000000000a";

inline int u16(const Bytes& bytes, std::size_t at) { return bytes[at] | bytes[at + 1] << 8; }

struct Alive {
    int parameters, head_inf;
    bool operator==(const Alive&) const = default;
};
inline void PrintTo(const Alive& a, std::ostream* out) {
    *out << std::hex << a.head_inf << "/" << a.parameters;
}

inline std::vector<Alive> alives(const std::vector<Send>& sent) {
    std::vector<Alive> found;
    for (const Send& s : sent)
        if (s.bytes.at(10) == 4) found.push_back({s.bytes.at(13), s.bytes.at(20)});
    return found;
}

inline std::vector<Bytes> lines(const std::vector<Send>& sent) {
    std::vector<Bytes> found;
    for (const Send& s : sent)
        if (s.bytes.at(10) == 2) found.push_back(s.bytes);
    return found;
}

inline std::vector<int> bearings(const std::vector<Send>& sent) {
    std::vector<int> found;
    for (const Bytes& line : lines(sent)) found.push_back(u16(line, 40));
    return found;
}

inline Bench powered_up(const Options& changes = {}, const std::string& model = "tritech-micron") {
    return Bench(make_device(model, {}, changes));
}

/// A command with some bytes replaced; `at` counts from the '@'.
inline std::string changed(std::string command, std::size_t at, const std::string& hex) {
    return command.replace(2 * at, hex.size(), hex);
}

/// Centred, with parameters, nothing pending.
inline Bench scanning(const std::string& command, const Options& changes = {},
                      const std::string& model = "tritech-micron") {
    Bench bench = powered_up(changes, model);
    bench.run_to(4s);
    bench.say(command);
    bench.sent();
    return bench;
}

}  // namespace echoloop::test
