#include "emulator/replay/message_reader.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace echoloop::replay {
namespace {

/// Whether a driver speaks HTTP.
bool is_http(ByteView bytes) {
    constexpr std::array<std::string_view, 4> methods{"GET /", "POST /", "PUT /", "DELETE /"};
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    return std::ranges::any_of(methods, [text](auto method) { return text.starts_with(method); });
}

bool is_whole(const inspect::Message& message) { return !message.name.empty() && message.reason.empty(); }

/// A frame whose content cannot be decoded asks for the same as another one of the same bytes.
Command command_in(const inspect::Message& message, ByteView bytes) {
    if (is_whole(message)) return command_of(message);
    if (message.name.empty()) return {};
    return {message.name + " " + std::string(bytes.begin(), bytes.end()), {}};
}

}  // namespace

void MessageReader::add(ByteView bytes, const Each& each) {
    if (family_ == nullptr && !datagrams_ && (http_ || is_http(bytes))) return add_http(bytes, each);
    if (datagrams_ || family_ == nullptr) return add_whole(bytes, each);
    stream_.add(bytes, decoded(each));
}

void MessageReader::finish(const Each& each) {
    if (!datagrams_ && family_ != nullptr) stream_.finish(decoded(each));
}

void MessageReader::clear() {
    stream_ = inspect::StreamDecoder(family_);
    http_.reset();
}

void MessageReader::add_http(ByteView bytes, const Each& each) {
    if (!http_) http_.emplace();
    http_->feed(bytes);
    while (const auto next = http_->next()) {
        const auto* request = std::get_if<http::Request>(&*next);
        if (request == nullptr) {
            each({bytes, "", {}});
        } else {
            each({{}, request->method + " " + request->target, command_of(*request)});
        }
    }
}

inspect::StreamDecoder::Each MessageReader::decoded(const Each& each) {
    return [&each](const inspect::Family*, const inspect::Message& message, wire::ByteView bytes) {
        each({bytes, message.name, command_in(message, bytes)});
    };
}

/// The first message in a datagram stands for all of it.
void MessageReader::add_whole(ByteView bytes, const Each& each) const {
    if (family_ == nullptr) return each({bytes, "", command_of(bytes)});
    const auto messages = family_->decode(bytes);
    const auto first =
        std::ranges::find_if(messages, [](const auto& message) { return !message.name.empty(); });
    if (first == messages.end()) return each({bytes, "", {}});
    each({bytes, first->name, command_in(*first, bytes)});
}

}  // namespace echoloop::replay
