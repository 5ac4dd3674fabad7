// How tests bring a stream to a framer, in pieces or cut in two, and account for every byte of it.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "protocols/inspect.h"
#include "protocols/wire/bytes.h"

namespace echoloop {

inline wire::Bytes joined(const std::vector<wire::Bytes>& parts) {
    wire::Bytes all;
    for (const wire::Bytes& part : parts) all.insert(all.end(), part.begin(), part.end());
    return all;
}

/// Hands to `take` what `framer` finds in a stream that comes in pieces of `piece` bytes and then ends.
template <class Framer, class Take>
void feed_in_pieces(Framer&& framer, wire::ByteView stream, std::size_t piece, Take take) {
    const auto drain = [&] {
        while (auto found = framer.next()) take(*std::move(found));
    };
    for (; !stream.empty(); stream = stream.subspan(std::min(piece, stream.size()))) {
        framer.feed(stream.first(std::min(piece, stream.size())));
        drain();
    }
    framer.finish();
    drain();
}

template <class Framer>
auto found_in_pieces(Framer framer, wire::ByteView stream, std::size_t piece) {
    std::vector<typename decltype(framer.next())::value_type> all;
    feed_in_pieces(framer, stream, piece, [&](auto found) { all.push_back(std::move(found)); });
    return all;
}

/// What `framer` finds in a stream that comes in two pieces, cut at `at`, and then ends.
template <class Framer>
auto found_in_two(Framer framer, wire::ByteView stream, std::size_t at) {
    std::vector<typename decltype(framer.next())::value_type> all;
    const auto drain = [&] {
        while (auto found = framer.next()) all.push_back(*std::move(found));
    };
    framer.feed(stream.first(at));
    drain();
    framer.feed(stream.subspan(at));
    drain();
    framer.finish();
    drain();
    return all;
}

/// Every byte of a stream of `size` belongs to one message.
inline void expect_all_covered(const std::vector<inspect::Message>& messages, std::size_t size) {
    std::size_t covered = 0;
    for (const inspect::Message& message : messages) {
        EXPECT_EQ(message.offset, covered);
        covered += message.size;
    }
    EXPECT_EQ(covered, size);
}

/// "name|reason" of each message.
inline std::vector<std::string> told(const std::vector<inspect::Message>& messages) {
    std::vector<std::string> lines;
    for (const inspect::Message& message : messages) lines.push_back(message.name + "|" + message.reason);
    return lines;
}

}  // namespace echoloop
