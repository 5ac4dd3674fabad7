// Reads a parsed JSON tree with its path at hand, so that each complaint names its place. Never throws
// anything but SceneFault.
#pragma once

#include <nlohmann/json.hpp>

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string>
#include <vector>

namespace echoloop {

class JsonView {
  public:
    JsonView(const nlohmann::json& value, std::string place) : value_(&value), place_(std::move(place)) {}

    const nlohmann::json& value() const { return *value_; }
    const std::string& place() const { return place_; }

    /// The member `key` of this object, or empty when it is absent. Throws when this is not an object.
    std::optional<JsonView> find(const char* key) const;
    /// The member `key` of this object. Throws when there is none.
    JsonView need(const char* key) const;
    /// The elements of this array, at most `most` of them.
    std::vector<JsonView> elements(std::size_t most) const;
    /// The elements of the array `key`; none when it is absent.
    std::vector<JsonView> elements_of(const char* key, std::size_t most) const;

    std::uint64_t integer(std::uint64_t least, std::uint64_t most) const;
    /// An index into something with `count` elements, called `what` in the complaint.
    std::uint64_t index(std::size_t count, const char* what) const;
    double number() const;
    bool boolean() const;
    const std::string& text() const;
    /// `count` finite numbers.
    std::vector<double> numbers(std::size_t count) const;

  private:
    void expect(bool good, const std::string& what) const;
    const nlohmann::json* value_;
    std::string place_;
};

}  // namespace echoloop
