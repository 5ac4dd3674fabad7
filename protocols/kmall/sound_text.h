// Texts that give a sounder a profile of the speed of sound, as public programs send them. Knows no state.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "protocols/kmall/messages.h"
#include "protocols/wire/result.h"

namespace echoloop::kmall {

struct SoundSample {
    double depth = 0;                                 ///< m
    std::optional<double> speed{};                    ///< m/s
    std::optional<double> temperature{}, salinity{};  ///< deg C, g/kg

    friend bool operator==(const SoundSample&, const SoundSample&) = default;
};

/// "$MVS01,00000,NNNN,hhmmss,dd,mm,yyyy," + N samples + "ddmm.mm,N,dddmm.mm,E,0.0,,comment,*hh\\" + CR LF; a
/// sample is "depth,speed,temperature,salinity,", and what it does not say is empty. The checksum is the XOR
/// of what stands between `$` and the last `*`, in lower or upper case.
struct SoundReading {
    std::string format;                             ///< "S01"
    std::uint32_t seconds = 0;                      ///< Unix time of the profile
    std::optional<double> latitude{}, longitude{};  ///< deg, positive to north and east
    std::vector<SoundSample> samples;               ///< depths rise from 0 to 12000 m
};

/// An error for another format than S00, S01, S02, S10, S12, S22, another checksum, a count of samples that
/// is none of 1 to 1000 or not theirs, depths that do not rise, and values that no water has: the whole is
/// refused.
wire::Result<SoundReading> read_sound_text(const SoundText& text);

}  // namespace echoloop::kmall
