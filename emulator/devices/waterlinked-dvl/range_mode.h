// The range modes of a DVL: which depths it looks for the bottom in, and how often. Pure functions and a
// small state machine; knows no message.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "emulator/contract/device.h"

namespace echoloop::waterlinked_dvl {

inline constexpr int modes = 5;

/// What a host sets: "auto", "=2", "1<=3", or "wt" (water tracking).
struct RangeMode {
    int lowest = 0, highest = modes - 1;
    std::string text = "auto";
    bool water = false;
    friend bool operator==(const RangeMode&, const RangeMode&) = default;
};
std::optional<RangeMode> read_range_mode(std::string_view text);

/// Altitudes, m, that a mode is for, and its pings a second.
struct ModeFigures {
    double nearest = 0, farthest = 0, rate = 0;
};
/// `highest_altitude`: of the device, m, where the last mode ends.
ModeFigures figures_of(int mode, double highest_altitude);
/// Of water tracking: the layer instead of altitudes.
inline constexpr ModeFigures water_layer{1.5, 4.5, 2};

/// Chooses the mode of the next ping: it follows the bottom, goes through all modes without one, and looks
/// for a nearer one now and then.
class ModeSearch {
  public:
    void restart(const RangeMode& allowed);
    /// Of the ping that goes out now. `cycling`: nearer modes are tried every ten seconds.
    int next(bool cycling, Time now);
    /// What that ping found.
    void found(std::optional<double> altitude, double highest_altitude, Time now);
    bool locked() const { return locked_; }
    /// Whether the last ping was a try that found nothing: nobody hears of it.
    bool lost() const { return lost_; }

  private:
    RangeMode allowed_;
    int mode_ = 0, tried_ = 0;
    bool locked_ = false, trying_ = false, lost_ = false;
    int misses_ = 0;
    Time last_try_{};
};

}  // namespace echoloop::waterlinked_dvl
