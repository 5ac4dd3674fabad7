#include "tools/capture/ping_viewer_log.h"

#include <algorithm>

#include "emulator/contract/error.h"
#include "emulator/scenario/value.h"
#include "tools/capture/container.h"

namespace echoloop::capture {
namespace {

// Written by Qt's QDataStream: big-endian, texts as a length in bytes and UTF-16; or re-encoded as UTF-8.
constexpr std::string_view magic = "PingViewer sensor log file";
constexpr std::uint32_t null_text = 0xFFFFFFFF;
constexpr std::size_t longest_text = 4096;
constexpr std::size_t longest_frame =
    2440;  // B that the program itself reads; behind a longer one it looks for a time
constexpr std::string_view time_form = "00:00:00.000";

std::uint32_t u32_big(ByteView bytes) {
    return std::uint32_t{bytes[0]} << 24 | std::uint32_t{bytes[1]} << 16 | std::uint32_t{bytes[2]} << 8 |
           bytes[3];
}

/// What is not ASCII becomes '?'. `width`: B of a character.
std::string ascii(ByteView text, std::size_t width) {
    std::string out;
    for (std::size_t i = 0; i + width <= text.size(); i += width) {
        const std::uint8_t last = text[i + width - 1];
        const bool plain = (width == 1 || text[i] == 0) && last >= ' ' && last <= '~';
        out += plain ? static_cast<char>(last) : '?';
    }
    return out;
}

/// "hh:mm:ss.zzz", since the log was begun.
std::optional<double> seconds_of(std::string_view text) {
    if (text.size() != time_form.size()) return {};
    double fields[4] = {};
    std::size_t field = 0;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const bool digit = text[i] >= '0' && text[i] <= '9';
        if (digit != (time_form[i] == '0') || (!digit && text[i] != time_form[i])) return {};
        if (digit)
            fields[field] = fields[field] * 10 + (text[i] - '0');
        else
            ++field;
    }
    return fields[0] * 3600 + fields[1] * 60 + fields[2] + fields[3] * 1e-3;
}

std::string line_name(std::uint32_t device) {
    constexpr std::uint32_t ping1d = 1, ping360 = 2;
    return device == ping360 ? "Ping360" : device == ping1d ? "Ping1D" : "sensor";
}

class ViewerRecords final : public Container {
  public:
    explicit ViewerRecords(std::size_t width) : width_(width) {}

    Entry look(ByteView pending, bool last) override {
        const auto record = record_at(pending);
        // A frame that does not say how long it is counts if another record follows it, or nothing.
        const bool enough = last || pending.size() >= head() + longest_frame + head();
        if (!enough && !(record && record->sure)) return {};
        const bool good = record && (record->sure || record->end == pending.size() ||
                                     time_at(pending.subspan(record->end)));
        if (!good) {
            const auto may_begin = [this, last](ByteView rest) {
                return time_at(rest) && (record_at(rest) || !last);
            };
            return {.size = distance_to_next(pending, last, head(), may_begin), .damaged = true};
        }
        const ByteView said = pending.subspan(head(), record->end - head());
        return {.size = record->end, .time = record->time, .said = {Bytes(said.begin(), said.end())}};
    }

  private:
    struct Record {
        double time = 0;
        std::size_t end = 0;
        bool sure = false;  ///< its frame is as long as it says itself
    };

    std::size_t text_size() const { return width_ * time_form.size(); }
    /// Lengths and time before the frame.
    std::size_t head() const { return 4 + text_size() + 4; }

    std::optional<double> time_at(ByteView bytes) const {
        if (bytes.size() < head() || u32_big(bytes) != text_size()) return {};
        return seconds_of(ascii(bytes.subspan(4, text_size()), width_));
    }

    /// All of it is there.
    std::optional<Record> record_at(ByteView bytes) const {
        const auto time = time_at(bytes);
        if (!time) return {};
        const std::size_t size = u32_big(bytes.subspan(head() - 4));
        if (size > longest_frame || size > bytes.size() - head()) return {};
        const ByteView said = bytes.subspan(head(), size);
        constexpr std::size_t around = 10;  // B of a Ping frame beside its payload
        const bool sure = size >= around && said[0] == 'B' && said[1] == 'R' &&
                          size == around + said[2] + (std::size_t{said[3]} << 8);
        return Record{*time, head() + size, sure};
    }

    std::size_t width_;
};

/// The beginning of the file, before its records.
class ViewerHeader {
  public:
    ViewerHeader(Input& input, std::size_t width) : input_(input), width_(width) {}

    std::optional<std::uint32_t> number() {
        const Bytes bytes = input_.read(4);
        read_ += bytes.size();
        if (bytes.size() < 4) return {};
        return u32_big(bytes);
    }
    std::optional<std::string> text() {
        const auto size = number();
        if (!size) return {};
        if (*size == null_text) return "";
        if (*size > longest_text) return {};
        const Bytes bytes = input_.read(*size);
        read_ += bytes.size();
        if (bytes.size() < *size) return {};
        return ascii(bytes, width_);
    }
    std::uint64_t size() const { return read_; }

  private:
    Input& input_;
    std::size_t width_;
    std::uint64_t read_ = 0;
};

/// B of a character; 0 if this is no log.
std::size_t width_of(Input& input) {
    const Bytes& start = input.peek(4 + 2 * magic.size());
    for (const std::size_t width : {1, 2}) {
        const std::size_t size = width * magic.size();
        if (start.size() >= 4 + size && u32_big(start) == size &&
            ascii(ByteView(start).subspan(4, size), width) == magic)
            return width;
    }
    return 0;
}

}  // namespace

std::unique_ptr<CaptureReader> open_ping_viewer_log(Input& input, const OpenSettings&) {
    const std::size_t width = width_of(input);
    if (width == 0) return nullptr;
    ViewerHeader header(input, width);
    const auto name = header.text();
    const auto version = header.number();
    bool good = name == magic && version == 1u;
    for (int i = 0; i < 5; ++i)
        good = good && header.text().has_value();  // program's hash, date, tag; system
    const auto family = header.number(), device = header.number();
    if (!good || !family || !device)
        throw StartError(Exit::data,
                         scenario::in_quotes(input.name()) +
                             ": the header of this Ping Viewer log cannot be read (version 1 can)");
    return std::make_unique<ContainerFile>(input, std::make_unique<ViewerRecords>(width), line_name(*device),
                                           ContainerFile::Speech::stream, header.size());
}

}  // namespace echoloop::capture
