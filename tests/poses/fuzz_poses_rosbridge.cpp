// Made-up text of a rosbridge server, and the tree of frames that its transforms make.
#include <cstddef>
#include <cstdint>
#include <string>

#include "tools/poses/common/frames.h"
#include "tools/poses/rosbridge/messages.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace echoloop::poses;
    const auto heard = read_rosbridge({reinterpret_cast<const char*>(data), size});
    Frames frames("map");
    std::string why;
    frames.add(heard.bodies, false);
    for (const auto& body : heard.bodies) frames.newest(body.name, why);
    return 0;
}
