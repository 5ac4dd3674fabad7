// Messages of ROS 2 as bytes: CDR, plain, little endian (OMG DDS-RTPS 10.2; DDS-XTypes calls it XCDR1).
#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>

namespace echoloop::bag {

class Cdr {
  public:
    Cdr() : bytes_("\x00\x01\x00\x00", 4) {}

    /// Padded to its own size.
    template <class T>
    requires std::is_arithmetic_v<T> Cdr& number(T value) {
        static_assert(std::endian::native == std::endian::little);
        bytes_.append((sizeof value - (bytes_.size() - head) % sizeof value) % sizeof value, '\0');
        bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
        return *this;
    }
    Cdr& flag(bool value) { return number(static_cast<std::uint8_t>(value)); }
    Cdr& length(std::size_t count) { return number(static_cast<std::uint32_t>(count)); }
    Cdr& text(std::string_view text) {
        length(text.size() + 1);
        bytes_.append(text);
        bytes_ += '\0';
        return *this;
    }
    /// A sequence.
    template <class T>
    Cdr& numbers(std::span<const T> values) {
        length(values.size());
        for (const T value : values) number(value);
        return *this;
    }
    Cdr& bytes(std::string_view bytes) {
        length(bytes.size());
        bytes_.append(bytes);
        return *this;
    }
    std::string take() { return std::move(bytes_); }

  private:
    static constexpr std::size_t head = 4;  ///< which says how it is written, and is no part of it
    std::string bytes_;
};

}  // namespace echoloop::bag
