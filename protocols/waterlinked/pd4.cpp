#include "protocols/waterlinked/pd4.h"

#include <algorithm>
#include <numeric>

#include "protocols/wire/read.h"
#include "protocols/wire/write.h"

namespace echoloop::waterlinked {

std::uint16_t pd4_sum(wire::ByteView block) {
    const auto before = block.first(block.size() - std::min<std::size_t>(block.size(), 2));
    return static_cast<std::uint16_t>(std::accumulate(before.begin(), before.end(), 0U));
}

wire::Bytes encode(Pd4 block) {
    block.checksum = pd4_sum(wire::serialise(block));
    return wire::serialise(block);
}

wire::Result<Pd4> parse_pd4(wire::ByteView bytes) {
    auto block = wire::parse<Pd4>(bytes);
    if (!block) return block.error();
    if (block->checksum != pd4_sum(bytes))
        return wire::Error{"PD4", "checksum", bytes.size() - 2, wire::Reason::wrong_constant};
    return block;
}

}  // namespace echoloop::waterlinked
