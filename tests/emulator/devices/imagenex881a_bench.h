// A host of the 881A on the bench.
#pragma once

#include "tests/emulator/devices/imagenex_bench.h"

namespace echoloop::test::imagenex881a {

// A host's command: id 10, 5 m, 20 dB, LOGF 20, 0.2 dB/m, 0 deg, 60 deg sector, 2.4 deg steps, 60 us, 500
// points.
inline const std::string plain = "FE44100500004300140114 3C1408060000000032080600000064FD";
enum At {
    id = 2,
    range,
    motion = 5,
    mode,
    gain = 8,
    logf,
    absorption,
    train,
    sector,
    step,
    pulse,
    least,
    points = 19,
    bits,
    baud,
    profile,
    calibrate,
    delay,
    frequency
};
constexpr int around = 120;

inline Bytes command(const Changes& changes = {}) { return changed(plain, changes); }
/// Its replies come as a whole when their last byte would, unless `changes` says otherwise.
inline Bench sonar(Options changes = {}) {
    changes.try_emplace("baud", 0.0);
    return Bench(make_device("imagenex-881a", {}, changes));
}

}  // namespace echoloop::test::imagenex881a
