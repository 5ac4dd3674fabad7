#include "tools/capture/message_file.h"

#include <algorithm>

#include "tools/capture/message_time.h"

namespace echoloop::capture {
namespace {

constexpr std::size_t bytes_at_once = std::size_t{64} << 10;

/// What the device said of a message in the file: a shot is a reply with a header and zeros around it.
ByteView said_of(const inspect::Message& message, ByteView bytes) {
    constexpr std::size_t shot_header = 100;
    if (!message.name.starts_with("Shot")) return bytes;
    const auto size = std::ranges::find(message.fields, "reply_bytes", &inspect::Field::name);
    if (size == message.fields.end() || !size->number || bytes.size() < shot_header) return bytes;
    const ByteView rest = bytes.subspan(shot_header);
    return rest.first(std::min(rest.size(), static_cast<std::size_t>(*size->number)));
}

/// What the program wrote that made the file, and no device said.
bool is_remark(const inspect::Message& message) { return message.name == "JsonWrapper"; }

}  // namespace

const inspect::Family* MessageFile::recognise(Input& input) {
    const auto* family = inspect::guess_family(input.peek(bytes_at_once));
    return family != nullptr && family->framing == inspect::Framing::stream ? family : nullptr;
}

MessageFile::MessageFile(Input& input, const inspect::Family& family, double interval)
    : input_(input), line_(family.name), interval_(interval), decoder_(&family) {}

std::optional<CaptureEvent> MessageFile::next() {
    const auto each = [this](const inspect::Family*, const inspect::Message& message, ByteView bytes) {
        keep(message, bytes);
    };
    while (waiting_.empty() && !ended_) {
        const Bytes bytes = input_.read(bytes_at_once);
        ended_ = bytes.empty();
        ended_ ? decoder_.finish(each) : decoder_.add(bytes, each);
    }
    if (waiting_.empty()) return {};
    CaptureEvent event = std::move(waiting_.front());
    waiting_.pop_front();
    return event;
}

void MessageFile::keep(const inspect::Message& message, ByteView bytes) {
    if (is_remark(message)) return;
    if (message.name.empty()) {
        ++counts_.skipped;
        return;
    }
    if (interval_ > 0) {
        time_ = interval_ * static_cast<double>(counts_.packets);
    } else if (const auto time = message_time(message)) {
        time_ = *time;
    }
    ++counts_.packets;
    const ByteView said = said_of(message, bytes);
    waiting_.push_back({time_, "", true, StreamPiece{line_, true, {}, {}, Bytes(said.begin(), said.end())}, 0,
                        "", message.name});
}

}  // namespace echoloop::capture
