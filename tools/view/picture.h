// An echogram made small enough for a page: whole numbers of dB, few beams and bins. Opens nothing.
#pragma once

#include <string>
#include <string_view>

#include "emulator/capture/watch.h"

namespace echoloop::view {

/// What is kept of a ping until it is sent; taken on the thread that hears it, so it is a plain copy.
struct Kept {
    std::string device;
    std::uint64_t number = 0;
    Time transmitted{}, late{}, drawn{}, due{};
    Echogram echogram;
    std::vector<Pose> movers;
};
Kept kept(const SeenPing& ping);

/// A message for the page: four bytes of length (little endian), that much JSON, then a byte for each level,
/// beam by beam, then as many objects of two bytes each (little endian) where the JSON says so.
/// A level is 0 for nothing, else floor + (byte - 1) / 2 dB; `floor` is in the JSON. Several bins of the
/// echogram make one of the picture: the loudest is shown.
std::string message_of(const Kept& ping);

}  // namespace echoloop::view
