// A parsed value or the place and reason why there is none. Never throws and never allocates for an error.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <variant>

namespace echoloop::wire {

enum class Reason {
    truncated,        ///< the bytes end before the field does, or a count claims more than there is
    trailing_bytes,   ///< bytes left over behind the last field
    wrong_constant,   ///< a byte that is always the same is not
    wrong_count,      ///< a count that contradicts another one or is below its least value
    wrong_size,       ///< a size field or a rest that no form of the message has
    wrong_section,    ///< another section than the one that stands here
    unknown_message,  ///< no layout for this message
};

std::string_view text(Reason reason);

/// All views point at string literals.
struct Error {
    std::string_view message;  ///< e.g. "HeadData"
    std::string_view field;    ///< e.g. "bins"; empty if it is about the whole message
    std::size_t offset = 0;    ///< byte offset, counted as the layout counts
    Reason reason = Reason::truncated;

    /// "HeadData.bins at byte 44: ..."
    std::string what() const;
    friend bool operator==(const Error&, const Error&) = default;
};

template <class T>
class Result {
  public:
    Result(T value) : state_(std::in_place_index<0>, std::move(value)) {}
    Result(Error error) : state_(std::in_place_index<1>, error) {}

    bool has_value() const { return state_.index() == 0; }
    explicit operator bool() const { return has_value(); }

    /// Only if has_value().
    const T& operator*() const& { return *std::get_if<0>(&state_); }
    T& operator*() & { return *std::get_if<0>(&state_); }
    T&& operator*() && { return std::move(*std::get_if<0>(&state_)); }
    const T* operator->() const { return std::get_if<0>(&state_); }
    T* operator->() { return std::get_if<0>(&state_); }

    /// Only if !has_value().
    const Error& error() const { return *std::get_if<1>(&state_); }

  private:
    std::variant<T, Error> state_;
};

}  // namespace echoloop::wire
