// What every fuzz target of a byte stream does with a framer: bytes in pieces, then the end.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>
#include <type_traits>

#include "protocols/wire/bytes.h"

namespace echoloop {

/// Feeds `stream` to `framer` in pieces of `piece` bytes, hands each frame to `take`, and ends the stream.
/// Aborts if more than `longest` bytes wait for more, if any wait at the end, if a byte is neither in a frame
/// nor counted as skipped nor one of `quiet`, or if `take` returns another number of bytes than the framer
/// says.
template <class Framer, class Take>
void stream_in_pieces(Framer& framer, wire::ByteView stream, std::size_t piece, std::size_t longest,
                      Take take, std::string_view quiet = {}) {
    std::uint64_t framed = 0;
    const auto drain = [&] {
        while (const auto frame = framer.next()) {
            framed += framer.frame_size();
            if constexpr (std::is_void_v<decltype(take(*frame))>)
                take(*frame);
            else if (take(*frame) != framer.frame_size())
                std::abort();
        }
    };
    for (std::size_t at = 0; at < stream.size(); at += piece) {
        framer.feed(stream.subspan(at, std::min(piece, stream.size() - at)));
        drain();
        if (framer.pending_bytes() > longest) std::abort();
    }
    framer.finish();
    drain();
    const std::uint64_t counted = framed + framer.skipped_bytes();
    const auto uncounted = std::ranges::count_if(
        stream, [&](std::uint8_t byte) { return quiet.find(static_cast<char>(byte)) != quiet.npos; });
    if (counted > stream.size() || counted + static_cast<std::uint64_t>(uncounted) < stream.size())
        std::abort();
    if (framer.pending_bytes() != 0) std::abort();
}

}  // namespace echoloop
