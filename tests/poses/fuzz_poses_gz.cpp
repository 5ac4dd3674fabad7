// Made-up messages of Gazebo; the first byte chooses the type.
#include <array>
#include <cstddef>
#include <cstdint>

#include "tools/poses/gz/messages.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace echoloop::poses;
    constexpr std::array types{"gz.msgs.Pose", "ignition.msgs.Pose_V", "gz.msgs.Odometry", "gz.msgs.Clock",
                               "ignition.msgs.WorldStatistics"};
    if (size == 0) return 0;
    const std::string_view bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
    const char* type = types[data[0] % types.size()];
    read_gz(bytes, type);
    read_gz_clock(bytes, type);
    return 0;
}
