#include "tools/view/said_picture.h"

#include <cstring>

#include "tools/bag/levels.h"
#include "tools/view/message.h"

namespace echoloop::view {

std::string message_of(const said::Picture& picture, const std::string& device, std::uint64_t number,
                       double unix_time) {
    const bag::Levels levels = bag::levels_of(picture);
    const bool ranges = !picture.ranges.empty();
    const Json head{{"type", "said"},
                    {"device", device},
                    {"name", picture.name},
                    {"number", number},
                    {"t", unix_time},
                    {"unit", picture.unit},
                    {"floor", levels.floor},
                    {"step", levels.step},
                    {"rows", levels.rows},
                    {"beams", levels.beams},
                    {"bins", levels.bins},
                    {"bearings", levels.bearings},
                    {"elevations", rounded(picture.elevations)},
                    {"numbered", picture.numbered},
                    {"pan", picture.pan},
                    {"waterfall", picture.waterfall},
                    {"down", picture.down},
                    {"assumed", picture.assumed},
                    {"first_range", levels.first_range},
                    {"bin_size", levels.bin_size},
                    {"ranges", ranges}};
    std::string bytes = levels.bytes;
    for (const float range : bag::ranges_of(picture)) {
        std::uint32_t bits = 0;
        std::memcpy(&bits, &range, sizeof bits);
        put_le(bytes, bits, 4);
    }
    return with_head(head, bytes);
}

}  // namespace echoloop::view
