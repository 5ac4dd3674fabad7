#include <cstddef>
#include <cstdint>
#include <string_view>

#include "tools/poses/truth/messages.h"

using namespace echoloop::poses;

/// A line of the ground truth, and what is made of it.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const auto read = read_truth({reinterpret_cast<const char*>(data), size});
    if (!read.ping) return 0;
    truth_points(*read.ping);
    TruthPicture picture;
    picture.add(*read.ping);
    picture.draw(40);
    return 0;
}
