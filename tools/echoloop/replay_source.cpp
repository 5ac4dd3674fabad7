#include "tools/echoloop/replay_source.h"

#include <algorithm>

namespace echoloop::cli {
namespace {

using replay::Said;
using replay::WholeMessage;

constexpr double longest = 4e6;  // s; times beyond it are a broken clock

Time time_since(double origin, double time) { return from_seconds(std::clamp(time - origin, 0.0, longest)); }

}  // namespace

CaptureSource::CaptureSource(SourceSettings settings) : settings_(std::move(settings)) { rewind(); }

void CaptureSource::rewind() {
    input_ = std::make_unique<capture::Input>(settings_.file);
    capture_ = capture::open_capture(*input_, settings_.open);
    readers_.clear();
    talks_.clear();
    waiting_.clear();
    begin_.reset();
    origin_.reset();
    last_ = {};
    ended_ = false;
}

std::optional<Said> CaptureSource::next() {
    while (waiting_.empty() && !ended_) ended_ = !read_more();
    if (waiting_.empty()) return {};
    Said said = std::move(waiting_.front());
    waiting_.pop_front();
    return said;
}

/// False at the end of what is played.
bool CaptureSource::read_more() {
    const auto event = capture_->next();
    if (event) {
        if (!begin_) begin_ = event->time;
        const double time = event->time - *begin_;
        if (time < settings_.from) return true;
        if (time <= settings_.until) {
            add(*event);
            return true;
        }
    }
    finish_ways();
    return false;
}

/// What several drivers were told at once is said to the one of a replay once.
bool CaptureSource::is_played(const PlayedPort& port, const capture::PortKey& key,
                              const capture::CaptureEvent& event) {
    const auto driver = capture::driver_of(event, key);
    if (!driver || port.drivers.size() < 2) return true;
    Talk& talk = talks_.try_emplace(key, Talk{*driver, {}}).first->second;
    const ByteView bytes = capture::bytes_of(event);
    if (talk.driver != *driver) {
        const auto last = port.drivers.find(talk.driver);
        if (last != port.drivers.end() && event.time <= last->second) return false;
        talk.driver = *driver;
        if (std::ranges::equal(bytes, talk.last)) return false;  // the one before has heard it just now
    }
    talk.last.assign(bytes.begin(), bytes.end());
    return true;
}

void CaptureSource::add(const capture::CaptureEvent& event) {
    const auto [key, by_first] = capture::origin_of(event, capture_->of_ports());
    const auto wanted =
        std::ranges::find_if(settings_.ports, [&](const auto& p) { return p.keys.contains(key); });
    if (wanted == settings_.ports.end() || !is_played(*wanted, key, event)) return;
    if (!origin_) origin_ = settings_.from > 0 ? *begin_ + settings_.from : event.time;
    const auto* datagram = std::get_if<capture::Datagram>(&event.content);
    if (datagram != nullptr && datagram->cut) return;
    Said said{time_since(*origin_, event.time),
              static_cast<std::size_t>(wanted - settings_.ports.begin()),
              by_first == wanted->keys.at(key),
              {}};
    const ByteView bytes = capture::bytes_of(event);
    if (!settings_.whole_messages) {
        said.bytes.assign(bytes.begin(), bytes.end());
        return say(std::move(said));
    }
    const auto keep = [&](const WholeMessage& message) {
        said.bytes.assign(message.bytes.begin(), message.bytes.end());
        said.name = message.name;
        said.command = message.command;
        say(said);
    };
    auto& reader =
        readers_.try_emplace({key, by_first}, replay::MessageReader(wanted->family, datagram != nullptr))
            .first->second;
    const auto* piece = std::get_if<capture::StreamPiece>(&event.content);
    if (piece != nullptr && piece->gap) reader.finish(keep);
    reader.add(bytes, keep);
}

/// A captured time is that of a message's last byte, so on a paced line its first one goes earlier.
void CaptureSource::say(Said said) {
    const double on_the_line = settings_.ports[said.port].byte_time * static_cast<double>(said.bytes.size());
    if (said.by_device) said.time -= from_seconds(std::min(on_the_line * settings_.speed, longest));
    said.time = std::max(said.time, last_);
    last_ = said.time;
    waiting_.push_back(std::move(said));
}

void CaptureSource::finish_ways() {
    for (auto& [way, reader] : readers_) {
        const auto& [key, by_first] = way;
        const auto wanted =
            std::ranges::find_if(settings_.ports, [&key](const auto& p) { return p.keys.contains(key); });
        Said said{last_,
                  static_cast<std::size_t>(wanted - settings_.ports.begin()),
                  by_first == wanted->keys.at(key),
                  {}};
        reader.finish([&](const WholeMessage& message) {
            said.bytes.assign(message.bytes.begin(), message.bytes.end());
            said.name = message.name;
            said.command = message.command;
            say(said);
        });
    }
}

}  // namespace echoloop::cli
