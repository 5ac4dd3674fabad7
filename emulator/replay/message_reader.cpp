#include "emulator/replay/message_reader.h"

#include <algorithm>

namespace echoloop::replay {
namespace {

bool is_whole(const inspect::Message& message) { return !message.name.empty() && message.reason.empty(); }

}  // namespace

void MessageReader::add(ByteView bytes, const Each& each) {
    if (datagrams_ || family_ == nullptr) return add_whole(bytes, each);
    stream_.add(bytes, decoded(each));
}

void MessageReader::finish(const Each& each) {
    if (!datagrams_ && family_ != nullptr) stream_.finish(decoded(each));
}

inspect::StreamDecoder::Each MessageReader::decoded(const Each& each) {
    return [&each](const inspect::Family*, const inspect::Message& message, wire::ByteView bytes) {
        if (is_whole(message)) {
            each({bytes, message.name, command_of(message)});
        } else {
            each({bytes, "", {}});
        }
    };
}

/// The first message in a datagram stands for all of it.
void MessageReader::add_whole(ByteView bytes, const Each& each) const {
    if (family_ == nullptr) return each({bytes, "", command_of(bytes)});
    const auto messages = family_->decode(bytes);
    const auto first = std::ranges::find_if(messages, is_whole);
    if (first == messages.end()) return each({bytes, "", {}});
    each({bytes, first->name, command_of(*first)});
}

}  // namespace echoloop::replay
