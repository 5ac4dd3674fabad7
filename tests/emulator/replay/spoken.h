// A capture as a list in memory, for tests of players.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "emulator/replay/player.h"

namespace echoloop::replay {

inline Time ms(double milliseconds) { return from_seconds(milliseconds * 1e-3); }
inline Bytes bytes_of(std::string_view text) { return {text.begin(), text.end()}; }
inline std::string text_of(const Bytes& bytes) { return {bytes.begin(), bytes.end()}; }

/// What the device said; `name` groups messages of a kind.
inline Said device(double at, std::string_view text, std::string name = "reply") {
    return {ms(at), 0, true, bytes_of(text), std::move(name), {}};
}
/// What its driver asked, as text.
inline Said driver(double at, std::string_view text) {
    return {ms(at), 0, false, bytes_of(text), "", command_of(bytes_of(text))};
}

class Spoken final : public Source {
  public:
    explicit Spoken(std::vector<Said> all) : all_(std::move(all)) {}
    std::optional<Said> next() override {
        if (at_ == all_.size()) return {};
        return all_[at_++];
    }
    void rewind() override { at_ = 0; }

  private:
    std::vector<Said> all_;
    std::size_t at_ = 0;
};

/// Everything that is due up to a time: "12 text" each, ms.
inline std::vector<std::string> said_until(Player& player, double milliseconds) {
    std::vector<std::string> said;
    while (const auto due = player.due()) {
        if (*due > ms(milliseconds)) break;
        const auto at = std::to_string(std::chrono::round<std::chrono::milliseconds>(*due).count());
        said.push_back(at + " " + text_of(player.take().bytes));
    }
    return said;
}

}  // namespace echoloop::replay
