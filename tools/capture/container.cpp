#include "tools/capture/container.h"

#include "emulator/contract/error.h"
#include "emulator/scenario/value.h"

namespace echoloop::capture {
namespace {

constexpr std::size_t block_of_records = std::size_t{256} << 10;

}  // namespace

ContainerFile::ContainerFile(Input& input, std::unique_ptr<Container> container, std::string line,
                             Speech speech, std::uint64_t begin)
    : input_(input),
      container_(std::move(container)),
      line_(std::move(line)),
      speech_(speech),
      place_(begin) {}

/// As much again as waits already, so that a long record costs no square.
bool ContainerFile::read_more() {
    pending_.erase(pending_.begin(), pending_.begin() + static_cast<std::ptrdiff_t>(at_));
    at_ = 0;
    const Bytes more = input_.read(std::max(block_of_records, pending_.size()));
    pending_.insert(pending_.end(), more.begin(), more.end());
    return !more.empty();
}

std::optional<CaptureEvent> ContainerFile::next() {
    while (waiting_.empty()) {
        const ByteView rest = ByteView(pending_).subspan(at_);
        if (rest.empty() && ended_) {
            end();
            refuse_others();
            return {};
        }
        Entry entry = rest.empty() ? Entry{} : container_->look(rest, ended_);
        if (entry.size == 0 && !ended_) {
            ended_ = !read_more();
            continue;
        }
        if (entry.size == 0) entry = {.size = rest.size(), .damaged = true};
        at_ += entry.size;
        keep(std::move(entry));
    }
    CaptureEvent event = std::move(waiting_.front());
    waiting_.pop_front();
    return event;
}

/// Damage that nothing follows is a file that ends early.
void ContainerFile::end() {
    if (damaged_ == 0) return;
    counts_.fault = "the last " + std::to_string(damaged_) + " bytes, from byte " +
                    std::to_string(place_ - damaged_) + " on, are no whole record";
    counts_.damaged_bytes -= damaged_;
    damaged_ = 0;
}

void ContainerFile::refuse_others() const {
    const std::string others = counts_.packets == 0 ? container_->others() : "";
    if (!others.empty()) throw StartError(Exit::data, scenario::in_quotes(input_.name()) + ": " + others);
}

void ContainerFile::keep(Entry entry) {
    if (entry.damaged) {
        if (counts_.damaged_bytes == 0) counts_.first_damage = place_;
        counts_.damaged_bytes += entry.size;
    }
    damaged_ = entry.damaged ? damaged_ + entry.size : 0;
    place_ += entry.size;
    if (!entry.said.empty()) ++counts_.packets;
    double time = entry.time;
    for (Bytes& bytes : entry.said) {
        CaptureEvent event{.time = time, .packet = counts_.packets, .clock = entry.clock};
        if (speech_ == Speech::datagrams) {
            event.interface = line_;
            event.sent = true;
            event.content = Datagram{{}, {}, std::move(bytes)};
        } else {
            event.sent = true;
            event.content = StreamPiece{line_, true, {}, {}, std::move(bytes)};
        }
        waiting_.push_back(std::move(event));
        time += entry.spacing;
    }
}

}  // namespace echoloop::capture
