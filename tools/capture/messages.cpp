#include "tools/capture/messages.h"

#include <algorithm>
#include <utility>

namespace echoloop::capture {
namespace {

using inspect::Message;

bool is_whole(const std::vector<Message>& messages) {
    return !messages.empty() &&
           std::none_of(messages.begin(), messages.end(), [](const Message& m) { return m.name.empty(); });
}

}  // namespace

void MessageSorter::add(const CaptureEvent& event) {
    MessageOrigin origin{{}, nullptr, event.time, event.packet};
    if (const auto* piece = std::get_if<StreamPiece>(&event.content)) {
        origin.way = {piece->from.port == 0 ? piece->line : "", piece->from.port == 0 && piece->sent,
                      piece->from, piece->to};
        add(origin, *piece);
    } else {
        const auto& datagram = std::get<Datagram>(event.content);
        origin.way = {datagram.from.port == 0 ? event.interface : "",
                      datagram.from.port == 0 && event.sent.value_or(false), datagram.from, datagram.to};
        add(origin, datagram);
    }
}

void MessageSorter::add(const MessageOrigin& origin, const StreamPiece& piece) {
    if (piece.gap) end(streams_, origin.way);
    continue_with(streams_, origin, piece.bytes);
}

/// A datagram is read alone where that tells all of it, as nearly always. What is left of others goes on in
/// the next one of the same direction.
void MessageSorter::add(const MessageOrigin& origin, const Datagram& datagram) {
    const auto* family = family_ != nullptr ? family_ : inspect::guess_family(datagram.payload);
    if (datagram.cut) {
        end(datagrams_, origin.way);
        const char* reason = family == nullptr ? "no known protocol" : "cut short by the capture";
        return giver(origin)(family, {.offset = 0, .size = datagram.payload.size(), .reason = reason}, {});
    }
    const bool alone = family != nullptr && family->framing == inspect::Framing::datagram;
    const auto payload =
        family == nullptr ? datagram.payload : whole_of(*family, origin.way, datagram.payload);
    const auto messages = family == nullptr ? std::vector<Message>{} : family->decode(payload);
    if (!alone && !is_whole(messages)) return continue_with(datagrams_, origin, datagram.payload);
    if (!alone) end(datagrams_, origin.way);
    for (const auto& message : messages) giver(origin)(family, message, {});
}

/// The last part of a divided datagram stands for the whole.
Bytes MessageSorter::whole_of(const inspect::Family& family, const Way& way, const Bytes& datagram) {
    constexpr std::size_t most = 16;  // ways of up to 8 MiB
    if (family.join == nullptr) return datagram;
    if (!joining_.contains(way) && joining_.size() >= most) joining_.clear();
    Bytes& held = joining_[way];
    return family.join(held, datagram) ? std::exchange(held, {}) : datagram;
}

void MessageSorter::finish() {
    for (Streams* streams : {&streams_, &datagrams_}) {
        for (auto& [way, stream] : *streams) stream.decoder.finish(giver(stream.last));
        streams->clear();
    }
}

void MessageSorter::continue_with(Streams& streams, const MessageOrigin& origin, ByteView bytes) {
    constexpr std::size_t most = 4096;
    if (!streams.contains(origin.way) && streams.size() >= most) finish();
    Stream& stream =
        streams.try_emplace(origin.way, Stream{inspect::StreamDecoder(family_), origin}).first->second;
    stream.last = origin;
    stream.decoder.add(bytes, giver(origin));
}

/// What did not become complete never will.
void MessageSorter::end(Streams& streams, const Way& way) {
    const auto found = streams.find(way);
    if (found != streams.end()) found->second.decoder.finish(giver(found->second.last));
}

inspect::StreamDecoder::Each MessageSorter::giver(const MessageOrigin& origin) const {
    return [this, origin](const inspect::Family* family, const Message& message, auto&&...) {
        MessageOrigin known = origin;
        known.family = family;
        each_(known, message);
    };
}

}  // namespace echoloop::capture
