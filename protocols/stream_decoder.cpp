#include "protocols/stream_decoder.h"

#include "protocols/http/inspect.h"

namespace echoloop::inspect {
namespace {

constexpr std::size_t enough_to_guess = std::size_t{512} << 10;

/// Bytes that must come before a long tail is worth another look, so that one byte at a time costs no square.
std::size_t worth_a_look(std::size_t tried) { return tried < 4096 ? 1 : tried / 8; }

}  // namespace

void StreamDecoder::add(wire::ByteView bytes, const Each& each) {
    waiting_.insert(waiting_.end(), bytes.begin(), bytes.end());
    if (waiting_.size() >= tried_ + worth_a_look(tried_)) {
        const std::size_t most = family_ == nullptr ? enough_to_guess : 2 * family_->longest_frame;
        decode(waiting_.size() > most, each);
    }
}

void StreamDecoder::finish(const Each& each) {
    if (!waiting_.empty()) decode(true, each);
}

void StreamDecoder::drop(std::size_t count) {
    waiting_.erase(waiting_.begin(), waiting_.begin() + static_cast<std::ptrdiff_t>(count));
    offset_ += count;
}

/// False where the bytes that wait are no HTTP; else what is left of them is not whole.
bool StreamDecoder::decode_http(const Each& each) {
    while (http::begins(waiting_)) {
        auto message = http::first_message(waiting_);
        if (!message) return true;
        message->offset = offset_;
        each(family_, *message, wire::ByteView(waiting_).first(message->size));
        drop(message->size);
        if (waiting_.empty()) return true;
    }
    return false;
}

void StreamDecoder::decode(bool last, const Each& each) {
    if (family_ != nullptr && decode_http(each) && !last) {
        tried_ = waiting_.size();
        return;
    }
    if (family_ == nullptr) family_ = guess_family(waiting_);
    std::size_t done = 0;
    if (family_ == nullptr && last) {
        each(nullptr, {.offset = offset_, .size = waiting_.size(), .reason = "no known protocol"}, waiting_);
        done = waiting_.size();
    } else if (family_ != nullptr) {
        for (auto& message : family_->decode(waiting_)) {
            const bool incomplete = message.name.empty() || !message.reason.empty();
            if (!last && incomplete && message.offset + message.size == waiting_.size()) break;
            const auto bytes = wire::ByteView(waiting_).subspan(message.offset, message.size);
            done = message.offset + message.size;
            message.offset += offset_;
            for (auto& field : message.fields) field.offset += offset_;
            each(family_, message, bytes);
        }
    }
    drop(done);
    tried_ = waiting_.size();
}

}  // namespace echoloop::inspect
