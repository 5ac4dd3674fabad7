// Strict reading of one map of the scenario: every key must be known, every value of its type and in its
// range. A fault is added to the problems and the default is returned, so that reading goes on and finds the
// next one.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/scenario/problems.h"
#include "emulator/scenario/value.h"
#include "render/pose.h"

namespace echoloop::scenario {

/// Inclusive bounds of a number, and the unit for messages ("" if none).
struct Range {
    double minimum;
    double maximum;
    std::string_view unit;
};

/// "-2 to 40 degC".
std::string text_of(const Range& range);

/// Checks single values; `path` is the value's name in messages.
class Checker {
  public:
    explicit Checker(Problems& problems) : problems_(problems) {}

    bool number(const Value& value, const std::string& path, const Range& range, double& result);
    bool whole(const Value& value, const std::string& path, const Range& range, std::int64_t& result);
    bool truth(const Value& value, const std::string& path, bool& result);
    bool text(const Value& value, const std::string& path, std::string& result);
    /// Text that must be one of `words`.
    bool word(const Value& value, const std::string& path, const std::vector<std::string_view>& words,
              std::string& result);
    /// Three numbers of that range.
    bool triple(const Value& value, const std::string& path, const Range& range, Vec3& result);

    bool fail(const Value& value, const std::string& path, const std::string& message);
    Problems& problems() { return problems_; }

  private:
    bool expected(const Value& value, const std::string& path, const std::string& what);
    Problems& problems_;
};

/// A map of which all keys are known. A null `value` stands for an absent or empty one.
class Section {
  public:
    Section(const Value* value, std::string path, const std::vector<std::string_view>& keys,
            Problems& problems);

    const Value* get(std::string_view key) const;
    std::string path_of(std::string_view key) const;
    Place place() const;

    double number(std::string_view key, double fallback, const Range& range) const;
    std::string text(std::string_view key, std::string fallback) const;
    std::string word(std::string_view key, std::string fallback,
                     const std::vector<std::string_view>& words) const;
    Vec3 triple(std::string_view key, const Range& range) const;

  private:
    const Value* map_ = nullptr;
    Place place_;
    std::string path_;
    Problems& problems_;
};

}  // namespace echoloop::scenario
