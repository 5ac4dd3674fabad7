#include "tools/capture/stream_windows.h"

#include <algorithm>

namespace echoloop::capture {
namespace {

constexpr std::size_t smallest_window = std::size_t{512} << 10;

/// Joins undecoded spans that touch.
class Joiner {
  public:
    explicit Joiner(const std::function<void(const inspect::Message&)>& each) : each_(each) {}

    void add(inspect::Message message) {
        const bool noise = message.name.empty();
        if (noise && noise_.size > 0 && noise_.reason == message.reason) {
            noise_.size += message.size;
            return;
        }
        finish();
        if (noise) {
            noise_ = std::move(message);
        } else {
            each_(message);
        }
    }

    void finish() {
        if (noise_.size > 0) each_(noise_);
        noise_ = {};
    }

  private:
    const std::function<void(const inspect::Message&)>& each_;
    inspect::Message noise_;  ///< size 0: none
};

void move_to(inspect::Message& message, std::size_t base) {
    message.offset += base;
    for (auto& field : message.fields) field.offset += base;
}

}  // namespace

std::size_t decode_windows(Input& input, const inspect::Family& family,
                           const std::function<void(const inspect::Message&)>& each) {
    Joiner joiner(each);
    const std::size_t window = std::max(smallest_window, 2 * family.longest_frame);
    Bytes bytes;
    std::size_t base = 0;
    while (true) {
        const auto more = input.read(window);
        bytes.insert(bytes.end(), more.begin(), more.end());
        const bool last = more.size() < window;
        // A frame that begins before `safe` lies wholly in the window: the bytes to come cannot change it.
        const std::size_t safe = last ? bytes.size() : bytes.size() - family.longest_frame;
        std::size_t done = 0;
        for (auto& message : family.decode(bytes)) {
            if (message.offset >= safe) break;
            if (message.name.empty()) message.size = std::min(message.size, safe - message.offset);
            done = message.offset + message.size;
            move_to(message, base);
            joiner.add(std::move(message));
        }
        base += done;
        if (last) break;
        bytes.erase(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(done));
    }
    joiner.finish();
    return base;
}

}  // namespace echoloop::capture
