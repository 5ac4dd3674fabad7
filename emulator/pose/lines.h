// Cuts what arrives into lines of bounded length. Knows nothing of what they say.
#pragma once

#include <string>
#include <string_view>
#include <utility>

#include "emulator/contract/device.h"

namespace echoloop {

class Lines {
  public:
    static constexpr std::size_t longest = 4096;  ///< bytes

    /// Calls `line` for each line that is not blank. One that is too long is given as "", once.
    template <class Line>
    void feed(ByteView bytes, Line line) {
        waiting_.append(bytes.begin(), bytes.end());
        std::size_t from = 0;
        for (std::size_t end; (end = waiting_.find('\n', from)) != std::string::npos; from = end + 1) {
            const auto text = std::string_view(waiting_).substr(from, end - from);
            if (!overlong_ && text.find_first_not_of(" \t\r") != std::string_view::npos)
                line(text.size() > longest ? std::string_view() : text);
            overlong_ = false;
        }
        waiting_.erase(0, from);
        if (waiting_.size() <= longest) return;
        if (!std::exchange(overlong_, true)) line(std::string_view());
        waiting_.clear();
    }
    void clear() {
        waiting_.clear();
        overlong_ = false;
    }

  private:
    std::string waiting_;  ///< the beginning of a line
    bool overlong_ = false;
};

}  // namespace echoloop
