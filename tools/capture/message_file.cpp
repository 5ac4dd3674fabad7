#include "tools/capture/message_file.h"

#include <algorithm>
#include <array>

#include "protocols/reson7k/codec.h"
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
bool is_remark(const inspect::Message& message) {
    constexpr std::array names{"JsonWrapper", "FileHeader", "FileCatalogue"};
    return std::ranges::any_of(names, [&](const char* name) { return message.name == name; });
}

/// Files hold 7k records bare; on the network they come in packets.
Bytes in_packets(ByteView record) {
    constexpr std::uint32_t centre = 7000;
    Bytes out;
    if (!reson7k::plausible_record_frame(record)) return {record.begin(), record.end()};
    for (const auto& packet : reson7k::packets_of(record, 0, centre))
        out.insert(out.end(), packet.begin(), packet.end());
    return out;
}

}  // namespace

const inspect::Family* MessageFile::recognise(Input& input) {
    // Sync words that are surer than the first family that finds something in the bytes behind them.
    const Bytes start = input.peek(reson7k::record_frame_size);
    if (reson7k::plausible_record_frame(start)) return inspect::find_family("reson7k");
    const auto* family = inspect::guess_family(input.peek(bytes_at_once));
    return family != nullptr && family->framing == inspect::Framing::stream ? family : nullptr;
}

MessageFile::MessageFile(Input& input, const inspect::Family& family, const OpenSettings& settings)
    : input_(input), line_(family.name), settings_(settings), decoder_(&family) {}

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
    if (settings_.interval > 0) {
        time_ = settings_.interval * static_cast<double>(counts_.packets);
    } else if (const auto time = message_time(message)) {
        time_ = *time;
    }
    ++counts_.packets;
    const ByteView said = said_of(message, bytes);
    Bytes out = settings_.as_sent && line_ == "reson7k" ? in_packets(said) : Bytes(said.begin(), said.end());
    waiting_.push_back(
        {time_, "", true, StreamPiece{line_, true, {}, {}, std::move(out)}, 0, "", message.name});
}

}  // namespace echoloop::capture
