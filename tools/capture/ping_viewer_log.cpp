#include "tools/capture/ping_viewer_log.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "emulator/contract/error.h"
#include "emulator/scenario/problems.h"
#include "emulator/scenario/value.h"

namespace echoloop::capture {
namespace {

// Written by Qt's QDataStream: big-endian, texts as a length in bytes and UTF-16.
constexpr std::string_view magic = "PingViewer sensor log file";
constexpr std::uint32_t null_text = 0xFFFFFFFF;
constexpr std::size_t longest_text = 4096, longest_record = std::size_t{1} << 20;

std::uint32_t u32(ByteView bytes) {
    return std::uint32_t{bytes[0]} << 24 | std::uint32_t{bytes[1]} << 16 | std::uint32_t{bytes[2]} << 8 |
           bytes[3];
}

/// What is not ASCII becomes '?'.
std::string ascii(ByteView utf16) {
    std::string out;
    for (std::size_t i = 0; i + 1 < utf16.size(); i += 2)
        out += utf16[i] == 0 && utf16[i + 1] >= ' ' && utf16[i + 1] <= '~' ? static_cast<char>(utf16[i + 1])
                                                                           : '?';
    return out;
}

/// "hh:mm:ss.zzz", since the log was begun.
std::optional<double> seconds_of(const std::string& text) {
    int hours = 0, minutes = 0, length = 0;
    double seconds = 0;
    if (std::sscanf(text.c_str(), "%4d:%2d:%lf%n", &hours, &minutes, &seconds, &length) != 3) return {};
    const bool good = static_cast<std::size_t>(length) == text.size() && hours >= 0 && minutes >= 0 &&
                      seconds >= 0 && std::isfinite(seconds);
    if (!good) return {};
    return hours * 3600.0 + minutes * 60.0 + seconds;
}

std::string line_name(std::uint32_t device) {
    constexpr std::uint32_t ping1d = 1, ping360 = 2;
    return device == ping360 ? "Ping360" : device == ping1d ? "Ping1D" : "sensor";
}

}  // namespace

bool PingViewerLog::recognises(Input& input) {
    const Bytes& start = input.peek(4 + 2 * magic.size());
    if (start.size() < 4 + 2 * magic.size()) return false;
    const ByteView text = ByteView(start).subspan(4, 2 * magic.size());
    return u32(start) == 2 * magic.size() && ascii(text) == magic;
}

PingViewerLog::PingViewerLog(Input& input) : input_(input) {
    const auto name = text();
    const auto version = number();
    bool good = name == magic && version == 1u;
    for (int i = 0; i < 5; ++i) good = good && text().has_value();  // program's hash, date and tag; system
    const auto family = number(), device = number();
    if (!good || !family || !device)
        throw StartError(Exit::data,
                         scenario::in_quotes(input.name()) +
                             ": the header of this Ping Viewer log cannot be read (version 1 can)");
    line_ = line_name(*device);
}

std::optional<std::uint32_t> PingViewerLog::number() {
    const Bytes bytes = input_.read(4);
    at_ += bytes.size();
    if (bytes.size() < 4) return {};
    return u32(bytes);
}

std::optional<std::string> PingViewerLog::text() {
    const auto size = number();
    if (!size) return {};
    if (*size == null_text) return "";
    if (*size > longest_text) return {};
    const Bytes bytes = input_.read(*size);
    at_ += bytes.size();
    if (bytes.size() < *size) return {};
    return ascii(bytes);
}

std::optional<CaptureEvent> PingViewerLog::fail(const std::string& why) {
    counts_.fault = "byte " + std::to_string(at_) + ": " + why;
    return {};
}

std::optional<CaptureEvent> PingViewerLog::next() {
    if (!counts_.fault.empty() || input_.peek(1).empty()) return {};
    const auto time_text = text();
    if (!time_text) return fail("a record without its time");
    const auto time = seconds_of(*time_text);
    if (!time) return fail("a time that is none: " + scenario::in_quotes(*time_text));
    const auto size = number();
    if (!size || *size > longest_record) return fail("a record of an impossible size");
    Bytes bytes = input_.read(*size);
    at_ += bytes.size();
    if (bytes.size() < *size) return fail("the last record is cut short");
    ++counts_.packets;
    return CaptureEvent{*time, "", true, StreamPiece{line_, true, {}, {}, std::move(bytes)}, counts_.packets};
}

}  // namespace echoloop::capture
