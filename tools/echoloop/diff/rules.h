// What is expected of a field when two captures are compared: by name, by default and as the user says.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

namespace echoloop::diff {

/// Arrays longer than this are samples, and compared by their statistics.
inline constexpr std::size_t longest_exact_array = 16;
/// Of the rms of samples, as a fraction.
inline constexpr double usual_rms_tolerance = 0.1;

struct Rule {
    bool ignored = false;    ///< the user does not want to know
    bool varies = false;     ///< must differ between two runs: times, counters, checksums
    bool has_limit = false;  ///< the user has given one
    double limit =
        0;  ///< greatest difference that is none; of samples: of the rms, as a fraction, 0: exactly
};

class Rules {
  public:
    void ignore(const std::string& field) { ignored_.insert(field); }
    void set_limit(const std::string& field, double limit) { limits_[field] = limit; }
    /// Every field is compared as it is.
    void compare_everything() { everything_ = true; }

    /// `field`: its name with those around it. A user's name is the whole of it, its last word, or
    /// "MESSAGE.FIELD".
    Rule of(const std::string& message, const std::string& field) const;
    /// Names given by the user that fit no field so far.
    std::vector<std::string> unused() const;

  private:
    std::set<std::string> ignored_;
    std::map<std::string, double> limits_;
    mutable std::set<std::string> used_;
    bool everything_ = false;
};

}  // namespace echoloop::diff
